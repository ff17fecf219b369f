"""Situations in radians and m/s, as trafficgen wrote them early in 2024, are told from those in degrees and knots.

Numbers that could be radians (latitudes within pi/2, longitudes within pi) are tried as both. A unit is ruled out by

    north, east    beside latitude and longitude that lie elsewhere, by more than a tenth of their distance
    distances      of more than WIDEST between own ship and another position
    courses        above a full turn in radians, or more than 20 deg from the first leg of the waypoints
    hulls          that lie inside each other

One unit must be left. Positions near 0 N 0 E, in degrees, are rare but exist.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import atan2, degrees, hypot, pi, radians
from typing import NamedTuple

from ...errors import ScenarioError
from ...scenario.tracks.tangent_plane import TangentPlane
from ..units import KNOT
from .schema import Leg, LegData, Position, Situation, TrafficShip, Waypoint
from .traffic import WIDEST

__all__ = ["convert_radians"]

AGREEMENT = 0.1
"""Error of a position as a fraction of its distance from own ship. Another unit is wrong by a factor of 57."""
LEAST_DISTANCE = 50.0
"""[m] Shorter distances are rounded too much to compare."""
LEAST_LEG = 10.0
"""[m] Shorter legs have no reliable direction."""
COURSE_AGREEMENT = radians(20.0)
"""[rad] Angle between course and first leg; a ship may start off its leg."""


class Unit(NamedTuple):
    name: str
    in_degrees: float


DEGREES, RADIANS = Unit("degrees", 1.0), Unit("radians", degrees(1.0))


def convert_radians(situation: Situation, file: str) -> tuple[Situation, bool]:
    """The situation in degrees and knots, and whether it was in radians and m/s.

    Raises ScenarioError where both units are possible, or neither.
    """
    ships = situation.roles
    positions = [position for _, position in _list_positions(ships)]
    if not positions or any(abs(p.lat) > 0.5 * pi or abs(p.lon) > pi for p in positions):
        return situation, False
    against = {unit: next(_contradict(ships, unit), "") for unit in (DEGREES, RADIANS)}
    if all(against.values()):
        said = "; ".join(f"in {unit.name} {fault}" for unit, fault in against.items())
        raise ScenarioError(
            f"{file}: positions and courses are neither in degrees nor in radians: {said}: give degrees, and north and "
            "east in metres from own ship"
        )
    if not any(against.values()):
        raise ScenarioError(
            f"{file}: positions within 1.57 N and 3.14 E may be in degrees or in radians: give north and east [m] in "
            "the position of each target, from own ship"
        )
    if against[RADIANS]:
        return situation, False
    return situation.model_copy(
        update={
            "ownShip": _convert_ship(situation.ownShip),
            "targetShips": [_convert_ship(ship) for ship in situation.targetShips or []],
        }
    ), True


def _list_positions(ships: Mapping[str, TrafficShip]) -> Iterator[tuple[str, Position]]:
    """Roles and positions, at the start and of the waypoints."""
    for role, ship in ships.items():
        if ship.initial is not None and ship.initial.position is not None:
            yield role, ship.initial.position
        for waypoint in ship.waypoints or []:
            yield role, waypoint.position


def _contradict(ships: Mapping[str, TrafficShip], unit: Unit) -> Iterator[str]:
    """What speaks against a unit; each ends a sentence that begins "in degrees"."""
    origin = ships["own"].fix
    if origin is None:
        return
    plane = TangentPlane(origin.lat * unit.in_degrees, origin.lon * unit.in_degrees)
    yield from _contradict_positions(ships, origin, plane, unit)
    yield from _contradict_courses(ships, plane, unit)
    yield from _contradict_hulls(ships, plane, unit)


def _locate(plane: TangentPlane, position: Position, unit: Unit) -> tuple[float, float]:
    return plane.position(position.lat * unit.in_degrees, position.lon * unit.in_degrees)


def _contradict_positions(
    ships: Mapping[str, TrafficShip], origin: Position, plane: TangentPlane, unit: Unit
) -> Iterator[str]:  # fmt: skip
    for role, position in _list_positions(ships):
        found = _locate(plane, position, unit)
        if position.north is not None and position.east is not None:
            said = position.north - (origin.north or 0.0), position.east - (origin.east or 0.0)
            off = hypot(found[0] - said[0], found[1] - said[1])
            if hypot(*said) > LEAST_DISTANCE and off > AGREEMENT * hypot(*said):
                yield f"{role} is {off:.0f} m from its north and east, {said[0]:g} and {said[1]:g} m"
        if hypot(*found) > WIDEST:
            yield f"{role} is {hypot(*found) / 1e3:.0f} km from own ship"


def _contradict_courses(ships: Mapping[str, TrafficShip], plane: TangentPlane, unit: Unit) -> Iterator[str]:
    for role, ship in ships.items():
        given = {} if ship.initial is None else {"cog": ship.initial.cog, "heading": ship.initial.heading}
        for key, value in given.items():
            if value is not None and abs(value) * unit.in_degrees > 360.5:
                yield f"{role} has {key} = {value:g}"
        cog, marks = given.get("cog"), [_locate(plane, w.position, unit) for w in (ship.waypoints or [])[:2]]
        if cog is None or len(marks) < 2 or hypot(marks[1][0] - marks[0][0], marks[1][1] - marks[0][1]) < LEAST_LEG:
            continue
        leg = atan2(marks[1][1] - marks[0][1], marks[1][0] - marks[0][0])
        apart = (radians(cog * unit.in_degrees) - leg + pi) % (2.0 * pi) - pi
        if abs(apart) > COURSE_AGREEMENT:
            yield f"{role} has cog = {cog:g} on a leg of {degrees(leg) % 360.0:.0f} deg"


def _contradict_hulls(ships: Mapping[str, TrafficShip], plane: TangentPlane, unit: Unit) -> Iterator[str]:
    own = ships["own"]
    for role, ship in ships.items():
        widths = own.dimensions.width, ship.dimensions.width
        if role == "own" or ship.fix is None or widths[0] is None or widths[1] is None:
            continue
        if hypot(*_locate(plane, ship.fix, unit)) < 0.5 * (widths[0] + widths[1]):
            yield f"own and {role} lie inside each other"


def _convert_ship(ship: TrafficShip) -> TrafficShip:
    """The ship in degrees and knots."""
    initial, waypoints = ship.initial, ship.waypoints
    if initial is not None:
        initial = initial.model_copy(
            update={
                "position": None if initial.position is None else _convert_position(initial.position),
                "sog": _convert(initial.sog, 1.0 / KNOT),
                "cog": _convert(initial.cog, RADIANS.in_degrees),
                "heading": _convert(initial.heading, RADIANS.in_degrees),
            }
        )
    if waypoints is not None:
        waypoints = [_convert_waypoint(waypoint) for waypoint in waypoints]
    return ship.model_copy(update={"initial": initial, "waypoints": waypoints})


def _convert_waypoint(waypoint: Waypoint) -> Waypoint:
    leg = waypoint.leg
    if leg is not None:
        leg = Leg(sog=_convert(leg.planned_sog, 1.0 / KNOT), data=LegData())
    return waypoint.model_copy(update={"position": _convert_position(waypoint.position), "leg": leg})


def _convert_position(position: Position) -> Position:
    return position.model_copy(update={"lat": degrees(position.lat), "lon": degrees(position.lon)})


def _convert(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor
