"""Start, route and ship file of each ship of a traffic situation.

lat, lon              become north, east on the tangent plane at own ship's position (tangent_plane.py)
sog [kn], cog [deg]   become the velocity over ground
heading [deg]         becomes the heading; without it the heading is the course
a, b, c, d            distances of the position from bow, stern, port and starboard: the start is moved to midship
length, width         become a ship file; missing values are estimated
"""

from __future__ import annotations

from collections.abc import Mapping
from math import atan2, cos, hypot, radians, sin
from pathlib import Path
from typing import NamedTuple

from ...errors import ScenarioError
from ...scenario.tables.autopilot import SHORTEST_LEG
from ...scenario.toml_writer import format_toml
from ...ship.tables.particulars import RHO_SEA
from ..units import KNOT
from .schema import Dimensions, Initial, Position, Static, TrafficShip
from .tangent_plane import TangentPlane

__all__ = ["TrafficStart", "locate_ships", "write_ship_file"]

WIDEST = 100e3
"""[m] Limit of the distance between own ship and a target. Beyond it the tangent plane is 4 m short, and a position is
probably mistaken."""
BLOCK_COEFFICIENTS = {"tanker": 0.82, "cargo": 0.75, "passenger": 0.62}
"""C_b by the first word of shipType, typical values; they set the mass of a ship made from its dimensions."""
OTHER_BLOCK_COEFFICIENT = 0.65
"""C_b of the other types."""
BREADTH_TO_DRAUGHT = 3.0
"""B/T of a ship whose draught is not given."""


class TrafficStart(NamedTuple):
    """A ship at the start: CO in n [m], heading and course [rad], speed over ground [m/s].

    route: the waypoints to come, north and east [m]; speeds: the planned speed on the leg to each [m/s].
    """

    north: float
    east: float
    heading: float
    course: float
    speed: float
    route: list[list[float]]
    speeds: list[float]

    @property
    def lengths(self) -> list[float]:
        """Lengths of the legs of the route [m]."""
        starts = [[self.north, self.east], *self.route]
        return [hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(starts, self.route, strict=False)]


def locate_ships(roles: Mapping[str, TrafficShip], path: Path) -> dict[str, TrafficStart]:
    """The starts of the ships by role, in n with its origin at own ship's position.

    Raises ScenarioError for a ship without position, course or speed, or farther than WIDEST from own ship.
    """
    first = _read_position(roles["own"], path, "own")
    plane = TangentPlane(first.lat, first.lon)
    starts = {role: _locate_ship(role, ship, plane, path) for role, ship in roles.items()}
    for role, start in starts.items():
        distance = hypot(start.north - starts["own"].north, start.east - starts["own"].east)
        if distance > WIDEST:
            raise ScenarioError(
                f"{path.name}: {role} is {distance / 1e3:.0f} km from own ship, at most {WIDEST / 1e3:.0f}: "
                "check lat, lon"
            )
    return starts


def _read_position(ship: TrafficShip, path: Path, role: str) -> Position:
    """Latitude and longitude of a ship at the start."""
    if ship.initial is not None and ship.initial.position is not None:
        return ship.initial.position
    if ship.waypoints:
        return ship.waypoints[0].position
    raise ScenarioError(f"{path.name}: {role} has no position: give initial.position or waypoints")


def _locate_ship(role: str, ship: TrafficShip, plane: TangentPlane, path: Path) -> TrafficStart:
    fix = _read_position(ship, path, role)
    north, east = plane.position(fix.lat, fix.lon)
    marks = [list(plane.position(w.position.lat, w.position.lon)) for w in ship.waypoints or []]
    heading, course = _read_directions(role, ship, marks, plane, path)
    speed = _read_sog(role, ship, path) * KNOT
    if ship.static is not None and ship.static.initDelay:
        raise ScenarioError(f"{path.name}: {role} initDelay = {ship.static.initDelay:g} s is not offered: set it to 0")
    d = _read_dimensions(ship)
    if d.a is not None and d.b is not None:
        ahead, aside = 0.5 * (d.a - d.b), 0.5 * (d.d - d.c) if d.c is not None and d.d is not None else 0.0
        north += ahead * cos(heading) - aside * sin(heading)
        east += ahead * sin(heading) + aside * cos(heading)
    route: list[list[float]] = []
    speeds: list[float] = []
    planned = speed
    for mark, waypoint in zip(marks[1:], (ship.waypoints or [])[1:], strict=True):
        sog = None if waypoint.leg is None else waypoint.leg.planned_sog
        planned = planned if sog is None else _check_sog(sog, role, path) * KNOT
        last = route[-1] if route else [north, east]
        if hypot(mark[0] - last[0], mark[1] - last[1]) > 10.0 * SHORTEST_LEG:
            route.append([round(x, 3) + 0.0 for x in mark])
            speeds.append(planned)
    return TrafficStart(north, east, heading, course, speed, route, speeds)


