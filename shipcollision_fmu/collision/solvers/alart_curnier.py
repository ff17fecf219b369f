"""Alart-Curnier: all contacts at once by a nonsmooth Newton method.

Contacts that depend on each other almost linearly, such as two plumb stems that meet along a line, would take thousands
of Gauss-Seidel sweeps: each sweep passes an impulse to and fro between them. The law of contact (contact_law.py) is
equivalent to piecewise smooth equations, which Newton's method mostly solves in a few steps:

    P_n = max(0, s),   s = P_n - rho_n v_n(P)                          v(P) = v + W P [m/s], rho [kg]
    P_t = projection of (P_t - rho_t v_t(P)) on the disc of radius mu max(0, s)

W is singular when there are more contacts than degrees of freedom, and nearly singular when contacts are close
together. Newton's method may then cycle. The proximal point method leads it to the solution:

    solve with W + w D and v - w D P_before, D = diag(W), and again with the P found and a smaller weight w

Each of these problems has a well-conditioned matrix. Its solution misses the law by w D (P - P_before), in which both
factors go to zero.

References: Alart and Curnier (1991), Comput. Methods Appl. Mech. Eng. 92:353-375; Rockafellar (1976), SIAM J. Control
Optim. 14:877-898 (proximal point method). Siconos: NSN_AC, within PROX.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ship.frames import Array
from .contact_law import law_residual
from .small_blocks import multiply, solve_system
from .work_limit import WorkLimit

__all__ = ["solve_alart_curnier"]

WARM_WEIGHTS = (1e-7, 1e-10)
"""Weights that are tried first. From the impulses of the substep before, half of all patches are solved so in some four
steps instead of eight."""

PROXIMAL_WEIGHTS = tuple(10.0**-k for k in range(2, 14))
"""Weights w, one after the other. Without any, all patches tried are solved as well, with twice the calls of ACLM. With
half as many, more patches of jammed rafts are left unsolved."""

MAX_WARM_STEPS = 6
"""Bound on Newton's steps for one of the weights that are tried first: more are wasted where these do not work."""

MAX_STEPS = 15
"""Bound on Newton's steps for one weight. Fewer than ten cost time: 5 twice as much, on 1 080 patches of two ships."""

_UNIT, _ROW = np.eye(3), np.arange(3)


def solve_alart_curnier(
    W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit | None = None
) -> Array:
    """Impulses (k, 3) [N s] with a residual (law_residual) of at most `tolerance` [m/s], or the best that were found.

    W (3k, 3k) [1/kg], v (3k,) [m/s] in contact axes; P (k, 3): first guess; work: the bound on what the
    solver may do.
    """
    work = work or WorkLimit()
    D = np.diag(W)
    D = np.where(D > 0.0, D, np.repeat(D[0::3], 3))  # also along tangents in which no ship moves
    best, least = P, law_residual(W, v, mu, P)
    warm = [(w, MAX_WARM_STEPS) for w in WARM_WEIGHTS]
    for i, (w, steps) in enumerate(warm + [(w, MAX_STEPS) for w in PROXIMAL_WEIGHTS]):
        if i == len(warm):
            P = best
        P = _solve_newton(W + np.diag(w * D), v - w * D * P.ravel(), mu, P, 0.3 * tolerance, work, steps)
        inside = _clip_to_cones(P, mu)
        residual = law_residual(W, v, mu, inside)
        if residual < least:
            best, least = inside, residual
        if least <= tolerance or work.is_spent:
            break
    return best


def _clip_to_cones(P: Array, mu: float) -> Array:
    """Impulses (k, 3) without the last rounding: no pull, no friction outside the cone."""
    normal = np.maximum(P[:, 0], 0.0)
    size, radius = np.hypot(P[:, 1], P[:, 2]), mu * normal
    share = np.where(size > radius, radius / np.where(size > 0.0, size, 1.0), 1.0)
    return np.column_stack([normal, P[:, 1:] * share[:, None]])


