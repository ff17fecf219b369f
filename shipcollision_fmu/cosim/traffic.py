"""Traffic situations of DNV's trafficgen and maritime-schema (JSON), read into a scenario file.

    lat, lon              to north, east on the tangent plane at own ship's position (tangent_plane.py)
    sog [kn], cog [deg]   to a velocity over ground; heading [deg] to the heading, the course where there is none
    a, b, c, d            where the position is aboard (bow, stern, port, starboard): CO is amidships
    length, width         to a ship file of that size when no ship is named; what is missing is estimated
    waypoints             the route of a ship that sails with hydrodynamics; a ship that coasts keeps her course

Both versions met in practice are read. 0.1 gives `initial`, and length and width in `static`; 0.2 puts them in
`static.dimensions`, and `initial`, or position, sog and cog in it, may be missing: they are then those of the first
leg. Wind, waves and visibility are not carried over.

Schema (MIT): https://github.com/dnv-opensource/maritime-schema, schemas/traffic_situation.json, version 0.2.0. Files
are made by https://github.com/dnv-opensource/ship-traffic-generator.
"""

from __future__ import annotations

import json
import re
import tempfile
from collections.abc import Collection
from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, inf, isclose, radians, sin
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from pydantic import AliasChoices, BaseModel, ConfigDict, Field, ValidationError

from ..errors import ScenarioError
from ..ship.library import load_ship
from ..ship.particulars import RHO_SEA
from ..ship.refusal import one_line
from .encounters import ship_reference
from .imazu import KNOT
from .scenario import load_scenario
from .scenario_text import scenario_text
from .tables import SHORTEST_LEG
from .tangent_plane import TangentPlane
from .trials import self_propulsion
from .wanted import whole_steps

__all__ = ["Imported", "imported"]

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

Knots = Annotated[float | None, Field(ge=0, le=60, description="the speed over ground in knots")]
Course = Annotated[float | None, Field(ge=-360, le=360, description="clockwise from north, in degrees")]
Metres = Annotated[float | None, Field(gt=0, le=500, description="a length in metres")]


class _Part(BaseModel):
    """Of the JSON: what is not needed is left alone."""

    model_config = ConfigDict(extra="ignore", frozen=True, allow_inf_nan=False, strict=True)


class _Position(_Part):
    lat: float = Field(ge=-85, le=85, validation_alias=AliasChoices("lat", "latitude"))
    lon: float = Field(ge=-180, le=180, validation_alias=AliasChoices("lon", "longitude"))


class _DataPoint(_Part):
    value: float | None = None


class _Leg(_Part):
    sog: Knots = None
    data: dict[str, _DataPoint | None] | None = None

    @property
    def planned_sog(self) -> float | None:
        """leg.data.sog takes priority over leg.sog."""
        point = (self.data or {}).get("sog")
        return self.sog if point is None or point.value is None else point.value


class _Waypoint(_Part):
    position: _Position
    leg: _Leg | None = None


class _Initial(_Part):
    position: _Position | None = None
    sog: Knots = None
    cog: Course = None
    heading: Course = None


class _Dimensions(_Part):
    length: Metres = None
    width: Metres = None
    draught: Metres = None
    a: Metres = None
    b: Metres = None
    c: Metres = None
    d: Metres = None


class _Static(_Dimensions):
    dimensions: _Dimensions | None = None
    name: str | None = None
    shipType: str | int | None = None
    initDelay: float | None = None


class _Ship(_Part):
    static: _Static | None = None
    initial: _Initial | None = None
    waypoints: list[_Waypoint] | None = None


class _Environment(_Part):
    currentSpeed: float | None = Field(default=None, ge=0, le=10, description="the speed of the current [m/s]")
    currentDirection: Course = None
    windSpeed: float | None = None


class _Situation(_Part):
    version: str | None = None
    title: str | None = None
    description: str | None = None
    ownShip: _Ship = Field(description="the own ship")
    targetShips: list[_Ship] | None = Field(default=None, description="a list of the target ships")
    environment: _Environment | None = None


@dataclass(frozen=True)
class Imported:
    """A scenario file's text, and the texts of the ship files that go beside it, by their names."""

    text: str
    ship_files: dict[str, str]


class _State(NamedTuple):
    """CO in n [m], heading and course [rad], speed over ground [m/s], the waypoints to come [m]."""

    north: float
    east: float
    heading: float
    course: float
    speed: float
    route: list[list[float]]


