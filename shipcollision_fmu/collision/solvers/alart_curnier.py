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

import numpy as np

from ...ship.frames import Array
from .contact_law import law_residual
from .work_limit import WorkLimit

__all__ = ["solve_alart_curnier"]

PROXIMAL_WEIGHTS = tuple(10.0**-k for k in range(2, 14))
"""Weights w, one after the other. Without any, all patches tried are solved as well, with twice the calls of ACLM."""

REGULAR_WEIGHT = 1e-9
"""Weight from which elimination solves Newton's equations: it takes a tenth of the time of least squares. With less
weight nearly dependent contacts make the equations singular, and elimination leads astray."""

MAX_STEPS = 15
"""Bound on Newton's steps for one weight. Fewer than ten cost time: 5 twice as much, on 1 080 patches of two ships."""


def solve_alart_curnier(
    W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit | None = None
) -> Array:
    """Impulses (k, 3) [N s] with a residual (law_residual) of at most `tolerance` [m/s], or the best that were found.

    W (3k, 3k) [1/kg], v (3k,) [m/s] in contact axes; P (k, 3): first guess; work: the bound on what the
    solver may do.
    """
    work = work or WorkLimit()
    D = np.diag(W)
    best, least = P, law_residual(W, v, mu, P)
    for w in PROXIMAL_WEIGHTS:
        P = _solve_newton(W + np.diag(w * D), v - w * D * P.ravel(), mu, P, 0.3 * tolerance, work, w >= REGULAR_WEIGHT)
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


def _solve_newton(W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit, regular: bool) -> Array:
    """Impulses (k, 3) at which every equation holds to `tolerance` [m/s], or the best on the way. regular: W is."""
    stiff = np.diag(W).reshape(-1, 3)
    rho = 1.0 / np.column_stack([stiff[:, 0], *[np.maximum(stiff[:, 1:].max(axis=1), 1e-300)] * 2])
    best, least = P, np.inf
    for _ in range(MAX_STEPS):
        error, slope = _evaluate_equations(W, v, mu, P, rho)
        size = float(np.abs(error).max())
        if size < least:
            best, least = P, size
        if size <= tolerance or work.is_spent:
            break
        work.spend_newton_step(len(P), regular)
        try:
            P = P - _solve_linear(slope, error, regular).reshape(-1, 3)
        except np.linalg.LinAlgError:  # the step before led to infinity
            break
    return best


def _solve_linear(slope: Array, error: Array, regular: bool) -> Array:
    """Newton's step (3k,): by elimination where the slope is regular, else the least of those that miss least."""
    if regular:
        try:
            step: Array = np.asarray(np.linalg.solve(slope, error), dtype=np.float64)
        except np.linalg.LinAlgError:
            pass
        else:
            if np.isfinite(step).all():
                return step
    least: Array = np.asarray(np.linalg.lstsq(slope, error, rcond=1e-13)[0], dtype=np.float64)
    return least


def _evaluate_equations(W: Array, v: Array, mu: float, P: Array, rho: Array) -> tuple[Array, Array]:
    """Error of the equations (3k,) [m/s] and its derivative by P (3k, 3k) [1/kg]."""
    k = len(P)
    after = (v + W @ P.ravel()).reshape(k, 3)
    s, t = P[:, 0] - rho[:, 0] * after[:, 0], P[:, 1:] - rho[:, 1:] * after[:, 1:]
    size, radius = np.hypot(t[:, 0], t[:, 1]), mu * s
    closed, W = s > 0.0, W.reshape(k, 3, 3 * k)
    error, slope = P / rho, np.diag(1.0 / rho.ravel()).reshape(k, 3, 3 * k)  # of contacts that are apart
    error[closed, 0], slope[closed, 0] = after[closed, 0], W[closed, 0]
    stick = closed & (size <= radius)
    error[stick, 1:], slope[stick, 1:] = after[stick, 1:], W[stick, 1:]
    slide = np.flatnonzero(closed & (size > radius))
    if len(slide):
        size, radius, rho_t = size[slide], radius[slide], rho[slide, 1:]
        unit, each = t[slide] / size[:, None], np.arange(len(slide))
        error[slide, 1:] = (P[slide, 1:] - radius[:, None] * unit) / rho_t
        ds, dt = -rho[slide, 0, None] * W[slide, 0], -rho_t[:, :, None] * W[slide, 1:]
        ds[each, 3 * slide] += 1.0
        dt[each, 0, 3 * slide + 1] += 1.0
        dt[each, 1, 3 * slide + 2] += 1.0
        across = unit[:, :, None]
        turned = (radius / size)[:, None, None] * (dt - across * (across * dt).sum(axis=1)[:, None, :])
        own = -(mu * across * ds[:, None, :] + turned)
        own[each, 0, 3 * slide + 1] += 1.0
        own[each, 1, 3 * slide + 2] += 1.0
        slope[slide, 1:] = own / rho_t[:, :, None]
    return error.ravel(), slope.reshape(3 * k, 3 * k)
