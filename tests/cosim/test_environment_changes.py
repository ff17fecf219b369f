"""[environment] changes: current and wind that change at given times reach every ship, in process and through FMUs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.batch.encounter_case import make_case
from shipcollision_fmu.batch.prepared_ships import PreparedShips
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.packaging.system_structure import build_system_structure
from shipcollision_fmu.results.run_text import csv_text
from shipcollision_fmu.scenario.scenario import Scenario, parse_scenario

SCENARIO = """
[scenario]
name = "blown"
duration = 20.0
step = 0.5
[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 0.0
hydrodynamics = true
[ships.target]
ship = "kcs"
position = [0.0, 900.0]
heading_deg = 90.0
hydrodynamics = true
"""
WIND = "wind = {speed = 20.0, from_deg = 270.0}"
CURRENT = "current = {speed = 2.0, towards_deg = 90.0}"


def blown(environment: str) -> Scenario:
    return parse_scenario(f"{SCENARIO}\n[environment]\n{environment}\n", "blown.toml")


def ran(environment: str, **options: Any) -> Run:
    return simulate(blown(environment), **({"in_process": True} | options))


def changes(*items: str) -> str:
    return f"changes = [{', '.join(f'{{{item}}}' for item in items)}]"


@pytest.mark.parametrize("around", [WIND, CURRENT, f"{WIND}\n{CURRENT}"])
def test_a_change_at_the_start_is_what_is_there_from_the_start(around: str) -> None:
    changed = ran(changes("time = 0.0, " + around.replace("\n", ", ")))
    assert csv_text(changed.states) == csv_text(ran(around).states)


def test_a_change_acts_from_its_communication_point_on() -> None:
    """A change at 10.2 s is one at 10.5 s, where the step is 0.5 s."""
    still, changed = ran("current = [0.0, 0.0]"), ran(changes(f"time = 10.2, {WIND}"))
    before = still.states["time"] <= 10.5
    assert csv_text(changed.states[before]) == csv_text(still.states[before])
    assert changed.states["own.velocity.sway"][22] != still.states["own.velocity.sway"][22]  # at 11 s
    assert changed.states["own.position.east"][-1] > 0.01  # to leeward


def test_a_change_of_the_current_keeps_the_wind() -> None:
    """The wind that is left out blows on: the run is that of both given again."""
    left_out = ran(f"{WIND}\n" + changes(f"time = 5.0, {CURRENT}"))
    given = ran(f"{WIND}\n" + changes(f"time = 5.0, {CURRENT}, {WIND}"))
    assert csv_text(left_out.states) == csv_text(given.states)
    without = ran(f"{WIND}\n" + changes(f"time = 5.0, {CURRENT}, wind = {{speed = 0.0, from_deg = 0.0}}"))
    assert csv_text(left_out.states) != csv_text(without.states)


@pytest.mark.parametrize("fmi", [2, 3])
def test_fmus_give_the_same_bits(fmi: int) -> None:
    around = changes(f"time = 5.0, {CURRENT}", f"time = 12.0, {WIND}")
    assert csv_text(ran(around, in_process=False, fmi=fmi).states) == csv_text(ran(around).states)


def test_packages_list_them_as_orders() -> None:
    orders = build_system_structure(blown(changes(f"time = 0.0, {CURRENT}", f"time = 5.0, {WIND}"))).orders
    assert [(o.time, o.ship, o.variable) for o in orders] == [
        (5.0, ship, variable) for ship in ("own", "target") for variable in ("wind.speed", "wind.direction")
    ]
    assert [o.value for o in orders[:2]] == pytest.approx([20.0, np.radians(270.0)])


@pytest.mark.parametrize(
    ("environment", "message"),
    [
        (changes(f"time = 30.0, {WIND}"), r"changes: time 30 s is after the end: must be <= 20 s"),
        (
            changes(f"time = 5.0, {WIND}", f"time = 5.0, {WIND}"),
            r"changes: time 5 s comes after 5 s: put them in order",
        ),
        (changes("time = 5.0"), r"changes nothing: give current or wind"),
        (changes("time = 5.0, current = [99.0, 0.0]"), r"runs faster than the limit of 10 m/s"),
        (changes("time = 5.0, wind = {speed = 99.0, from_deg = 0.0}"), r"speed = 99.0 must be less than"),
    ],
)
def test_what_is_refused(environment: str, message: str) -> None:
    with pytest.raises(ScenarioError, match=message):
        blown(environment)


def test_changes_act_on_a_ship_that_sails_only() -> None:
    coasting = SCENARIO.replace("hydrodynamics = true", "hydrodynamics = false")
    with pytest.raises(ScenarioError, match=r"\[environment\] changes acts on no ship: set hydrodynamics = true"):
        parse_scenario(f"{coasting}\n[environment]\n{changes(f'time = 5.0, {WIND}')}\n", "blown.toml")


def test_encounters_in_one_call_refuse_them() -> None:
    with (
        PreparedShips() as files,
        pytest.raises(
            ScenarioError, match=r"has 1 changes, but encounters in one call keep .*: remove changes, or take"
        ),
    ):
        make_case(blown(changes(f"time = 5.0, {WIND}")), files, None)
