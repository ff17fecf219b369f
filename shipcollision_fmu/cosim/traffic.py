"""Traffic situations of DNV's trafficgen and maritime-schema (JSON), made into a scenario file.

    lat, lon              to north, east on the tangent plane at own ship's position (tangent_plane.py)
    sog [kn], cog [deg]   to a velocity over ground; heading [deg] to the heading, the course where there is none
    a, b, c, d            where the position is aboard (bow, stern, port, starboard): CO is amidships
    length, width         to a ship file of that size when no ship is named; what is missing is estimated
    waypoints             the route of a ship that sails with hydrodynamics
    sog of the legs       orders of revolutions to her engine, at the times at which the legs begin as planned
    current, wind         the scenario's, for ships that sail with hydrodynamics

A ship that coasts keeps her course and speed. What is not carried over is said in the file and in `notes`.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, inf, isclose, radians, sin
from pathlib import Path
from typing import Any, NamedTuple

from ..errors import ScenarioError
from ..ship.library import load_ship
from ..ship.particulars import RHO_SEA
from .encounters import ship_reference
from .imazu import KNOT
from .scenario import load_scenario
from .scenario_text import scenario_text
from .tables import SHORTEST_LEG
from .tangent_plane import TangentPlane
from .traffic_schema import Dimensions, Environment, Initial, Position, Situation, Static, TrafficShip, situation
from .trials import self_propulsion
from .wanted import whole_steps

__all__ = ["Imported", "traffic_scenario"]

WIDEST = 100e3
"""[m] between own ship and a target: further apart, a plane is no map, and the positions are probably mistaken."""
LONGEST_DEFAULT = 3600.0
"""[s] A situation is run for as long as own ship's route takes, and no longer than this."""
USUAL_DURATION = 600.0
"""[s] Where own ship has no route to sail."""
BLOCK_COEFFICIENTS = {"tanker": 0.82, "cargo": 0.75, "passenger": 0.62}
"""C_b by the first word of shipType; 0.65 for the others. Typical values."""
BREADTH_TO_DRAUGHT = 3.0
"""B/T of a ship whose draught is not given."""


@dataclass(frozen=True)
class Imported:
    """A scenario file's text, the texts of the ship files that go beside it, by their names, and what was left out."""

    text: str
    ship_files: dict[str, str]
    notes: tuple[str, ...] = ()


class _State(NamedTuple):
    """CO in n [m], heading and course [rad], speed over ground [m/s], the waypoints to come [m], and the planned
    speed [m/s] on the leg to each."""

    north: float
    east: float
    heading: float
    course: float
    speed: float
    route: list[list[float]]
    speeds: list[float]


class _Plan(NamedTuple):
    """What the scenario is made from: file and content, states and ships by role, texts of the ship files made."""

    path: Path
    out: Path
    situation: Situation
    states: dict[str, _State]
    ships: dict[str, str]
    files: dict[str, str]
    steps: int
    step: float
    hydrodynamics: bool


def traffic_scenario(
    path: str | Path,
    *,
    out: str | Path = "traffic.toml",
    ship: str | None = None,
    own: str | None = None,
    duration: float | None = None,
    step: float = 0.05,
    hydrodynamics: bool = False,
) -> Imported:
    """The traffic situation in a JSON file as a scenario file that will be stored as `out`.

    `ship` names the ship that every role is played by, `own` own ship's; without them each gets a ship file of her
    dimensions. Raises ScenarioError, in one line, for what is no traffic situation or cannot be run.
    """
    path, out = Path(path), Path(out)
    content = situation(path)
    roles = _roles(content, path)
    states = _states(roles, path)
    ships, files = _cast(roles, ship, own, hydrodynamics, path, out)
    steps = whole_steps(_duration(states["own"]) if duration is None else duration, step)
    plan = _Plan(path, out, content, states, ships, files, steps, step, hydrodynamics)
    _check_it_loads(plan)
    return Imported(_text(plan, out.parent), files, tuple(_notes(plan)))


