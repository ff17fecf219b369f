"""Passivity: no impulses add kinetic energy. Impulses that would are scaled back to an elastic impact.

    T(s P) - T(0) = s P.v + 1/2 s^2 P' W P        v: relative velocities before, W: delassus.py             [J]

is zero at s = -2 P.v / P' W P. The solvers do not add energy by themselves, except in two cases: Newton's restitution
with friction; and contact solved with a velocity bias (other_forces.py) whose force has ended. Bodies that touch
directly or through others form a group and are scaled together. Each then stays in balance and in its friction cone.
Obstacles do not move, and connect no groups.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from math import hypot
from operator import add  # sum() rounds otherwise from Python 3.12 on

from ...ship.frames import Array
from .body_state import BodyState
from .contact import NO_IMPULSE, Impulse, energy_velocities

__all__ = ["enforce_passivity", "group_impulses"]

ROUNDING = 1e-9
"""Gain, as a share of the work of the impulses, that is rounding. With zero, exact elastic impacts would be scaled."""


def enforce_passivity(impulses: Sequence[Impulse], states: Sequence[BodyState]) -> tuple[list[Impulse], float]:
    """(the impulses, scaled where they would add energy; the largest velocity [m/s] that a body lost by it)."""
    passive: list[Impulse] = []
    taken_off = 0.0
    for group in group_impulses(impulses, states) if impulses else ():
        s, speed = _scale(group, states)
        taken_off = max(taken_off, (1.0 - s) * speed)
        passive += group if s == 1.0 else [Impulse(i.contact, s * i.P) for i in group]
    return passive, taken_off


def _scale(group: Sequence[Impulse], states: Sequence[BodyState]) -> tuple[float, float]:
    """The factor s of a group, and where it is not 1 the largest change of the velocity of CO by the group [m/s]."""
    work, J = 0.0, dict[int, Array]()
    for impulse, v in zip(group, energy_velocities([i.contact for i in group], states), strict=True):
        if impulse.P.tolist() == NO_IMPULSE:
            continue
        c, P = impulse.contact, impulse.P
        work += float(P @ v)
        for body, J_body in ((c.a, -(P @ c.G_a)), (c.b, P @ c.G_b)):
            J[body] = J[body] + J_body if body in J else J_body
    changes = {body: states[body].M_inverse @ J_body for body, J_body in J.items()}
    quadratic = reduce(add, (float(J[body] @ change) for body, change in changes.items()), 0.0)
    if quadratic <= 0.0 or work + 0.5 * quadratic <= ROUNDING * (abs(work) + quadratic):
        return 1.0, 0.0
    return max(0.0, -2.0 * work / quadratic), max(hypot(*change[:3].tolist()) for change in changes.values())


def group_impulses(impulses: Sequence[Impulse], states: Sequence[BodyState]) -> list[list[Impulse]]:
    """Impulses by the groups of bodies that they connect; obstacles connect none."""
    pairs = {(i.contact.a, i.contact.b) for i in impulses}
    if len(pairs) == 1:
        return [list(impulses)]
    root = {ship: ship for pair in pairs for ship in pair}

    def find(ship: int) -> int:
        while root[ship] != ship:
            ship = root[ship]
        return ship

    for a, b in sorted(pairs):
        if not (states[a].fixed or states[b].fixed):
            root[find(b)] = find(a)
    groups: dict[int, list[Impulse]] = {}
    for impulse in impulses:
        c = impulse.contact
        groups.setdefault(find(c.b if states[c.a].fixed else c.a), []).append(impulse)
    return list(groups.values())