def imported(
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
    situation = _read(path)
    if not situation.targetShips:
        raise ScenarioError(f"{path.name}: targetShips is empty: a collision needs a target, add one")
    roles = {"own": situation.ownShip}
    several = len(situation.targetShips) > 1
    roles |= {f"target_{i}" if several else "target": one for i, one in enumerate(situation.targetShips, start=1)}
    first = _fix(situation.ownShip, path, "own")
    plane = TangentPlane(first.lat, first.lon)
    states = {role: _state(role, one, plane, path) for role, one in roles.items()}
    for role, state in states.items():
        apart = hypot(state.north - states["own"].north, state.east - states["own"].east)
        if apart > WIDEST:
            raise ScenarioError(
                f"{path.name}: {role} is {apart / 1e3:.0f} km from own ship, at most {WIDEST / 1e3:.0f}: check lat, lon"
            )
    files, names = {}, {}
    for role, one in roles.items():
        named = own if role == "own" and own is not None else ship
        if named is None:
            names[role] = f"{out.stem}-{role}.toml"
            files[names[role]] = _ship_file(role, one, path)
            if hydrodynamics:
                raise ScenarioError(
                    f"{path.name}: {role} has dimensions only and can but coast: name a ship with --ship, or leave out "
                    "--hydrodynamics"
                )
        else:
            names[role] = named
            if hydrodynamics and load_ship(named).manoeuvring is None:
                raise ScenarioError(
                    f"ship {named!r} can only coast, she has no [manoeuvring]: leave out --hydrodynamics"
                )
    steps = whole_steps(_duration(states["own"]) if duration is None else duration, step)

    def text(directory: Path) -> str:
        return _text(situation, states, names, files, directory, steps, step, hydrodynamics, path, out)

    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:  # refuse before anything is written
        for name, content in files.items():
            Path(aside, name).write_text(content, encoding="utf-8")
        trial = Path(aside, out.name)
        trial.write_text(text(Path(aside)), encoding="utf-8")
        try:
            load_scenario(trial)
        except ScenarioError as error:
            raise ScenarioError(f"{path.name}: does not make a scenario: {error}") from None
    return Imported(text(out.parent), files)


def _read(path: Path) -> _Situation:
    """The file's content, or what the member trafficSituation of a larger document holds."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ScenarioError(f"{path} cannot be read: {error.strerror}: give the path of a JSON file") from None
    except UnicodeDecodeError as error:
        raise ScenarioError(f"{path.name}: is not UTF-8 text (byte {error.start}): save it as UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise ScenarioError(f"{path.name}: is not valid JSON: {error}") from None
    if isinstance(content, dict) and isinstance(content.get("trafficSituation"), dict):
        content = content["trafficSituation"]
    if not isinstance(content, dict) or "ownShip" not in content:
        raise ScenarioError(
            f"{path.name}: is no traffic situation, it has no ownShip: give a file of trafficgen or maritime-schema"
        )
    try:
        return _Situation.model_validate(content)
    except ValidationError as error:
        raise ScenarioError(f"{path.name}: {one_line(error, _Situation)}") from None


def _fix(ship: _Ship, path: Path, role: str) -> _Position:
    """Where a ship is at the start."""
    if ship.initial is not None and ship.initial.position is not None:
        return ship.initial.position
    if ship.waypoints:
        return ship.waypoints[0].position
    raise ScenarioError(f"{path.name}: {role} is nowhere: give initial.position or waypoints")


def _state(role: str, ship: _Ship, plane: TangentPlane, path: Path) -> _State:
    fix = _fix(ship, path, role)
    north, east = plane.position(fix.lat, fix.lon)
    initial, waypoints = ship.initial or _Initial(), ship.waypoints or []
    marks = [list(plane.position(w.position.lat, w.position.lon)) for w in waypoints]
    if initial.cog is not None:
        course = plane.direction(fix.lat, fix.lon, radians(initial.cog))
    elif len(marks) > 1:
        course = atan2(marks[1][1] - marks[0][1], marks[1][0] - marks[0][0])
    elif initial.heading is not None:
        course = plane.direction(fix.lat, fix.lon, radians(initial.heading))
    else:
        raise ScenarioError(f"{path.name}: {role} has no course: give initial.cog, or two waypoints")
    heading = course
    if initial.heading is not None:
        heading = plane.direction(fix.lat, fix.lon, radians(initial.heading))
    sog = initial.sog
    for waypoint in waypoints[1:2]:  # the first leg is described in its end
        if sog is None and waypoint.leg is not None:
            sog = waypoint.leg.planned_sog
    if sog is None:
        raise ScenarioError(
            f"{path.name}: {role} has no speed: give initial.sog, or sog in the leg of her second waypoint"
        )
    if not 0.0 <= sog <= 60.0:
        raise ScenarioError(f"{path.name}: {role} sog = {sog:g} must be 0 to 60: it is the speed over ground in knots")
    if ship.static is not None and ship.static.initDelay:
        raise ScenarioError(f"{path.name}: {role} initDelay = {ship.static.initDelay:g} s is not offered: set it to 0")
    d = _dimensions(ship)
    if d.a is not None and d.b is not None:
        ahead, aside = 0.5 * (d.a - d.b), 0.5 * (d.d - d.c) if d.c is not None and d.d is not None else 0.0
        north += ahead * cos(heading) - aside * sin(heading)
        east += ahead * sin(heading) + aside * cos(heading)
    route: list[list[float]] = []
    for mark in marks[1:]:
        last = route[-1] if route else [north, east]
        if hypot(mark[0] - last[0], mark[1] - last[1]) > 10.0 * SHORTEST_LEG:
            route.append([round(x, 3) for x in mark])
    return _State(north, east, heading, course, sog * KNOT, route)


def _dimensions(ship: _Ship) -> _Dimensions:
    static = ship.static or _Static()
    return static.dimensions or static


def _duration(own: _State) -> float:
    """Until own ship has sailed her waypoints."""
    at, way = [own.north, own.east], 0.0
    for mark in own.route:
        way, at = way + hypot(mark[0] - at[0], mark[1] - at[1]), mark
    return min(LONGEST_DEFAULT, way / own.speed if own.speed > 0.0 else inf) if way > 0.0 else USUAL_DURATION


def _ship_file(role: str, ship: _Ship, path: Path) -> str:
    """A ship that coasts, of the dimensions given."""
    d, static = _dimensions(ship), ship.static or _Static()
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


def _text(
    situation: _Situation, states: dict[str, _State], ships: dict[str, str], made: Collection[str], directory: Path,
    steps: int, step: float, hydrodynamics: bool, path: Path, out: Path,
) -> str:  # fmt: skip
    version = situation.version or "not given, 0.1 or older"
    comment = [
        f"Made by `shipcollision import {path.name}` (traffic situation, schema version {version}).",
        "n's origin is own ship's position in that file; positions here are of midship.",
    ]
    if not hydrodynamics and any(len(state.route) > 1 for state in states.values()):
        comment.append("The ships coast and keep their courses: bends of their routes are left out.")
    if situation.environment is not None and situation.environment.windSpeed:
        comment.append("The file's wind is not carried over.")
    tables: dict[str, dict[str, Any]] = {
        "scenario": {
            "name": re.sub(r"[^A-Za-z0-9_.-]+", "_", out.stem).lstrip(".-") or "traffic",
            "description": " ".join((situation.description or situation.title or path.stem).split()),
            "duration": round(steps * step, 9),
            "step": step,
        }
    }
    for role, state in states.items():
        drift = state.course - state.heading
        straight = isclose(cos(drift), 1.0, abs_tol=1e-12)
        surge, sway = state.speed * cos(drift), state.speed * sin(drift)
        tables[f"ships.{role}"] = {
            "ship": ships[role] if ships[role] in made else ship_reference(ships[role], directory),
            "position": [round(state.north, 3) + 0.0, round(state.east, 3) + 0.0],
            "heading_deg": round(degrees(state.heading), 6) % 360.0,
            "speed": round(state.speed, 6) if straight else None,
            "surge": None if straight else round(surge, 6),
            "sway": None if straight else round(sway, 6),
            "hydrodynamics": hydrodynamics or None,
            "orders": [{"time": 0.0, "rev_per_s": self_propulsion(ships[role], state.speed)}]
            if hydrodynamics and state.speed > 0.0
            else None,
            "route": {"waypoints": state.route} if hydrodynamics and state.route else None,
        }
    around = situation.environment
    if hydrodynamics and around is not None and around.currentSpeed:
        towards = around.currentDirection or 0.0
        tables["environment"] = {"current": {"speed": around.currentSpeed, "towards_deg": towards}}
    return scenario_text(comment, tables)