def _roles(content: Situation, path: Path) -> dict[str, TrafficShip]:
    """Ships by their names in the scenario."""
    if not content.targetShips:
        raise ScenarioError(f"{path.name}: targetShips is empty: a collision needs a target, add one")
    several = len(content.targetShips) > 1
    targets = {f"target_{i}" if several else "target": one for i, one in enumerate(content.targetShips, start=1)}
    return {"own": content.ownShip, **targets}


def _states(roles: Mapping[str, TrafficShip], path: Path) -> dict[str, _State]:
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


def _cast(
    roles: Mapping[str, TrafficShip], ship: str | None, own: str | None, hydrodynamics: bool, path: Path, out: Path
) -> tuple[dict[str, str], dict[str, str]]:  # fmt: skip
    """Which ship plays each role, and the texts of the ship files that are made for it."""
    ships, files = {}, {}
    for role, one in roles.items():
        named = own if role == "own" and own is not None else ship
        if named is None:
            ships[role] = f"{out.stem}-{role}.toml"
            files[ships[role]] = _ship_file(role, one, path)
            if hydrodynamics:
                raise ScenarioError(
                    f"{path.name}: {role} has dimensions only and can but coast: name a ship with --ship, or leave out "
                    "--hydrodynamics"
                )
        else:
            ships[role] = named
            if hydrodynamics and load_ship(named).manoeuvring is None:
                raise ScenarioError(
                    f"ship {named!r} can only coast, she has no [manoeuvring]: leave out --hydrodynamics"
                )
    return ships, files


def _check_it_loads(plan: _Plan) -> None:
    """Refuse before anything is written."""
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:
        for name, content in plan.files.items():
            Path(aside, name).write_text(content, encoding="utf-8")
        trial = Path(aside, plan.out.name)
        trial.write_text(_text(plan, Path(aside)), encoding="utf-8")
        try:
            load_scenario(trial)
        except ScenarioError as error:
            raise ScenarioError(f"{plan.path.name}: does not make a scenario: {error}") from None


def _fix(ship: TrafficShip, path: Path, role: str) -> Position:
    """Where a ship is at the start."""
    if ship.initial is not None and ship.initial.position is not None:
        return ship.initial.position
    if ship.waypoints:
        return ship.waypoints[0].position
    raise ScenarioError(f"{path.name}: {role} is nowhere: give initial.position or waypoints")


def _state(role: str, ship: TrafficShip, plane: TangentPlane, path: Path) -> _State:
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
            route.append([round(x, 3) for x in mark])
            speeds.append(planned)
    return _State(north, east, heading, course, speed, route, speeds)


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


def _lengths(state: _State) -> list[float]:
    """Of the legs of a route [m]."""
    starts = [[state.north, state.east], *state.route]
    return [hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(starts, state.route, strict=False)]


def _duration(own: _State) -> float:
    """Until own ship has sailed her waypoints, as planned."""
    times = [length / speed if speed > 0.0 else inf for length, speed in zip(_lengths(own), own.speeds, strict=True)]
    return min(LONGEST_DEFAULT, sum(times)) if times else USUAL_DURATION


def _ship_file(role: str, ship: TrafficShip, path: Path) -> str:
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


def _notes(plan: _Plan) -> list[str]:
    """What of the file is not carried over, or only in part."""
    notes, around = [], plan.situation.environment or Environment()
    states = plan.states.values()
    faster = any(not isclose(speed, state.speed) for state in states for speed in state.speeds)
    if plan.hydrodynamics:
        if faster:
            notes.append("Speeds of later legs: the engine is ordered when the leg should begin; no gradual change.")
        if any(waypoint.turnRadius for ship in _roles(plan.situation, plan.path).values()
               for waypoint in ship.waypoints or []):  # fmt: skip
            notes.append("turnRadius is not carried over: the ships turn as their autopilots do.")
    else:
        if any(len(state.route) > 1 for state in states):
            notes.append("The ships coast and keep their courses: bends of their routes are left out.")
        if faster:
            notes.append("The ships coast and keep their speeds: those of later legs are left out.")
        for what, value in (("wind", around.windSpeed), ("current", around.currentSpeed)):
            if value:
                notes.append(f"The file's {what} is not carried over: the ships coast.")
    if around.significantWaveHeight:
        notes.append("The file's waves are not carried over: the sea is smooth.")
    return notes


