"""A route of waypoints, followed by line of sight.

    heading = bearing of the leg - atan(cross-track distance / lookahead)

The ship turns to the next leg from `acceptance` before the waypoint. The last leg is followed on beyond its end.
Source: Fossen (2021), Handbook of Marine Craft Hydrodynamics and Motion Control, section 12.3.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, sin

from ..ship.ship_state import ShipState

__all__ = ["Route", "line_of_sight"]


@dataclass(frozen=True)
class Route:
    """Ends of the legs, north and east [m]; the first leg begins at `start`. Lookahead and acceptance [m]."""

    start: tuple[float, float]
    waypoints: tuple[tuple[float, float], ...]
    lookahead: float
    acceptance: float


def line_of_sight(route: Route, leg: int, own: ShipState) -> tuple[float, int]:
    """Heading to steer [rad], and the leg to which it belongs, counted from 0."""
    while True:
        (north, east), (end_north, end_east) = (route.start, *route.waypoints)[leg : leg + 2]
        bearing = atan2(end_east - east, end_north - north)
        c, s = cos(bearing), sin(bearing)
        to_go = (end_north - own.north) * c + (end_east - own.east) * s
        if to_go >= route.acceptance or leg + 1 == len(route.waypoints):
            break
        leg += 1
    cross_track = (own.east - east) * c - (own.north - north) * s  # positive to starboard of the leg
    return bearing - atan2(cross_track, route.lookahead), leg
