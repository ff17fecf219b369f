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
from ..dynamics.small_blocks import multiply, solve_system
from .contact_law import law_residual
from .work_limit import WorkLimit

__all__ = ["solve_alart_curnier"]

WARM_WEIGHTS = (1e-7, 1e-10)
"""Weights that are tried first. From the impulses of the substep before, half of all patches are solved so in some four
steps instead of eight. Where Newton's method fails at the first, it fails at the second as well."""

PROXIMAL_WEIGHTS = tuple(10.0**-k for k in range(4, 14))
"""Weights w, one after the other. Without any, all patches tried are solved as well, with twice the calls of ACLM. With
half as many, more patches of jammed rafts are left unsolved. Begun at 1e-2, half as many again are left unsolved when
their work is spent."""

MAX_WARM_STEPS = 6
"""Bound on Newton's steps for one of the weights that are tried first: more are wasted where these do not work."""

MAX_STEPS = 15
"""Bound on Newton's steps for one weight. Fewer than ten cost time: 5 twice as much, on 1 080 patches of two ships."""

Indices = NDArray[np.intp]

STALLED = 1e3
"""Error, in units of the tolerance, up to which Newton's method has ended in rounding when a step makes it no smaller.
With 1, a boat between ships takes all steps of every weight, since its impulses are known to 1e-13 of theirs."""

_PLANE, _ROW = np.eye(2), np.arange(3)


def solve_alart_curnier(
    W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit | None = None
) -> Array:
    """Impulses (k, 3) [N s] with a residual (law_residual) of at most `tolerance` [m/s], or the best that were found.

    W (3k, 3k) [1/kg], v (3k,) [m/s] in contact axes; P (k, 3): first guess; work: the bound on what the
    solver may do.
    """
    work = work or WorkLimit()
    diagonal = W.diagonal()
    D = np.where(diagonal > 0.0, diagonal, diagonal[0::3].repeat(3))  # also along tangents in which no ship moves
    weighted, on_diagonal = W.copy(), slice(None, None, len(W) + 1)
    best, least = P, law_residual(W, v, mu, P)
    warm, solved = [(w, MAX_WARM_STEPS) for w in WARM_WEIGHTS], True
    for i, (w, steps) in enumerate(warm + [(w, MAX_STEPS) for w in PROXIMAL_WEIGHTS]):
        if i < len(warm) and not solved:
            continue
        if i == len(warm):
            P = best
        weighted.ravel()[on_diagonal] = diagonal + w * D
        P, solved = _solve_newton(weighted, v - w * D * P.ravel(), mu, P, 0.3 * tolerance, work, steps)
        inside = _clip_to_cones(P, mu)
        residual = law_residual(W, v, mu, inside)
        work.spend_residual(len(P))
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
    inside = P * share[:, None]
    inside[:, 0] = normal
    return inside


def _solve_newton(
    W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit, steps: int
) -> tuple[Array, bool]:
    """Impulses (k, 3), and whether every equation holds to `tolerance` [m/s]; if none does, the best on the way."""
    stiff = W.diagonal().reshape(-1, 3)
    rho_n, rho_t = 1.0 / stiff[:, 0], 1.0 / np.maximum(stiff[:, 1:].max(axis=1), 1e-300)
    rho = np.column_stack([rho_n, rho_t, rho_t])
    best, least = P, np.inf
    for _ in range(steps):
        equations = _evaluate_equations(P, (v + multiply(W, P.ravel())).reshape(-1, 3), mu, rho)
        size = float(np.abs(equations.error).max())
        stalls = least <= size <= STALLED * tolerance
        if size < least:
            best, least = P, size
        if size <= tolerance or stalls:
            return best, True
        if work.is_spent:
            break
        work.spend_newton_step(len(P), len(equations.closed))
        try:
            P = P - _newton_step(W, equations, mu, rho)
        except np.linalg.LinAlgError:  # the step before led to infinity, or to a singular system
            break
        if not np.isfinite(P).all():
            break
    return best, False


class Equations(NamedTuple):
    """Error (k, 3) [m/s]; closed, sliding: indices of the contacts that touch, and of those of them that slide; unit
    (s, 2), share (s,): direction and friction radius / |t| of those that slide, t = P_t - rho_t v_t.

    Of a contact that is apart the equation is P / rho = 0, of one that sticks v = 0.
    """

    error: Array
    closed: Indices
    sliding: Indices
    unit: Array
    share: Array


def _evaluate_equations(P: Array, after: Array, mu: float, rho: Array) -> Equations:
    """The equations at impulses P (k, 3) that leave the velocities `after` (k, 3); rho (k, 3)."""
    moved = P - rho * after
    s, size = moved[:, 0], np.hypot(moved[:, 1], moved[:, 2])
    touches = s > 0.0
    closed, sliding = touches.nonzero()[0], (touches & (size > mu * s)).nonzero()[0]
    error = after if len(closed) == len(P) and not len(sliding) else np.where(touches[:, None], after, P / rho)
    size = size[sliding]
    unit, share = moved[sliding, 1:] / size[:, None], mu * s[sliding] / size
    if len(sliding):
        error[sliding, 1:] = (P[sliding, 1:] - share[:, None] * moved[sliding, 1:]) / rho[sliding, 1:]
    return Equations(error, closed, sliding, unit, share)


def _newton_step(W: Array, equations: Equations, mu: float, rho: Array) -> Array:
    """Newton's step (k, 3): what is taken off P. A contact that is apart loses its impulse; the others are solved.

    With velocity v, a contact that slides in the direction d has the equations v_n = 0 and

        (P_t - mu s d) / rho_t = 0      ds = dP_n - rho_n dv_n,   d(s d) = d ds + (s/|t|) (1 - d d') (dP_t - rho_t dv_t)
    """
    error, closed, sliding, unit, share = equations
    k, n = len(error), len(closed)
    step = error * rho
    if not n:
        return step
    slope, right = W, error
    if n < k:
        rows = (3 * closed[:, None] + _ROW).ravel()
        W_rows = W[rows]
        lost = step.copy()
        lost[closed] = 0.0
        change = multiply(W_rows, lost.ravel()).reshape(-1, 3)
        slope, right = W_rows[:, rows], error[closed] - change
        places = np.searchsorted(closed, sliding)
    else:
        slope, places = W.copy(), sliding
    if len(sliding):
        rho_n, rho_t = rho[sliding, 0, None], rho[sliding, 1, None]
        turning = share[:, None, None] * (_PLANE - unit[:, :, None] * unit[:, None, :])
        B = np.empty((len(sliding), 2, 3))  # by the velocity of the contact
        B[:, :, 0], B[:, :, 1:] = mu * unit * (rho_n / rho_t), turning
        blocks = slope.reshape(n, 3, 3 * n)
        blocks[places, 1:] = B @ blocks[places]
        A = np.empty((len(sliding), 2, 3))  # by its impulse
        A[:, :, 0], A[:, :, 1:] = -mu * unit / rho_t, (_PLANE - turning) / rho_t[:, :, None]
        slope.reshape(n, 3, n, 3)[places, 1:, places, :] += A
        if n < k:
            right[places, 1:] = error[sliding, 1:] - np.einsum("kab,kb->ka", B, change[places])
    step[closed] = solve_system(slope, right.ravel()).reshape(-1, 3)
    return step
