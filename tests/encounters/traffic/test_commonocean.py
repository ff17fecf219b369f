"""CommonOcean scenarios in XML: axes, angles and units; what is read, named, or refused by its name."""

from __future__ import annotations

import re
from itertools import pairwise
from math import atan2, cos, degrees, pi, sin
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.encounters.traffic.situation import TrafficScenario, traffic_scenario
from shipcollision_fmu.encounters.traffic.thinning import thin_track
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.scenario import Scenario

REAL = Path(__file__).parent / "situations" / "commonocean_io_2025_1.xml"
"""Written by commonocean-io 2025.1, which keeps four digits of an angle: 0.5235 for 30 deg."""


def stored(made: TrafficScenario, out: Path) -> Scenario:
    for name, text in {**made.ship_files, out.name: made.text}.items():
        (out.parent / name).write_text(text, encoding="utf-8")
    return load_scenario(out)


def imported(text: str, folder: Path, **options: object) -> tuple[Scenario, TrafficScenario]:
    (folder / "s.xml").write_text(text, encoding="utf-8")
    made = traffic_scenario(folder / "s.xml", out=folder / "s.toml", **options)  # type: ignore[arg-type]  # of one test
    return stored(made, folder / "s.toml"), made


def test_the_file_of_its_own_writer(tmp_path: Path) -> None:
    """Own ship at (100, -200) to the north at 6 m/s; a ship that goes west, one that turns from north to east.

    Expected by hand from the script that wrote it. The three corners of the land are those that the library itself
    gives for time 0: (1943.98, -1127.52), (2052.21, -914.94), (2203.81, -977.54).
    """
    made = traffic_scenario(REAL, out=tmp_path / "r.toml", own="kcs", step=0.5)
    scenario = stored(made, tmp_path / "r.toml")
    own, west, turning = scenario.ships.values()
    assert (own.start.position, own.start.velocity) == ([0.0, 0.0, 0.0], [6.0, 0.0, 0.0])
    assert degrees(own.start.attitude[2]) == pytest.approx(0.0, abs=0.01)
    assert west.start.position == [1100.0, 1400.0, 0.0]
    assert degrees(west.start.attitude[2]) == pytest.approx(270.0, abs=0.01)
    assert west.start.velocity == [5.0, 0.0, 0.0]
    assert turning.start.position == [-300.0, -900.0, 0.0]
    ships = scenario.load_ships()
    assert (ships["target_1"].L_oa, ships["target_1"].B, ships["target_1"].kind) == (120.0, 20.0, "cargoship")
    assert (ships["target_2"].L_oa, ships["target_2"].B, ships["target_2"].kind) == (60.0, 12.0, "fishingvessel")
    assert scenario.scenario.duration == 600.0  # the goal's 60 steps of 10 s
    buoy, land, anchored = scenario.obstacles.values()
    assert (buoy.position, buoy.diameter, buoy.bottom) == ([600.0, 200.0], 4.0, None)
    assert (anchored.length, anchored.breadth, anchored.bottom) == (100.0, 18.0, 15.0)
    assert (anchored.position, anchored.heading_deg) == ([1700.0, 500.0], pytest.approx(60.0, abs=0.01))
    assert land.points is not None
    corners = sorted([land.position[1] + e + 100.0, land.position[0] + n - 200.0] for n, e in land.points)
    assert corners[0] == pytest.approx([1943.98, -1127.52], abs=0.01)
    assert corners[1] == pytest.approx([2052.21, -914.94], abs=0.01)
    assert corners[2] == pytest.approx([2203.81, -977.54], abs=0.01)


def test_what_is_not_used_is_named(tmp_path: Path) -> None:
    made = traffic_scenario(REAL, out=tmp_path / "r.toml", own="kcs", step=0.5)
    assert made.notes == (
        "The depth of dynamic obstacles is not used: draughts are estimated from the width.",
        "Static obstacles are fixed, of type anchoredvessel and buoy as well.",
        "Not used: location, navigationableArea, shallow.",
        "The ships coast and keep their courses: bends of their routes are left out.",
        "The ships coast and keep their speeds: the speeds of later legs are left out.",
    )
    assert "CommonOcean 2022a" in made.text


