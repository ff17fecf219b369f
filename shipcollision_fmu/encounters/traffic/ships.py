"""The ships of a traffic situation: where each is at the start, where she is bound, and a ship file of her size.

lat, lon              to north, east on the tangent plane at own ship's position (tangent_plane.py)
sog [kn], cog [deg]   to a velocity over ground; heading [deg] to the heading, the course where there is none
a, b, c, d            where the position is aboard (bow, stern, port, starboard): CO is amidships
length, width         to a ship file; what is missing is estimated
"""

from __future__ import annotations

from collections.abc import Mapping
from math import atan2, cos, hypot, radians, sin
from pathlib import Path
from typing import NamedTuple

from ...errors import ScenarioError
from ...scenario.tables import SHORTEST_LEG
from ...scenario.toml_writer import scenario_text
from ...ship.tables.particulars import RHO_SEA
from ..imazu import KNOT
from .schema import Dimensions, Initial, Position, Static, TrafficShip
from .tangent_plane import TangentPlane

__all__ = ["State", "ship_file_text", "states_of"]

WIDEST = 100e3
"""[m] between own ship and a target: further apart, a plane is no map, and the positions are probably mistaken."""
BLOCK_COEFFICIENTS = {"tanker": 0.82, "cargo": 0.75, "passenger": 0.62}
"""C_b by the first word of shipType; 0.65 for the others. Typical values."""
BREADTH_TO_DRAUGHT = 3.0
"""B/T of a ship whose draught is not given."""


class State(NamedTuple):
    """CO in n [m], heading and course [rad], speed over ground [m/s], the waypoints to come [m], and the planned
    speed [m/s] on the leg to each."""

    north: float
    east: float
    heading: float
    course: float
    speed: float
    route: list[list[float]]
    speeds: list[float]

    @property
    def lengths(self) -> list[float]:
        """Of the legs of the route [m]."""
        starts = [[self.north, self.east], *self.route]
        return [hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(starts, self.route, strict=False)]


def states_of(roles: Mapping[str, TrafficShip], path: Path) -> dict[str, State]:
    first = _fix(roles["own"], path, "own")
    plane = TangentPlane(first.lat, first.lon)
    states = {role: _state(role, one, plane, path) for role, one in roles.items()}
    for role, state in states.items():
        apart = hypot(state.north - states["own"].north, state.east - states["own"].east)
        if apart > WIDEST:
            raise ScenarioError(
                f"{path.name}: {role} is {apart / 1e3:.0f} km from own ship, at most {WIDEST / 1e3:.0f}: check lat, lon"
            )
    return states


def _fix(ship: TrafficShip, path: Path, role: str) -> Position:
    """Where a ship is at the start."""
    if ship.initial is not None and ship.initial.position is not None:
        return ship.initial.position
    if ship.waypoints:
        return ship.waypoints[0].position
    raise ScenarioError(f"{path.name}: {role} is nowhere: give initial.position or waypoints")


def _state(role: str, ship: TrafficShip, plane: TangentPlane, path: Path) -> State:
    fix = _fix(ship, path, role)
    north, east = plane.position(fix.lat, fix.lon)
    marks = [list(plane.position(w.position.lat, w.position.lon)) for w in ship.waypoints or []]
    heading, course = _directions(role, ship, marks, plane, path)
    speed = _sog(role, ship, path) * KNOT
    if ship.static is not None and ship.static.initDelay:
        raise ScenarioError(f"{path.name}: {role} initDelay = {ship.static.initDelay:g} s is not offered: set it to 0")
    d = _dimensions(ship)
    if d.a is not None and d.b is not None:
        ahead, aside = 0.5 * (d.a - d.b), 0.5 * (d.d - d.c) if d.c is not None and d.d is not None else 0.0
        north += ahead * cos(heading) - aside * sin(heading)
        east += ahead * sin(heading) + aside * cos(heading)
    route: list[list[float]] = []
    speeds: list[float] = []
    planned = speed
    for mark, waypoint in zip(marks[1:], (ship.waypoints or [])[1:], strict=True):
        sog = None if waypoint.leg is None else waypoint.leg.planned_sog
        planned = planned if sog is None else _believable(sog, role, path) * KNOT
        last = route[-1] if route else [north, east]
        if hypot(mark[0] - last[0], mark[1] - last[1]) > 10.0 * SHORTEST_LEG:
            route.append([round(x, 3) + 0.0 for x in mark])
            speeds.append(planned)
    return State(north, east, heading, course, speed, route, speeds)


def _directions(
    role: str, ship: TrafficShip, marks: list[list[float]], plane: TangentPlane, path: Path
) -> tuple[float, float]:  # fmt: skip
    """Heading and course at the start [rad]."""
    fix, initial = _fix(ship, path, role), ship.initial or Initial()
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


def _sog(role: str, ship: TrafficShip, path: Path) -> float:
    """Speed over ground at the start [kn]."""
    sog = ship.initial.sog if ship.initial is not None else None
    for waypoint in (ship.waypoints or [])[1:2]:  # the first leg is described in its end
        if sog is None and waypoint.leg is not None:
            sog = waypoint.leg.planned_sog
    if sog is None:
        raise ScenarioError(
            f"{path.name}: {role} has no speed: give initial.sog, or sog in the leg of her second waypoint"
        )
    return _believable(sog, role, path)


def _believable(sog: float, role: str, path: Path) -> float:
    if not 0.0 <= sog <= 60.0:
        raise ScenarioError(f"{path.name}: {role} sog = {sog:g} must be 0 to 60: it is the speed over ground in knots")
    return sog


def _dimensions(ship: TrafficShip) -> Dimensions:
    static = ship.static or Static()
    return static.dimensions or static


def ship_file_text(role: str, ship: TrafficShip, path: Path) -> str:
    """A ship that coasts, of the dimensions given."""
    d, static = _dimensions(ship), ship.static or Static()
    if d.length is None or d.width is None:
        raise ScenarioError(f"{path.name}: {role} has no length and width in static: name a ship with --ship")
    L, B = d.length, d.width
    if B >= L:
        raise ScenarioError(f"{path.name}: {role} is wider than long, width = {B:g} m and length = {L:g} m: check them")
    T = round(B / BREADTH_TO_DRAUGHT, 3) if d.draught is None else d.draught
    kind = str(static.shipType or "unknown")
    C_b = BLOCK_COEFFICIENTS.get(kind.split()[0].split("/")[0].lower(), 0.65)
    drawn = f"T = B/{BREADTH_TO_DRAUGHT:g}" if d.draught is None else "draught from the same file"
    return scenario_text(
        [f"Made by `shipcollision import {path.name}`: {role}."],
        {
            "ship": {
                "name": static.name or role,
                "kind": kind,
                "source": f"Length and width: {path.name}. Estimated: {drawn}; mass from C_b = {C_b:g}, typical of her "
                "type; depth 1.5 T; the shape of the hull.",
            },
            "particulars": {"L_pp": L, "L_oa": L, "B": B, "T": T, "mass": round(RHO_SEA * C_b * L * B * T, 1)},
            "hull": {
                "shape": "parametric", "depth": round(1.5 * T, 3), "bow_length": round(0.2 * L, 3),
                "stern_length": round(0.2 * L, 3), "transom_fraction": 0.6,
            },
        },
    )  # fmt: skip
