"""Traffic from a situation in JSON.

lat, lon              become north, east on the tangent plane at own ship's position (tangent_plane.py)
sog [kn], cog [deg]   become the velocity over ground
heading [deg]         becomes the heading; without it the heading is the course
a, b, c, d            distances of the position from bow, stern, port and starboard: the start is moved to midship
length, width         become the size of the ship, else a + b and c + d
sogMax [kn]           sizes the engine of a ship that sails by estimate; knots in all versions
"""

from __future__ import annotations

from math import atan2, cos, hypot, inf, radians, sin

from ...errors import ScenarioError
from ...scenario.tables.autopilot import SHORTEST_LEG
from ...scenario.tracks.ship_size import ShipSize
from ...scenario.tracks.tangent_plane import TangentPlane
from ..units import KNOT
from .angle_units import convert_radians
from .schema import Environment, Initial, Position, Situation, Static, TrafficShip, parse_situation
from .traffic import LONGEST_DEFAULT, WIDEST, Surroundings, Traffic, TrafficStart
from .unread import name_unread

__all__ = ["read_situation"]

USUAL_DURATION = 600.0
"""[s] Default duration where own ship has no route."""


def read_situation(content: bytes, file: str) -> Traffic:
    """The traffic in a file of maritime-schema with that content.

    Raises ScenarioError, in one line, for content that is no traffic situation, and for a ship without position, course
    or speed, or farther than WIDEST from own ship.
    """
    parsed = parse_situation(content, file)
    if not parsed.targetShips:
        raise ScenarioError(f"{file}: targetShips is empty: a collision needs a target, add one")
    situation, converted = convert_radians(parsed, file)
    roles = situation.roles
    starts = _locate_ships(roles, file)
    notes = [note for role, ship in roles.items() for note in _list_unavailable(role, ship)]
    if converted:
        notes.append("Positions and courses are in radians, speeds in m/s, as trafficgen wrote them early in 2024.")
    turning = any(waypoint.turnRadius for ship in roles.values() for waypoint in ship.waypoints or [])
    return Traffic(
        origin=_describe_origin(situation),
        frame="n's origin is own ship's position in that file; positions here are of midship.",
        description=situation.description or situation.title or "",
        duration=_plan_duration(starts["own"]),
        starts=starts,
        sizes={role: _read_size(ship) for role, ship in roles.items()},
        surroundings=_read_surroundings(situation.environment or Environment()),
        notes=(*notes, *name_unread(situation)),
        top_speed_key="static.sogMax in knots",
        notes_if_sailed=("turnRadius is not carried over: the autopilots choose the turns.",) if turning else (),
    )


def _describe_origin(situation: Situation) -> str:
    said = [
        f"{what} {version}"
        for what, version in (
            ("schema version", situation.schemaVersion), ("trafficgen", situation.trafficgenVersion),
            ("version", situation.version),
        )
        if version
    ]  # fmt: skip
    return ", ".join(["traffic situation", *(said or ["no version given"])])


def _plan_duration(own: TrafficStart) -> float:
    """Time [s] in which own ship sails its waypoints as planned, at most LONGEST_DEFAULT."""
    times = [length / speed if speed > 0.0 else inf for length, speed in zip(own.lengths, own.speeds, strict=True)]
    return min(LONGEST_DEFAULT, sum(times)) if times else USUAL_DURATION


def _read_size(ship: TrafficShip) -> ShipSize:
    d, static = ship.dimensions, ship.static or Static()
    length = d.a + d.b if d.length is None and d.a is not None and d.b is not None else d.length
    width = d.c + d.d if d.width is None and d.c is not None and d.d is not None else d.width
    top = None if not static.sogMax else static.sogMax * KNOT
    return ShipSize(static.name, static.shipType, length or None, width or None, d.draught, top)


def _read_surroundings(around: Environment) -> Surroundings:
    return Surroundings(
        around.windSpeed or 0.0, around.windDirection or 0.0, around.currentSpeed or 0.0,
        around.currentDirection or 0.0, bool(around.significantWaveHeight),
    )  # fmt: skip


def _list_unavailable(role: str, ship: TrafficShip) -> list[str]:
    """Notes on what AIS calls not available, and what is taken for it."""
    taken = {"heading": "its course", "sog": "the speed of its first leg", "cog": "its first leg or its heading",
             "position": "its first waypoint"}  # fmt: skip
    unavailable = ship.initial.unavailable if ship.initial is not None else []
    return [f'{role}: {said} is AIS\'s "not available": {taken[said.split()[0]]} is taken.' for said in unavailable]


