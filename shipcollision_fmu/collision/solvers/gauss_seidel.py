"""Projected Gauss-Seidel: non-penetration and Coulomb friction at all contacts at once.

Guan et al. 2014, equations (5)-(13), state the law of contact (contact_law.py) with a pyramid for the cone, one scalar
row at a time, and stop after a fixed count. Here a contact is one 3 x 3 block, the cone is a cone, and the sweeps end
on a residual.

    equations (5)-(10)    motion of the bodies under contact impulses: here v = v(0) + W P (delassus.py)
    equation (11)         the Jacobian; in the second body's block r_j belongs where r_i is printed (delassus.py)
    equation (13)         the law with bounds: w = 0 strictly between them, >= 0 at the lower, <= 0 at the upper one,
                          printed with > and < there                                               (there is no (12))
    figure 4              the sweep: each row with the others' latest impulses; it clips the increment of an impulse,
                          but what must be projected is the accumulated impulse

    turn every contact's tangents to the principal axes of its own W_tt
    start from the impulses of the substep before, scaled to take most energy (warm start)
    sweep over the contacts until none changes its velocity by more than SWEEP_TOLERANCE of the approach; sweeps that
    slow down steadily are extrapolated (aitken.py)
    sweeps that do not get there in PATIENCE are followed by Newton's method on all contacts at once (alart_curnier.py),
    and where that fails, by a sequence of convex problems (aclm_fixed_point.py), now and then with Newton's method
    measure what is left by the law itself: Solution.residual

Plain floats in the sweeps: a block is nine numbers, arrays would cost more than the sums.

References: Guan et al. (2014); Catto (2005), "Iterative dynamics with temporal coherence"; Jourdan, Alart and Jean
(1998) for the block form with friction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from .aclm_fixed_point import solve_aclm
from .aitken import Aitken
from .alart_curnier import solve_alart_curnier
from .contact_law import ContactBlock, law_residual
from .one_contact import solve_one_contact

__all__ = ["SWEEP_TOLERANCE", "Solution", "clear_rounding", "principal_axes", "solve_gauss_seidel"]

SWEEP_TOLERANCE = 1e-11
"""Change of a contact's velocity in a sweep, in units of the largest approach speed, at which the sweeps end."""

PATIENCE = 60
"""Bound on the sweeps; what has not got there by then is solved for all contacts at once."""

ROUNDS = 20
"""Bound on the trials of both."""

FLAT = 1e-9
"""Share of the largest mobility below which neither ship can move along a tangent."""


@dataclass(frozen=True)
class Solution:
    """P (k, 3) [N s] in the contacts' axes (normal, two tangents); sweeps taken; residual: by how much the law of
    contact is missed, in units of the largest approach speed."""

    P: Array
    residual: float
    sweeps: int


def solve_gauss_seidel(W: Array, v: Array, mu: float, start: Array | None = None) -> Solution:
    """Impulses of k contacts in a plastic impact. W (3k, 3k) [1/kg] and v (3k,) [m/s] in contact axes, per contact
    (normal, t1, t2).

    v is the relative velocity before; its normal part is negative on approach. start (k, 3): impulses to start from,
    of which the direction counts and not the size. Restitution is in poisson_restitution.py.
    """
    k = len(v) // 3
    scale = -min((float(x) for x in v[0::3]), default=0.0)
    if scale <= 0.0:
        return Solution(np.zeros((k, 3)), 0.0, 0)
    T = principal_axes(W)
    W_p, v_p = T @ W @ T.T, T @ v
    clear_rounding(W_p, v_p)
    blocks = [ContactBlock.of(W_p[i : i + 3, i : i + 3]) for i in range(0, 3 * k, 3)]
    if k == 1:
        v_n, v_1, v_2 = v_p.tolist()
        P_p, sweeps = np.array([solve_one_contact(blocks[0], (v_n, v_1, v_2), mu)[0]]), 1
    else:
        P_p, sweeps = _swept(W_p, v_p, mu, blocks, scale, _scaled(W, v, start, T))
    return Solution((P_p.ravel() @ T).reshape(k, 3), law_residual(W_p, v_p, mu, P_p) / scale, sweeps)


