"""Collisions and scratches in time, decided here and nowhere else.

    collision    of a pair: opens at the first contact (the *impact*), closes when the pair has been without contact for
                 minimum_separation_time
    scratch      contact of a pair without a pause longer than SCRATCH_PAUSE

Both are numbered from 1. Contacts are read and never changed. Of ships `answered_once` (feedback "none": models that
ignore contact) only the impact is answered with impulses; the rest of the collision is merely recorded. So are all
contacts of two bodies that are `immovable`.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, field
from math import acos, degrees
from typing import Any

import numpy as np

from ..ship.frames import Array
from .dynamics.body_state import BodyState
from .dynamics.contact import Contact, mean_velocity
from .geometry.broad_phase import Pair
from .interface import NO_IMPACT, Impact

__all__ = ["SCRATCH_PAUSE", "Collisions", "Numbers", "heading_angle"]

SCRATCH_PAUSE = 0.5
"""Pause of contact [s] that does not end a scratch: sliding ships touch and part at every substep. With zero, a scratch
would fall into one piece per substep."""

Numbers = dict[Pair, tuple[int, int, Impact]]
"""(number of the collision, number of the scratch, impact with which the collision began) of pairs in contact."""


@dataclass
class _Pair:
    collision: int = 0  # number of the open collision, 0: none
    scratch: int = 0
    last_contact: float = 0.0
    impact: Impact = field(default_factory=lambda: NO_IMPACT)  # with which the collision began


class Collisions:
    """Opens, numbers and closes the collisions and scratches of every pair. count: collisions so far."""

    def __init__(
        self, minimum_separation_time: float, answered_once: Container[int] = (), immovable: Container[int] = ()
    ) -> None:
        self._separation = minimum_separation_time
        self._answered_once, self._immovable = answered_once, immovable
        self._pairs: dict[Pair, _Pair] = {}
        self.count = 0
        self.scratches = 0
        self.latest = Impact()
        self.opened: list[Impact] = []
        """Collisions that opened since the list was last emptied. No part of the state: it is for the log alone."""

    def close_old(self, t: float) -> None:
        """Close what has been without contact for long enough at time t [s]."""
        for pair in self._pairs.values():
            if pair.scratch and t - pair.last_contact > SCRATCH_PAUSE:
                pair.scratch = 0
            if pair.collision and t - pair.last_contact >= self._separation:
                pair.collision = 0

    def split_by_answer(self, pairs: Sequence[Pair]) -> tuple[Sequence[Pair], Sequence[Pair]]:
        """(pairs whose contacts are answered with impulses, pairs whose contacts are merely recorded)."""
        if not (self._answered_once or self._immovable):
            return pairs, ()
        recorded = {pair for pair in pairs if self._is_recorded(*pair)}
        return [pair for pair in pairs if pair not in recorded], [pair for pair in pairs if pair in recorded]

    def _is_recorded(self, a: int, b: int) -> bool:
        if a in self._immovable and b in self._immovable:
            return True
        pair = self._pairs.get((a, b))
        return (a in self._answered_once or b in self._answered_once) and pair is not None and pair.collision > 0

    def register(self, t: float, contacts: Sequence[Contact], states: Sequence[BodyState]) -> Numbers:
        """Open what begins with these contacts at time t [s]; the numbers of every pair in contact.

        Call it before the impulses of the instant are booked: the closing speed is that of the approach.
        """
        by_pair: dict[Pair, list[Contact]] = {}
        for contact in contacts:
            by_pair.setdefault((contact.a, contact.b), []).append(contact)
        numbers = {}
        for key, of_pair in by_pair.items():
            pair = self._pairs.setdefault(key, _Pair())
            if not pair.collision:
                self.count += 1
                pair.collision = self.count
                pair.impact = self.latest = _find_impact(t, of_pair, states)
                self.opened.append(self.latest)
            if not pair.scratch:
                self.scratches += 1
                pair.scratch = self.scratches
            pair.last_contact = t
            numbers[key] = pair.collision, pair.scratch, pair.impact
        return numbers

    def bodies_in_collision(self) -> set[int]:
        """Bodies in an open collision with any other."""
        return {body for pair, state in self._pairs.items() if state.collision for body in pair}

    def open_pairs(self) -> list[Pair]:
        """Pairs in an open collision."""
        return [pair for pair, state in self._pairs.items() if state.collision]

    def describe_opened(self, names: Sequence[str]) -> list[str]:
        """A line about each collision of `opened`; names of the bodies."""
        first = self.count - len(self.opened) + 1
        return [
            f"collision {number}: {names[impact.ship_a - 1]} and {names[impact.ship_b - 1]} touch at "
            f"t = {impact.time:.3f} s, north {impact.point[0]:.1f} m, east {impact.point[1]:.1f} m, closing at "
            f"{impact.closing_speed:.2f} m/s, {degrees(impact.angle):.0f} deg between their headings"
            for number, impact in enumerate(self.opened, first)
        ]

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        pairs = [
            [a, b, p.collision, p.scratch, p.last_contact, _as_data(p.impact)] for (a, b), p in self._pairs.items()
        ]
        return {"pairs": pairs, "count": self.count, "scratches": self.scratches, "latest": _as_data(self.latest)}

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self._pairs = {
            (a, b): _Pair(collision, scratch, last, _from_data(impact))
            for a, b, collision, scratch, last, impact in state["pairs"]
        }
        self.opened.clear()
        self.count, self.scratches, self.latest = state["count"], state["scratches"], _from_data(state["latest"])


def _as_data(impact: Impact) -> dict[str, Any]:
    return {**vars(impact), "point": list(impact.point)}


def _from_data(data: dict[str, Any]) -> Impact:
    return Impact(**{**data, "point": list(data["point"])})


def _find_impact(t: float, contacts: Sequence[Contact], states: Sequence[BodyState]) -> Impact:
    """The impact of one pair: at the middle of its contacts, with the largest approach of any."""
    a, b = contacts[0].a, contacts[0].b
    point = sum((c.point for c in contacts), np.zeros(3)) / len(contacts)
    closing = max(-float(mean_velocity(c, states) @ c.normal) for c in contacts)
    angle = heading_angle(states[a].R, states[b].R)
    return Impact(t, point.tolist(), max(0.0, closing), angle, a + 1, b + 1)


def heading_angle(R_a: Array, R_b: Array) -> float:
    """Angle [rad] in 0..pi between the ships' headings, from the horizontal parts of their forward axes."""
    forward_a, forward_b = R_a[:2, 0], R_b[:2, 0]
    c = float(forward_a @ forward_b) / float(np.linalg.norm(forward_a) * np.linalg.norm(forward_b))
    return acos(min(1.0, max(-1.0, c)))