def test_ships_sail_along_trajectories_by_estimate(tmp_path: Path) -> None:
    made = traffic_scenario(REAL, out=tmp_path / "r.toml", own="kcs", step=4.0, duration=400.0, hydrodynamics=True)
    scenario = stored(made, tmp_path / "r.toml")
    routes = {name: ship.route.waypoints for name, ship in scenario.ships.items() if ship.route is not None}
    assert routes == {
        "own": [[2200.0, -100.0]],
        "target_1": [[1100.0, -100.0]],
        "target_2": [[500.0, -900.0], [500.0, 300.0]],
    }
    assert [order.time for order in scenario.ships["target_2"].orders] == [0.0, 200.0]
    run = simulate(scenario, in_process=True)
    north, east, yaw = (
        run.states[f"target_2.{key}"][-1] for key in ("position.north", "position.east", "attitude.yaw")
    )
    # it has left the corner at (500, -900) for the point (500, 300); at 4 to 6 m/s it is between
    assert (north, degrees(yaw)) == (pytest.approx(500.0, abs=40.0), pytest.approx(90.0, abs=10.0))
    assert -900.0 + 4.0 * 170.0 < east < 300.0


def scene(
    ships: str = "", obstacles: str = "", own: str = "", root: str = 'commonOceanVersion="2022a" timeStepSize="2.0"'
) -> str:
    """A file with own ship at (0, 0), a rectangle of 60 m x 10 m, that goes east; `own` stands for its state."""
    state = own or "<orientation><exact>0.0</exact></orientation><velocity><exact>5.0</exact></velocity>"
    return (
        f"<?xml version='1.0' encoding='UTF-8'?>\n<commonOcean {root}>{obstacles}"
        f"{vessel(1, 0.0, 0.0, state)}{ships}</commonOcean>"
    )


def vessel(number: int, x: float, y: float, state: str, shape: str = "", more: str = "") -> str:
    form = shape or "<rectangle><length>60.0</length><width>10.0</width></rectangle>"
    return (
        f'<dynamicObstacle id="{number}"><type>motorvessel</type><shape>{form}</shape><initialState>{point(x, y)}'
        f"{state}<time><exact>0</exact></time></initialState>{more}</dynamicObstacle>"
    )


def point(x: float, y: float) -> str:
    return f"<position><point><x>{x}</x><y>{y}</y></point></position>"


def exactly(**values: float) -> str:
    return "".join(f"<{key}><exact>{value}</exact></{key}>" for key, value in values.items())


def test_orientation_is_anticlockwise_from_east(tmp_path: Path) -> None:
    """A ship that is turned by 30 deg goes (cos 30, sin 30) in x, y: it drifts to port and turns to port.

    x' = u cos psi - v sin psi, y' = u sin psi + v cos psi: the project's own model of three degrees of freedom.
    """
    psi, u, v, r = pi / 6.0, 5.0, 3.0, 0.01
    other = vessel(2, 1000.0, 500.0, exactly(orientation=psi, velocity=u, velocityY=v, yawRate=r))
    scenario, _ = imported(scene(other), tmp_path)
    start = scenario.ships["target"].start
    heading = start.attitude[2]
    assert start.position == [500.0, 1000.0, 0.0]
    assert degrees(heading) == pytest.approx(60.0, abs=1e-5)
    north = start.velocity[0] * cos(heading) - start.velocity[1] * sin(heading)
    east = start.velocity[0] * sin(heading) + start.velocity[1] * cos(heading)
    assert (east, north) == pytest.approx((u * cos(psi) - v * sin(psi), u * sin(psi) + v * cos(psi)), abs=1e-5)
    assert start.rate == [0.0, 0.0, -r]


def test_a_point_mass_has_its_velocity_in_x_and_y(tmp_path: Path) -> None:
    scenario, _ = imported(scene(vessel(2, 1000.0, 0.0, exactly(velocity=-3.0, velocityY=4.0))), tmp_path)
    start = scenario.ships["target"].start
    assert start.velocity == pytest.approx([5.0, 0.0, 0.0], abs=1e-6)
    assert start.attitude[2] == pytest.approx(atan2(-3.0, 4.0) % (2.0 * pi), abs=1e-6)  # north 4, east -3


def test_a_speed_that_is_missing_is_that_of_the_trajectory(tmp_path: Path) -> None:
    """12 m in 3 steps of 2 s."""
    track = f"<trajectory><state>{point(1012.0, 0.0)}{exactly(time=3)}</state></trajectory>"
    other = vessel(2, 1000.0, 0.0, exactly(orientation=0.0), more=track)
    scenario, _ = imported(scene(other), tmp_path)
    assert scenario.ships["target"].start.velocity == pytest.approx([2.0, 0.0, 0.0], abs=1e-6)
    assert scenario.scenario.duration == 6.0


def test_an_interval_is_replaced_by_its_middle(tmp_path: Path) -> None:
    state = (
        exactly(orientation=0.0)
        + "<velocity><intervalStart>2.0</intervalStart><intervalEnd>4.0</intervalEnd></velocity>"
    )
    scenario, made = imported(scene(vessel(2, 1000.0, 0.0, state)), tmp_path)
    assert scenario.ships["target"].start.velocity[0] == pytest.approx(3.0, abs=1e-6)
    assert "Intervals in initial states are replaced by their middles." in made.notes


