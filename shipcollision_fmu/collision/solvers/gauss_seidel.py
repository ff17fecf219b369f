"""Block projected Gauss-Seidel (NSGS): the law of contact at all contacts at once. The response `pgs`.

Guan et al. (2014), equations (5)-(13), state the law of contact (contact_law.py) with a pyramid for the cone. They
solve one scalar row at a time and stop after a fixed count of sweeps. Here a contact is one 3 x 3 block, the cone is
round, and the sweeps end on a residual.

    equations (5)-(10)    motion of the bodies under contact impulses: here v = v(0) + W P (delassus.py)
    equation (11)         the Jacobian; in the second body's block r_j belongs where r_i is printed (delassus.py)
    equation (13)         the law with bounds: w = 0 strictly between them, >= 0 at the lower, <= 0 at the upper one,
                          printed with > and < there                                               (there is no (12))
    figure 4              the sweep: each row with the others' latest impulses; it clips the increment of an impulse,
                          but what must be projected is the accumulated impulse

The steps:

    turn the tangents of every contact to the principal axes of its own W_tt
    start from the impulses of the substep before (warm_start.py), scaled to dissipate most energy
    sweep over the contacts, each solved exactly (one_contact.py) with the latest impulses of the others, until no
        contact changes its velocity by more than SWEEP_TOLERANCE of the approach; extrapolate between (aitken.py)
    after MAX_SWEEPS, or half of the work allowed (work_limit.py), solve all contacts together: Newton's method
        (alart_curnier.py), and where it cycles, in turns with a sequence of convex problems (aclm_fixed_point.py)
    measure the residual of the law itself: Solution.residual

The sweeps use plain floats: a block is nine numbers, and arrays would cost more than the sums.

References: Guan et al. (2014); Catto (2005), "Iterative dynamics with temporal coherence"; Jourdan, Alart and Jean
(1998), Comput. Methods Appl. Mech. Eng. 155:31-47 (block form with friction). Siconos: NSGS.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, sin

import numpy as np

from ...ship.frames import Array
from ..dynamics.small_blocks import MOST_ROWS, multiply, rotate_rows
from .aclm_fixed_point import solve_aclm
from .aitken import Aitken
from .alart_curnier import solve_alart_curnier
from .contact_law import MANY_CONTACTS, ContactBlock, law_residual
from .one_contact import solve_one_contact
from .work_limit import WorkLimit

__all__ = ["SWEEP_TOLERANCE", "Solution", "clear_rounding", "principal_axes", "solve_gauss_seidel", "turn_tangents"]

SWEEP_TOLERANCE = 1e-11
"""Change of a contact's velocity in a sweep, as a share of the largest approach speed, at which the sweeps end.
It is the accuracy of the motion: with 1e-9 residuals are up to 1e-9, and the model counts more as not converged."""

MAX_SWEEPS = 30
"""Bound on the sweeps, after which all contacts are solved together. Bounds of 10 to 200 give the same motion in about
the same time on 1 080 patches of two ships; with fewer sweeps ships in a row need Newton's method more often."""

LEAST_SWEEPS = 8
"""Sweeps over few contacts that are made although the work of the step is spent. With fewer, approach is left at
contacts that a solver of a fixed count of sweeps would stop."""

LEAST_NEWTON_STEPS = 6
"""Steps of Newton's method for many contacts, in the same case. They cost less than LEAST_SWEEPS, and solve half of all
patches from the impulses of the substep before."""

MAX_SWEEPS_OF_MANY = 2
"""Bound on the sweeps of so many contacts. Sweeps pass impulses through a raft of ships from ship to ship, so Newton's
method is faster. With 20, jammed rafts spend their work on sweeps, and twice as many substeps end unconverged."""

MAX_ROUNDS = 20
"""Bound on the rounds of ACLM and Newton's method. Few patches need any: 11 of 2 160 with normals up to a wedge apart
are not solved without."""

IMMOBILE = 1e-9
"""Share of the largest diagonal entry of W below which no ship moves along a tangent. Smaller: friction is divided by
rounding. Larger: friction is taken from ships that can just move."""


Others = tuple[int, float, float, float, float, float, float, float, float, float]
"""First column of a block of W, and the nine numbers of the block by rows."""


