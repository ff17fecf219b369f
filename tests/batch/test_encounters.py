"""run_encounters(): the numbers of a run of the native models by the ordinary master, to the bit."""

from __future__ import annotations

import ctypes
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import ScenarioError, load_scenario, run_encounters, simulate
from shipcollision_fmu.batch.encounter_columns import COLLISION_ROW, ENCOUNTER_ROW, SHIP_ROW
from shipcollision_fmu.batch.native_encounters import EncounterCase, EncounterShip
from shipcollision_fmu.fmi.names import STATE
from shipcollision_fmu.scenario.scenario import Scenario, parse_scenario
from shipcollision_fmu.toolchain.load import load_library
from tests.batch.native_run import simulate_native, simulate_native_fmus

COASTING = """
[scenario]
name = "coasting"
description = "two ships coast into each other"
duration = 5.0
step = 0.25

[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 5.0
speed = 7.0
hydrodynamics = false
degrees_of_freedom = 6

[ships.target]
ship = "kcs"
position = [196.0, 20.0]
heading_deg = 100.0
speed = 2.0
hydrodynamics = false
degrees_of_freedom = 4

[collision]
restitution = 0.3
"""

STEERED = """
[scenario]
name = "steered"
description = "three ships between a quay and each other, in wind and current"
duration = 14.0
step = 0.5
algorithm = "jacobi"

[environment]
current = [0.3, -0.2]
wind = {speed = 12.0, from_deg = 200.0}

[ships.a]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 0.0
speed = 6.0
hydrodynamics = true
orders = [{time = 0.0, rev_per_s = 0.8}, {time = 3.0, heading_deg = 15.0}, {time = 9.0, rudder_deg = -10.0}]

[ships.b]
ship = "kcs"
position = [230.0, 70.0]
heading_deg = 250.0
speed = 4.0
hydrodynamics = true
orders = [{time = 0.0, rev_per_s = 0.9}]
evasion = {of = "a", distance = 215.0, rudder_deg = 35.0, rev_per_s = -0.5}

[ships.c]
ship = "kvlcc2"
position = [40.0, -100.0]
heading_deg = 20.0
speed = 5.0
hydrodynamics = true
degrees_of_freedom = 4
orders = [{time = 0.0, rev_per_s = 0.8}]
route = {waypoints = [[250.0, 60.0], [900.0, 100.0]]}
fender = {stiffness = 1e6, damping = 1e5, thickness = 1.0}

[obstacles.quay]
kind = "quay"
shape = "box"
length = 900.0
breadth = 30.0
position = [150.0, -178.0]
heading_deg = 2.0
"""


def compare_with_run(scenario: Scenario, run: Any, relative: float) -> None:
    """The tables of an encounter beside the states, the events and the summary of a run."""
    batch = run_encounters([scenario], tracks=True)
    encounter, track = batch.encounters[0], batch.tracks[0]
    assert encounter["status"] == 0, encounter["reason"]
    states = np.array([[[row[f"{name}.{s}"] for s in STATE] for name in scenario.ships] for row in run.states])
    scale = np.abs(states).max(axis=(0, 1))
    assert (np.abs(track - states) <= relative * scale).all()
    assert (batch.ships["start"] == track[0]).all()
    assert (batch.ships["end"] == track[-1]).all()
    assert batch.ships["ship"].tolist() == list(scenario.ships)
    near = {"rel": max(relative, 1e-12), "abs": 1e-9}
    energy, summary = run.summary["energy"], run.summary
    assert encounter["energy"] == pytest.approx(energy["dissipated"], **near)
    assert encounter["fender_dissipated"] == pytest.approx(energy["fender_dissipated"], **near)
    assert encounter["clearance"] == pytest.approx(summary["least_clearance"], rel=near["rel"], abs=1e-6)
    assert [encounter["nearest_a"], encounter["nearest_b"]] == summary["nearest"]
    for ship in batch.ships:
        for column in ("issued", "applied"):
            assert ship[column] == pytest.approx(np.array(summary["ledger"][str(ship["ship"])][column]), **near)
    assert encounter["collisions"] == len(run.events["collisions"])
    for row, event in zip(batch.collisions, run.events["collisions"], strict=True):
        assert (row["case"], row["number"], row["ship_a"], row["ship_b"]) == (
            0,
            event["id"],
            event["ship_a"],
            event["ship_b"],
        )
        for column in ("start", "end", "closing_speed", "angle", "energy"):
            assert row[column] == pytest.approx(event[column], **near), column
        for column, value in (
            ("point", event["first_point"]["n"]), ("a_point", event["first_point"]["b_a"]),
            ("b_point", event["first_point"]["b_b"]), ("relative_velocity", event["relative_velocity"]),
            ("impulse", event["impulse"]["n"]), ("a_gain", event["delta_v"][event["ship_a"]]),
            ("b_gain", event["delta_v"][event["ship_b"]]),
        ):  # fmt: skip
            assert row[column] == pytest.approx(
                np.array(value), rel=near["rel"], abs=near["rel"] * (1.0 + np.abs(value).max())
            ), column


SEQUENTIAL = STEERED.replace("jacobi", "gauss-seidel")


