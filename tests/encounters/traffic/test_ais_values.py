"""ITU-R M.1371: 511, 102.3, 360, 91, 181 and 0 are "not available", in traffic as in AIS."""

from __future__ import annotations

import json
from math import degrees
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu.encounters.traffic.situation import TrafficScenario, traffic_scenario
from shipcollision_fmu.encounters.units import KNOT
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.scenario import Scenario, load_scenario
from shipcollision_fmu.scenario.tracks.ship_file import describe_kind
from shipcollision_fmu.ship.ship_type import find_ship_type

LEG = [{"position": {"lat": 58.79, "lon": 10.49}}, {"position": {"lat": 58.76, "lon": 10.49}, "leg": {"sog": 7.0}}]


def situation(target: dict[str, Any], static: dict[str, Any] | None = None, **others: Any) -> dict[str, Any]:
    own = {"position": {"lat": 58.76, "lon": 10.49}, "sog": 10.0, "cog": 0.0}
    size = {"length": 100.0, "width": 16.0}
    initial = {"position": {"lat": 58.79, "lon": 10.49}, "sog": 8.0, "cog": 180.0, **target}
    return {
        "ownShip": {"static": size, "initial": own},
        "targetShips": [{"static": size if static is None else static, "initial": initial, **others}],
    }


def imported(data: dict[str, Any], folder: Path) -> tuple[Scenario, TrafficScenario]:
    (folder / "s.json").write_text(json.dumps(data), encoding="utf-8")
    made = traffic_scenario(folder / "s.json", out=folder / "s.toml")
    for name, text in {**made.ship_files, "s.toml": made.text}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return load_scenario(folder / "s.toml"), made


@pytest.mark.parametrize("heading", [511, 511.0])
def test_without_a_heading_the_course_is_taken(tmp_path: Path, heading: float) -> None:
    scenario, made = imported(situation({"heading": heading, "cog": 200.0}), tmp_path)
    assert degrees(scenario.ships["target"].start.attitude[2]) == pytest.approx(200.0, abs=0.01)
    assert made.notes == ('target: heading 511 is AIS\'s "not available": its course is taken.',)


def test_an_unknown_speed_is_named_and_the_remedy_helps(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError) as refused:
        imported(situation({"sog": 102.3}), tmp_path)
    assert str(refused.value) == (
        's.json: target has no speed (sog 102.3 is AIS\'s "not available"): give initial.sog, or sog in the leg of its '
        "second waypoint"
    )
    scenario, made = imported(situation({"sog": 102.3}, waypoints=LEG), tmp_path)
    assert scenario.ships["target"].start.velocity[0] == pytest.approx(7.0 * KNOT, rel=1e-6)
    assert made.notes == ('target: sog 102.3 is AIS\'s "not available": the speed of its first leg is taken.',)


def test_a_course_of_360_is_north_unless_the_heading_says_otherwise(tmp_path: Path) -> None:
    scenario, made = imported(situation({"cog": 360.0, "heading": 2.0}), tmp_path)
    assert degrees(scenario.ships["target"].start.attitude[2]) % 360.0 == pytest.approx(0.0, abs=0.01)
    assert [note.split(":")[0] for note in made.notes] == ["The ships coast in water at rest"]
    scenario, made = imported(situation({"cog": 360.0, "heading": 135.0}), tmp_path)
    assert degrees(scenario.ships["target"].start.attitude[2]) == pytest.approx(135.0, abs=0.01)
    assert made.notes == ('target: cog 360 is AIS\'s "not available": its first leg or its heading is taken.',)


@pytest.mark.parametrize("position", [{"lat": 91.0, "lon": 181.0}, {"latitude": 91, "longitude": 181}])
def test_an_unknown_position_is_named_and_the_remedy_helps(tmp_path: Path, position: dict[str, float]) -> None:
    with pytest.raises(ScenarioError) as refused:
        imported(situation({"position": position}), tmp_path)
    assert str(refused.value) == (
        's.json: target has no position (position is AIS\'s "not available"): give initial.position or waypoints'
    )
    scenario, _ = imported(situation({"position": position}, waypoints=LEG), tmp_path)
    assert scenario.ships["target"].start.position[0] == pytest.approx(0.03 * 111407.0, abs=2.0)


@pytest.mark.parametrize(
    ("dimensions", "size", "ahead"),
    [
        ({"a": 80.0, "b": 20.0, "c": 6.0, "d": 10.0}, (100.0, 16.0), 30.0),
        ({"a": 0, "b": 100, "c": 0, "d": 16}, (100.0, 16.0), 0.0),  # the reference point is not available
        ({"length": 90.0, "width": 15.0, "draught": 0.0, "a": 0, "b": 0, "c": 0, "d": 0}, (90.0, 15.0), 0.0),
        ({"a": 0, "b": 100, "c": 6, "d": 10}, (100.0, 16.0), -50.0),  # the reference point is at the stem
    ],
)
def test_dimensions_are_those_of_ais(
    tmp_path: Path, dimensions: dict[str, float], size: tuple[float, float], ahead: float
) -> None:
    scenario, _ = imported(situation({"cog": 0.0}, {"dimensions": dimensions}), tmp_path)
    ship = scenario.load_ships()["target"]
    assert (ship.L_oa, ship.B, ship.T) == (*size, pytest.approx(size[1] / 3.0, abs=1e-3))
    without, _ = imported(situation({"cog": 0.0}), tmp_path)
    north = [s.ships["target"].start.position[0] for s in (scenario, without)]
    assert north[0] - north[1] == pytest.approx(ahead, abs=0.01)


def test_a_ship_without_dimensions_is_named_and_the_remedy_helps(tmp_path: Path) -> None:
    data = situation({}, {"dimensions": {"a": 0, "b": 0, "c": 0, "d": 0}})
    with pytest.raises(ScenarioError, match=r"s.json: target has no length and width: name a ship with --ship$"):
        imported(data, tmp_path)
    assert traffic_scenario(tmp_path / "s.json", out=tmp_path / "x.toml", ship="kcs").ship_files == {}


@pytest.mark.parametrize(
    ("said", "type_of_ship", "typical"),
    [
        (80, "tanker, loaded", True), (89, "tanker, loaded", True), (70, "cargo vessel, loaded", True),
        (60, "passenger liner", True), (30, "fishing vessel", True), (31, "tug", True), (52, "tug", True),
        (35, "destroyer", True), (36, "speed boat", True), (40, "speed boat", True), (50, "tender", True),
        (55, "tender", True), (0, "cargo vessel, loaded", False), (90, "cargo vessel, loaded", False),
        (None, "cargo vessel, loaded", False), ("Not available", "cargo vessel, loaded", False),
        ("Passenger/Ro-Ro Cargo Ship", "ferry", True), ("Law enforcement", "tender", True),
        ("Towing large", "tug", True), ("Military operations", "destroyer", True),
    ],
)  # fmt: skip
def test_types_of_ship(said: str | int | None, type_of_ship: str, typical: bool) -> None:
    """Numbers of M.1371-5, table 53, and trafficgen's words for them."""
    kind, named = describe_kind(said)
    assert (find_ship_type(kind).name, named) == (type_of_ship, typical)
