"""ArmedFailures: failures that begin by themselves, at a run time or when another ship comes near."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from math import isfinite
from typing import Any

from ...errors import InputError

__all__ = ["FARTHEST", "Armed", "ArmedFailures"]

FARTHEST = 200_000.0
"""[m] Limit of a range: ships in a run are not farther apart."""
LONGEST = 1e6
"""[s] Limit of a time."""
ROUNDING = 1e-9
"""[s] Times of communication points are rounded."""


@dataclass(frozen=True)
class Armed:
    """A failure of a ship that begins at the run time `at` [s], or once CO of ship `of` is nearer than `within` [m]."""

    ship: str
    what: str
    at: float | None = None
    of: str | None = None
    within: float | None = None

    def check(self, now: float, distance: Callable[[str, str], float]) -> None:
        """Raise InputError for a condition that is none, or that holds already. `distance` [m] of two ships by name."""
        name = f"{self.ship}, {self.what}"
        if (self.at is None) == (self.within is None) or (self.within is None) != (self.of is None):
            raise InputError(f"{name}: give either at, a run time, or within and of, a distance and a ship")
        if self.at is not None and not (isfinite(self.at) and now < self.at <= LONGEST):
            raise InputError(f"{name}: at = {self.at:g} s must be later than now, {now:g} s, and at most {LONGEST:g} s")
        if self.within is not None and not 0.0 < self.within <= FARTHEST:
            raise InputError(f"{name}: within = {self.within:g} m must be above 0 and at most {FARTHEST:g} m")
        if self.of == self.ship:
            raise InputError(f"{name}: of = {self.of!r} is the ship itself: name another one")
        if self.is_due(now, distance):
            raise InputError(
                f"{name}: {self.of} is nearer than {self.within:g} m already: give less, or let it fail now"
            )

    def is_due(self, now: float, distance: Callable[[str, str], float]) -> bool:
        """Whether it begins at the time `now` [s]."""
        if self.at is not None:
            return now >= self.at - ROUNDING
        return self.of is not None and self.within is not None and distance(self.ship, self.of) < self.within


class ArmedFailures:
    """What is armed, one of a kind for each ship. `listed` is a new tuple after every change."""

    def __init__(self) -> None:
        self.listed: tuple[Armed, ...] = ()

    def as_dicts(self) -> list[dict[str, Any]]:
        """They, as events and pages have them: ship, what, at, of, within."""
        return [asdict(one) for one in self.listed]

    def arm(self, armed: Armed) -> None:
        """Add one, instead of one of its kind."""
        self.listed = (*(one for one in self.listed if (one.ship, one.what) != (armed.ship, armed.what)), armed)

    def disarm(self, ship: str, what: str) -> None:
        """Take one away. Raises InputError where there is none."""
        left = tuple(one for one in self.listed if (one.ship, one.what) != (ship, what))
        if left == self.listed:
            raise InputError(f"{ship}: no {what} is armed: nothing is to be disarmed")
        self.listed = left

    def take_due(self, now: float, distance: Callable[[str, str], float]) -> list[Armed]:
        """Those that begin now, which are armed no more."""
        if not self.listed:
            return []
        due = [one for one in self.listed if one.is_due(now, distance)]
        if due:
            self.listed = tuple(one for one in self.listed if one not in due)
        return due
