"""Traffic situations: both versions of the schema, the plane they are put on, and what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import degrees, hypot, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.encounters.traffic.situation import TrafficScenario, traffic_scenario
from shipcollision_fmu.encounters.units import KNOT
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.scenario import Scenario
from shipcollision_fmu.scenario.tracks.tangent_plane import TangentPlane

HERE = Path(__file__).parent / "situations"
OLD, NEW = HERE / "version_0_1.json", HERE / "version_0_2.json"


def stored(made: TrafficScenario, out: Path) -> Scenario:
    for name, text in {**made.ship_files, out.name: made.text}.items():
        (out.parent / name).write_text(text, encoding="utf-8")
    return load_scenario(out)


@pytest.mark.parametrize(
    ("latitude", "of_latitude", "of_longitude"),
    # Length of a degree on WGS 84 [m], as tabulated (e.g. Wikipedia, Latitude)
    [(0.0, 110574.0, 111320.0), (45.0, 111132.0, 78847.0), (60.0, 111412.0, 55800.0)],
)
def test_a_degree_has_its_tabulated_length(latitude: float, of_latitude: float, of_longitude: float) -> None:
    plane = TangentPlane(latitude, 10.0)
    north, east = plane.position(latitude + 0.01, 10.0)
    assert (100 * north, east) == (pytest.approx(of_latitude, abs=12.0), pytest.approx(0.0, abs=1e-9))
    assert 100 * plane.position(latitude, 10.01)[1] == pytest.approx(of_longitude, abs=1.0)


def test_positions_agree_with_trafficgens_own() -> None:
    """ship-traffic-generator, baseline situation 4 (2023), gave lat, lon and north, east; 1 m: theirs is a sphere."""
    north, east = TangentPlane(58.763449, 10.490654).position(58.783612, 10.501054)
    assert (north, east) == (pytest.approx(2245.991, abs=1.0), pytest.approx(601.811, abs=1.0))


def test_courses_turn_with_the_meridians() -> None:
    """East of the origin true north leans to the west, by the difference of longitude times sin(latitude)."""
    plane = TangentPlane(58.0, 10.0)
    turned = plane.direction(58.0, 10.2, 0.0)
    assert degrees(turned) == pytest.approx(-0.2 * sin(radians(58.0)), rel=1e-4)
    here, there = (np.array(plane.position(latitude, 10.2)) for latitude in (58.0, 58.001))
    assert np.arctan2(*(there - here)[::-1]) == pytest.approx(turned, abs=1e-5)


def test_version_0_1(tmp_path: Path) -> None:
    scenario = stored(traffic_scenario(OLD, out=tmp_path / "old.toml"), tmp_path / "old.toml")
    own, first, second = scenario.ships.values()
    assert list(scenario.ships) == ["own", "target_1", "target_2"]
    assert own.start.position == [0.0, 0.0, 0.0]
    assert own.start.velocity[0] == pytest.approx(10 * KNOT, rel=1e-6)
    assert first.start.position[0] == pytest.approx(0.04 * 111385, abs=5.0)
    assert degrees(first.start.attitude[2]) == pytest.approx(185.0, abs=0.02)  # turned from 182 deg to its course
    assert first.start.velocity == pytest.approx([12.5 * KNOT, 0.0, 0.0], rel=1e-5)
    assert degrees(second.start.attitude[2]) == pytest.approx(109.5, abs=0.05)  # no heading: the course
    ships = scenario.load_ships()
    assert (ships["target_1"].L_oa, ships["target_1"].B) == (50.0, 10.0)
    assert ships["target_2"].kind == "Tanker"
    assert scenario.scenario.duration == pytest.approx(3007 / (10 * KNOT), rel=0.01)  # own's route


def test_version_0_2(tmp_path: Path) -> None:
    """No initial: the first waypoint, course and speed of the first leg; leg.data.sog before leg.sog."""
    scenario = stored(traffic_scenario(NEW, out=tmp_path / "new.toml"), tmp_path / "new.toml")
    own, target = scenario.ships.values()
    assert list(scenario.ships) == ["own", "target"]
    assert own.start.velocity[0] == pytest.approx(14.0 * KNOT, rel=1e-6)
    assert sin(own.start.attitude[2]) == pytest.approx(0.0, abs=1e-4)
    assert own.start.position[:2] == pytest.approx([50.0, 4.0], abs=0.01)  # midship is 50 m ahead of a = 140, b = 40
    assert hypot(*target.start.velocity) == pytest.approx(6.0 * KNOT, rel=1e-6)
    assert degrees(target.start.attitude[2]) == pytest.approx(345.4, abs=0.1)  # the first leg's, not the heading of 340
    assert target.start.velocity[1] == 0.0
    text = (tmp_path / "new.toml").read_text(encoding="utf-8")
    assert "bends of their routes are left out" in text
    assert "wind is not carried over" in text
    assert "keep their speeds: the speeds of later legs are left out" in text


def crossing(tmp_path: Path, heading: float) -> dict[str, Any]:
    """Summary of an import in which a coaster on the course 185 deg meets own ship, near its bow."""
    content = json.loads(OLD.read_text(encoding="utf-8"))
    target = content["targetShips"][0]
    target["initial"] |= {"position": {"lat": 58.765, "lon": 10.4904}, "heading": heading}
    content["targetShips"] = [target]
    path = tmp_path / "met.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    out = tmp_path / "met.toml"
    run = simulate(stored(traffic_scenario(path, out=out, duration=90.0, step=0.1), out), in_process=True)
    assert run.events["collisions"]
    return run.summary


@pytest.mark.one_in(2)
@pytest.mark.parametrize("heading", [182.0, 185.0])
def test_imported_ships_that_collide_gain_no_energy_from_coasting(tmp_path: Path, heading: float) -> None:
    """AIS gives a heading beside the course: what is lost in contact is all that is lost, and momentum stays."""
    summary = crossing(tmp_path, heading)
    energy, momentum = summary["energy"], summary["momentum"]
    before, after = energy["before"]["total"], energy["after"]["total"]
    assert energy["dissipated"] > 0.01 * before
    assert after + energy["dissipated"] == pytest.approx(before, rel=1e-9)
    assert momentum["closed"]
    np.testing.assert_allclose(momentum["after"]["linear"], momentum["before"]["linear"], rtol=1e-9, atol=1.0)


def test_a_ship_that_drifts_keeps_its_heading(tmp_path: Path) -> None:
    content = json.loads(OLD.read_text(encoding="utf-8"))
    content["targetShips"][0]["initial"] |= {"sog": 0.5, "heading": 95.0}
    path = tmp_path / "adrift.json"
    path.write_text(json.dumps(content), encoding="utf-8")
    scenario = stored(traffic_scenario(path, out=tmp_path / "adrift.toml"), tmp_path / "adrift.toml")
    assert degrees(scenario.ships["target_1"].start.attitude[2]) == pytest.approx(95.0, abs=0.02)
    assert scenario.ships["target_1"].start.velocity[1] == pytest.approx(0.5 * KNOT, rel=1e-3)


def test_what_is_left_out_is_told(tmp_path: Path) -> None:
    coasting = traffic_scenario(NEW, out=tmp_path / "x.toml").notes
    assert [note.split(":")[0] for note in coasting] == [
        "Not used",
        "The ships coast in water at rest", "The ships coast and keep their courses",
        "The ships coast and keep their speeds",
        "The file's wind is not carried over", "The file's current is not carried over",
    ]  # fmt: skip
    sailing = traffic_scenario(NEW, out=tmp_path / "x.toml", ship="kvlcc2", step=0.5, hydrodynamics=True).notes
    assert [note.split(":")[0] for note in sailing] == [
        "Not used",
        "Speeds of later legs",
        "turnRadius is not carried over",
    ]


def test_ships_by_name_sail_their_waypoints(tmp_path: Path) -> None:
    made = traffic_scenario(NEW, out=tmp_path / "new.toml", ship="kvlcc2", duration=60.0, step=0.5, hydrodynamics=True)
    assert made.ship_files == {}
    scenario = stored(made, tmp_path / "new.toml")
    own = scenario.ships["own"]
    assert own.route is not None
    assert len(own.route.waypoints) == 2
    assert own.orders[0].rev_per_s == pytest.approx(1.2268 * 14 * KNOT / 7.974, rel=1e-6)
    assert scenario.environment.current == pytest.approx([0.0, 1.0], abs=1e-9)
    assert scenario.environment.wind is not None
    assert (scenario.environment.wind.speed, scenario.environment.wind.from_deg) == (10.0, 180.0)
    run = simulate(scenario, in_process=True)
    assert run.states["own.position.north"][-1] > 400.0


def test_the_engine_is_ordered_for_the_speed_of_each_leg(tmp_path: Path) -> None:
    """14 kn for 3.3 km, then 9 kn; the trial's figures of revolutions."""
    made = traffic_scenario(
        NEW, out=tmp_path / "new.toml", ship="kvlcc2", duration=1500.0, step=0.5, hydrodynamics=True
    )
    first, second = stored(made, tmp_path / "new.toml").ships["own"].orders
    assert (first.time, first.rev_per_s) == (0.0, pytest.approx(1.2268 * 14 * KNOT / 7.974, rel=1e-6))
    assert second.time == pytest.approx(0.03 * 111399 / (14 * KNOT), rel=0.02)
    assert second.rev_per_s == pytest.approx(1.2268 * 9 * KNOT / 7.974, rel=1e-6)
    short = traffic_scenario(NEW, out=tmp_path / "new.toml", ship="kvlcc2", duration=60.0, step=0.5, hydrodynamics=True)
    assert "rev_per_s" in short.text
    assert len(stored(short, tmp_path / "new.toml").ships["own"].orders) == 1


