"""Fix: what the instruments of a ship show, from its state in n and the place of n on earth."""

from __future__ import annotations

from math import atan2, degrees, hypot
from typing import NamedTuple

from ...scenario.tracks.tangent_plane import TangentPlane
from ...ship.ship_state import ShipState

__all__ = ["MAKES_WAY", "Fix", "find_fix"]

MAKES_WAY = 0.05
"""[m/s] A slower ship has no course over ground: it would be the direction of noise."""


class Fix(NamedTuple):
    """Latitude, longitude [deg] of CO; SOG [m/s]; COG and true heading [deg], 0 to 360; rate of turn [deg/s]."""

    latitude: float
    longitude: float
    sog: float
    cog: float | None
    heading: float
    rate_of_turn: float


def find_fix(state: ShipState, plane: TangentPlane) -> Fix:
    """The fix of a ship; its heading and course refer to north where it is. rate_of_turn: to starboard."""
    latitude, longitude = plane.geographic(state.north, state.east)
    v_north, v_east = state.plan_velocity
    speed = hypot(v_north, v_east)
    cog = None
    if speed >= MAKES_WAY:
        cog = degrees(plane.true_course(latitude, longitude, atan2(v_east, v_north))) % 360.0
    heading = degrees(plane.true_course(latitude, longitude, state.heading)) % 360.0
    return Fix(latitude, longitude, speed, cog, heading, degrees(state.yaw_rate))
