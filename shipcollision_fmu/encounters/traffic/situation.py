"""traffic_scenario(): a file of other people's traffic as a scenario file.

    JSON                  maritime-schema and trafficgen (ships.py)
    XML                   CommonOcean (commonocean.py)
    ships                 become position, heading and velocity
    length, width         become a ship file of that size when no ship is named (scenario/tracks/ship_file.py)
    waypoints             become the route of a ship that sails with hydrodynamics
    speeds of the legs    become orders of revolutions, at the times at which the legs begin as planned
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

from ...errors import ScenarioError, ShipError
from ...manoeuvring.trials.steady_course import find_self_propulsion
from ...scenario.scenario import load_scenario
from ...scenario.toml_writer import format_toml
from ...scenario.tracks.ship_file import find_engine_reach, write_ship_file
from ..request import count_steps
from ..ship_table import build_ship_table, refer_to_ship, require_manoeuvring, round_off
from .commonocean import read_commonocean
from .ships import read_situation
from .traffic import Surroundings, Traffic, TrafficStart

__all__ = ["TrafficScenario", "traffic_scenario"]

LARGEST_CRAB = radians(15.0)
"""[rad] Angle between heading and course that wind and current explain. Ships beyond it drift, at low speed."""


@dataclass(frozen=True)
class TrafficScenario:
    """A scenario file's text, the texts of the ship files beside it by name, and notes on what is not carried over."""

    text: str
    ship_files: dict[str, str]
    notes: tuple[str, ...] = ()


class _Plan(NamedTuple):
    """What the scenario is made from.

    ships: by role, as the scenario file names them; files: texts of the generated ship files by name;
    aside: a folder in which these are stored while the scenario is made.
    """

    path: Path
    out: Path
    traffic: Traffic
    ships: dict[str, str]
    files: dict[str, str]
    aside: Path
    steps: int
    step: float
    hydrodynamics: bool

    def locate(self, ship: str) -> str:
        """The argument of load_ship for a ship of the scenario."""
        return str(self.aside / ship) if ship in self.files else ship


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
    """The traffic in a file of maritime-schema, trafficgen or CommonOcean as a scenario that will be stored as `out`.

    `ship` names the ship of every role, `own` that of own ship. Without them each role gets a ship file of the
    dimensions in the file. Raises ScenarioError, in one line, for a file that is no traffic, or that does not make a
    scenario.
    """
    path, out = Path(path), Path(out)
    traffic = _read(path)
    ships, files = _choose_ships(traffic, ship, own, hydrodynamics, path, out)
    steps = count_steps(traffic.duration if duration is None else duration, step)
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:
        for name, content in files.items():
            Path(aside, name).write_text(content, encoding="utf-8")
        plan = _Plan(path, out, traffic, ships, files, Path(aside), steps, step, hydrodynamics)
        if hydrodynamics:
            _check_engines(plan)
        _check_loading(plan)
        return TrafficScenario(_write(plan, out.parent), files, tuple(_list_omissions(plan)))


def _read(path: Path) -> Traffic:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ScenarioError(
            f"{path} cannot be read: {error.strerror}: give the path of a JSON or CommonOcean file"
        ) from None
    is_xml = path.suffix.lower() == ".xml" or content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<")
    return read_commonocean(content, path.name) if is_xml else read_situation(content, path.name)


def _choose_ships(
    traffic: Traffic, ship: str | None, own: str | None, hydrodynamics: bool, path: Path, out: Path
) -> tuple[dict[str, str], dict[str, str]]:  # fmt: skip
    """The ship of each role, and the texts of the ship files generated for it by name."""
    ships, files = {}, {}
    for role, size in traffic.sizes.items():
        named = own if role == "own" and own is not None else ship
        if named is None:
            ships[role] = f"{out.stem}-{role}.toml"
            remedy = f"name a ship with {'--own or ' if role == 'own' else ''}--ship"
            files[ships[role]] = write_ship_file(role, size, path.name, remedy, hydrodynamics)
        else:
            ships[role] = named
            if hydrodynamics:
                require_manoeuvring(named, "leave out --hydrodynamics")
    return ships, files


