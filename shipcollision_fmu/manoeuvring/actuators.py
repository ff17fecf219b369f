"""Steering gear and engine: a quantity follows its order at a limited rate, within a range.

A direct-reversing engine cannot be run through: ordered the other way round, the propeller first comes to rest at its
rate, rests for the reversal delay, and then runs up. The delay begins when the propeller has stopped while the order is
for the other side; an order back to the old side, or to stop, ends it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, radians

from ..ship.tables.manoeuvring import EngineTable, RudderTable

__all__ = ["NEUTRAL", "Actuator", "Engine", "Gear", "make_engine", "make_steering_gear"]

Gear = tuple[float, float]
"""The side that the engine runs or last ran to, 1.0 ahead, -1.0 astern, 0.0 not yet; how long the reversal has
lasted [s]."""
NEUTRAL: Gear = (0.0, 0.0)


@dataclass(frozen=True)
class Actuator:
    """Range and rate; the rate per second, in the unit of the quantity."""

    least: float
    most: float
    rate: float

    def limit(self, order: float) -> float:
        """The order, limited to the range."""
        return min(self.most, max(self.least, order))

    def follow(self, value: float, order: float, time: float) -> float:
        """The value after `time` [s] of moving towards the order: exact, whatever the length of the step."""
        target, reach = self.limit(order), self.rate * time
        return value + min(reach, max(-reach, target - value))


@dataclass(frozen=True)
class Engine:
    """The propeller speed's actuator [1/s] and the reversal delay [s]."""

    speed: Actuator
    reversal_delay: float = 0.0

    def limit(self, order: float) -> float:
        """The order, limited to the range."""
        return self.speed.limit(order)

    def find_gear(self, n: float) -> Gear:
        """The gear of an engine that runs at n [1/s]."""
        return (copysign(1.0, n) if n else 0.0, 0.0)

    def follow(self, n: float, gear: Gear, order: float, time: float) -> tuple[float, Gear]:
        """Propeller speed and gear after `time` [s] under the order; exact, whatever the length of the step."""
        speed, delay = self.speed, self.reversal_delay
        if delay == 0.0:
            return speed.follow(n, order, time), gear
        side, waited = gear
        target = speed.limit(order)
        if target * side >= 0.0:  # the way it runs, or stop
            return speed.follow(n, target, time), (side or copysign(1.0, target) if target else side, 0.0)
        stopping = abs(n) / speed.rate
        if time < stopping:
            return speed.follow(n, 0.0, time), (side, 0.0)
        waited += time - stopping
        if waited < delay:
            return 0.0, (side, waited)
        return speed.follow(0.0, target, waited - delay), (-side, 0.0)


def make_steering_gear(table: RudderTable | None) -> Actuator:
    """The rudder angle's [rad]; none: it stays amidships."""
    if table is None:
        return Actuator(0.0, 0.0, 0.0)
    most = radians(table.max_angle_deg)
    return Actuator(-most, most, radians(table.rate_deg_per_s))


def make_engine(table: EngineTable | None) -> Engine:
    """The propeller speed's [1/s]; none: it stays at rest."""
    if table is None:
        return Engine(Actuator(0.0, 0.0, 0.0))
    return Engine(Actuator(-table.max_astern_rev_per_s, table.max_rev_per_s, table.rate), table.reversal_delay)
