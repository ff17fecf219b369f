"""Collisions and scratches in time.

A collision (episode) of a pair opens at its first contact and closes when the pair has been apart for
`minimum_separation_time`. A scratch is contact without a pause longer than SCRATCH_PAUSE. Both are numbered from 1.
Trackers read contacts and never write back.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import acos
from typing import Any

import numpy as np

from ..ship.frames import Array
from .dynamics.body_state import BodyState
from .dynamics.contact import Contact, contact_velocity

__all__ = ["SCRATCH_PAUSE", "Collisions", "Impact", "heading_angle"]

SCRATCH_PAUSE = 0.5
"""Pause of contact [s] that a scratch survives: ships that slide along each other touch and part at every substep."""


@dataclass
class Impact:
    """The start of a collision: time [s], first contact point in n [m], closing speed along the normal [m/s], and the
    angle between the headings [rad], 0 to pi (0: same heading, pi: head-on). ship_a, ship_b are 1-based."""

    time: float = 0.0
    point: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    closing_speed: float = 0.0
    angle: float = 0.0
    ship_a: int = 0
    ship_b: int = 0


@dataclass
class _Pair:
    impact: int = 0  # number of the open collision, 0: none
    scratch: int = 0
    last_contact: float = 0.0


class Collisions:
    """Opens, numbers and closes the collisions and scratches of every pair."""

    def __init__(self, minimum_separation_time: float) -> None:
        self._separation = minimum_separation_time
        self._pairs: dict[tuple[int, int], _Pair] = {}
        self.impacts = 0
        self.scratches = 0
        self.latest = Impact()

    def close_old(self, t: float) -> None:
        """Close what has been without contact for long enough at time t [s]."""
        for pair in self._pairs.values():
            if pair.scratch and t - pair.last_contact > SCRATCH_PAUSE:
                pair.scratch = 0
            if pair.impact and t - pair.last_contact >= self._separation:
                pair.impact = 0

    def touch(self, t: float, contacts: Sequence[Contact], states: Sequence[BodyState]) -> None:
        """Take the contacts of one pair at time t [s], before their impulses change the states' velocities."""
        a, b = contacts[0].a, contacts[0].b
        pair = self._pairs.setdefault((a, b), _Pair())
        if not pair.impact:
            self.impacts += 1
            pair.impact = self.impacts
            point = sum((c.point for c in contacts), np.zeros(3)) / len(contacts)
            closing = max(-float(contact_velocity(c, states) @ c.normal) for c in contacts)
            self.latest = Impact(
                t, point.tolist(), max(closing, 0.0), heading_angle(states[a].R, states[b].R), a + 1, b + 1
            )
        if not pair.scratch:
            self.scratches += 1
            pair.scratch = self.scratches
        pair.last_contact = t

    def is_open(self, a: int, b: int) -> bool:
        """Whether the pair is in a collision."""
        return (a, b) in self._pairs and self._pairs[a, b].impact > 0

    def open_ships(self) -> set[int]:
        """Bodies that are in a collision with any other."""
        return {ship for pair, state in self._pairs.items() if state.impact for ship in pair}

    def numbers(self, a: int, b: int) -> tuple[int, int]:
        """(collision, scratch) of a pair, 0 where none is open."""
        pair = self._pairs.get((a, b), _Pair())
        return pair.impact, pair.scratch

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        pairs = [[a, b, p.impact, p.scratch, p.last_contact] for (a, b), p in self._pairs.items()]
        latest = {**vars(self.latest), "point": list(self.latest.point)}
        return {"pairs": pairs, "impacts": self.impacts, "scratches": self.scratches, "latest": latest}

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state that get_state returned."""
        self._pairs = {(a, b): _Pair(impact, scratch, last) for a, b, impact, scratch, last in state["pairs"]}
        self.impacts, self.scratches = state["impacts"], state["scratches"]
        latest = dict(state["latest"])
        latest["point"] = list(latest["point"])
        self.latest = Impact(**latest)


def heading_angle(R_a: Array, R_b: Array) -> float:
    """Angle [rad] in 0..pi between the ships' headings, from the horizontal parts of their forward axes."""
    forward_a, forward_b = R_a[:2, 0], R_b[:2, 0]
    c = float(forward_a @ forward_b) / float(np.linalg.norm(forward_a) * np.linalg.norm(forward_b))
    return acos(min(1.0, max(-1.0, c)))