def test_a_situation_inside_a_larger_document_is_found(tmp_path: Path) -> None:
    path = tmp_path / "output.json"
    path.write_text(json.dumps({"trafficSituation": json.loads(OLD.read_text())}), encoding="utf-8")
    assert "target_2" in traffic_scenario(path, out=tmp_path / "x.toml", ship="kvlcc2").text


Spoil = Callable[[dict[str, Any]], Any]


@pytest.mark.parametrize(
    ("spoil", "line"),
    [
        (lambda d: d.pop("ownShip"), r"s.json: is no traffic situation, it has no ownShip: give a file of trafficgen"),
        (lambda d: d.update(targetShips=[]), r"s.json: targetShips is empty: a collision needs a target"),
        (lambda d: d["ownShip"]["initial"].update(sog=6000), r"\[ownShip.*\] sog = 6000 must be .* 60: it is .* knots"),
        (lambda d: d["ownShip"]["initial"].update(sog="ten"), r"sog = 'ten' must be a number"),
        (lambda d: d["ownShip"]["initial"].update(sog=None), r"s.json: own has no speed: give initial.sog, or sog in"),
        (lambda d: d["ownShip"]["initial"].update(cog=1234), r"cog = 1234 must be .* 360: it is clockwise"),
        (lambda d: d["ownShip"]["initial"]["position"].update(latitude=5876), r"5876 must be less than or equal to 85"),
        (lambda d: d["ownShip"]["initial"].pop("position"), None),  # the first waypoint will do
        (lambda d: d["targetShips"][1]["initial"].pop("position"), r"target_2 has no position: give initial.position"),
        (lambda d: d["targetShips"][1]["initial"].pop("cog"), r"target_2 has no course: give initial.cog, or two wayp"),
        (lambda d: d["targetShips"][1]["static"].pop("width"), r"target_2 has no width: name a ship with --ship"),
        (lambda d: d["targetShips"][1]["static"].update(initDelay=15.0), r"target_2 initDelay = 15 s is not offered"),
        (lambda d: d["targetShips"][0]["initial"]["position"].update(lon=20.5), r"target_1 is \d+ km from own ship"),
        (lambda d: d["targetShips"][0]["initial"].update(position=d["ownShip"]["initial"]["position"]),
         r"s.json: does not make a scenario: .*position = .* is also that of own"),
        (lambda d: d["targetShips"][0]["static"].update(width=80.0), r"s.json: target_1 is wider than long"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_refused_in_one_line(tmp_path: Path, spoil: Spoil, line: str | None) -> None:
    data = json.loads(OLD.read_text(encoding="utf-8"))
    spoil(data)
    path = tmp_path / "s.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    if line is None:
        traffic_scenario(path, out=tmp_path / "x.toml")
        return
    with pytest.raises(ScenarioError, match=line) as refused:
        traffic_scenario(path, out=tmp_path / "x.toml")
    assert "\n" not in str(refused.value)
    assert [p.name for p in tmp_path.iterdir()] == ["s.json"]


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"{", r"s.json: is not valid JSON: .* line 1 column 2"), (b"[1, 2]", r"is no traffic situation"),
        (b"\xff\xfe{}", r"s.json: is not UTF-8 text \(byte 0\): save it as UTF-8"), (b"", r"is not valid JSON"),
        (b'{"ownShip": {"initial": {"sog": NaN}}}', r"sog = nan must be a finite number"),
        (b'{"ownShip": 3}', r"\[ownShip\] = 3 must be"),
    ],
)  # fmt: skip
def test_malformed_files_are_refused_in_one_line(tmp_path: Path, content: bytes, line: str) -> None:
    path = tmp_path / "s.json"
    path.write_bytes(content)
    with pytest.raises(ScenarioError, match=line) as refused:
        traffic_scenario(path)
    assert "\n" not in str(refused.value)


