"""Scenario files: what they mean, and what is refused in one line."""

from __future__ import annotations

import re
from math import pi, radians, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import simulate
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.scenario.order_schedule import schedule_orders
from shipcollision_fmu.scenario.scenario import list_scenario_names, load_scenario
from shipcollision_fmu.scenario.tables.header import Header
from shipcollision_fmu.scenario.tables.orders import Order
from shipcollision_fmu.scenario.tables.ship_start import ShipStart
from shipcollision_fmu.ship.frames import rotation
from tests.conftest import Write

OWN = 'ship = "./barge.toml"\nposition = [5.0, -64.0]'
MANOEUVRES = (OWN, 'ship = "kvlcc2"\nhydrodynamics = true\nposition = [5.0, -640.0]')


def start(**given: object) -> ShipStart:
    return ShipStart.model_validate({"ship": "kvlcc2", "position": [1, 2], "heading_deg": 30} | given)


def test_a_scenario_is_what_its_file_says(scenario_file: Write) -> None:
    scenario = load_scenario(scenario_file())
    assert (scenario.name, scenario.step, scenario.steps, scenario.algorithm) == ("encounter", 0.05, 60, "gauss-seidel")
    assert list(scenario.ships) == ["own", "target"]
    own = scenario.ships["own"].start
    assert own.position == [5.0, -64.0, 0.0]
    assert own.attitude == [0.0, 0.0, pi / 2]
    assert own.velocity == [4.0, 0.0, 0.0]
    assert own.rate == [0.0, 0.0, 0.0]
    assert scenario.collision.friction == 0.3
    assert scenario.collision.restitution is None


def test_a_path_of_a_ship_is_relative_to_the_scenario(scenario_file: Write, monkeypatch: pytest.MonkeyPatch) -> None:
    path = scenario_file()
    monkeypatch.chdir("/")
    assert load_scenario(path).ship_file("own") == str(path.parent / "barge.toml")


def test_steps_are_counted_in_whole_numbers() -> None:
    """0.1 s three times is not 0.3 s in floats, and 5.1/0.05 is not 102; both are whole numbers of steps."""
    for duration, step, steps in ((0.3, 0.1, 3), (5.1, 0.05, 102), (120.0, 0.05, 2400), (5.0, 1 / 60, 300)):
        assert Header(name="x", duration=duration, step=step).steps == steps


def test_velocity_in_n_is_turned_into_b() -> None:
    given = start(attitude_deg=[5.0, -3.0], velocity_ned=[1.0, 2.0, 0.5], angular_velocity_ned=[0.01, 0.02, 0.03])
    R_nb = rotation(given.start.attitude)
    np.testing.assert_allclose(R_nb @ given.start.velocity, [1.0, 2.0, 0.5], rtol=1e-14)
    np.testing.assert_allclose(R_nb @ given.start.rate, [0.01, 0.02, 0.03], rtol=1e-14)


def test_a_quaternion_is_an_attitude() -> None:
    """(x, y, z, w) of a turn to starboard by 90 deg is about the down axis."""
    given = ShipStart(ship="x", position=[0, 0], quaternion=[0.0, 0.0, sqrt(0.5), sqrt(0.5)])
    np.testing.assert_allclose(given.start.attitude, [0.0, 0.0, pi / 2], atol=1e-15)


def test_speed_may_be_given_by_component() -> None:
    assert start(surge=3.0, sway=-0.5, heave=0.1).start.velocity == [3.0, -0.5, 0.1]
    assert start(surge=3.0, rates=[0.0, 0.0, 0.01]).start.rate == [0.0, 0.0, 0.01]
    assert start(position=[1, 2, 3]).start.position == [1.0, 2.0, 3.0]


def test_ships_move_in_the_plane_unless_told() -> None:
    assert start().free == start(hydrodynamics=True).free == start(coasting="straight").free == 3
    assert start(hydrodynamics=True, degrees_of_freedom=4).free == 4


@pytest.mark.parametrize(
    ("keys", "sails", "law", "predicted"),
    [
        ("", True, "kirchhoff", "straight"),
        ("hydrodynamics = false", False, "kirchhoff", "kirchhoff"),
        ('coasting = "free"', False, "free", "free"),
        ('coasting = "straight"\nhydrodynamics = false', False, "straight", "straight"),
    ],
)
def test_a_ship_with_manoeuvring_data_sails_unless_told(
    scenario_file: Write, keys: str, sails: bool, law: str, predicted: str
) -> None:
    scenario = load_scenario(scenario_file((OWN, f'ship = "kvlcc2"\n{keys}\nposition = [5.0, -640.0]')))
    own = scenario.ships["own"]
    assert (bool(own.hydrodynamics), own.law, own.predicted_law) == (sails, law, predicted)
    others = [ship for name, ship in scenario.ships.items() if name != "own"]
    assert not any(ship.hydrodynamics for ship in others)  # barges
    assert scenario.changed(step=0.1).ships["own"] == own


