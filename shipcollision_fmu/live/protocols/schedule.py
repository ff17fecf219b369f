"""What is due when, in simulated time.

    Every               a fixed period
    AisSchedule         position reports of AIS class A, by speed and change of course
    DeadReckoning       when the extrapolation of the last PDU misses the ship

A time that goes back (a mark of the instructor's) begins anew: what is due is due at once.

Intervals: ITU-R M.1371-5, annex 1, table 1. A ship changes course while its heading differs by more than 5 deg from the
mean of the last 30 s, and for 20 s afterwards (annex 2, 4.3.3.4). Dead reckoning: IEEE 1278.1, defaults of annex E.
"""

from __future__ import annotations

from collections import deque
from math import acos, floor

import numpy as np

from ...ship.frames import rotation_vector
from ...ship.ship_type import KNOT
from .dis import Entity
from .fix import Fix

__all__ = ["AisSchedule", "DeadReckoning", "Every"]

ROUNDING = 1e-6
"""[s] By which a sample may come early: the times of samples are rounded."""

MEAN_OVER, TURNED, HELD = 30.0, 5.0, 20.0
"""[s], [deg], [s] of a change of course."""
SLOW, FAST = 14.0 * KNOT, 23.0 * KNOT

HEARTBEAT, DISTANCE, ANGLE = 5.0, 1.0, 3.0 * np.pi / 180.0
"""[s], [m], [rad] after which an entity state is sent again."""


class Every:
    """Due once in every period [s]: at the first sample in it."""

    def __init__(self, period: float) -> None:
        self._period, self._last = period, -1

    def is_due(self, time: float) -> bool:
        """Whether a sample at this time is due; it then counts as sent."""
        number = floor((time + ROUNDING) / self._period)
        due, self._last = number != self._last, number
        return due


class AisSchedule:
    """Position reports of one ship of class A."""

    def __init__(self) -> None:
        self._last: float | None = None
        self._headings: deque[tuple[float, float]] = deque()
        self._changing_until = float("-inf")

    def is_due(self, time: float, fix: Fix) -> bool:
        """Whether a report at this time is due; it then counts as sent."""
        if self._last is not None and time < self._last - ROUNDING:
            self.__init__()  # type: ignore[misc]
        if self._is_turning(time, fix.heading):
            self._changing_until = time + HELD
        interval = find_interval(fix.sog, time <= self._changing_until)
        if self._last is not None and time < self._last + interval - ROUNDING:
            return False
        self._last = time
        return True

    def _is_turning(self, time: float, heading: float) -> bool:
        headings = self._headings
        if not headings or time >= headings[-1][0] + 0.5:
            headings.append((time, heading))
        while headings and headings[0][0] < time - MEAN_OVER:
            headings.popleft()
        off = [(h - heading + 180.0) % 360.0 - 180.0 for _, h in headings]
        return bool(off) and abs(sum(off) / len(off)) > TURNED


def find_interval(sog: float, changing: bool) -> float:
    """Seconds between two reports of a ship under way, at a speed [m/s]."""
    if sog > FAST:
        return 2.0
    if sog > SLOW:
        return 2.0 if changing else 6.0
    return 10.0 / 3.0 if changing else 10.0


class DeadReckoning:
    """Entity states of one ship."""

    def __init__(self) -> None:
        self._time, self._entity = float("nan"), None

    def is_due(self, time: float, entity: Entity) -> bool:
        """Whether an entity state at this time is due; it then counts as sent."""
        if self._entity is not None and 0.0 <= time - self._time < HEARTBEAT - ROUNDING:
            last: Entity = self._entity
            h = time - self._time
            missed = float(np.linalg.norm(entity.place - last.place - h * last.velocity))
            turned = rotation_vector(np.array(last.rate) * h).T @ last.R_be
            cosine = 0.5 * (float(np.trace(entity.R_be @ turned.T)) - 1.0)
            if missed <= DISTANCE and acos(max(-1.0, min(1.0, cosine))) <= ANGLE:
                return False
        self._time, self._entity = time, entity  # type: ignore[assignment]
        return True
