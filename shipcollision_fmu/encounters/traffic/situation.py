"""Traffic situations of DNV's trafficgen and maritime-schema (JSON), made into a scenario file.

    ships                 to position, heading and velocity (ships.py)
    length, width         to a ship file of that size when no ship is named
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
from math import cos, degrees, inf, isclose, sin
from pathlib import Path
from typing import Any, NamedTuple

from ...errors import ScenarioError
from ...manoeuvring.trials.steady_course import self_propulsion
from ...scenario.scenario import load_scenario
from ...scenario.toml_writer import scenario_text
from ...ship.loading.library import load_ship
from ..encounter_file import ship_reference
from ..request import whole_steps
from .schema import Environment, Situation, TrafficShip, situation
from .ships import State, ship_file_text, states_of

__all__ = ["Imported", "traffic_scenario"]

LONGEST_DEFAULT = 3600.0
"""[s] A situation is run for as long as own ship's route takes, and no longer than this."""
USUAL_DURATION = 600.0
"""[s] Where own ship has no route to sail."""


@dataclass(frozen=True)
class Imported:
    """A scenario file's text, the texts of the ship files that go beside it, by their names, and what was left out."""

    text: str
    ship_files: dict[str, str]
    notes: tuple[str, ...] = ()


class _Plan(NamedTuple):
    """What the scenario is made from: file and content, states and ships by role, texts of the ship files made."""

    path: Path
    out: Path
    situation: Situation
    states: dict[str, State]
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
    states = states_of(roles, path)
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


def _cast(
    roles: Mapping[str, TrafficShip], ship: str | None, own: str | None, hydrodynamics: bool, path: Path, out: Path
) -> tuple[dict[str, str], dict[str, str]]:  # fmt: skip
    """Which ship plays each role, and the texts of the ship files that are made for it."""
    ships, files = {}, {}
    for role, one in roles.items():
        named = own if role == "own" and own is not None else ship
        if named is None:
            ships[role] = f"{out.stem}-{role}.toml"
            files[ships[role]] = ship_file_text(role, one, path)
            if hydrodynamics:
                raise ScenarioError(
                    f"{path.name}: {role} has dimensions only and can but coast: name a ship with --ship, or leave out "
                    "--hydrodynamics"
                )
        else:
            ships[role] = named
            if load_ship(named).manoeuvring is None and hydrodynamics:
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


def _duration(own: State) -> float:
    """Until own ship has sailed her waypoints, as planned."""
    times = [length / speed if speed > 0.0 else inf for length, speed in zip(own.lengths, own.speeds, strict=True)]
    return min(LONGEST_DEFAULT, sum(times)) if times else USUAL_DURATION


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


def _ship_table(state: State, ship: str, made: Collection[str], directory: Path, plan: _Plan) -> dict[str, Any]:
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


def _orders(state: State, ship: str, duration: float) -> list[dict[str, float]]:
    """Revolutions for the speed at the start, and for that of each leg from when it should begin."""
    orders, now, time = [{"time": 0.0, "rev_per_s": _revolutions(ship, state.speed)}], state.speed, 0.0
    for i, (length, speed) in enumerate(zip(state.lengths, state.speeds, strict=True)):
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
