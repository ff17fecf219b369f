"""Watch over how a ship model answers impulses: its velocity after one against the one predicted, and impulse_applied
against what was issued.

A ship answers an impulse J by M^-1 J. Its share of that, over the steps since the first impulse:

    share = J^T (change of nu) / J^T M^-1 J

J is impulse_applied of a ship with feedback "ledger", and the impulse issued of others. A share is counted only while
M^-1 J exceeds what other forces could do in the time. A false alarm is worse than a finding that is missed.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import reduce
from math import hypot, inf
from operator import add  # sum() rounds otherwise from Python 3.12 on

from .bodies import Body
from .findings import Found
from .interface import ShipState

__all__ = ["AnswerWatch"]

DOUBTS = 2
"""Doubtful shares in a row before a finding is said: a ship model may apply an impulse in parts."""

DEADLINE_STEPS, DEADLINE = 10, 1.0
"""Steps and seconds within which an impulse is answered: ship models may take steps ten times as long."""

LONGEST_WATCH = 3.0
"""Seconds after which the answer to small impulses is no longer waited for: other forces have changed the motion."""

LEAST_CHANGE, OTHER_ACCELERATION = 0.05, 0.5
"""An impulse counts from a change of the velocity of so many m/s, and so many m/s2 times the time. With less, a ship
that its propeller presses to a quay, and that rightly stays there, would be suspected."""

LIGHTEST, HEAVIEST, CERTAIN, NO_ANSWER = 3.0, 1.0 / 3.0, 30.0, 0.1
"""Shares beyond which the mass differs, at the second look or at once, and below which there is no answer. A ship model
without added mass has a share of 2."""


@dataclass
class AnswerWatch:
    """Watch over the answer of a ship, until it was seen to be right.

    t [s], steps: since the impulse that is watched, or None; nu, applied: (6) as received with it; issued (6): before
    it; known (6): issued until the last look; share: largest since; counts: a share was large enough to count.
    """

    t: float | None = None
    steps: int = 0
    nu: list[float] = field(default_factory=list)
    applied: list[float] = field(default_factory=list)
    issued: list[float] = field(default_factory=list)
    known: list[float] = field(default_factory=lambda: [0.0] * 6)
    share: float = 0.0
    counts: bool = False
    doubts: int = 0
    done: bool = False

    def look(self, ship: ShipState, body: Body, issued: list[float], t: float) -> Found | None:
        """What is found at t [s]: begin with the step that issues an impulse, and judge in the steps after. issued (6):
        cumulative, as of now."""
        before = self.known
        if issued != before:
            self.known = issued
            if self.t is None:
                self.t, self.steps, self.share, self.counts, self.doubts = t, 0, 0.0, False, 0
                self.nu, self.applied, self.issued = ship.velocity + ship.rate, list(ship.impulse_applied), before
                return None
        if self.t is None:
            return None
        self.steps += 1
        found = self._judge(ship, body, t - self.t, before)
        if self.done:
            self.t = None
        return found

    def _judge(self, ship: ShipState, body: Body, T: float, issued: list[float]) -> Found | None:
        """What T [s] after the first impulse shows. issued (6): all that the ship can have received."""
        by_ledger = body.feedback == "ledger"
        applied = by_ledger and ship.impulse_applied != self.applied
        ends = (ship.impulse_applied, self.applied) if applied else (issued, self.issued)
        share, counts = self._measure_share(ship, body, [a - b for a, b in zip(*ends, strict=True)], T)
        if counts:
            self.share, self.counts = max(share, self.share), True
            if (applied or not by_ledger) and HEAVIEST <= share <= LIGHTEST:
                self.done = True
                return None
            self.doubts = self.doubts + 1 if applied or share > LIGHTEST else 0
            if (self.doubts >= DOUBTS or share > CERTAIN) and (applied or not by_ledger):
                return _other_mass(share)
        overdue = self.steps >= DEADLINE_STEPS and T >= DEADLINE
        if overdue and by_ledger and not applied:
            key = "impulse_applied not returned" if self.share > HEAVIEST else "impulse not applied"
            return key, {"duration": T}
        if overdue and counts and not by_ledger:
            if self.share < NO_ANSWER:
                return "force without effect", {"duration": T, "share": share}
            return _other_mass(share)
        if overdue and T >= LONGEST_WATCH:
            self.t = None
        return None

    def _measure_share(self, ship: ShipState, body: Body, J: list[float], T: float) -> tuple[float, bool]:
        """The share of M^-1 J that the ship shows since the impulse, and whether it is large enough to count."""
        predicted = (body.inverse_at(ship.attitude) @ J).tolist()
        change = [now - then for now, then in zip(ship.velocity + ship.rate, self.nu, strict=True)]
        whole = reduce(add, (a * b for a, b in zip(J, predicted, strict=True)))
        if whole <= 0.0 or hypot(*predicted[:3]) < LEAST_CHANGE + OTHER_ACCELERATION * T:
            return 0.0, False
        return reduce(add, (a * b for a, b in zip(J, change, strict=True))) / whole, True


def _other_mass(share: float) -> Found:
    return "other mass", {"share": share, "mass": 1.0 / share if share > 0.0 else inf}