def test_an_order_is_given_at_the_first_communication_point_from_its_time() -> None:
    """0.3 s is 6 steps of 0.05 s, though 0.3/0.05 is not 6 in floats; 0.31 s waits for the next point."""
    orders = [Order(time=0.0, rev_per_s=1.5), Order(time=0.3, rudder_deg=20.0), Order(time=0.31, rudder_deg=-20.0)]
    ship = ShipStart(ship="x", position=[0, 0], heading_deg=0, hydrodynamics=True, orders=orders)
    assert schedule_orders(ship, 0.05) == [(0, [0.0, 1.5]), (6, [radians(20), 1.5]), (7, [radians(-20), 1.5])]


def test_of_orders_on_one_communication_point_the_last_counts() -> None:
    orders = [Order(time=0.01, rudder_deg=10.0), Order(time=0.02, rudder_deg=20.0)]
    ship = ShipStart(ship="x", position=[0, 0], heading_deg=0, hydrodynamics=True, orders=orders)
    assert schedule_orders(ship, 0.05) == [(1, [radians(20), 0.0])]


def test_a_current_may_have_a_speed_and_a_direction(scenario_file: Write) -> None:
    added = "\n[environment]\ncurrent = {speed = 2.0, towards_deg = 90.0}\n"
    scenario = load_scenario(scenario_file(MANOEUVRES, added=added))
    np.testing.assert_allclose(scenario.environment.current, [0.0, 2.0], atol=1e-15)


def test_options_change_a_scenario(scenario_file: Write) -> None:
    scenario = load_scenario(scenario_file())
    changed = scenario.changed(algorithm="jacobi", step=0.1)
    assert (changed.algorithm, changed.step, changed.steps) == ("jacobi", 0.1, 30)
    assert scenario.step == 0.05
    assert changed.ship_file("own") == scenario.ship_file("own")
    assert scenario.changed() is scenario