def _check_engines(plan: _Plan) -> None:
    """Raise ScenarioError for a ship made from its dimensions that cannot sail, or not as fast as the file says."""
    for role, ship in plan.ships.items():
        if ship not in plan.files:
            continue
        remedy = "name a ship with --ship, or leave out --hydrodynamics"
        try:
            reach = find_engine_reach(plan.locate(ship))
        except ShipError as error:
            raise ScenarioError(f"{plan.path.name}: {role} cannot sail by estimate: {error}: {remedy}") from None
        if reach is None:
            raise ScenarioError(f"{plan.path.name}: {role} cannot sail by estimate: {remedy}")
        start = plan.traffic.starts[role]
        state = f"state {plan.traffic.top_speed_key}, " if plan.traffic.top_speed_key else ""
        fastest = max(start.speed, *start.speeds, 0.0)
        if fastest > reach:
            raise ScenarioError(
                f"{plan.path.name}: {role} goes {fastest:.2f} m/s, its engine, estimated from length, type and largest "
                f"speed, gives {reach:.2f} m/s: {state}{remedy}"
            )


def _check_loading(plan: _Plan) -> None:
    """Raise ScenarioError, before any file is stored, when the scenario cannot be loaded."""
    trial = plan.aside / plan.out.name
    trial.write_text(_write(plan, plan.aside), encoding="utf-8")
    try:
        load_scenario(trial)
    except ScenarioError as error:
        raise ScenarioError(f"{plan.path.name}: does not make a scenario: {error}") from None


def _list_omissions(plan: _Plan) -> list[str]:
    """Sentences on the contents of the file that are converted, not carried over, or only in part."""
    traffic, around = plan.traffic, plan.traffic.surroundings
    notes, starts = list(traffic.notes), traffic.starts.values()
    faster = any(not isclose(speed, start.speed) for start in starts for speed in start.speeds)
    if plan.hydrodynamics:
        if faster:
            notes.append("Speeds of later legs: revolutions are ordered when the leg should begin, at once.")
        notes += traffic.notes_if_sailed
    else:
        if any(_crabs(start) for start in starts):
            notes.append("The ships coast in water at rest: a heading within 15 deg of the course is turned to it.")
        if any(len(start.route) > 1 for start in starts):
            notes.append("The ships coast and keep their courses: bends of their routes are left out.")
        if faster:
            notes.append("The ships coast and keep their speeds: the speeds of later legs are left out.")
        for what, value in (("wind", around.wind), ("current", around.current)):
            if value:
                notes.append(f"The file's {what} is not carried over: the ships coast.")
    if around.waves:
        notes.append("The file's waves are not carried over: the sea is smooth.")
    return [_make_line(note) for note in notes]


def _make_line(text: str) -> str:
    """The text in one line without control characters, which would end a comment; names are the foreign file's."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


def _write(plan: _Plan, directory: Path) -> str:
    traffic = plan.traffic
    comment = [
        _make_line(f"Made by `shipcollision import {plan.path.name}` ({traffic.origin})."),
        traffic.frame,
        *_list_omissions(plan),
    ]
    tables: dict[str, Mapping[str, Any]] = {
        "scenario": {
            "name": re.sub(r"[^A-Za-z0-9_.-]+", "_", plan.out.stem).lstrip(".-") or "traffic",
            "description": " ".join((traffic.description or plan.path.stem).split()),
            "duration": round(plan.steps * plan.step, 9),
            "step": plan.step,
        }
    }
    for role, start in traffic.starts.items():
        tables[f"ships.{role}"] = _ship_table(start, plan.ships[role], directory, plan)
    tables |= {f"obstacles.{name}": table for name, table in traffic.obstacles.items()}
    if plan.hydrodynamics:
        around = _environment_table(traffic.surroundings)
        if around:
            tables["environment"] = around
    return format_toml(comment, tables)


def _ship_table(start: TrafficStart, ship: str, directory: Path, plan: _Plan) -> dict[str, Any]:
    heading = start.course if not plan.hydrodynamics and _crabs(start) else start.heading
    drift_angle = start.course - heading
    orders = _list_orders(start, plan.locate(ship), plan.steps * plan.step) if plan.hydrodynamics else []
    return build_ship_table(
        ship if ship in plan.files else refer_to_ship(ship, directory),
        (round_off(start.north, 3), round_off(start.east, 3)),
        round(degrees(heading), 6) % 360.0,
        round_off(start.speed * cos(drift_angle), 6),
        round_off(start.speed * sin(drift_angle), 6),
        rates=[0.0, 0.0, round_off(start.yaw_rate, 9)] if start.yaw_rate else None,
        hydrodynamics=plan.hydrodynamics,
        orders=orders or None,
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


def _environment_table(around: Surroundings) -> dict[str, Any]:
    """The table [environment]; empty without current and wind."""
    tables: dict[str, Any] = {}
    if around.current:
        tables["current"] = {"speed": around.current, "towards_deg": around.current_towards_deg}
    if around.wind:
        tables["wind"] = {"speed": around.wind, "from_deg": around.wind_from_deg}
    return tables