def _locate_ships(roles: dict[str, TrafficShip], file: str) -> dict[str, TrafficStart]:
    """The starts of the ships by role, in n with its origin at own ship's position."""
    first = _read_position(roles["own"], file, "own")
    plane = TangentPlane(first.lat, first.lon)
    starts = {role: _locate_ship(role, ship, plane, file) for role, ship in roles.items()}
    for role, start in starts.items():
        distance = hypot(start.north - starts["own"].north, start.east - starts["own"].east)
        if distance > WIDEST:
            raise ScenarioError(
                f"{file}: {role} is {distance / 1e3:.0f} km from own ship, at most {WIDEST / 1e3:.0f}: check lat, lon"
            )
    return starts


def _read_position(ship: TrafficShip, file: str, role: str) -> Position:
    """Latitude and longitude of a ship at the start."""
    if ship.fix is None:
        raise ScenarioError(
            f"{file}: {role} has no position{_say_unavailable(ship, 'position')}: give initial.position or waypoints"
        )
    return ship.fix


def _say_unavailable(ship: TrafficShip, key: str) -> str:
    """' (sog 102.3 is AIS's "not available")' where the file says so."""
    said = [said for said in (ship.initial or Initial()).unavailable if said.split()[0] == key]
    return f' ({said[0]} is AIS\'s "not available")' if said else ""


def _locate_ship(role: str, ship: TrafficShip, plane: TangentPlane, file: str) -> TrafficStart:
    fix = _read_position(ship, file, role)
    north, east = plane.position(fix.lat, fix.lon)
    marks = [list(plane.position(w.position.lat, w.position.lon)) for w in ship.waypoints or []]
    heading, course = _read_directions(role, ship, marks, plane, file)
    speed = _read_sog(role, ship, file) * KNOT
    if ship.static is not None and ship.static.initDelay:
        raise ScenarioError(f"{file}: {role} initDelay = {ship.static.initDelay:g} s is not offered: set it to 0")
    d = ship.dimensions
    if d.a is not None and d.b is not None:
        ahead, aside = 0.5 * (d.a - d.b), 0.5 * (d.d - d.c) if d.c is not None and d.d is not None else 0.0
        north += ahead * cos(heading) - aside * sin(heading)
        east += ahead * sin(heading) + aside * cos(heading)
    route: list[list[float]] = []
    speeds: list[float] = []
    planned = speed
    for mark, waypoint in zip(marks[1:], (ship.waypoints or [])[1:], strict=True):
        sog = None if waypoint.leg is None else waypoint.leg.planned_sog
        planned = planned if sog is None else _check_sog(sog, role, file) * KNOT
        last = route[-1] if route else [north, east]
        if hypot(mark[0] - last[0], mark[1] - last[1]) > 10.0 * SHORTEST_LEG:
            route.append([round(x, 3) + 0.0 for x in mark])
            speeds.append(planned)
    return TrafficStart(north, east, heading, course, speed, route, speeds)


def _read_directions(
    role: str, ship: TrafficShip, marks: list[list[float]], plane: TangentPlane, file: str
) -> tuple[float, float]:  # fmt: skip
    """Heading and course at the start [rad]."""
    fix, initial = _read_position(ship, file, role), ship.initial or Initial()
    if initial.cog is not None:
        course = plane.direction(fix.lat, fix.lon, radians(initial.cog))
    elif len(marks) > 1:
        course = atan2(marks[1][1] - marks[0][1], marks[1][0] - marks[0][0])
    elif initial.heading is not None:
        course = plane.direction(fix.lat, fix.lon, radians(initial.heading))
    else:
        raise ScenarioError(
            f"{file}: {role} has no course{_say_unavailable(ship, 'heading')}: give initial.cog, or two waypoints"
        )
    if initial.heading is None:
        return course, course
    return plane.direction(fix.lat, fix.lon, radians(initial.heading)), course


def _read_sog(role: str, ship: TrafficShip, file: str) -> float:
    """Speed over ground at the start [kn]."""
    sog = ship.initial.sog if ship.initial is not None else None
    for waypoint in (ship.waypoints or [])[1:2]:  # the first leg is described in its end
        if sog is None and waypoint.leg is not None:
            sog = waypoint.leg.planned_sog
    if sog is None:
        raise ScenarioError(
            f"{file}: {role} has no speed{_say_unavailable(ship, 'sog')}: give initial.sog, or sog in the leg of its "
            "second waypoint"
        )
    return _check_sog(sog, role, file)


def _check_sog(sog: float, role: str, file: str) -> float:
    """The speed over ground [kn]; ScenarioError when no ship has it."""
    if not 0.0 <= sog <= 60.0:
        raise ScenarioError(f"{file}: {role} sog = {sog:g} must be 0 to 60: it is the speed over ground in knots")
    return sog
