"""Projected Gauss-Seidel: non-penetration and Coulomb friction at all contacts at once.

For every contact, with v = v(0) + W P split along the normal (n) and across it (t), and friction mu:

    0 <= P_n   perpendicular to   v_n >= 0                         no approach left, no pull
    |P_t| <= mu P_n,   and while sliding   P_t = -mu P_n v_t / |v_t|    friction inside the cone, against the slip

Guan et al. 2014, equations (5)-(13), state this with a pyramid for the cone, one scalar row at a time, and stop after a
fixed count. Here a contact is one 3 x 3 block, the cone is a cone, and the sweep ends on a residual: the largest change
of contact velocity that solving any block anew would make, in units of the largest approach speed. (Their figure 4
clips the increment of the impulse; it is the accumulated impulse that must be projected, as is done here.)

One contact alone takes one sweep and is not measured by the residual: where ships are held in some direction W is
singular, and the search for the slip's angle can miss. restitution.py checks it and then follows the slip path instead;
of several contacts nobody checks that yet. Plain floats: a block is nine numbers, arrays would cost more than the sums.

References: Guan et al. (2014); Catto (2005), "Iterative dynamics with temporal coherence"; Jourdan, Alart and Jean
(1998) for the block form with friction.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin
from typing import Any

import numpy as np
import numpy.typing as npt

from ..ship.frames import Array

__all__ = ["MAX_SWEEPS", "RESIDUAL", "Solution", "solve_pgs"]

RESIDUAL = 1e-11
"""Relative velocity residual at which the sweeps end."""

MAX_SWEEPS = 10_000
"""Bound on the sweeps: nearly dependent contacts need some thousands, and a sweep costs microseconds."""

ALIGNED = 1e-13
"""Angle [rad] below which friction counts as exactly against the slip."""

RANK = 1e-9
"""Singular values of a block below this share of the largest are directions in which neither ship can move."""

Row = tuple[float, float, float]
Block = tuple[Row, Row, Row]


@dataclass(frozen=True)
class Solution:
    """P (k, 3) [N s] in the contacts' axes (normal, two tangents); residual (relative velocity); sweeps taken."""

    P: Array
    residual: float
    sweeps: int


def solve_pgs(W: Array, v: Array, mu: float) -> Solution:
    """Impulses of k contacts in a plastic impact. W (3k, 3k) [1/kg] and v (3k,) [m/s] in contact axes, per contact
    (normal, t1, t2).

    v is the relative velocity before; its normal part is negative on approach. Restitution is in restitution.py.
    """
    k = len(v) // 3
    scale = max((-float(x) for x in v[0::3]), default=0.0)
    if scale <= 0.0:
        return Solution(np.zeros((k, 3)), 0.0, 0)
    blocks = [_block(W[3 * i : 3 * i + 3, 3 * i : 3 * i + 3]) for i in range(k)]
    inverses = [_block(np.linalg.pinv(W[3 * i : 3 * i + 3, 3 * i : 3 * i + 3], RANK, hermitian=True)) for i in range(k)]
    rows, start = W.tolist(), v.tolist()
    P = [0.0] * (3 * k)
    angles: list[float | None] = [None] * k
    residual, sweeps = np.inf, 0
    while residual > RESIDUAL and sweeps < (1 if k == 1 else MAX_SWEEPS):
        residual, sweeps = 0.0, sweeps + 1
        for i in range(k):
            first = 3 * i
            old = (P[first], P[first + 1], P[first + 2])
            block = blocks[i]
            # Contact velocity if this contact had no impulse: all the others' effect.
            free = tuple(
                start[first + r] + sum(map(_times, rows[first + r], P)) - _dot(block[r], old) for r in range(3)
            )
            new, angles[i] = _one_contact(block, inverses[i], free, mu, angles[i])
            P[first : first + 3] = new
            step = (new[0] - old[0], new[1] - old[1], new[2] - old[2])
            residual = max(residual, *(abs(_dot(row, step)) for row in block))
        residual /= scale
    return Solution(np.array(P).reshape(k, 3), 0.0 if k == 1 else residual, sweeps)


