"""Restitution of a whole impact: all contacts of a patch spring back together, and never with more than they stored.

    compression   P_c      plastic impact of all contacts at once (pgs.py)
    restitution   P_r      normal impulses e P_c,n; friction held or sliding anew inside the cone mu e P_c,n (Poisson)
    impact        P_c + P_r

Newton's rule asks every contact of one rigid patch for its own share of its own approach, which the patch cannot
satisfy; Poisson's asks the impact as a whole. For one contact that slides one way throughout both rules agree.

With friction Poisson's rule can create energy, rarely. Then the impact (1 + e) P_c is taken instead, which cannot:
P_c is plastic, so P_c . (v + W P_c) <= 0, hence P_c . W P_c <= -P_c . v = a, and the energy gained is

    (1 + e) P_c . v + 1/2 (1 + e)^2 P_c . W P_c  <=  -1/2 (1 + e)(1 - e) a  <=  0

A single contact whose plastic impulse breaks the law of friction is solved along its slip path (slip_path.py) instead.

References: Poisson's hypothesis as in Glocker and Pfeiffer (1995); that it may gain energy: Stronge (2000), chapter 3.
"""

from __future__ import annotations

import numpy as np

from ..ship.frames import Array
from .pgs import MAX_SWEEPS, RESIDUAL, Solution, solve_pgs
from .slip_path import solve_slip_path

__all__ = ["solve_impact"]


def solve_impact(W: Array, v: Array, mu: float, e: float) -> Solution:
    """Impulses of k contacts with restitution e. W (3k, 3k) [1/kg], v (3k,) [m/s] before, in contact axes."""
    plastic = solve_pgs(W, v, mu)
    if len(v) == 3 and not _sound(W, v, mu, plastic.P[0]):
        # Ships that cannot move in some direction make W singular, and the search for the slip's angle may miss.
        return Solution(solve_slip_path(W, v, mu, e).P[None, :], 0.0, plastic.sweeps)
    if e == 0.0 or not plastic.P.any():
        return plastic
    P = plastic.P.ravel()
    after = v + W @ P
    whole = P + _sprung_back(W, after, mu, e * P)
    if whole @ (v + 0.5 * W @ whole) > 0.0:
        whole = (1.0 + e) * P
    last = solve_pgs(W, v + W @ whole, mu)  # contacts that the others' rebound has closed
    residual = max(plastic.residual, last.residual)
    return Solution(whole.reshape(-1, 3) + last.P, residual, plastic.sweeps + last.sweeps)


def _sound(W: Array, v: Array, mu: float, P: Array) -> bool:
    """Whether a single contact's plastic impulse obeys its law: friction against the slip, full while it slides."""
    if not np.isfinite(P).all():
        return False
    after = v + W @ P
    slip, friction = float(np.hypot(*after[1:])), float(np.hypot(*P[1:]))
    if slip <= 1e-9 * float(np.abs(v).max()) or P[0] <= 0.0 or mu == 0.0:
        return True
    against = float(P[1:] @ after[1:]) <= -(1.0 - 1e-6) * friction * slip
    return against and friction >= (1.0 - 1e-6) * mu * P[0]


def _sprung_back(W: Array, v: Array, mu: float, P: Array) -> Array:
    """Impulses of restitution (3k,): P's normal parts are given; friction, in the cone, holds the slip if it can.

    Projected Gauss-Seidel on the tangential pairs alone.
    """
    P = P.copy()
    P_n = P[0::3].copy()
    tangents = [slice(3 * i + 1, 3 * i + 3) for i in range(len(P_n))]
    for i, part in enumerate(tangents):
        P[part] = 0.0
        P[3 * i] = P_n[i]
    inverses = [np.linalg.pinv(W[part, part], 1e-9, hermitian=True) for part in tangents]
    scale = float(np.abs(v).max() + np.abs(W @ P).max())
    for _ in range(MAX_SWEEPS):
        change = 0.0
        for i, part in enumerate(tangents):
            old = P[part].copy()
            slip = v[part] + W[part] @ P
            new = old - inverses[i] @ slip
            size, limit = float(np.hypot(*new)), mu * P_n[i]
            if size > limit:
                new *= limit / size
            P[part] = new
            change = max(change, float(np.abs(W[part, part] @ (new - old)).max()))
        if change <= RESIDUAL * scale:
            break
    return P
