"""A ship that a steady wind holds against a quay, with its own hydrodynamics: ten minutes in steps of half a second."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.scenario.scenario import load_scenario

SCENARIO = """
[scenario]
name = "held"
duration = 600.0
step = 0.5
algorithm = "{algorithm}"
[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 0.0
hydrodynamics = true
degrees_of_freedom = {free}
[collision]
substep = 0.5
[environment]
wind = {{speed = 20.0, from_deg = 270.0}}
[obstacles.quay]
kind = "quay"
shape = "box"
length = 800.0
breadth = 20.0
position = [0.0, 40.0]
"""
FACE = 1.0  # m to the quay, where it starts: half its breadth is 29 m


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("free", [4, 6])
def test_wind_holds_a_ship_at_the_quay_for_ten_minutes(tmp_path: Path, free: int, algorithm: str) -> None:
    """One collision; the overlap is at most the way of the ship until detection, and the ship stays there."""
    path = tmp_path / "held.toml"
    path.write_text(SCENARIO.format(algorithm=algorithm, free=free), encoding="utf-8")
    run = simulate(load_scenario(path), in_process=True)
    east = np.array([s["own.position.east"] for s in run.states])
    fastest = float(np.diff(east).max())  # m in a step
    assert east.max() >= FACE - 0.01
    assert east.max() <= FACE + (1 if algorithm == "gauss-seidel" else 2) * fastest
    assert np.ptp(east[len(east) // 2 :]) < 1e-3  # no creep in five minutes
    summary = run.summary
    assert summary["collisions"] == 1
    # The work of the wind up to the contact is lost, and nothing springs back: all but at rest in the end.
    assert 0.0 < summary["energy"]["normal"] <= summary["energy"]["dissipated"]
    assert summary["energy"]["after"]["own"] < 1e-3 * summary["energy"]["dissipated"]