def test_own_ship_and_an_obstacle_are_enough(tmp_path: Path) -> None:
    """A quay in its way, in a shape that has its own middle and turn; several shapes are several obstacles."""
    wall = (
        '<staticObstacle id="7"><type>land</type><depth>inf</depth><shape><rectangle><length>200.0</length><width>20.0'
        "</width><orientation>1.5707963267948966</orientation><center><x>10.0</x><y>0.0</y></center></rectangle>"
        f"<circle><radius>5.0</radius></circle></shape><initialState>{point(90.0, 0.0)}{exactly(orientation=0.0)}"
        "</initialState></staticObstacle>"
    )
    scenario, made = imported(scene(obstacles=wall), tmp_path, duration=20.0, step=0.1)
    assert list(scenario.obstacles) == ["land_7_1", "land_7_2"]
    assert scenario.obstacles["land_7_1"].position == [0.0, 100.0]
    assert scenario.obstacles["land_7_1"].heading_deg == pytest.approx(0.0, abs=1e-6)
    assert any("No planning problem" in note for note in made.notes)
    run = simulate(scenario, in_process=True)
    # 5 m/s from 30 m of half a length to the cylinder's side at 85 m
    assert run.events["collisions"][0]["start"] == pytest.approx((85.0 - 30.0) / 5.0, abs=0.15)


TRIANGLE = "<polygon>" + "".join(f"<point><x>{x}</x><y>{y}</y></point>" for x, y in ((-30, -5), (30, 0), (-30, 5)))


def test_a_polygon_gives_a_ship_its_box(tmp_path: Path) -> None:
    other = vessel(2, 1000.0, 0.0, exactly(orientation=0.0, velocity=0.0), TRIANGLE + "</polygon>")
    ship = imported(scene(other), tmp_path)[0].load_ships()["target"]
    assert (ship.L_oa, ship.B) == (60.0, 10.0)


def test_midship_is_the_middle_of_a_polygon_s_box(tmp_path: Path) -> None:
    """A ship from x = 0 to 60 about its position, turned by 90 deg about its centroid at x = 20."""
    corners = "".join(f"<point><x>{x}</x><y>{y}</y></point>" for x, y in ((0, -5), (60, 0), (0, 5)))
    other = vessel(2, 1000.0, 0.0, exactly(orientation=pi / 2, velocity=0.0), f"<polygon>{corners}</polygon>")
    assert imported(scene(other), tmp_path)[0].ships["target"].start.position == [10.0, 1020.0, 0.0]