@pytest.mark.parametrize("text", [
        COASTING, STEERED, pytest.param(SEQUENTIAL, marks=pytest.mark.slow),
        *(pytest.param(f'{COASTING}feedback = "{word}"\n', marks=pytest.mark.slow) for word in ("force", "none")),
    ],
)  # fmt: skip
def test_an_encounter_is_a_run_of_the_native_models(text: str) -> None:
    """States to the bit at each communication point; collisions and balances as in the events and the summary."""
    scenario = parse_scenario(text, "test")
    run = simulate_native(scenario)
    assert len(run.events["collisions"]) >= 1
    compare_with_run(scenario, run, 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("text", [COASTING, COASTING.replace("[ships.own]", 'algorithm = "jacobi"\n[ships.own]')])
def test_an_encounter_is_a_run_of_the_native_fmus(
    text: str, native_fmus: dict[str, Path], native_collisions: dict[str, Path]
) -> None:
    """To the bit, through FMPy."""
    scenario = parse_scenario(text, "test")
    run = simulate_native_fmus(scenario, native_fmus["2"], native_collisions["2"])
    assert len(run.events["collisions"]) >= 1
    compare_with_run(scenario, run, 0.0)


@pytest.mark.slow
def test_a_shipped_scenario_is_as_in_python() -> None:
    scenario = load_scenario("guan2014_added_mass")
    compare_with_run(scenario, simulate(scenario, in_process=True), 1e-9)


def test_an_encounter_depends_on_its_scenario_alone() -> None:
    """Not on those before it, nor on the thread; models are kept from one to the next of the same ships."""
    one, other = (
        parse_scenario(COASTING, "test"),
        parse_scenario(COASTING.replace("speed = 7.0", "speed = 5.0"), "test"),
    )
    alone = [run_encounters([scenario], tracks=True) for scenario in (one, other)]
    together = [one, other, parse_scenario(STEERED.replace("14.0", "1.0").replace("{time = 3.0", "{time = 0.5").replace(
        "{time = 9.0", "{time = 1.0"), "test"), other, one]  # fmt: skip
    with ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda _: run_encounters(together, tracks=True), range(2)))
    for run in runs:
        for i, expected in ((0, alone[0]), (1, alone[1]), (3, alone[1]), (4, alone[0])):
            assert run.encounters[i] == expected.encounters[0]
            assert (run.tracks[i] == expected.tracks[0]).all()
            found = run.collisions[run.collisions["case"] == i]
            assert found[["start", "energy"]].tolist() == expected.collisions[["start", "energy"]].tolist()


def test_an_encounter_ends_after_the_separation() -> None:
    """So many seconds after the last contact; without contact at its duration."""
    scenario = parse_scenario(COASTING.replace("duration = 5.0", "duration = 30.0"), "test")
    whole, ended = run_encounters([scenario]), run_encounters([scenario], separation=2.0)
    last = ended.collisions["end"].max()
    assert ended.encounters["time"] == pytest.approx(last + 2.0)
    assert whole.encounters["time"] == pytest.approx(30.0)
    assert ended.collisions["energy"] == pytest.approx(whole.collisions["energy"])
    with pytest.raises(ScenarioError, match=r"separation = -1\.0 must be seconds, at least 0"):
        run_encounters([scenario], separation=-1.0)


def test_one_scenario_is_no_list() -> None:
    """It would be taken apart, into its letters or its tables."""
    scenario = parse_scenario(COASTING, "test")
    for given, name in (("guan2014", "'guan2014'"), (Path("x.toml"), "PosixPath"), (scenario, "a Scenario"), (3, "3")):
        with pytest.raises(ScenarioError, match=rf"^run_encounters: {name}.* is no list of scenarios: give \[scenario"):
            run_encounters(given)


def test_encounters_are_printed_in_two_lines() -> None:
    result = run_encounters([parse_scenario(COASTING, "test"), "nowhere"])
    assert repr(result) == (
        "2 encounters, 1 with a status other than 0, 1 collision\nnext: .encounters, .ships, .collisions"
    )


def test_a_refused_encounter_has_its_reason() -> None:
    """Whether its scenario, its start or a step is refused; the others are run."""
    scenario = parse_scenario(COASTING.replace("duration = 5.0", "duration = 0.5"), "test")
    closed = parse_scenario(COASTING.replace("[collision]", '[collision]\nresponse = "closed_form"'), "test")
    coarse = parse_scenario(COASTING.replace("[collision]", "[collision]\nsubstep = 1e-6"), "test")
    rows = run_encounters(["no_such", closed, scenario, coarse, 5000 * "x", 5000 * "x" + ".toml"])
    assert rows.encounters["status"].tolist() == [1, 1, 0, 1, 1, 1]
    reasons = [reason.decode() for reason in rows.encounters["reason"]]
    assert reasons[0].startswith("unknown scenario 'no_such': known: ")
    assert reasons[4].startswith("unknown scenario 'xxx")
    assert reasons[5].startswith("scenario file xxx")
    assert reasons[1] == (
        "[collision] response = 'closed_form' needs Python, and native code has 'pgs' alone: take 'pgs', as the "
        "scenarios guan2014_added_mass and kvlcc2_crossing do, or simulate() with engine = 'python'"
    )
    assert reasons[3].startswith(
        "collision: a step of 0.25 s takes 2.5e+05 substeps of 1e-06 s, at most 10000 where hulls"
    )
    assert set(rows.ships["case"]) == {2, 3}
    assert simulate(closed, engine="python", in_process=True).summary["collisions"]  # the remedy


def test_the_structures_are_those_of_the_library() -> None:
    sizes = (ctypes.c_size_t * 5)()
    load_library().shipcollision_encounter_sizes(sizes)
    assert list(sizes) == [
        ENCOUNTER_ROW.itemsize, SHIP_ROW.itemsize, COLLISION_ROW.itemsize, ctypes.sizeof(EncounterCase),
        ctypes.sizeof(EncounterShip),
    ]  # fmt: skip