@dataclass(frozen=True)
class Solution:
    """Impulses P (k, 3) [N s] in contact axes (normal, two tangents), sweeps taken, and the residual of the law of
    contact (law_residual) as a share of the largest approach speed."""

    P: Array
    residual: float
    sweeps: int


def solve_gauss_seidel(
    W: Array,
    v: Array,
    mu: float,
    start: Array | None = None,
    scale: float | None = None,
    work: WorkLimit | None = None,
) -> Solution:
    """Impulses of k contacts in a plastic impact; restitution is in poisson_restitution.py.

    W (3k, 3k) [1/kg] and v (3k,) [m/s] in contact axes, per contact (normal, t1, t2). v is the velocity of ship b
    relative to ship a before the impact, with a negative normal part on approach. start (k, 3): impulses to start from,
    of which only the direction counts. scale [m/s]: approach that tolerance and residual are shares of; None: the
    largest of v. Of an impact that is solved in parts it is the approach before the first. An approach within the
    tolerance counts as none. work: the bound on what the solver may do; none: unbounded.
    """
    k = len(v) // 3
    approach = -min((float(x) for x in v[0::3]), default=0.0)
    if scale is None:
        scale = approach
    elif approach <= SWEEP_TOLERANCE * scale:
        return Solution(np.zeros((k, 3)), max(0.0, approach) / scale, 0)
    if approach <= 0.0:
        return Solution(np.zeros((k, 3)), 0.0, 0)
    T = principal_axes(W)
    few = len(v) <= MOST_ROWS  # where BLAS begins no threads
    W_p, v_p = turn_tangents(T, W), T @ v if few else multiply(T, v)
    clear_rounding(W_p, v_p)
    blocks = ContactBlock.of_all(W_p)
    if k == 1:
        v_n, v_1, v_2 = v_p.tolist()
        P_p, sweeps = np.array([solve_one_contact(blocks[0], (v_n, v_1, v_2), mu)[0]]), 1
    else:
        P_p, sweeps = _sweep(W_p, v_p, mu, blocks, scale, _scale_start(W, v, start, T), work or WorkLimit())
    P = P_p.ravel() @ T if few else multiply(T.T, P_p.ravel())
    return Solution(P.reshape(k, 3), law_residual(W_p, v_p, mu, P_p) / scale, sweeps)


def principal_axes(W: Array) -> Array:
    """Rotation T (3k, 3k) of the tangents of every contact to the principal axes of its own W_tt."""
    T, on, beside = np.eye(len(W)), W.diagonal().tolist(), W.diagonal(1).tolist()
    for n in range(1, len(W), 3):
        angle = 0.5 * atan2(2.0 * beside[n], on[n] - on[n + 1])
        c, s = cos(angle), sin(angle)
        T[n, n], T[n, n + 1], T[n + 1, n], T[n + 1, n + 1] = c, s, -s, c
    return T


def turn_tangents(T: Array, W: Array) -> Array:
    """T W T' (3k, 3k)."""
    if len(T) < 3 * MANY_CONTACTS:
        turned: Array = T @ W @ T.T
        return turned
    return rotate_rows(T, rotate_rows(T, W).T)


def clear_rounding(W: Array, v: Array) -> None:
    """Set to zero, in place, the rows and columns of tangents along which no ship moves."""
    diagonal = W.diagonal().tolist()
    least = IMMOBILE * max(diagonal)
    for n, w in enumerate(diagonal):
        if n % 3 and w <= least:
            W[n], W[:, n] = 0.0, 0.0
            if abs(v[n]) <= IMMOBILE * float(np.abs(v).max()):
                v[n] = 0.0


