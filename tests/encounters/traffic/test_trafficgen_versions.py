"""Files of every generation of DNV's trafficgen: names, versions, units, and inputs told from outputs."""

from __future__ import annotations

import json
from math import degrees, hypot, pi, tan
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import load_scenario
from shipcollision_fmu.encounters.traffic.situation import traffic_scenario
from shipcollision_fmu.encounters.units import KNOT
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.scenario import Scenario

HERE = Path(__file__).parent / "situations"


def written(data: Any, folder: Path) -> Path:
    path = folder / "s.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    return path


def imported(data: Any, folder: Path) -> tuple[Scenario, str]:
    made = traffic_scenario(written(data, folder), out=folder / "s.toml")
    for name, text in {**made.ship_files, "s.toml": made.text}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return load_scenario(folder / "s.toml"), made.text


def test_the_file_of_trafficgen_0_9_1(tmp_path: Path) -> None:
    """Positions, courses and speeds are left to the waypoints. Expected: trafficgen's headings and its speeds."""
    data = json.loads((HERE / "trafficgen_0_9_1.json").read_text(encoding="utf-8"))
    scenario, text = imported(data, tmp_path)
    assert "(traffic situation, schema version 0.2.0, trafficgen 0.9.1)" in text
    assert list(scenario.ships) == ["own", "target_1", "target_2", "target_3"]
    for ship, target in zip(list(scenario.ships.values())[1:], data["targetShips"], strict=True):
        assert degrees(ship.start.attitude[2]) == pytest.approx(target["initial"]["heading"], abs=0.1)
        assert hypot(*ship.start.velocity) == pytest.approx(target["waypoints"][1]["leg"]["sog"] * KNOT, rel=1e-5)


@pytest.mark.parametrize(
    ("versions", "said"),
    [
        ({"schemaVersion": "0.2.0"}, "traffic situation, schema version 0.2.0)"),
        ({"version": "0.8.2"}, "traffic situation, version 0.8.2)"),
        ({}, "traffic situation, no version given)"),
    ],
)
def test_the_version_is_said_by_the_file_s_own_key(tmp_path: Path, versions: dict[str, str], said: str) -> None:
    assert said in imported({**plain(), **versions}, tmp_path)[1]


def plain() -> dict[str, Any]:
    """Own ship and a target on opposite courses, 3 km apart, off Larvik."""
    return {
        "ownShip": ship(58.76, 10.49, 0.0, 10.0),
        "targetShips": [ship(58.787, 10.49, 180.0, 12.0)],
    }


def ship(latitude: float, longitude: float, cog: float, sog: float) -> dict[str, Any]:
    return {
        "static": {"length": 100.0, "width": 16.0, "shipType": "Cargo"},
        "initial": {"position": {"latitude": latitude, "longitude": longitude}, "cog": cog, "sog": sog},
    }


def test_the_file_of_2023_with_underscores(tmp_path: Path) -> None:
    """start_pose with speed and course, target_ship, waypoints that are positions; a made-up one in that form."""
    position = {"north": 3006.0, "east": 0.0, "latitude": 58.787, "longitude": 10.49}
    data = {
        "title": "HO", "input_file_name": "x.json", "common_vector": 10.0, "lat_lon_0": [58.76, 10.49],
        "own_ship": {
            "static": {"length": 122, "width": 20, "speed_max": 17, "ship_type": "Passenger/Ro-Ro Cargo Ship"},
            "start_pose": {"speed": 10.0, "course": 0.0, "position": {"latitude": 58.76, "longitude": 10.49}},
            "waypoints": [{"latitude": 58.76, "longitude": 10.49}, position],
        },
        "target_ship": [
            {
                "static": {"length": 50, "width": 10, "ship_type": "General Cargo Ship"}, "id": 1,
                "start_pose": {"speed": 12.0, "course": 183.7, "position": position},
            }
        ],
    }  # fmt: skip
    scenario, text = imported(data, tmp_path)
    own, target = scenario.ships.values()
    assert own.start.velocity[0] == pytest.approx(10.0 * KNOT, rel=1e-6)
    assert target.start.velocity[0] == pytest.approx(12.0 * KNOT, rel=1e-6)
    assert degrees(target.start.attitude[2]) == pytest.approx(183.7, abs=0.01)
    assert target.start.position[:2] == pytest.approx([3007.3, 0.0], abs=1.5)  # north is rounded, on a sphere
    assert "Not used" not in text
    assert {s.kind for s in scenario.load_ships().values()} == {
        "Passenger/Ro-Ro Cargo Ship (ferry)",
        "General Cargo Ship",
    }