def test_every_shipped_scenario_can_be_loaded() -> None:
    assert "guan2014" in list_scenario_names()
    for name in list_scenario_names():
        assert load_scenario(name).name == name


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("step = 0.05", "step = 0.0", r"\[scenario\] step = 0.0 must be greater than 0: it is the communication step"),
        ("step = 0.05", "step = -0.05", r"\[scenario\] step = -0.05 must be greater than 0"),
        ("step = 0.05", "step = nan", r"\[scenario\] step = nan must be a finite number"),
        ("step = 0.05", "step = inf", r"\[scenario\] step = inf must be a finite number"),
        ("step = 0.05", 'step = "fast"', r"\[scenario\] step = 'fast' must be a number"),
        ("step = 0.05", "step = 0.07", r"duration = 3 s is 42.8571 steps of 0.07 s, .* take duration = 2.94 or 3.01"),
        ("step = 0.05", "step = 10.0", r"duration = 3 s is 0.3 steps of 10 s, .* take duration = 10, or a step"),
        ("step = 0.05", "step = 1e-7", r"step = 1e-07 s makes 3e\+07 steps of 3 s, the limit is 1000000: take a"),
        ("duration = 3.0", "duration = -3.0", r"\[scenario\] duration = -3.0 must be greater than 0"),
        ("duration = 3.0", "", r"\[scenario\] duration is missing: give a whole number of steps"),
        ("duration = 3.0", "durration = 3.0", r"\[scenario\] durration is not a known key: did you mean duration\?"),
        ('"encounter"', '"../up"', r"\[scenario\] name = '../up' cannot name a folder: take letters"),
        ("step = 0.05", 'algorithm = "gauss"', r"algorithm = 'gauss' must be 'gauss-seidel' or 'jacobi'"),
        ('ship = "./barge.toml"', 'ship = "kvlc2"', r"^encounter.toml: \[ships.own\] unknown ship 'kvlc2': did you"),
        ('ship = "./barge.toml"', 'ship = "./brig.toml"', r"\[ships.own\] ship file .*/brig.toml does not"),
        (
            'ship = "./barge.toml"',
            'ship = "./brig.toml"\norders = [{time = 0.0, rudder_deg = 5.0}]',
            r"^encounter.toml: \[ships.own\] ship file .*/brig.toml does not",
        ),
        ("heading_deg = 90.0", "heading = 90.0", r"\[ships.own\] heading is not a known key: did you mean heading_deg"),
        ("heading_deg = 90.0", "", r"\[ships.own\] heading_deg is missing: clockwise from north"),
        ("speed = 4.0", "speed = 400.0", r"\[ships.own\] moves at 400 m/s, the limit is 50: give metres per second"),
        ("speed = 4.0", "speed = nan", r"\[ships.own\] speed = nan must be a finite number"),
        ("speed = 4.0", "speed = 4.0\nsway = 1.0", r"\[ships.own\] gives both speed and sway: keep one"),
        ("speed = 4.0", "rates = [0.0, 0.0, 3.0]", r"\[ships.own\] turns at 3 rad/s, the limit is 1: give radians"),
        ("speed = 4.0", "rates = [0.0, 3.0]", r"rates = \[0.0, 3.0\] must have at least 3 values, it has 2"),
        ("speed = 4.0", "quaternion = [0.0, 0.0, 0.0, 1.0]", r"\[ships.own\] gives both quaternion and heading_deg"),
        ("speed = 4.0", "attitude_deg = [95.0, 0.0]", r"\[ships.own\] attitude_deg = \[95.0, 0.0\] must be within 90"),
        ("heading_deg = 90.0", "quaternion = [0.0, 0.0, 0.0, 2.0]", r"quaternion has length 2, must be 1 within"),
        ("speed = 4.0", "hydrodynamics = true", r"\[ships.own\] ship = .* can only coast, it has no table"),
        ("speed = 4.0", "orders = [{time = 0.0, rudder_deg = 5.0}]", r"\[ships.own\] has orders, but coasts: set"),
        ("speed = 4.0", "orders = [{time = 0.0}]", r"\[ships.own.orders.0\] orders nothing: give rudder_deg or"),
        ("speed = 4.0", "orders = [{time = -1.0, rudder_deg = 5.0}]", r"\[ships.own\] orders\[0\].time = -1.0 must be"),
        ("speed = 4.0", "degrees_of_freedom = 5", r"\[ships.own\] degrees_of_freedom = 5 must be 3, 4 or 6"),
        ("position = [5.0, -64.0]", "position = [0.0, 0.0]", r"\[ships.target\] position = .* is also that of own"),
        ("position = [5.0, -64.0]", "position = [0.0]", r"position = \[0.0\] must have at least 2 values, it has 1"),
        ("[ships.own]", '[ships."own ship"]', r"\[ships.own ship\] is no name for a ship, .* take letters"),
        ("[ships.own]", "[ships.contact]", r"\[ships.contact\] is no name for a ship, since .* have it: take"),
        ("friction = 0.3", "friction = -0.3", r"\[collision\] friction = -0.3 must be greater than or equal to 0"),
        ("friction = 0.3", "friction = 10.5", r"\[collision\] friction = 10.5 must be less than or equal to 10"),
        ("friction = 0.3", "restitution = 1.5", r"\[collision\] restitution = 1.5 must be less than or equal to 1"),
        ("friction = 0.3", 'response = "psg"', r"\[collision\] response = 'psg' is not offered: take one of .*pgs"),
        ("friction = 0.3", 'feedback = "state"', r'\[collision\] feedback = "state" needs ships that adopt post'),
        ("friction = 0.3", "[environment]\nwind = 10.0", r"\[environment\] wind = 10.0 .*: it is the wind, {speed = "),
        ("friction = 0.3", "[environment]\nwind = {speed = 10.0}", r"\[environment.wind\] from_deg is missing: give "),
        ("friction = 0.3", "[environment]\nwind = {speed = 99.0, from_deg = 0.0}", r"speed = 99.0 must be less than"),
        ("friction = 0.3", "[environment]\nwind = {speed = 9.0, from_deg = 0.0}", r"\] wind acts on no ship: set"),
        ("friction = 0.3", "[environment]\ncurrent = [1.0, 0.0]", r"\[environment\] current acts on no ship: set"),
        ("friction = 0.3", "[environment]\ncurrent = [99.0, 0.0]", r"runs faster than the limit of 10 m/s"),
        ("friction = 0.3", "[environment]\ncurrent = {speed = 1.0}", r"\[environment\] current = .* must be two"),
        ("friction = 0.3", "[waves]\nheight = 1.0", r"\[waves\] is not a known key: .*known: scenario, ships, col"),
        ("friction = 0.3", "friction = ", r"encounter.toml: is not valid TOML: .* line"),
    ],
)  # fmt: skip
def test_what_cannot_be_run_is_refused_in_one_line(scenario_file: Write, old: str, new: str, line: str) -> None:
    with pytest.raises(ScenarioError, match=line) as refused:
        load_scenario(scenario_file((old, new)))
    assert str(refused.value).startswith("encounter.toml: ")
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("orders", "line"),
    [
        ("[{time = 1.0, rudder_deg = 5.0}, {time = 1.0, rudder_deg = 6.0}]", r"orders: time 1 s comes after 1 s: put"),
        ("[{time = 4.0, rudder_deg = 5.0}]", r"\[ships.own\] orders: time 4 s is after the end: must be <= 3 s"),
    ],
)  # fmt: skip
def test_orders_that_are_never_given_are_refused(scenario_file: Write, orders: str, line: str) -> None:
    path = scenario_file(MANOEUVRES, ("speed = 4.0", f"speed = 4.0\norders = {orders}"))
    with pytest.raises(ScenarioError, match=line):
        load_scenario(path)


