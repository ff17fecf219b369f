"""bodies.json and signals.csv: with them a run's folder needs nothing else to be shown."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.ship.hull.hull import build_hull
from tests.conftest import Write

QUAY = """
[obstacles.quay]
kind = "quay"
shape = "box"
length = 40.0
breadth = 10.0
position = [300.0, 20.0]
heading_deg = 90.0
top = 3.0
bottom = 12.0
"""


def test_the_solids_of_the_run_are_in_its_folder_to_the_bit(scenario_file: Write, tmp_path: Path) -> None:
    path = scenario_file(added=QUAY)
    simulate(load_scenario(path), in_process=True, out=tmp_path / "run")
    written = json.loads((tmp_path / "run" / "bodies.json").read_text())
    ships = load_scenario(path).load_ships()
    assert list(written["ships"]) == ["own", "target"]
    for name, ship in ships.items():
        hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
        assert np.array_equal(written["ships"][name]["vertices"], hull.vertices)
        assert np.array_equal(written["ships"][name]["triangles"], hull.triangles)
        assert np.array_equal(written["ships"][name]["inertia"], ship.M)
    quay = written["obstacles"]["quay"]
    vertices = np.array(quay["vertices"])
    assert (vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()) == ([-20.0, -5.0, -3.0], [20.0, 5.0, 12.0])
    assert quay["position"] == [300.0, 20.0, 0.0]
    assert np.isclose(quay["heading"], np.pi / 2)


def test_signals_follow_clearance_and_dissipated_energy(scenario_file: Write) -> None:
    run = simulate(load_scenario(scenario_file()), in_process=True)
    clearance, dissipated = run.signals["clearance"], run.signals["energy.dissipated"]
    assert np.array_equal(run.signals["time"], run.states["time"])
    assert clearance.min() == run.summary["least_clearance"]
    assert clearance[0] > 3.0 > clearance.min()
    assert dissipated[0] == 0.0
    assert dissipated[-1] == run.summary["energy"]["dissipated"] > 0.0
    assert np.all(np.diff(dissipated) >= -1e-9 * dissipated[-1])
