"""All contacts at once by a nonsmooth Newton method: where Gauss-Seidel's sweeps would go on for thousands.

Contacts that all but depend on each other (two plumb stems that meet along a line) pass an impulse to and fro between
them. The law of contact, as equations that hold if and only if it does,

    P_n = max(0, s),   s = P_n - rho_n v_n
    P_t = projection of (P_t - rho_t v_t) on the disc of radius mu max(0, s)

is piecewise smooth, and Newton's method on it ends in a few steps, mostly. W is singular when there are more contacts
than ways to move, and nearly so when they are close together: the method may then walk in circles. So it is led there:

    solve for W + s D with v - s D P_before, D = diag(W), and again with the P found and a smaller s

Each of these has a well-conditioned matrix (it is a step of the proximal point method), and what it solves differs from
the law by s D (P - P_before), which goes to zero twice over.

References: Alart and Curnier (1991), Comput. Methods Appl. Mech. Eng. 92:353-375; Rockafellar (1976), SIAM J. Control
Optim. 14:877-898 (proximal points).
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from .contact_law import law_residual

__all__ = ["solve_alart_curnier"]

SOFTNESS = tuple(10.0**-k for k in range(2, 14))
"""Values of s, one after the other."""

STEPS = 15
"""Newton's steps for each, at most."""


def solve_alart_curnier(W: Array, v: Array, mu: float, P: Array, wanted: float) -> Array:
    """Impulses (k, 3) from a first guess P (k, 3): such that the law is missed by at most `wanted` [m/s], or the best
    found. W (3k, 3k), v (3k,)."""
    D = np.diag(W)
    best, least = P, law_residual(W, v, mu, P)
    for s in SOFTNESS:
        P = _steps(W + np.diag(s * D), v - s * D * P.ravel(), mu, P, 0.3 * wanted)
        inside = _in_cone(P, mu)
        missed = law_residual(W, v, mu, inside)
        if missed < least:
            best, least = inside, missed
        if least <= wanted:
            break
    return best


def _in_cone(P: Array, mu: float) -> Array:
    """Without the last rounding: no pull, no friction outside the cone."""
    normal = np.maximum(P[:, 0], 0.0)
    size, radius = np.hypot(P[:, 1], P[:, 2]), mu * normal
    share = np.where(size > radius, radius / np.where(size > 0.0, size, 1.0), 1.0)
    return np.column_stack([normal, P[:, 1:] * share[:, None]])


def _steps(W: Array, v: Array, mu: float, P: Array, wanted: float) -> Array:
    """Newton's steps until no equation misses by more than `wanted`; the best P on the way."""
    stiff = np.diag(W).reshape(-1, 3)
    rho = 1.0 / np.column_stack([stiff[:, 0], *[np.maximum(stiff[:, 1:].max(axis=1), 1e-300)] * 2])
    best, least = P, np.inf
    for _ in range(STEPS):
        missed, slope = _equations(W, v, mu, P, rho)
        size = float(np.abs(missed).max())
        if size < least:
            best, least = P, size
        if size <= wanted:
            break
        try:
            P = P - np.linalg.lstsq(slope, missed, rcond=1e-13)[0].reshape(-1, 3)
        except np.linalg.LinAlgError:  # it left for infinity
            break
    return best


def _equations(W: Array, v: Array, mu: float, P: Array, rho: Array) -> tuple[Array, Array]:
    """What is missed [m/s], (3k,), and its derivative by P (3k, 3k) [1/kg]."""
    k = len(P)
    after = (v + W @ P.ravel()).reshape(k, 3)
    s, t = P[:, 0] - rho[:, 0] * after[:, 0], P[:, 1:] - rho[:, 1:] * after[:, 1:]
    missed, slope = np.empty((k, 3)), np.empty((3 * k, 3 * k))
    for i in range(k):
        n, across = 3 * i, slice(3 * i + 1, 3 * i + 3)
        if s[i] <= 0.0:
            missed[i] = P[i] / rho[i]
            slope[n : n + 3] = 0.0
            slope[n, n], slope[n + 1, n + 1], slope[n + 2, n + 2] = 1.0 / rho[i]
            continue
        missed[i, 0], slope[n] = after[i, 0], W[n]
        size, radius = float(np.hypot(*t[i])), mu * float(s[i])
        if size <= radius:
            missed[i, 1:], slope[across] = after[i, 1:], W[across]
            continue
        unit = t[i] / size
        missed[i, 1:] = (P[i, 1:] - radius * unit) / rho[i, 1:]
        ds, dt = -rho[i, 0] * W[n], -rho[i, 1:, None] * W[across]
        ds[n] += 1.0
        dt[0, n + 1] += 1.0
        dt[1, n + 2] += 1.0
        turned = radius / size * (dt - np.outer(unit, unit @ dt))
        own = -(mu * np.outer(unit, ds) + turned)
        own[0, n + 1] += 1.0
        own[1, n + 2] += 1.0
        slope[across] = own / rho[i, 1:, None]
    return missed.ravel(), slope