def _text(plan: _Plan, directory: Path) -> str:
    version = plan.situation.version or "not given, 0.1 or older"
    comment = [
        f"Made by `shipcollision import {plan.path.name}` (traffic situation, schema version {version}).",
        "n's origin is own ship's position in that file; positions here are of midship.",
        *_notes(plan),
    ]
    described = plan.situation.description or plan.situation.title or plan.path.stem
    tables: dict[str, Mapping[str, Any]] = {
        "scenario": {
            "name": re.sub(r"[^A-Za-z0-9_.-]+", "_", plan.out.stem).lstrip(".-") or "traffic",
            "description": " ".join(described.split()),
            "duration": round(plan.steps * plan.step, 9),
            "step": plan.step,
        }
    }
    for role, state in plan.states.items():
        tables[f"ships.{role}"] = _ship_table(state, plan.ships[role], plan.files, directory, plan)
    if plan.hydrodynamics and plan.situation.environment is not None:
        around = _environment(plan.situation.environment)
        if around:
            tables["environment"] = around
    return scenario_text(comment, tables)


def _ship_table(state: _State, ship: str, made: Collection[str], directory: Path, plan: _Plan) -> dict[str, Any]:
    drift = state.course - state.heading
    straight = isclose(cos(drift), 1.0, abs_tol=1e-12)
    return {
        "ship": ship if ship in made else ship_reference(ship, directory),
        "position": [round(state.north, 3) + 0.0, round(state.east, 3) + 0.0],
        "heading_deg": round(degrees(state.heading), 6) % 360.0,
        "speed": round(state.speed, 6) if straight else None,
        "surge": None if straight else round(state.speed * cos(drift), 6),
        "sway": None if straight else round(state.speed * sin(drift), 6),
        "hydrodynamics": plan.hydrodynamics or None,
        "orders": (_orders(state, ship, plan.steps * plan.step) or None) if plan.hydrodynamics else None,
        "route": {"waypoints": state.route} if plan.hydrodynamics and state.route else None,
    }


def _orders(state: _State, ship: str, duration: float) -> list[dict[str, float]]:
    """Revolutions for the speed at the start, and for that of each leg from when it should begin."""
    orders, now, time = [{"time": 0.0, "rev_per_s": _revolutions(ship, state.speed)}], state.speed, 0.0
    for i, (length, speed) in enumerate(zip(_lengths(state), state.speeds, strict=True)):
        if i and not isclose(speed, now):
            orders.append({"time": round(time, 3), "rev_per_s": _revolutions(ship, speed)})
        # The first leg is sailed at the speed of the start, which initial.sog may give other than the leg does.
        now = speed if i else state.speed
        time += length / now if now > 0.0 else inf
        if time >= duration:
            break
    return orders if any(order["rev_per_s"] for order in orders) else []


def _revolutions(ship: str, speed: float) -> float:
    return self_propulsion(ship, speed) if speed > 0.0 else 0.0


def _environment(around: Environment) -> dict[str, Any]:
    """The table [environment]; empty when there is neither current nor wind."""
    tables: dict[str, Any] = {}
    if around.currentSpeed:
        tables["current"] = {"speed": around.currentSpeed, "towards_deg": around.currentDirection or 0.0}
    if around.windSpeed:
        tables["wind"] = {"speed": around.windSpeed, "from_deg": around.windDirection or 0.0}
    return tables
