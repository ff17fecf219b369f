"""Scenarios with obstacles, light floating ones and fenders: read, run, written, refused."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path

import jsonschema
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.errors import ScenarioError

Write = Callable[..., Path]

QUAY = """
[obstacles.quay]
kind = "quay"
shape = "box"
length = 400.0
breadth = 30.0
position = [0.0, 70.0]
"""
FENDER = "fender = {stiffness = 5e6, damping = 2e5, thickness = 1.0}\n"
AHEAD = ("position = [5.0, -64.0]", "position = [5.0, 0.0]")
AWAY = ("position = [0.0, 0.0]", "position = [900.0, 0.0]")


def written(path: Path) -> tuple[list[dict], dict, dict]:
    with (path / "contacts.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    return rows, json.loads((path / "events.json").read_text()), json.loads((path / "summary.json").read_text())


def test_a_ship_runs_into_a_quay_through_the_fmus_and_in_process(scenario_file: Write, tmp_path: Path) -> None:
    scenario = load_scenario(scenario_file(AHEAD, AWAY, added=QUAY))
    simulate(scenario, out=tmp_path / "fmu")
    run = simulate(scenario, out=tmp_path / "process", in_process=True)
    for file in ("states.csv", "contacts.csv", "events.json", "summary.json"):
        assert (tmp_path / "fmu" / file).read_bytes() == (tmp_path / "process" / file).read_bytes()
    rows, events, summary = written(tmp_path / "fmu")
    assert {(row["ship_a"], row["ship_b"]) for row in rows} == {("own", "quay")}
    (collision,) = events["collisions"]
    assert (collision["ship_a"], collision["ship_b"]) == ("own", "quay")
    assert collision["delta_v"]["quay"] == [0.0, 0.0, 0.0]
    assert collision["closing_speed"] == pytest.approx(4.0)
    schema = Path(__file__).parents[2] / "shipcollision_fmu/results/events.schema.json"
    jsonschema.validate(events, json.loads(schema.read_text()))
    # 1.05 m v: all of it went into the quay, and momentum of the ships is not claimed to be kept.
    assert summary["obstacles"]["quay"]["kind"] == "quay"
    assert summary["obstacles"]["quay"]["impulse"] == pytest.approx([0.0, 4.0 * 1.05 * 8.2e6, 0.0], rel=1e-3, abs=2e5)
    assert summary["momentum"]["closed"] is False
    lost = summary["energy"]["before"]["total"] - summary["energy"]["after"]["total"]
    assert lost == pytest.approx(summary["energy"]["dissipated"], rel=1e-6)
    assert run.summary["collisions"] == 1


def test_an_obstacle_out_of_the_way_takes_nothing(scenario_file: Write) -> None:
    run = simulate(load_scenario(scenario_file(added=QUAY.replace("70.0", "7000.0"))), in_process=True)
    assert run.summary["obstacles"]["quay"]["impulse"] == [0.0, 0.0, 0.0]


def test_a_fender_is_no_collision(scenario_file: Write, tmp_path: Path) -> None:
    slow = ("speed = 4.0", "speed = 0.4")
    near = ("position = [5.0, -64.0]", "position = [0.0, 3.8]")
    run = simulate(load_scenario(scenario_file(slow, near, AWAY, added=QUAY + FENDER)), in_process=True, out=tmp_path)
    rows, events, summary = written(tmp_path)
    assert rows
    assert all(row["impact"] == row["scratch"] == "0" for row in rows)
    assert events == {"collisions": [], "scratches": []}
    energy = summary["energy"]
    lost = energy["before"]["total"] - energy["after"]["total"]
    assert energy["dissipated"] == 0.0
    assert energy["fender_stored"] > 0.0
    assert lost == pytest.approx(energy["fender_stored"] + energy["fender_dissipated"], rel=1e-6)
    assert run.summary["obstacles"]["quay"]["impulse"][1] > 0.0


def test_a_ships_own_fender_reaches_the_model(scenario_file: Write) -> None:
    slow = ("speed = 4.0", "speed = 0.4\n" + FENDER)
    near = ("position = [5.0, -64.0]", "position = [0.0, 3.8]")
    run = simulate(load_scenario(scenario_file(slow, near, AWAY, added=QUAY)), in_process=True)
    assert run.summary["collisions"] == 0
    assert run.summary["energy"]["fender_stored"] > 0.0


def test_one_ship_and_a_lock_are_a_scenario(tmp_path: Path, scenario_file: Write) -> None:
    """A chamber is its walls; the ship scrapes along one of them and has no collision with the other."""
    scenario_file()  # the barge
    walls = "".join(
        f'[obstacles.{name}]\nkind = "lock wall"\nshape = "box"\nlength = 150.0\nbreadth = 5.0\n'
        f"position = [0.0, {east}]\n"
        for name, east in (("west", -13.0), ("east", 13.0))
    )
    path = tmp_path / "lock.toml"
    path.write_text(
        '[scenario]\nname = "lock"\nduration = 10.0\nstep = 0.05\n[ships.own]\nship = "./barge.toml"\n'
        "position = [-60.0, 0.0]\nheading_deg = 0.5\nspeed = 1.5\ndegrees_of_freedom = 3\n" + walls
    )
    run = simulate(load_scenario(path), in_process=True)
    assert [c["ship_b"] for c in run.events["collisions"]] == ["east"]
    assert run.summary["obstacles"]["west"]["impulse"] == [0.0, 0.0, 0.0]


def test_a_buoy_and_a_log_are_ships(scenario_file: Write) -> None:
    buoy = ('[ships.target]\nship = "./barge.toml"\nposition = [0.0, 0.0]\nheading_deg = 0.0\nspeed = 1.0',
            '[ships.target]\nship = "buoy"\nposition = [5.0, -8.0]\nheading_deg = 0.0\nspeed = 0.0\n'
            "degrees_of_freedom = 3")  # fmt: skip
    run = simulate(load_scenario(scenario_file(buoy)), in_process=True)
    assert run.summary["collisions"] == 1
    log = (buoy[0], buoy[1].replace("buoy", "floating_log"))
    assert simulate(load_scenario(scenario_file(log)), in_process=True).summary["collisions"] == 1


@pytest.mark.parametrize(
    ("added", "message"),
    [
        (QUAY + "hight = 3.0", r"\[obstacles.quay\] hight is not a known key: did you mean height\?"),
        (QUAY.replace("400.0", "0.0"), r"\[obstacles.quay\] length = 0.0 must be greater than 0: it is the"),
        (QUAY.replace("obstacles.quay", "obstacles.own"), r"\[obstacles.own\] is no name for an obstacle"),
        (QUAY.replace("70.0", "10.0"), r"\[ships.target\] and \[obstacles.quay\] overlap by 10 m at the start"),
        (QUAY + "fender = {stiffness = 1.0}", r"\[obstacles.quay.fender\] thickness is missing: give how far before"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_in_one_line(scenario_file: Write, added: str, message: str) -> None:
    with pytest.raises(ScenarioError, match=message) as error:
        load_scenario(scenario_file(added=added))
    assert "\n" not in str(error.value)


def test_ships_that_start_inside_each_other_are_refused(scenario_file: Write) -> None:
    over = ("position = [5.0, -64.0]", "position = [5.0, -30.0]")
    with pytest.raises(ScenarioError, match=r"\[ships.own\] and \[ships.target\] overlap by .* m at the start"):
        load_scenario(scenario_file(over))


def test_a_bridge_deck_overhead_is_no_overlap(scenario_file: Write) -> None:
    deck = QUAY.replace("70.0", "0.0") + "top = 40.0\nbottom = -30.0\n"
    assert load_scenario(scenario_file(added=deck)).obstacles["quay"].depth == -30.0