def _scale_start(W: Array, v: Array, start: Array | None, T: Array) -> Array:
    """Start (k, 3) in principal axes, of the size that dissipates most energy; zero if there is none.

    Between substeps the split of an impulse between the contacts persists, its size does not.
    """
    if start is None or not start.any():
        return np.zeros((len(v) // 3, 3))
    P = start.ravel()
    share = max(0.0, -float(P @ v)) / float(P @ multiply(W, P))
    if not np.isfinite(share):
        return np.zeros((len(v) // 3, 3))
    return (T @ (share * P) if len(v) <= MOST_ROWS else multiply(T, share * P)).reshape(-1, 3)


def _sweep(
    W: Array, v: Array, mu: float, blocks: list[ContactBlock], scale: float, start: Array, work: WorkLimit
) -> tuple[Array, int]:
    """Impulses (k, 3) and the sweeps taken. scale: largest approach speed [m/s]."""
    before, many = v.tolist(), len(blocks) >= MANY_CONTACTS
    others, few = (_without_own_blocks(W), []) if many else (W, _list_others(W))
    impulses = np.empty(len(v))
    P: list[float] = start.ravel().tolist()
    angles: list[float | None] = [None] * len(blocks)
    sweeps, tolerance = 0, SWEEP_TOLERANCE * scale
    most, kept = MAX_SWEEPS_OF_MANY if many else MAX_SWEEPS, 0.5 * work.left  # kept for Newton's method
    aitken = Aitken()
    while True:
        sweeps, change, last = sweeps + 1, 0.0, P[:]
        work.spend_sweep(len(blocks))
        if many:
            impulses[:] = P
        for i, W_i in enumerate(blocks):
            n = 3 * i
            p, p_1, p_2 = P[n : n + 3]
            # Velocity at this contact without its own impulse.
            f, f_1, f_2 = before[n : n + 3]
            if many:
                g, g_1, g_2 = others[n : n + 3].dot(impulses).tolist()
                f, f_1, f_2 = f + g, f_1 + g_1, f_2 + g_2
            else:
                for m, a, b, c, d, e, g, h, j, k in few[i]:
                    x, y, z = P[m : m + 3]
                    f += a * x + b * y + c * z
                    f_1 += d * x + e * y + g * z
                    f_2 += h * x + j * y + k * z
            new, angles[i] = solve_one_contact(W_i, (f, f_1, f_2), mu, angles[i])
            P[n : n + 3] = new
            if many:
                impulses[n : n + 3] = new
            W_nn, w_n1, w_n2, a_1, a_2, _, _ = W_i
            d, d_1, d_2 = new[0] - p, new[1] - p_1, new[2] - p_2
            change = max(
                change, abs(W_nn * d + w_n1 * d_1 + w_n2 * d_2), abs(w_n1 * d + a_1 * d_1), abs(w_n2 * d + a_2 * d_2)
            )
        if change <= tolerance:
            return np.array(P).reshape(-1, 3), sweeps
        if sweeps >= (LEAST_SWEEPS if work.left < kept and not many else most):
            if many:
                work.reserve_newton_steps(LEAST_NEWTON_STEPS, len(blocks))
            return _solve_together(W, v, mu, np.array(P).reshape(-1, 3), tolerance, work), sweeps
        P = aitken.extrapolate(P, last)


def _without_own_blocks(W: Array) -> Array:
    """W (3k, 3k) with zeros in the blocks on its diagonal: what the other contacts do to each."""
    others: Array = W.copy()
    for n in range(0, len(W), 3):
        others[n : n + 3, n : n + 3] = 0.0
    return others


def _list_others(W: Array) -> list[list[Others]]:
    """The same of few contacts: per contact the blocks of the others, each with its first column before its rows."""
    rows, starts = W.tolist(), range(0, len(W), 3)
    return [
        [(m, *_three(rows[n], m), *_three(rows[n + 1], m), *_three(rows[n + 2], m)) for m in starts if m != n]
        for n in starts
    ]


def _three(row: list[float], first: int) -> tuple[float, float, float]:
    return row[first], row[first + 1], row[first + 2]


def _solve_together(W: Array, v: Array, mu: float, P: Array, tolerance: float, work: WorkLimit) -> Array:
    """Impulses (k, 3) with a residual of at most `tolerance` [m/s] by the methods that solve all contacts together, or
    the best that were found."""
    none = np.zeros_like(P)
    if law_residual(W, v, mu, P) > law_residual(W, v, mu, none):  # as from a start that belongs to other contacts
        P = none
    best = solve_alart_curnier(W, v, mu, P, tolerance, work)
    least, P = law_residual(W, v, mu, best), np.zeros_like(P)
    for _ in range(MAX_ROUNDS):
        if least <= tolerance or work.is_spent:
            break
        P = solve_aclm(W, v, mu, P, tolerance, work)
        candidate = solve_alart_curnier(W, v, mu, P, tolerance, work)
        if (residual := law_residual(W, v, mu, candidate)) < least:
            best, least = candidate, residual
    return best
