"""Indicative damage from a scenario file to events.json: off unless asked for, and whose bow it was."""

from __future__ import annotations

import json
from math import radians
from pathlib import Path

import jsonschema
import pytest

import shipcollision_fmu.cosim
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.errors import ScenarioError
from shipcollision_fmu.results.damage import bow_crush, minorsky_volume
from shipcollision_fmu.scenario.scenario import load_scenario
from tests.conftest import Write

SCHEMA = json.loads(
    (Path(shipcollision_fmu.results.__file__).parent / "events.schema.json").read_text(encoding="utf-8")
)
ASKED = ("friction = 0.3", "friction = 0.3\ndamage = {t_eq = 0.1, half_angle_deg = 30.0, shells = [[4.0, 0.01]]}")


def test_collision_carries_damage_by_name_of_formula(scenario_file: Write) -> None:
    run = simulate(load_scenario(scenario_file(ASKED)), in_process=True)
    jsonschema.validate(run.events, SCHEMA)
    for collision in run.events["collisions"]:
        damage = collision["damage"]
        assert damage["energy"] == collision["energy"]
        assert damage["striking"] == "own"
        assert damage["minorsky_1959"]["destroyed_volume"] == minorsky_volume(collision["energy"])
        assert damage["pedersen_1993"]["crush_length"] == bow_crush(collision["energy"], 100.0)
        assert damage["wedge"]["half_angle"] == radians(30.0)
        assert damage["woisin_1979"]["destroyed_volume"] > damage["minorsky_1959"]["destroyed_volume"]
    assert run.events["collisions"]


def test_sides_that_touch_have_no_bow(scenario_file: Write) -> None:
    """On opposite courses, port to port and past each other's bows: the quarters touch."""
    path = scenario_file(
        ASKED, ("position = [5.0, -64.0]", "position = [40.0, -20.5]"),
        ("heading_deg = 90.0\nspeed = 4.0", "heading_deg = 0.0\nsurge = 1.0\nsway = 2.0"),
        ("position = [0.0, 0.0]\nheading_deg = 0.0", "position = [0.0, 0.0]\nheading_deg = 180.0"),
    )  # fmt: skip
    run = simulate(load_scenario(path), in_process=True)
    jsonschema.validate(run.events, SCHEMA)
    (damage,) = [collision["damage"] for collision in run.events["collisions"]]
    assert damage["striking"] is None
    assert set(damage) == {"indicative", "energy", "striking", "minorsky_1959", "woisin_1979"}


def test_not_asked_for_not_there(scenario_file: Write) -> None:
    run = simulate(load_scenario(scenario_file()), in_process=True)
    assert run.events["collisions"]
    assert all("damage" not in collision for collision in run.events["collisions"])


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("{t_eq = 0.0, half_angle_deg = 30.0}", r"t_eq = 0"),
        ("{t_eq = 0.1, half_angle_deg = 90.0}", r"half_angle_deg = 90"),
        ("{t_eq = 0.1}", r"half_angle_deg is missing"),
        (
            "{t_eq = 0.1, half_angle_deg = 30.0, shells = [[4.0, 20.0]]}",
            r"shell \[4.0, 20.0\] must be a height and a thick",
        ),
    ],
)
def test_refusals(scenario_file: Write, table: str, message: str) -> None:
    with pytest.raises(ScenarioError, match=message):
        load_scenario(scenario_file(("friction = 0.3", f"friction = 0.3\ndamage = {table}")))
