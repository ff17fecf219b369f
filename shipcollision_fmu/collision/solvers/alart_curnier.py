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

__all__ = ["solve_alart_curnier"]

PROXIMAL_WEIGHTS = tuple(10.0**-k for k in range(2, 14))
"""Weights w, one after the other. Without any, all patches tried are solved as well, with twice the calls of ACLM."""

MAX_STEPS = 15
"""Bound on Newton's steps for one weight. Fewer than ten cost time: 5 twice as much, on 1 080 patches of two ships."""


def solve_alart_curnier(W: Array, v: Array, mu: float, P: Array, tolerance: float) -> Array:
    """Impulses (k, 3) [N s] with a residual (law_residual) of at most `tolerance` [m/s], or the best that were found.

    W (3k, 3k) [1/kg], v (3k,) [m/s] in contact axes; P (k, 3): first guess.
    """
    D = np.diag(W)
    best, least = P, law_residual(W, v, mu, P)
    for w in PROXIMAL_WEIGHTS:
        P = _solve_newton(W + np.diag(w * D), v - w * D * P.ravel(), mu, P, 0.3 * tolerance)
        inside = _clip_to_cones(P, mu)
        residual = law_residual(W, v, mu, inside)
        if residual < least:
            best, least = inside, residual
        if least <= tolerance:
            break
    return best


def _clip_to_cones(P: Array, mu: float) -> Array:
    """Impulses (k, 3) without the last rounding: no pull, no friction outside the cone."""
    normal = np.maximum(P[:, 0], 0.0)
    size, radius = np.hypot(P[:, 1], P[:, 2]), mu * normal
    share = np.where(size > radius, radius / np.where(size > 0.0, size, 1.0), 1.0)
    return np.column_stack([normal, P[:, 1:] * share[:, None]])


def _solve_newton(W: Array, v: Array, mu: float, P: Array, tolerance: float) -> Array:
    """Impulses (k, 3) at which every equation holds to `tolerance` [m/s], or the best on the way."""
    stiff = np.diag(W).reshape(-1, 3)
    rho = 1.0 / np.column_stack([stiff[:, 0], *[np.maximum(stiff[:, 1:].max(axis=1), 1e-300)] * 2])
    best, least = P, np.inf
    for _ in range(MAX_STEPS):
        error, slope = _evaluate_equations(W, v, mu, P, rho)
        size = float(np.abs(error).max())
        if size < least:
            best, least = P, size
        if size <= tolerance:
            break
        try:
            P = P - np.linalg.lstsq(slope, error, rcond=1e-13)[0].reshape(-1, 3)
        except np.linalg.LinAlgError:  # the step before led to infinity
            break
    return best


def _evaluate_equations(W: Array, v: Array, mu: float, P: Array, rho: Array) -> tuple[Array, Array]:
    """Error of the equations (3k,) [m/s] and its derivative by P (3k, 3k) [1/kg]."""
    k = len(P)
    after = (v + W @ P.ravel()).reshape(k, 3)
    s, t = P[:, 0] - rho[:, 0] * after[:, 0], P[:, 1:] - rho[:, 1:] * after[:, 1:]
    error, slope = np.empty((k, 3)), np.empty((3 * k, 3 * k))
    for i in range(k):
        n, across = 3 * i, slice(3 * i + 1, 3 * i + 3)
        if s[i] <= 0.0:  # apart
            error[i] = P[i] / rho[i]
            slope[n : n + 3] = 0.0
            slope[n, n], slope[n + 1, n + 1], slope[n + 2, n + 2] = 1.0 / rho[i]
            continue
        error[i, 0], slope[n] = after[i, 0], W[n]
        size, radius = float(np.hypot(*t[i])), mu * float(s[i])
        if size <= radius:  # stick
            error[i, 1:], slope[across] = after[i, 1:], W[across]
            continue
        unit = t[i] / size  # slide
        error[i, 1:] = (P[i, 1:] - radius * unit) / rho[i, 1:]
        ds, dt = -rho[i, 0] * W[n], -rho[i, 1:, None] * W[across]
        ds[n] += 1.0
        dt[0, n + 1] += 1.0
        dt[1, n + 2] += 1.0
        turned = radius / size * (dt - np.outer(unit, unit @ dt))
        own = -(mu * np.outer(unit, ds) + turned)
        own[0, n + 1] += 1.0
        own[1, n + 2] += 1.0
        slope[across] = own / rho[i, 1:, None]
    return error.ravel(), slope
