"""collide(): the collisions of coasting ships, beside impact() and beside the same as scenarios."""

from __future__ import annotations

from math import degrees

import numpy as np
import pytest

from shipcollision_fmu import ScenarioError, collide, impact, run_encounters
from shipcollision_fmu.scenario.scenario import parse_scenario

ANGLES, PLACES = np.array([[40.0], [90.0], [120.0]]), np.array([-0.3, 0.2])

SCENARIO = """
[scenario]
name = "case"
description = "a case of collide()"
duration = 7.0
step = 0.2
"""
SHIP = """
[ships.{name}]
ship = "{ship}"
position = [{north!r}, {east!r}]
heading_deg = {heading!r}
surge = {surge!r}
sway = {sway!r}
hydrodynamics = false
coasting = "{coasting}"
"""


def test_a_collision_is_that_of_a_scenario_from_the_same_start() -> None:
    """Which a start written in degrees is to rounding; its impact is that of impact(), at the time asked for."""
    arguments = {"own_speed": 6.0, "target_speed": 2.0, "target_sway": 0.4, "restitution": 0.2, "heading_deg": 30.0}
    result = collide("kvlcc2", "kcs", ANGLES, PLACES, **arguments, before=1.0, after=6.0, step=0.2)
    rows = impact("kvlcc2", "kcs", ANGLES, PLACES, **arguments).ravel()
    assert result.encounters["status"].tolist() == [0] * 6
    firsts = result.collisions[result.collisions["number"] == 1]
    assert firsts["case"].tolist() == list(range(6))
    assert np.abs(firsts["start"] - 1.0).max() <= 0.011  # a substep
    assert firsts["closing_speed"] == pytest.approx(rows["closing_speed"], rel=1e-3)
    assert np.abs(firsts["point"][:, :2]).max() < 0.1
    scenarios = []
    for ships in result.ships.reshape(6, 2):
        tables = [
            SHIP.format(
                name=ship["ship"], ship=file, north=float(ship["start"][0]), east=float(ship["start"][1]),
                heading=degrees(ship["start"][5]) % 360.0, surge=float(ship["start"][6]), sway=float(ship["start"][7]),
                coasting="straight" if ship["start"][7] else "kirchhoff",
            )
            for ship, file in zip(ships, ("kvlcc2", "kcs"), strict=True)
        ]  # fmt: skip
        scenarios.append(parse_scenario(f"{SCENARIO}{''.join(tables)}[collision]\nrestitution = 0.2\n", "case"))
    runs = run_encounters(scenarios)
    assert runs.encounters["energy"] == pytest.approx(result.encounters["energy"], rel=1e-5)
    assert runs.collisions["start"] == pytest.approx(result.collisions["start"])
    assert runs.ships["applied"] == pytest.approx(result.ships["applied"], rel=1e-5, abs=1e-5 * 1e9)


def test_a_case_without_impact_is_refused_alone() -> None:
    result = collide("kvlcc2", "kcs", 90.0, 0.0, [5.0, -1.0, 5.0], after=1.0, tracks=True)
    assert result.encounters["status"].tolist() == [0, 1, 0]
    assert b"at the place they close at -1.00 m/s" in result.encounters["reason"][1]
    assert set(result.ships["case"]) == {0, 2}
    assert (result.tracks[0] == result.tracks[2]).all()
    assert result.tracks[0].shape == (41, 2, 12)
    assert result.tracks[1].shape == (0, 0, 12)


def test_times_out_of_range_are_refused() -> None:
    for arguments, words in (
        ({"before": 0.0}, r"before = 0\.0 must be seconds, above 0"), ({"after": float("nan")}, "after = nan must be"),
        ({"separation": -2.0}, r"separation = -2\.0 must be"), ({"degrees_of_freedom": 2}, "degrees_of_freedom = 2"),
        ({"after": "5"}, "after = '5' must be seconds"), ({"separation": [1.0]}, r"separation = \[1\.0\] must be"),
        (
            {"step": 1e-6, "after": 7200.0},  # of 32 bits the number would be negative, and no step be made
            r"step = 1e-06 s makes 7\.2e\+09 steps, the limit is 1000000: take a longer step",
        ),
    ):  # fmt: skip
        with pytest.raises(ScenarioError, match=f"^collide: {words}"):
            collide("kvlcc2", "kcs", **arguments)
