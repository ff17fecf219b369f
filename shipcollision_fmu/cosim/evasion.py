"""Late evasion: the rudder hard over, and the engine as ordered, once another ship is near.

Near is a distance between midships, or a time to the closest approach on present courses. The manoeuvre does not end.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from ..ship.ship_state import ShipState

__all__ = ["Evasion", "closest_approach", "is_too_near"]


@dataclass(frozen=True)
class Evasion:
    """Name of the other ship, when to begin (distance [m] or time [s], the other one zero), and the orders from then.

    `rudder` [rad]; `revolutions` [1/s], None: as ordered before.
    """

    of: str
    distance: float
    time_to_closest: float
    rudder: float
    revolutions: float | None


def closest_approach(own: ShipState, other: ShipState) -> tuple[float, float]:
    """Time to, and distance at, the closest approach of two midships on present courses [s, m]; negative: past."""
    x, y = other.north - own.north, other.east - own.east
    (own_n, own_e), (other_n, other_e) = own.plan_velocity, other.plan_velocity
    u, v = other_n - own_n, other_e - own_e
    square = u * u + v * v
    time = -(x * u + y * v) / square if square > 0.0 else 0.0
    return time, hypot(x + u * time, y + v * time)


def is_too_near(evasion: Evasion, own: ShipState, other: ShipState) -> bool:
    """Whether the evasion begins now."""
    if evasion.distance > 0.0:
        return hypot(other.north - own.north, other.east - own.east) <= evasion.distance
    time, _ = closest_approach(own, other)
    return 0.0 <= time <= evasion.time_to_closest