def test_a_file_that_is_not_there_is_refused() -> None:
    with pytest.raises(
        ScenarioError, match=r"nowhere.json cannot be read: No such file or directory: give the path of"
    ):
        traffic_scenario("nowhere.json")


def faster(target: float, top: float | None, folder: Path) -> Path:
    """The first file, in which a ship of 50 m goes `target` [kn]; `top` is its largest speed [kn]."""
    data = json.loads(OLD.read_text(encoding="utf-8"))
    data["targetShips"][0]["initial"] |= {"sog": target, "heading": 185.0}
    if top is not None:
        data["targetShips"][0]["static"]["sogMax"] = top
    path = folder / "f.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    return path


def test_dimensions_alone_sail_by_estimate(tmp_path: Path) -> None:
    """Ships at 10 kn: their revolutions keep their speed."""
    out = tmp_path / "f.toml"
    made = traffic_scenario(faster(10.0, None, tmp_path), out=out, duration=100.0, step=1.0, hydrodynamics=True)
    scenario = stored(made, out)
    assert all(ship.hydrodynamics for ship in scenario.ships.values())
    run = simulate(scenario, in_process=True)
    assert run.states["own.velocity.surge"][-1] == pytest.approx(10.0 * KNOT, rel=0.01)
    assert run.states["target_1.velocity.surge"][-1] == pytest.approx(10.0 * KNOT, rel=0.01)


