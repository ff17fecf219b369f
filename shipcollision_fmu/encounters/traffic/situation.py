"""traffic_scenario(): a traffic situation in JSON as a scenario file.

    ships                 become position, heading and velocity (ships.py)
    length, width         become a ship file of that size when no ship is named
    waypoints             become the route of a ship that sails with hydrodynamics
    sog of the legs       becomes orders of revolutions, at the times at which the legs begin as planned
    current, wind         become the scenario's, for ships that sail with hydrodynamics

A coasting ship keeps its course and speed. The file's comment and `notes` name what is not carried over.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, degrees, inf, isclose, pi, radians, sin
from pathlib import Path
from typing import Any, NamedTuple

from ...errors import ScenarioError
from ...manoeuvring.trials.steady_course import find_self_propulsion
from ...scenario.scenario import load_scenario
from ...scenario.toml_writer import format_toml
from ..request import count_steps
from ..ship_table import build_ship_table, refer_to_ship, require_manoeuvring, round_off
from .schema import Environment, Situation, TrafficShip, read_situation
from .ships import TrafficStart, locate_ships, write_ship_file

__all__ = ["TrafficScenario", "traffic_scenario"]

LARGEST_CRAB = radians(15.0)
"""[rad] Angle between heading and course that wind and current explain. Ships beyond it drift, at low speed."""
LONGEST_DEFAULT = 3600.0
"""[s] Limit of the default duration, which is the time that own ship's route takes."""
USUAL_DURATION = 600.0
"""[s] Default duration where own ship has no route."""


@dataclass(frozen=True)
class TrafficScenario:
    """A scenario file's text, the texts of the ship files beside it by name, and notes on what is not carried over."""

    text: str
    ship_files: dict[str, str]
    notes: tuple[str, ...] = ()


class _Plan(NamedTuple):
    """What the scenario is made from: file and content; starts and ships by role; texts of the generated ship files."""

    path: Path
    out: Path
    situation: Situation
    starts: dict[str, TrafficStart]
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
) -> TrafficScenario:
    """The traffic situation in a JSON file as a scenario file that will be stored as `out`.

    `ship` names the ship of every role, `own` that of own ship. Without them each role gets a ship file of the
    dimensions in the JSON. Raises ScenarioError, in one line, for a file that is no traffic situation, or that does not
    make a scenario.
    """
    path, out = Path(path), Path(out)
    content = read_situation(path)
    roles = _name_ships(content, path)
    starts = locate_ships(roles, path)
    ships, files = _choose_ships(roles, ship, own, hydrodynamics, path, out)
    steps = count_steps(_plan_duration(starts["own"]) if duration is None else duration, step)
    plan = _Plan(path, out, content, starts, ships, files, steps, step, hydrodynamics)
    _check_loading(plan)
    return TrafficScenario(_write(plan, out.parent), files, tuple(_list_omissions(plan)))


def _name_ships(content: Situation, path: Path) -> dict[str, TrafficShip]:
    """The ships by role, which is the name in the scenario."""
    if not content.targetShips:
        raise ScenarioError(f"{path.name}: targetShips is empty: a collision needs a target, add one")
    several = len(content.targetShips) > 1
    targets = {f"target_{i}" if several else "target": ship for i, ship in enumerate(content.targetShips, start=1)}
    return {"own": content.ownShip, **targets}


def _choose_ships(
    roles: Mapping[str, TrafficShip], ship: str | None, own: str | None, hydrodynamics: bool, path: Path, out: Path
) -> tuple[dict[str, str], dict[str, str]]:  # fmt: skip
    """The ship of each role, and the texts of the ship files generated for it by name."""
    ships, files = {}, {}
    for role, traffic_ship in roles.items():
        named = own if role == "own" and own is not None else ship
        if named is None:
            ships[role] = f"{out.stem}-{role}.toml"
            files[ships[role]] = write_ship_file(role, traffic_ship, path)
            if hydrodynamics:
                raise ScenarioError(
                    f"{path.name}: {role} has dimensions only and can but coast: name a ship with --ship, or leave out "
                    "--hydrodynamics"
                )
        else:
            ships[role] = named
            if hydrodynamics:
                require_manoeuvring(named, "leave out --hydrodynamics")
    return ships, files


def _check_loading(plan: _Plan) -> None:
    """Raise ScenarioError, before any file is stored, when the scenario cannot be loaded."""
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:
        for name, content in plan.files.items():
            Path(aside, name).write_text(content, encoding="utf-8")
        trial = Path(aside, plan.out.name)
        trial.write_text(_write(plan, Path(aside)), encoding="utf-8")
        try:
            load_scenario(trial)
        except ScenarioError as error:
            raise ScenarioError(f"{plan.path.name}: does not make a scenario: {error}") from None


