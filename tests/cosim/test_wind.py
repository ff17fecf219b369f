"""[environment] wind reaches every ship that sails, through the same variables as a host would set."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.scenario.scenario import load_scenario

SCENARIO = """
[scenario]
name = "blown"
duration = 60.0
step = 0.5
[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 0.0
hydrodynamics = true
degrees_of_freedom = 6
[ships.target]
ship = "kcs"
position = [0.0, 900.0]
heading_deg = 90.0
hydrodynamics = true
[environment]
wind = {speed = 20.0, from_deg = 270.0}
"""


def test_ships_at_rest_are_blown_to_leeward(tmp_path: Path) -> None:
    path = tmp_path / "blown.toml"
    path.write_text(SCENARIO, encoding="utf-8")
    last = simulate(load_scenario(path), in_process=True).states[-1]
    assert last["own.position.east"] > 1.0
    assert last["own.attitude.roll"] > 0.0  # the wind comes from port
    assert last["target.position.east"] > 900.5  # from astern
    assert abs(last["target.position.north"]) < 0.1


@pytest.mark.parametrize("from_deg", [-90.0, 270.0])
def test_direction_is_where_it_comes_from(tmp_path: Path, from_deg: float) -> None:
    path = tmp_path / "blown.toml"
    path.write_text(SCENARIO.replace("270.0", str(from_deg)), encoding="utf-8")
    wind = load_scenario(path).environment.wind
    assert wind is not None
    assert (wind.speed, wind.from_deg) == (20.0, from_deg)
    assert simulate(load_scenario(path), in_process=True).states[-1]["own.position.east"] > 1.0
