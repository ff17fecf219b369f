"""Poisson's restitution of a whole patch: all contacts give back the share e of their compression together.

    compression   P_c      plastic impact of all contacts at once (gauss_seidel.py)                       [N s]
    restitution   P_r      normal impulses e P_c,n; friction in discs of radius mu e P_c,n (Poisson)      [N s]
    impact        P_c + P_r

An impact whose contacts all approach more slowly than LEAST_REBOUNDING_APPROACH is plastic. Tolerances are shares of
the approach before the impact, also of the solve after the rebound.

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
from ..dynamics.small_blocks import MOST_ROWS, multiply
from .aitken import Aitken
from .contact_law import ContactBlock, solve_friction_in_disc
from .gauss_seidel import SWEEP_TOLERANCE, Solution, clear_rounding, principal_axes, solve_gauss_seidel, turn_tangents
from .work_limit import WorkLimit

__all__ = ["solve_poisson_impact"]

NO_REBOUND = 1e-12
"""Restitution that counts as none: the rebound is rounding. With none, squares of it underflow and are divided by."""

LEAST_REBOUNDING_APPROACH = 1e-3
"""Approach [m/s] of an impact below which nothing springs back: the impact is plastic.

A ship that lies against another is pressed on by wind, current or propeller and closes anew in every substep: at the
acceleration of 1 to 50 mm/s2 of a ship in a gale, at 0.01 to 0.5 mm/s in a substep of 10 ms. Such an approach is no
impact but a force, which steel plates carry without a rebound. At 1 mm/s a ship of 100 000 t has 50 J, less than a
person who walks. A rebound would be below 1 mm/s, and would carry the ship less than a millimetre in a second.
Under a parallel master a pressed ship may close faster: responses.py takes that for no impact either.

Zero: ships at rest spring back from the rounding of their contacts, and rebounds of rebounds are solved to shares of
nothing. Larger than the slowest berthing, some 10 mm/s: real impacts lose their restitution.
"""

MAX_SWEEPS = 200
"""Bound on the sweeps over the friction of restitution. An early end leaves slip that friction could have stopped; the
friction stays in its disc, so no law is broken."""


def solve_poisson_impact(
    W: Array,
    v: Array,
    mu: float,
    e: float,
    start: Array | None = None,
    slip: Array | None = None,
    work: WorkLimit | None = None,
) -> Solution:
    """Impulses of k contacts with restitution e.

    W (3k, 3k) [1/kg] and v (3k,) [m/s] before, in contact axes; start (k, 3) and work: as in solve_gauss_seidel; slip
    (3k,): what compression adds to the slip by motions that are held (held_motions.py); restitution adds e times as
    much.
    """
    work = work or WorkLimit()
    approach = -float(v[0::3].min())
    scale = max(approach, LEAST_REBOUNDING_APPROACH)
    met = v if slip is None else v + slip
    plastic = solve_gauss_seidel(W, met, mu, start, scale, work)
    if e <= NO_REBOUND or approach < LEAST_REBOUNDING_APPROACH or not plastic.P.any():
        return plastic
    P = plastic.P.ravel()
    if slip is not None:
        met = met + e * slip
    whole = P + _solve_restitution(W, met + multiply(W, P), mu, e * P, work)
    if whole @ (v + 0.5 * multiply(W, whole)) > 0.0:
        whole = (1.0 + e) * P
    # Contacts that the rebound of others has closed.
    last = solve_gauss_seidel(W, met + multiply(W, whole), mu, scale=scale, work=work)
    residual = max(plastic.residual, last.residual)
    return Solution(whole.reshape(-1, 3) + last.P, residual, plastic.sweeps + last.sweeps)


def _solve_restitution(W: Array, v: Array, mu: float, P: Array, work: WorkLimit) -> Array:
    """Impulses of restitution (3k,) [N s], with the normal parts of P and friction that stops the slip if it can.

    Projected Gauss-Seidel on the tangential pairs alone, in discs of radius mu P_n. The friction minimises a convex
    energy, so the sweeps converge. v: velocity [m/s] after compression.
    """
    T, few = principal_axes(W), len(v) <= MOST_ROWS  # where BLAS begins no threads
    W, v = turn_tangents(T, W), T @ v if few else multiply(T, v)
    clear_rounding(W, v)
    P = T @ P if few else multiply(T, P)
    blocks = ContactBlock.of_all(W)
    tangents = [W[n + 1 : n + 3] for n in range(0, len(P), 3)]
    impulses: list[float] = P.tolist()
    scale = float(np.abs(v).max() + np.abs(multiply(W, P)).max())
    before, aitken, kept = v.tolist(), Aitken(), 0.5 * work.left
    for _ in range(MAX_SWEEPS):
        change, last = 0.0, impulses
        P[:] = impulses
        for i, block in enumerate(blocks):
            n = 3 * i
            _, p_1, p_2 = P[n : n + 3].tolist()
            f_1, f_2 = tangents[i].dot(P).tolist()
            P[n + 1], P[n + 2] = new_1, new_2 = solve_friction_in_disc(
                block,
                before[n + 1] + f_1 - block.a_1 * p_1,
                before[n + 2] + f_2 - block.a_2 * p_2,
                mu * impulses[n],
            )
            change = max(change, abs(block.a_1 * (new_1 - p_1)), abs(block.a_2 * (new_2 - p_2)))
        work.spend_sweep(len(blocks))
        if change <= SWEEP_TOLERANCE * scale or work.left < kept:
            break
        impulses = aitken.extrapolate(P.tolist(), last)
    return P @ T if few else multiply(T.T, P)