def _read_directions(
    role: str, ship: TrafficShip, marks: list[list[float]], plane: TangentPlane, path: Path
) -> tuple[float, float]:  # fmt: skip
    """Heading and course at the start [rad]."""
    fix, initial = _read_position(ship, path, role), ship.initial or Initial()
    if initial.cog is not None:
        course = plane.direction(fix.lat, fix.lon, radians(initial.cog))
    elif len(marks) > 1:
        course = atan2(marks[1][1] - marks[0][1], marks[1][0] - marks[0][0])
    elif initial.heading is not None:
        course = plane.direction(fix.lat, fix.lon, radians(initial.heading))
    else:
        raise ScenarioError(f"{path.name}: {role} has no course: give initial.cog, or two waypoints")
    if initial.heading is None:
        return course, course
    return plane.direction(fix.lat, fix.lon, radians(initial.heading)), course


def _read_sog(role: str, ship: TrafficShip, path: Path) -> float:
    """Speed over ground at the start [kn]."""
    sog = ship.initial.sog if ship.initial is not None else None
    for waypoint in (ship.waypoints or [])[1:2]:  # the first leg is described in its end
        if sog is None and waypoint.leg is not None:
            sog = waypoint.leg.planned_sog
    if sog is None:
        raise ScenarioError(
            f"{path.name}: {role} has no speed: give initial.sog, or sog in the leg of its second waypoint"
        )
    return _check_sog(sog, role, path)


def _check_sog(sog: float, role: str, path: Path) -> float:
    """The speed over ground [kn]; ScenarioError when no ship has it."""
    if not 0.0 <= sog <= 60.0:
        raise ScenarioError(f"{path.name}: {role} sog = {sog:g} must be 0 to 60: it is the speed over ground in knots")
    return sog


def _read_dimensions(ship: TrafficShip) -> Dimensions:
    static = ship.static or Static()
    return static.dimensions or static


def write_ship_file(role: str, ship: TrafficShip, path: Path) -> str:
    """The text of a ship file for a coasting ship of the dimensions given.

    Raises ScenarioError when length or width is missing, or the ship is wider than long.
    """
    d, static = _read_dimensions(ship), ship.static or Static()
    if d.length is None or d.width is None:
        raise ScenarioError(f"{path.name}: {role} has no length and width in static: name a ship with --ship")
    L, B = d.length, d.width
    if B >= L:
        raise ScenarioError(f"{path.name}: {role} is wider than long, width = {B:g} m and length = {L:g} m: check them")
    T = round(B / BREADTH_TO_DRAUGHT, 3) if d.draught is None else d.draught
    kind = str(static.shipType or "unknown")
    C_b = BLOCK_COEFFICIENTS.get(kind.split()[0].split("/")[0].lower(), OTHER_BLOCK_COEFFICIENT)
    draught = f"T = B/{BREADTH_TO_DRAUGHT:g}" if d.draught is None else "draught from the same file"
    return format_toml(
        [f"Made by `shipcollision import {path.name}`: {role}."],
        {
            "ship": {
                "name": static.name or role,
                "kind": kind,
                "source": f"Length and width: {path.name}. Estimated: {draught}; mass from C_b = {C_b:g}, typical of "
                "its type; depth 1.5 T; the shape of the hull.",
            },
            "particulars": {"L_pp": L, "L_oa": L, "B": B, "T": T, "mass": round(RHO_SEA * C_b * L * B * T, 1)},
            "hull": {
                "shape": "parametric", "depth": round(1.5 * T, 3), "bow_length": round(0.2 * L, 3),
                "stern_length": round(0.2 * L, 3), "transom_fraction": 0.6,
            },
        },
    )  # fmt: skip
