"""autopilot and route of a ship: the gains, and the waypoints that the autopilot follows."""

from __future__ import annotations

from pydantic import Field

from ...ship.tables.table import Pair, Table

__all__ = ["SHORTEST_LEG", "AutopilotTable", "RouteTable"]

SHORTEST_LEG = 1.0
"""[m] Limit of a leg of a route; the bearing of a shorter leg is unreliable."""


class AutopilotTable(Table):
    """autopilot: gains of the heading autopilot; a gain that is left out follows from the ship's length and speed."""

    gain: float = Field(default=1.5, gt=0, le=20, description="the rudder per error in heading [deg/deg]")
    rate_gain: float | None = Field(default=None, ge=0, description="the rudder per rate of turn [s], e.g. 60.0")
    integral_gain: float = Field(
        default=0.0, ge=0, le=1, description="the rudder per integral of the error in heading [1/s], e.g. 0.005"
    )
    rudder_limit_deg: float = Field(default=35.0, gt=0, le=90, description="the largest rudder order [deg]")


class RouteTable(Table):
    """route: waypoints from the start; the last leg continues beyond its end."""

    waypoints: list[Pair] = Field(min_length=1, description="[[north, east], ...] [m], without the ship's start")
    lookahead: float | None = Field(
        default=None, gt=0, description="the distance ahead at which the ship is steered onto the leg [m]"
    )
    acceptance: float | None = Field(
        default=None, gt=0, description="the distance before a waypoint at which the turn begins [m]"
    )
