"""Poisson's restitution of a whole patch: all contacts give back the share e of their compression together.

    compression   P_c      plastic impact of all contacts at once (gauss_seidel.py)                       [N s]
    restitution   P_r      normal impulses e P_c,n; friction in discs of radius mu e P_c,n (Poisson)      [N s]
    impact        P_c + P_r

Newton's rule demands of every contact of one rigid patch a share of its own approach, which the patch cannot satisfy.
Poisson's rule is about the impact as a whole. For one contact that slides one way throughout, both rules agree.

With friction Poisson's rule can create energy, in rare cases. Then the impact (1 + e) P_c is taken instead, which
cannot. P_c is plastic, so P_c . (v + W P_c) <= 0, hence P_c . W P_c <= -P_c . v = a, and the energy gained is

    (1 + e) P_c . v + 1/2 (1 + e)^2 P_c . W P_c  <=  -1/2 (1 + e)(1 - e) a  <=  0

References: Poisson's hypothesis as in Glocker and Pfeiffer (1995); that it may gain energy: Stronge (2000), chapter 3.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from .contact_law import ContactBlock, solve_friction_in_disc
from .gauss_seidel import SWEEP_TOLERANCE, Solution, clear_rounding, principal_axes, solve_gauss_seidel

__all__ = ["solve_poisson_impact"]

NO_REBOUND = 1e-12
"""Restitution that counts as none: the rebound is rounding. With none, squares of it underflow and are divided by."""

MAX_SWEEPS = 1000
"""Bound on the sweeps over the friction of restitution. An early end leaves slip that friction could have stopped; the
friction stays in its disc, so no law is broken."""


def solve_poisson_impact(
    W: Array, v: Array, mu: float, e: float, start: Array | None = None, slip: Array | None = None
) -> Solution:
    """Impulses of k contacts with restitution e.

    W (3k, 3k) [1/kg] and v (3k,) [m/s] before, in contact axes; start (k, 3): as in solve_gauss_seidel; slip (3k,):
    what compression adds to the slip by motions that are held (held_motions.py); restitution adds e times as much.
    """
    met = v if slip is None else v + slip
    plastic = solve_gauss_seidel(W, met, mu, start)
    if e <= NO_REBOUND or not plastic.P.any():
        return plastic
    P = plastic.P.ravel()
    if slip is not None:
        met = met + e * slip
    whole = P + _solve_restitution(W, met + W @ P, mu, e * P)
    if whole @ (v + 0.5 * W @ whole) > 0.0:
        whole = (1.0 + e) * P
    last = solve_gauss_seidel(W, met + W @ whole, mu)  # contacts that the rebound of others has closed
    residual = max(plastic.residual, last.residual)
    return Solution(whole.reshape(-1, 3) + last.P, residual, plastic.sweeps + last.sweeps)


def _solve_restitution(W: Array, v: Array, mu: float, P: Array) -> Array:
    """Impulses of restitution (3k,) [N s], with the normal parts of P and friction that stops the slip if it can.

    Projected Gauss-Seidel on the tangential pairs alone, in discs of radius mu P_n. The friction minimises a convex
    energy, so the sweeps converge. v: velocity [m/s] after compression.
    """
    T = principal_axes(W)
    W, v = T @ W @ T.T, T @ v
    clear_rounding(W, v)
    P = T @ P
    blocks = [ContactBlock.of(W[n : n + 3, n : n + 3]) for n in range(0, len(P), 3)]
    for n in range(0, len(P), 3):
        P[n + 1 : n + 3] = 0.0
    scale = float(np.abs(v).max() + np.abs(W @ P).max())
    for _ in range(MAX_SWEEPS):
        change = 0.0
        for i, block in enumerate(blocks):
            n = 3 * i
            pair = slice(n + 1, n + 3)
            old = P[pair].copy()
            own = np.array([block.a_1, block.a_2]) * old
            free = v[pair] + W[pair] @ P - own
            P[pair] = solve_friction_in_disc(block, float(free[0]), float(free[1]), mu * float(P[n]))
            change = max(change, float(np.abs(np.array([block.a_1, block.a_2]) * (P[pair] - old)).max()))
        if change <= SWEEP_TOLERANCE * scale:
            break
    return P @ T
