"""Watch over what a ship model gives as its motion: position against velocity, and heading against rate.

The ship is compared with itself over windows of a few steps (motion_check.py). Between the windows are pauses, so that
ships that lie still or sail north cost little.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import hypot, inf
from typing import Any

from .findings import Found
from .interface import ShipState
from .motion_check import SLOW, Motion, judge_motion

__all__ = ["MotionWatch"]

CHANGES, LEAST_CHANGES, DURATION = 8, 3, 1.0
"""A window ends after so many changes of the position, or after fewer and so many seconds. With fewer, a ship model
whose step is slightly longer than the collision model's would be suspected; in longer ones a ship surges in waves."""

PATIENCE = 32
"""Steps without a change of the position after which a window is given up."""

PAUSE, LONGEST_PAUSE, LONGEST_STRIDE = 128, 512, 64
"""Steps between windows, twice as many after each, and most steps between looks at a ship at rest. A window costs 5 %
of a far step per ship and step."""

WINDOWS = 2
"""Windows in a row with the same finding before it is said: a host may move a ship once."""

STILL_STEPS, STILL = 50, 15.0
"""A ship with a velocity whose position has not changed since the start for so many steps and seconds is not connected.
With fewer, ship models with steps ten times as long and tracks with a report every 10 s would be suspected."""


@dataclass
class MotionWatch:
    """Watch over the motion of a ship, until it was seen to be right.

    next: time [s] of the next look; stride, pause: in steps; start: of the window; position: last received; changes: of
    it in the window, -2 before the first is received; idle: steps without one; still_since: time [s] from which on
    the ship had a velocity without a change of the position, inf once it moved; speed, rate: seen to be right.
    """

    next: float = -inf
    stride: int = 1
    pause: int = PAUSE
    start: list[Any] | None = None
    position: list[float] = field(default_factory=list)
    changes: int = -2
    idle: int = 0
    still_since: float = -inf
    suspicion: str = ""
    windows: int = 0
    speed: bool = False
    rate: bool = False
    done: bool = False

    def look(self, ship: ShipState, is_settled: bool, t: float, H: float) -> Found | None:
        """What is found in the step of H [s] from t [s]. If the ship moves, begin a window, go on with it, and judge it
        at its end. is_settled: whether no impulse is pending, which would change the velocity within a step."""
        if not is_settled:
            self._rest(t, H, self.pause)
        elif ship.position == self.position:
            self.idle += 1
            if self.changes < 0 or self.idle > PATIENCE:
                return self._judge_still(ship, t, H)
        else:
            self.still_since = inf if self.position or self.still_since == inf else t
            self.idle, self.position, self.next = 0, list(ship.position), t
            self.changes += 1
            now = Motion(t, self.position, list(ship.attitude), list(ship.velocity), list(ship.rate))
            if self.changes == 0:
                self.start = list(now)
            elif self.start is not None:
                T = t - self.start[0]
                if self.changes >= CHANGES or (self.changes >= LEAST_CHANGES and T >= DURATION):
                    return self._judge(Motion(*self.start), now, H)
        return None

    def _judge(self, start: Motion, now: Motion, H: float) -> Found | None:
        verdict = judge_motion(start, now)
        self.speed, self.rate = self.speed or verdict.speed, self.rate or verdict.rate
        self.done = self.speed and self.rate
        self.windows = self.windows + 1 if verdict.finding == self.suspicion else 1
        self.suspicion = verdict.finding
        if verdict.finding and self.windows >= WINDOWS:
            return verdict.finding, verdict.measured
        if verdict.finding:
            self.start, self.changes = list(now), 0  # the next window begins at once
        else:
            self._rest(now.t, H, self.pause)
            self.pause = min(2 * self.pause, LONGEST_PAUSE)
        return None

    def _judge_still(self, ship: ShipState, t: float, H: float) -> Found | None:
        """What is found of a ship whose position has not changed since the last look, and look again after a stride."""
        u, v, _ = ship.velocity
        if u * u + v * v <= SLOW * SLOW:
            self.still_since = inf if self.still_since == inf else t
        elif t - self.still_since >= STILL and t - self.still_since >= STILL_STEPS * H:
            return "no motion", {"given": hypot(u, v), "duration": t - self.still_since}
        self._rest(t, H, self.stride)
        self.position, self.stride = list(ship.position), min(2 * self.stride, LONGEST_STRIDE)
        return None

    def _rest(self, t: float, H: float, steps: int) -> None:
        """Leave the window, and look again after so many steps of H [s]; half a step less for rounding."""
        self.start, self.position, self.changes, self.idle = None, [], -2, 0
        self.next = t + (steps - 0.5) * H