def principal_axes(W: Array) -> Array:
    """(3k, 3k): turns the tangents of every contact to the principal axes of its own W_tt."""
    T = np.eye(len(W))
    for i in range(1, len(W), 3):
        a, b, d = W[i, i], W[i, i + 1], W[i + 1, i + 1]
        angle = 0.5 * np.arctan2(2.0 * b, a - d)
        c, s = np.cos(angle), np.sin(angle)
        T[i, i], T[i, i + 1], T[i + 1, i], T[i + 1, i + 1] = c, s, -s, c
    return T


def clear_rounding(W: Array, v: Array) -> None:
    """Exact zeros, in place, for the tangents along which neither ship can move."""
    largest = float(np.diag(W).max())
    for n in range(len(v)):
        if n % 3 and W[n, n] <= FLAT * largest:
            W[n], W[:, n] = 0.0, 0.0
            if abs(v[n]) <= FLAT * float(np.abs(v).max()):
                v[n] = 0.0


def _scaled(W: Array, v: Array, start: Array | None, T: Array) -> Array:
    """The guess, as large as takes most energy: its share in the impulses persists, their size does not."""
    if start is None or not start.any():
        return np.zeros((len(v) // 3, 3))
    P = start.ravel()
    share = max(0.0, -float(P @ v)) / float(P @ W @ P)
    return (T @ (share * P)).reshape(-1, 3) if np.isfinite(share) else np.zeros((len(v) // 3, 3))


def _swept(W: Array, v: Array, mu: float, blocks: list[ContactBlock], scale: float, start: Array) -> tuple[Array, int]:
    """Impulses (k, 3) and the sweeps taken."""
    rows, before = W.tolist(), v.tolist()
    contacts = range(len(blocks))
    P: list[float] = start.ravel().tolist()
    angles: list[float | None] = [None] * len(blocks)
    sweeps, wanted = 0, SWEEP_TOLERANCE * scale
    ahead = Aitken()
    while True:
        sweeps, change, last = sweeps + 1, 0.0, P[:]
        for i in contacts:
            n = 3 * i
            W_i = blocks[i]
            p, p_1, p_2 = P[n : n + 3]
            row, row_1, row_2 = rows[n], rows[n + 1], rows[n + 2]
            # Contact velocity if this contact had no impulse: all the others' effect.
            f, f_1, f_2 = before[n], before[n + 1], before[n + 2]
            for x, w, w_1, w_2 in zip(P, row, row_1, row_2, strict=True):
                f += w * x
                f_1 += w_1 * x
                f_2 += w_2 * x
            f -= W_i.W_nn * p + W_i.w_1 * p_1 + W_i.w_2 * p_2
            f_1 -= W_i.w_1 * p + W_i.a_1 * p_1
            f_2 -= W_i.w_2 * p + W_i.a_2 * p_2
            new, angles[i] = solve_one_contact(W_i, (f, f_1, f_2), mu, angles[i])
            P[n : n + 3] = new
            d, d_1, d_2 = new[0] - p, new[1] - p_1, new[2] - p_2
            change = max(
                change,
                abs(W_i.W_nn * d + W_i.w_1 * d_1 + W_i.w_2 * d_2),
                abs(W_i.w_1 * d + W_i.a_1 * d_1),
                abs(W_i.w_2 * d + W_i.a_2 * d_2),
            )
        if change <= wanted:
            return np.array(P).reshape(-1, 3), sweeps
        if sweeps == PATIENCE:
            return _all_at_once(W, v, mu, np.array(P).reshape(-1, 3), wanted), sweeps
        P = ahead(P, last)


def _all_at_once(W: Array, v: Array, mu: float, P: Array, wanted: float) -> Array:
    """Impulses (k, 3) by the methods that take all contacts at once: the first that get there, or the best."""
    best = solve_alart_curnier(W, v, mu, P, wanted)
    least, P = law_residual(W, v, mu, best), np.zeros_like(P)
    for _ in range(ROUNDS):
        if least <= wanted:
            break
        P = solve_aclm(W, v, mu, P, wanted)
        tried = solve_alart_curnier(W, v, mu, P, wanted)
        if (missed := law_residual(W, v, mu, tried)) < least:
            best, least = tried, missed
    return best
