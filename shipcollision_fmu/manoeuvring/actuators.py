"""Steering gear and engine: a quantity follows its order at a limited rate, within a range."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

from ..ship.particulars import EngineTable, RudderTable

__all__ = ["Actuator", "engine", "steering_gear"]


@dataclass(frozen=True)
class Actuator:
    """Range and rate; the rate per second, in the unit of the quantity."""

    least: float
    most: float
    rate: float

    def limited(self, order: float) -> float:
        """The order, within range."""
        return min(self.most, max(self.least, order))

    def followed(self, value: float, order: float, time: float) -> float:
        """The value after `time` [s] of moving towards the order: exact, whatever the length of the step."""
        target, reach = self.limited(order), self.rate * time
        return value + min(reach, max(-reach, target - value))


def steering_gear(table: RudderTable) -> Actuator:
    """The rudder angle's [rad]."""
    most = radians(table.max_angle_deg)
    return Actuator(-most, most, radians(table.rate_deg_per_s))


def engine(table: EngineTable) -> Actuator:
    """The propeller speed's [1/s]."""
    return Actuator(-table.max_astern_rev_per_s, table.max_rev_per_s, table.rate)