def _solve_newton(W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit, steps: int) -> Array:
    """Impulses (k, 3) at which every equation holds to `tolerance` [m/s] after at most so many steps, or the best on
    the way."""
    stiff = np.diag(W).reshape(-1, 3)
    rho = 1.0 / np.column_stack([stiff[:, 0], np.maximum(stiff[:, 1:].max(axis=1), 1e-300)])
    best, least = P, np.inf
    for _ in range(steps):
        equations = _evaluate_equations(P, (v + multiply(W, P.ravel())).reshape(-1, 3), mu, rho)
        size = float(np.abs(equations.error).max())
        if size < least:
            best, least = P, size
        if size <= tolerance or work.is_spent:
            break
        work.spend_newton_step(len(P), int(np.count_nonzero(equations.closed)))
        try:
            P = P - _newton_step(W, equations, rho)
        except np.linalg.LinAlgError:  # the step before led to infinity, or to a singular system
            break
        if not np.isfinite(P).all():
            break
    return best


class Equations(NamedTuple):
    """Error (k, 3) [m/s] and its derivatives: by own P A (k, 3, 3) [1/kg], by own v B (k, 3, 3). closed (k,): contacts
    that touch; of the others the equation is P / rho = 0."""

    error: Array
    A: Array
    B: Array
    closed: NDArray[np.bool_]


def _evaluate_equations(P: Array, after: Array, mu: float, rho: Array) -> Equations:
    """The equations at impulses P (k, 3) that leave the velocities `after` (k, 3); rho (k, 2): along and across."""
    k = len(P)
    s, t = P[:, 0] - rho[:, 0] * after[:, 0], P[:, 1:] - rho[:, 1:] * after[:, 1:]
    size, radius = np.hypot(t[:, 0], t[:, 1]), mu * s
    closed = s > 0.0
    error, A, B = np.where(closed[:, None], after, 0.0), np.zeros((k, 3, 3)), np.zeros((k, 3, 3))
    error[~closed] = P[~closed] / rho[~closed][:, [0, 1, 1]]
    B[:] = _UNIT
    slide = np.flatnonzero(closed & (size > radius))
    if len(slide):
        size, radius, rho_n, rho_t = size[slide], radius[slide], rho[slide, 0], rho[slide, 1]
        unit = t[slide] / size[:, None]
        share = radius / size
        error[slide, 1:] = (P[slide, 1:] - radius[:, None] * unit) / rho_t[:, None]
        turning = share[:, None, None] * (_UNIT[1:, 1:] - unit[:, :, None] * unit[:, None, :])
        A[slide, 1:, 1:] = (_UNIT[1:, 1:] - turning) / rho_t[:, None, None]
        A[slide, 1:, 0] = -mu * unit / rho_t[:, None]
        B[slide, 1:, 1:] = turning
        B[slide, 1:, 0] = mu * unit * (rho_n / rho_t)[:, None]
    return Equations(error, A, B, closed)


def _newton_step(W: Array, equations: Equations, rho: Array) -> Array:
    """Newton's step (k, 3): what is taken off P. A contact that is apart loses its impulse; the others are solved."""
    error, A, B, closed = equations
    k = len(error)
    step = error * rho[:, [0, 1, 1]]
    touching = np.flatnonzero(closed)
    if not len(touching):
        return step
    W_closed, lost = W, np.zeros(0)
    if len(touching) < k:
        rows = (3 * touching[:, None] + _ROW).ravel()
        W_rows = W[rows]
        lost = np.where(closed[:, None], 0.0, step).ravel()
        error = error[touching] - np.einsum("kab,kb->ka", B[touching], multiply(W_rows, lost).reshape(-1, 3))
        W_closed, A, B = W_rows[:, rows], A[touching], B[touching]
    n = len(touching)
    slope = B @ W_closed.reshape(n, 3, 3 * n)
    each = np.arange(n)
    slope.reshape(n, 3, n, 3)[each, :, each, :] += A
    step[touching] = solve_system(slope.reshape(3 * n, 3 * n), error.ravel()).reshape(-1, 3)
    return step