RADIANS: dict[str, Any] = {
    "title": "radians", "commonVector": 600.0,
    "ownShip": {
        "static": {"length": 122.0, "width": 20.0},
        "initial": {
            "position": {"north": 0.0, "east": 0.0, "latitude": 1.02561566, "longitude": 0.18309645},
            "sog": 5.14, "cog": 0.0,
        },
    },
    "targetShips": [
        {
            "static": {"length": 50.0, "width": 10.0},
            "initial": {
                "position": {"north": 4781.0, "east": 8280.0, "latitude": 1.02636477, "longitude": 0.1855937},
                "sog": 7.7, "cog": 4.805,
            },
        }
    ],
}  # fmt: skip
"""As trafficgen wrote it in February 2024 (baseline situation 13), but for one target and the ships' names."""


def changed(data: dict[str, Any], *path: str | int, **values: Any) -> dict[str, Any]:
    """A copy in which the table at the path has the values; a value None removes its key."""
    copy: dict[str, Any] = json.loads(json.dumps(data))
    table: Any = copy
    for part in path:
        table = table[part]
    for key, value in values.items():
        table[key] = value
        if value is None:
            del table[key]
    return copy


TARGET = ("targetShips", 0, "initial")


R, TAN = 6.39e6, tan(1.02561566)
PLACE = [4781.0 + 8280.0**2 * TAN / (2.0 * R), 8280.0 * (1.0 - 4781.0 * TAN / R)]
"""Where the target is [m]: trafficgen's own north and east, along its parallel and meridian, on the tangent plane.

Parallels bend towards the pole, by E^2 tan(phi)/(2 R) = 9 m, and shorten by N tan(phi)/R, 10 m.
"""


def test_radians_and_metres_per_second_are_converted(tmp_path: Path) -> None:
    """Expected: the file's own north and east, and its numbers."""
    scenario, text = imported(RADIANS, tmp_path)
    own, target = scenario.ships.values()
    assert target.start.position[:2] == pytest.approx(PLACE, abs=1.0)
    assert target.start.velocity == pytest.approx([7.7, 0.0, 0.0], rel=1e-5)
    assert degrees(target.start.attitude[2]) == pytest.approx(degrees(4.805), abs=0.2)  # the meridians converge
    assert own.start.velocity == pytest.approx([5.14, 0.0, 0.0], rel=1e-5)
    assert "in radians, speeds in m/s" in text


def without_north_and_east(data: dict[str, Any]) -> dict[str, Any]:
    """Also without the courses by which degrees and radians could be told."""
    for place in (("ownShip", "initial"), TARGET):
        data = changed(data, *place, "position", north=None, east=None)
    return data


def test_radians_are_told_by_the_course_along_the_first_leg(tmp_path: Path) -> None:
    """Positions that could be both, 9.6 or 0.3 km apart; 4.805 is the direction of the leg in radians only."""
    marks = [{"position": {"lat": 1.02636477, "lon": 0.1855937}}, {"position": {"lat": 1.02651, "lon": 0.18259}}]
    data = changed(without_north_and_east(RADIANS), "targetShips", 0, waypoints=marks)
    scenario, _ = imported(data, tmp_path)
    assert scenario.ships["target"].start.position[:2] == pytest.approx(PLACE, abs=1.0)
    data = changed(data, *TARGET, cog=275.3)  # a course in degrees
    scenario, text = imported(data, tmp_path)
    assert scenario.ships["target"].start.position[:2] == pytest.approx([83.0, 278.0], abs=1.0)
    assert "in radians" not in text


def test_degrees_near_the_equator_stay_degrees(tmp_path: Path) -> None:
    """0.05 deg is 5.5 km, 0.05 rad 319 km: beyond the reach of an encounter. So are courses beyond a full turn."""
    data = {"ownShip": ship(0.0, 0.0, 0.0, 10.0), "targetShips": [ship(0.05, 0.0, 3.0, 5.0)]}
    scenario, text = imported(data, tmp_path)
    assert scenario.ships["target"].start.position[0] == pytest.approx(0.05 * 110574.0, abs=1.0)
    assert "in radians" not in text
    near = {"ownShip": ship(0.0, 0.0, 0.0, 10.0), "targetShips": [ship(0.005, 0.0, 183.0, 5.0)]}
    assert imported(near, tmp_path)[0].ships["target"].start.position[0] == pytest.approx(552.9, abs=0.1)