@pytest.mark.parametrize(
    ("content", "line"),
    [
        ("<commonRoad/>", r"s.xml: is a CommonRoad scenario, of road vehicles: give a CommonOcean scenario, or a traf"),
        ("<route/>", r"s.xml: is a route \(RTZ\) of one ship: give a CommonOcean"),
        ("<kml/>", r"s.xml: is no traffic, its root element is <kml>: give a CommonOcean scenario"),
        ("<commonOcean>", r"s.xml: is not valid XML: no element found: line 1"),
        ("", r"s.xml: is not valid XML: no element found"),
        ("{}", r"s.xml: is not valid XML: not well-formed"),
        ("<a>" * 50, r"s.xml: elements are nested more than 40 deep: give a CommonOcean scenario"),
        ('<!DOCTYPE commonOcean SYSTEM "file:///etc/passwd"><commonOcean/>', r"s.xml: has a document type declaration"),
        ("<commonOcean/>", r"s.xml: \[timeStepSize\] is missing: give the length of a time step in seconds"),
        (scene(root='timeStepSize="0.0"'), r"s.xml: \[timeStepSize\] = '0.0' must be greater than 0: it is the length"),
        (scene(), r"s.xml: has 1 ship and 0 staticObstacle: a collision needs a planningProblem or dynamicObst"),
        (scene(vessel(1, 900.0, 0.0, exactly(orientation=0.0, velocity=1.0))),
         r"s.xml: dynamicObstacle 1 has the id of a dynamicObstacle: give each its own"),
        (scene(vessel(2, 900.0, 0.0, exactly(velocity=1.0))),
         r"s.xml: dynamicObstacle 2 has no orientation in its initialState: give it in radians"),
        (scene(vessel(2, 900.0, 0.0, exactly(orientation=0.0))),
         r"s.xml: dynamicObstacle 2 has no velocity in its initialState: give it in m/s"),
        (scene(vessel(2, 9e5, 0.0, exactly(orientation=0.0, velocity=1.0))),
         r"s.xml: target is 900 km from own ship, at most 100: check its position"),
        (scene(vessel(2, 900.0, 0.0, exactly(orientation=0.0, velocity=1.0)).replace("60.0", "long")),
         r"length = 'long' must be a number"),
        (scene(vessel(2, 900.0, 0.0, exactly(orientation=0.0, velocity=1.0)).replace("900.0", "nan")),
         r"x = 'nan' must be a finite number"),
        (scene(vessel(2, 20.0, 0.0, exactly(orientation=0.0, velocity=1.0))),
         r"s.xml: does not make a scenario: .*\[ships.own\] and \[ships.target\] overlap"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_refused_in_one_line(tmp_path: Path, content: str, line: str) -> None:
    with pytest.raises(ScenarioError, match=line) as refused:
        imported(content, tmp_path)
    assert "\n" not in str(refused.value)
    assert [p.name for p in tmp_path.iterdir()] == ["s.xml"]


def test_entities_are_not_expanded(tmp_path: Path) -> None:
    """A billion laughs: 10^9 characters from 500."""
    levels = "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10))
    text = f'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a0 "ha">{levels}]><commonOcean>&a9;</commonOcean>'
    with pytest.raises(ScenarioError) as refused:
        imported(text, tmp_path)
    assert str(refused.value) == "s.xml: has a document type declaration (<!DOCTYPE>), which is not read: remove it"
    cured = scene(vessel(2, 900.0, 0.0, exactly(orientation=0.0, velocity=1.0)))
    assert "target" in imported(cured, tmp_path)[0].ships


def test_own_ship_of_a_planning_problem_has_no_size_and_the_remedy_helps(tmp_path: Path) -> None:
    text = REAL.read_text(encoding="utf-8")
    with pytest.raises(ScenarioError, match=r"s.xml: own has no length and width: name a ship with --own or --ship$"):
        imported(text, tmp_path)
    for remedy in ({"own": "kcs"}, {"ship": "kcs"}):
        assert "own" in imported(text, tmp_path, **remedy)[0].ships


def test_a_round_ship_has_no_size_and_the_remedy_helps(tmp_path: Path) -> None:
    other = vessel(2, 900.0, 0.0, exactly(orientation=0.0, velocity=1.0), "<circle><radius>9.0</radius></circle>")
    with pytest.raises(ScenarioError, match=r"s.xml: target has no length and width: name a ship with --ship$"):
        imported(scene(other), tmp_path)
    assert "target" in imported(scene(other), tmp_path, ship="kcs")[0].ships


def test_land_that_is_not_convex_is_refused_and_the_remedy_helps(tmp_path: Path) -> None:
    def land(number: int, *corners: tuple[float, float]) -> str:
        points = "".join(f"<point><x>{x}</x><y>{y}</y></point>" for x, y in corners)
        return (
            f'<staticObstacle id="{number}"><type>land</type><shape><polygon>{points}</polygon></shape><initialState>'
            f"{point(900.0, 0.0)}{exactly(orientation=0.0)}</initialState></staticObstacle>"
        )

    bay = land(7, (0, 0), (200, 0), (200, 200), (100, 20), (0, 200))
    with pytest.raises(ScenarioError, match=r"\[obstacles.land_7\].* convex polygon: .* make several obstacles of it"):
        imported(scene(obstacles=bay), tmp_path)
    cut = (
        land(7, (0, 0), (100, 20), (0, 200)),
        land(8, (0, 0), (200, 0), (100, 20)),
        land(9, (200, 0), (200, 200), (100, 20)),
    )
    assert list(imported(scene(obstacles="".join(cut)), tmp_path)[0].obstacles) == ["land_7", "land_8", "land_9"]


def test_a_trajectory_is_thinned_to_its_corners() -> None:
    straight = [(10.0 * k, 0.0) for k in range(11)]
    bent = [*straight, *((100.0, 10.0 * k) for k in range(1, 11))]
    assert thin_track(straight, 2.0, 5.0) == [0, 10]
    assert thin_track(bent, 2.0, 5.0) == [0, 10, 20]
    assert thin_track([(0.0, 0.0)], 2.0, 5.0) == [0]
    assert thin_track([(0.0, 0.0), (1.0, 0.0), (60.0, 0.0)], 2.0, 50.0) == [0, 2]
    circle = [(100.0 * cos(a / 50.0), 100.0 * sin(a / 50.0)) for a in range(300)]
    kept = thin_track(circle, 2.0, 5.0)
    # a chord whose arc is 2 m high spans 2 acos(1 - 2/100) = 0.4 rad, 20 points; halving stops between half and all
    assert max(b - a for a, b in pairwise(kept)) <= 20


def test_the_file_is_read_by_its_content_too(tmp_path: Path) -> None:
    (tmp_path / "s.txt").write_bytes(b"\xef\xbb\xbf" + REAL.read_bytes())
    assert re.search(r"CommonOcean 2022a", traffic_scenario(tmp_path / "s.txt", own="kcs").text)