def test_an_engine_that_does_not_suffice_is_told_and_the_remedies_help(tmp_path: Path) -> None:
    """12.5 kn; a cargo ship of 50 m is estimated to make 11.2 kn at most, and 13 kn where the file says so."""
    out = tmp_path / "f.toml"
    with pytest.raises(ScenarioError) as refused:
        traffic_scenario(faster(12.5, None, tmp_path), out=out, hydrodynamics=True)
    assert str(refused.value) == (
        "f.json: target_1 goes 6.43 m/s, its engine, estimated from length, type and largest speed, gives 5.77 m/s: "
        "state static.sogMax in knots, name a ship with --ship, or leave out --hydrodynamics"
    )
    path = faster(12.5, 13.0, tmp_path)
    made = traffic_scenario(path, out=out, hydrodynamics=True)
    ship = stored(made, out).load_ships()["target_1"]
    assert ship.engine is not None
    assert ship.propeller is not None
    assert ship.propeller.service_speed is not None
    assert ship.propeller.service_rev_per_s is not None
    reach = ship.propeller.service_speed * ship.engine.max_rev_per_s / ship.propeller.service_rev_per_s
    assert reach == pytest.approx(13.0 * KNOT, rel=1e-3)
    assert traffic_scenario(path, out=out, ship="kcs", hydrodynamics=True).ship_files == {}
    assert traffic_scenario(faster(12.5, None, tmp_path), out=out).ship_files


def test_named_ships_that_only_coast_do_not_sail(tmp_path: Path) -> None:
    with pytest.raises(
        ScenarioError, match=r"ship 'guan2014_own' can only coast, it has no \[manoeuvring\]: leave out"
    ):
        traffic_scenario(OLD, out=tmp_path / "x.toml", ship="guan2014_own", hydrodynamics=True)