def _plan_duration(own: TrafficStart) -> float:
    """Time [s] in which own ship sails its waypoints as planned, at most LONGEST_DEFAULT."""
    times = [length / speed if speed > 0.0 else inf for length, speed in zip(own.lengths, own.speeds, strict=True)]
    return min(LONGEST_DEFAULT, sum(times)) if times else USUAL_DURATION


def _list_omissions(plan: _Plan) -> list[str]:
    """Sentences on the contents of the file that are not carried over, or only in part."""
    notes, around = [], plan.situation.environment or Environment()
    starts = plan.starts.values()
    faster = any(not isclose(speed, start.speed) for start in starts for speed in start.speeds)
    if plan.hydrodynamics:
        if faster:
            notes.append("Speeds of later legs: revolutions are ordered when the leg should begin, at once.")
        if any(waypoint.turnRadius for ship in _name_ships(plan.situation, plan.path).values()
               for waypoint in ship.waypoints or []):  # fmt: skip
            notes.append("turnRadius is not carried over: the autopilots choose the turns.")
    else:
        if any(_crabs(start) for start in starts):
            notes.append("The ships coast in water at rest: a heading within 15 deg of the course is turned to it.")
        if any(len(start.route) > 1 for start in starts):
            notes.append("The ships coast and keep their courses: bends of their routes are left out.")
        if faster:
            notes.append("The ships coast and keep their speeds: the speeds of later legs are left out.")
        for what, value in (("wind", around.windSpeed), ("current", around.currentSpeed)):
            if value:
                notes.append(f"The file's {what} is not carried over: the ships coast.")
    if around.significantWaveHeight:
        notes.append("The file's waves are not carried over: the sea is smooth.")
    return notes


def _write(plan: _Plan, directory: Path) -> str:
    version = plan.situation.version or "not given, 0.1 or older"
    comment = [
        f"Made by `shipcollision import {plan.path.name}` (traffic situation, schema version {version}).",
        "n's origin is own ship's position in that file; positions here are of midship.",
        *_list_omissions(plan),
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
    for role, start in plan.starts.items():
        tables[f"ships.{role}"] = _ship_table(start, plan.ships[role], directory, plan)
    if plan.hydrodynamics and plan.situation.environment is not None:
        around = _environment_table(plan.situation.environment)
        if around:
            tables["environment"] = around
    return format_toml(comment, tables)


def _ship_table(start: TrafficStart, ship: str, directory: Path, plan: _Plan) -> dict[str, Any]:
    heading = start.course if not plan.hydrodynamics and _crabs(start) else start.heading
    drift_angle = start.course - heading
    return build_ship_table(
        ship if ship in plan.files else refer_to_ship(ship, directory),
        (round_off(start.north, 3), round_off(start.east, 3)),
        round(degrees(heading), 6) % 360.0,
        round_off(start.speed * cos(drift_angle), 6),
        round_off(start.speed * sin(drift_angle), 6),
        hydrodynamics=plan.hydrodynamics,
        orders=(_list_orders(start, ship, plan.steps * plan.step) or None) if plan.hydrodynamics else None,
        route={"waypoints": start.route} if plan.hydrodynamics and start.route else None,
    )


def _crabs(start: TrafficStart) -> bool:
    """Whether a ship under way points a little off its course, as wind and current make it do.

    Coasting in water at rest, it would swing broadside by the Munk moment before it meets anyone.
    """
    return 0.0 < abs(_wrap(start.course - start.heading)) <= LARGEST_CRAB


def _wrap(angle: float) -> float:
    """The angle [rad] within half a turn of zero."""
    return (angle + pi) % (2.0 * pi) - pi


def _list_orders(start: TrafficStart, ship: str, duration: float) -> list[dict[str, float]]:
    """Orders of revolutions for the speed at the start and, from the planned beginning of each leg, for its speed."""
    orders, now, time = [{"time": 0.0, "rev_per_s": _find_revolutions(ship, start.speed)}], start.speed, 0.0
    for i, (length, speed) in enumerate(zip(start.lengths, start.speeds, strict=True)):
        if i and not isclose(speed, now):
            orders.append({"time": round(time, 3), "rev_per_s": _find_revolutions(ship, speed)})
        # initial.sog may differ from the speed planned for the first leg, which is sailed at initial.sog.
        now = speed if i else start.speed
        time += length / now if now > 0.0 else inf
        if time >= duration:
            break
    return orders if any(order["rev_per_s"] for order in orders) else []


def _find_revolutions(ship: str, speed: float) -> float:
    """Revolutions [1/s] that keep a speed [m/s]; zero for a ship at rest."""
    return find_self_propulsion(ship, speed) if speed > 0.0 else 0.0


def _environment_table(around: Environment) -> dict[str, Any]:
    """The table [environment]; empty without current and wind."""
    tables: dict[str, Any] = {}
    if around.currentSpeed:
        tables["current"] = {"speed": around.currentSpeed, "towards_deg": around.currentDirection or 0.0}
    if around.windSpeed:
        tables["wind"] = {"speed": around.windSpeed, "from_deg": around.windDirection or 0.0}
    return tables