def test_radians_that_would_be_hulls_inside_each_other_are_radians(tmp_path: Path) -> None:
    """9e-5 deg is 10 m, less than the half widths of 16 m; 9e-5 rad is 573 m."""
    data = {"ownShip": ship(1.0, 0.2, 0.0, 5.0), "targetShips": [ship(1.00009, 0.2, pi, 5.0)]}
    scenario, _ = imported(data, tmp_path)
    assert scenario.ships["target"].start.position[0] == pytest.approx(9e-5 * 6.38e6, rel=5e-3)


def test_what_may_be_either_is_refused_and_the_remedy_helps(tmp_path: Path) -> None:
    data = without_north_and_east(RADIANS)
    with pytest.raises(ScenarioError) as refused:
        imported(data, tmp_path)
    assert str(refused.value) == (
        "s.json: positions within 1.57 N and 3.14 E may be in degrees or in radians: give north and east [m] in the "
        "position of each target, from own ship"
    )
    cured = changed(data, *TARGET, "position", north=4781.0, east=8280.0)
    assert imported(cured, tmp_path)[0].ships["target"].start.position[:2] == pytest.approx(PLACE, abs=1.0)
    in_degrees = changed(data, *TARGET, "position", north=83.0, east=278.0)
    assert imported(in_degrees, tmp_path)[0].ships["target"].start.position[0] == pytest.approx(83.0, abs=1.0)


def test_what_is_neither_is_refused_and_the_remedy_helps(tmp_path: Path) -> None:
    """north and east ten times too far."""
    with pytest.raises(ScenarioError) as refused:
        imported(changed(RADIANS, *TARGET, "position", north=47810.0, east=82800.0), tmp_path)
    assert str(refused.value) == (
        "s.json: positions and courses are neither in degrees nor in radians: in degrees target is 95330 m from its "
        "north and east, 47810 and 82800 m; in radians target is 86055 m from its north and east, 47810 and 82800 m: "
        "give degrees, and north and east in metres from own ship"
    )
    data = changed(
        RADIANS, "ownShip", "initial", "position", latitude=degrees(1.02561566), longitude=degrees(0.18309645)
    )
    data = changed(data, *TARGET, "position", latitude=degrees(1.02636477), longitude=degrees(0.1855937))
    data = changed(data, *TARGET, cog=degrees(4.805))
    assert imported(data, tmp_path)[0].ships["target"].start.position[:2] == pytest.approx(PLACE, abs=1.0)


@pytest.mark.parametrize(
    "data",
    [
        {"title": "HO", "ownShip": ship(58.7, 10.4, 0.0, 10.0), "encounters": [{"desiredEncounterType": "head-on"}]},
        {"title": "HO", "own_ship": {}, "encounter": [{"desired_encounter_type": "head-on"}]},
        {"trafficSituations": [], "ownShipStatic": {}, "targetShipsStatic": [], "encounterSettings": {}},
        [{"title": "HO", "ownShip": {}, "encounters": []}],
    ],
)
def test_inputs_of_trafficgen_are_sent_to_trafficgen(tmp_path: Path, data: Any) -> None:
    """The remedy, the file that trafficgen writes, is read above."""
    with pytest.raises(ScenarioError) as refused:
        imported(data, tmp_path)
    assert str(refused.value) == (
        "s.json: is an input of trafficgen, it has encounters and no targetShips: run `trafficgen gen-situation -s "
        "s.json -os OWN.json -t TARGETS -o FOLDER`, and import a file of that FOLDER"
    )


def test_tables_that_are_not_used_are_named(tmp_path: Path) -> None:
    data = changed(plain(), landAreas=[{"name": "Larvik"}], environment={"visibility": 5.0, "waveDirection": 30.0})
    data = changed(data, "ownShip", sensors={"radar": 1}, waypoints=[])
    data = changed(data, "targetShips", 0, sensors={"radar": 1})
    text = imported(data, tmp_path)[1]
    said = "landAreas, ownShip.sensors, targetShips.sensors, environment.visibility, environment.waveDirection"
    assert f"# Not used: {said}.\n" in text
    assert "Not used" not in imported(plain(), tmp_path)[1]


def test_names_of_a_foreign_file_stay_in_their_comment(tmp_path: Path) -> None:
    data = changed(plain(), **{"land\n[collision]\u0001\x7fx": [{"x": 1}], "version": "1\n[environment]\nwind = 9"})
    scenario, text = imported(data, tmp_path)
    assert "# Not used: land [collision] x." in text
    assert scenario.environment.wind is None