@pytest.mark.parametrize(
    ("barge", "line"),
    [
        (("mass = 8200000.0", "mass = -8200000.0"), r"\[ships.own\] barge.toml: .*mass = -8200000.0"),
        (("mass = 8200000.0", "mass = 22.0e6"), r"\[ships.own\] barge.toml: .*rho L_pp B T"),
    ],
)  # fmt: skip
def test_a_ship_that_cannot_be_is_refused(scenario_file: Write, barge: tuple[str, str], line: str) -> None:
    with pytest.raises(ScenarioError, match=line) as refused:
        load_scenario(scenario_file(barge=barge))
    assert "\n" not in str(refused.value)


def test_one_ship_is_not_enough(tmp_path: Path) -> None:
    path = tmp_path / "alone.toml"
    own = '[ships.own]\nship = "kvlcc2"\nposition = [0, 0]\nheading_deg = 0\n'
    path.write_text(f'[scenario]\nname = "alone"\nduration = 1.0\n{own}', encoding="utf-8")
    with pytest.raises(ScenarioError, match=r"alone.toml: \[ships\] has one ship and nothing to meet: give another"):
        load_scenario(path)


REFERENCE = """
[reference]
source = "Someone, 1999"
time = 2.5
[reference.ships.own]
printed = {x = 1.0, h = 0.5}
corrected = {h = 0.25}
tolerance = {horizontal = 0.5, vertical = 0.1, quaternion = 0.005, velocity = 0.02, rate = 0.003}
"""


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("time = 2.5", "time = 3.5", r"\[reference\] time = 3.5 s is after the end: must be <= duration = 3 s"),
        ("ships.own", "ships.onw", r"\[reference.ships.onw\] is no ship here: the ships are own, target"),
        ("h = 0.25", "w_x = 0.25", r"\[reference.ships.own\] corrects w_x, which is not printed: printed are x, h"),
        ("h = 0.5", "k = 0.5", r"\[reference.ships.own.printed.*\].* must be 'x', 'y', 'z'"),
        ("vertical = 0.1, ", "", r"\[reference.ships.own.tolerance\] vertical is missing: give the tolerance of z"),
    ],
)
def test_a_reference_must_fit_the_run(scenario_file: Write, old: str, new: str, line: str) -> None:
    assert old in REFERENCE
    with pytest.raises(ScenarioError, match=line):
        load_scenario(scenario_file(added=REFERENCE.replace(old, new)))


def test_an_unknown_scenario_is_refused_with_a_near_one_or_all(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=r"unknown scenario 'guan2015': did you mean guan2014\? Else give the path"):
        load_scenario("guan2015")
    with pytest.raises(ScenarioError, match=r"unknown scenario 'x': known: guan2014, .*; or give the path of a"):
        load_scenario("x")
    (tmp_path / "ship.toml").write_text("[ship]\n[particulars]\n", encoding="utf-8")
    with pytest.raises(
        ScenarioError, match=r"^ship.toml is a ship, not a scenario: give a scenario, whose \[ships.NAME"
    ):
        load_scenario(tmp_path / "ship.toml")
    with pytest.raises(ScenarioError, match=r"scenario file nowhere/x.toml does not exist: give the path .*guan2014"):
        load_scenario("nowhere/x.toml")


@pytest.mark.parametrize("step", [0.0, -1.0, float("nan"), 0.07])
def test_an_option_that_does_not_fit_is_named(scenario_file: Write, step: float) -> None:
    with pytest.raises(ScenarioError, match=rf"encounter.toml with another step: \[scenario\] .*{step:g}"):
        load_scenario(scenario_file()).changed(step=step)
    with pytest.raises(ScenarioError, match=r"with another algorithm: \[scenario\] algorithm = 'gauss' must be"):
        load_scenario(scenario_file()).changed(algorithm="gauss")


@pytest.mark.parametrize("source", [None, 5, [1], ""])
def test_what_is_no_scenario_is_refused_in_one_line(source: Any) -> None:
    line = rf"^scenario = {re.escape(repr(source))} is no scenario: give a name or the path of a TOML file$"
    with pytest.raises(ScenarioError, match=line):
        load_scenario(source)
    with pytest.raises(ScenarioError, match=line):
        simulate(source)