def _block(m: npt.NDArray[np.floating[Any]]) -> Block:
    a, b, c = m.tolist()
    return (tuple(a), tuple(b), tuple(c))


def _times(a: float, b: float) -> float:
    return a * b


def _dot(a: Row, b: Row) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _one_contact(W: Block, inverse: Block, v: Row, mu: float, near: float | None) -> tuple[Row, float | None]:
    """Impulse of one contact alone: apart, else stick, else slide; and the angle of the friction if it slides."""
    if v[0] >= 0.0:
        return (0.0, 0.0, 0.0), None
    stick = (-_dot(inverse[0], v), -_dot(inverse[1], v), -_dot(inverse[2], v))
    if hypot(stick[1], stick[2]) <= mu * stick[0]:
        return stick, None
    return _slide(W, v, mu, near)


def _slide(W: Block, v: Row, mu: float, near: float | None) -> tuple[Row, float]:
    """Sliding impulse P_n (1, mu cos a, mu sin a): P_n makes the normal velocity vanish, and the slip that then remains
    must point against the friction. `turn` is the angle by which it misses; its zero is sought next to the friction
    against the slip before (or next to `near`, the angle of the last sweep)."""

    def impulse(a: float) -> Row:
        c, s = mu * cos(a), mu * sin(a)
        felt = W[0][0] + W[0][1] * c + W[0][2] * s
        if felt <= 0.0:  # friction so strong that it would pull the hulls together: the normal alone holds
            return (-v[0] / W[0][0], 0.0, 0.0)
        P_n = -v[0] / felt
        return (P_n, P_n * c, P_n * s)

    def turn(a: float) -> float:
        P = impulse(a)
        slip_1, slip_2 = v[1] + _dot(W[1], P), v[2] + _dot(W[2], P)
        c, s = cos(a), sin(a)
        return atan2(s * slip_1 - c * slip_2, -(c * slip_1 + s * slip_2))

    start = atan2(-v[2], -v[1]) if near is None else near
    angle = start if mu == 0.0 else _zero_near(turn, start)
    return impulse(angle), angle


def _zero_near(f: Callable[[float], float], start: float) -> float:
    """The zero of f next to `start`, f being an angle in (-pi, pi] of period 2 pi: bracketed outwards, then closed
    in."""
    step = pi / 48
    left = right = start
    f_left = f_right = f(start)
    for a, f_a in ((start, f_left), (start + pi, f(start + pi))):
        if abs(f_a) < ALIGNED:  # ships that move in the plane slide this way or the other, nothing between
            return a
    for _ in range(48):
        # Outwards first to the side to which f points: near a zero friction turns towards it.
        for side in (1, -1) if f_left + f_right > 0.0 else (-1, 1):
            old, f_old = (right, f_right) if side > 0 else (left, f_left)
            new = old + side * step
            f_new = f(new)
            if f_old * f_new <= 0.0 and abs(f_new - f_old) < pi:  # a zero, not the jump from pi to -pi
                return _closed_in(f, old, new, f_old, f_new)
            if side > 0:
                right, f_right = new, f_new
            else:
                left, f_left = new, f_new
    return start


def _closed_in(f: Callable[[float], float], a: float, b: float, f_a: float, f_b: float) -> float:
    """Zero of f between a and b, to rounding: regula falsi with Illinois' weights."""
    for _ in range(100):
        if f_a == f_b:
            return a
        c = b - f_b * (b - a) / (f_b - f_a)
        f_c = f(c)
        if f_c == 0.0 or c in (a, b):
            return c
        if f_c * f_b < 0.0:
            a, f_a = b, f_b
        else:
            f_a *= 0.5
        b, f_b = c, f_c
    return b
