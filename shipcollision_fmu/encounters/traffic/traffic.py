"""Traffic: what every reader of foreign files gives, and what situation.py makes a scenario of."""

from __future__ import annotations

from math import hypot
from typing import Any, NamedTuple

from ...scenario.tracks.ship_size import ShipSize

__all__ = ["LONGEST_DEFAULT", "WIDEST", "Surroundings", "Traffic", "TrafficStart"]

WIDEST = 100e3
"""[m] Limit of the distance between own ship and a target. Beyond it the tangent plane is 4 m short, and a position is
probably mistaken."""
LONGEST_DEFAULT = 3600.0
"""[s] Limit of the default duration."""


class TrafficStart(NamedTuple):
    """A ship at the start: CO in n [m], heading and course [rad], speed over ground [m/s], rate of turn [rad/s].

    route: the waypoints to come, north and east [m]; speeds: the planned speed on the leg to each [m/s].
    """

    north: float
    east: float
    heading: float
    course: float
    speed: float
    route: list[list[float]]
    speeds: list[float]
    yaw_rate: float = 0.0

    @property
    def lengths(self) -> list[float]:
        """Lengths of the legs of the route [m]."""
        starts = [[self.north, self.east], *self.route]
        return [hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(starts, self.route, strict=False)]


class Surroundings(NamedTuple):
    """Wind [m/s] and where it comes from [deg], current [m/s] and where it flows to [deg]; whether there are waves."""

    wind: float = 0.0
    wind_from_deg: float = 0.0
    current: float = 0.0
    current_towards_deg: float = 0.0
    waves: bool = False


class Traffic(NamedTuple):
    """The content of a file.

    origin           kind and version of the file, for the comment    frame    what n's origin is
    description      of the situation                                duration default duration [s]
    starts, sizes    by role, which is the ship's name in the scenario; own first
    obstacles        tables [obstacles.NAME]
    notes            what is converted or not used                   notes_if_sailed   the same, for ships that sail
    top_speed_key    where the file may state the largest speed of a ship; empty: nowhere
    """

    origin: str
    frame: str
    description: str
    duration: float
    starts: dict[str, TrafficStart]
    sizes: dict[str, ShipSize]
    surroundings: Surroundings = Surroundings()
    obstacles: dict[str, dict[str, Any]] = {}  # noqa: RUF012  # never changed
    notes: tuple[str, ...] = ()
    notes_if_sailed: tuple[str, ...] = ()
    top_speed_key: str = ""
