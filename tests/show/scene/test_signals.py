"""The curve of kinetic energy is that of the motions that may change, also of a ship that heels."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.show.scene.run_folder import read_run_folder
from shipcollision_fmu.show.scene.signals import signals_of
from tests.show.conftest import MakeRun

HEELED = (
    ("position = [5.0, -64.0]", "position = [5.0, -64.0]\nattitude_deg = [-12.0, 0.0]\ndegrees_of_freedom = 4"),
    (
        "position = [0.0, 0.0]\nheading_deg = 0.0",
        "position = [0.0, 0.0]\nheading_deg = 0.0\nattitude_deg = [15.0, 0.0]\ndegrees_of_freedom = 4",
    ),
    ("duration = 3.0", "duration = 4.0"),
)
"""The meeting of two barges, both with a list."""
TIMES = (0.5, 1.5, 2.0, 3.5)


@pytest.fixture
def heeled(meeting: MakeRun) -> Path:
    return meeting(*HEELED)


def kinetic(folder: Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    curves = signals_of(read_run_folder(folder))
    return curves.times, {str(curve.ship): curve.values for curve in curves.of("kinetic")}


def test_the_energy_of_a_heeled_ship_is_that_of_the_summary(heeled: Path) -> None:
    summary = json.loads((heeled / "summary.json").read_text())
    assert summary["collisions"] == 1
    _, curves = kinetic(heeled)
    for name, values in curves.items():
        assert values[0] == pytest.approx(summary["energy"]["before"][name], rel=1e-12)
        assert values[-1] == pytest.approx(summary["energy"]["after"][name], rel=1e-12)


def test_the_energy_of_a_heeled_ship_is_that_of_its_track(heeled: Path) -> None:
    """1/2 m (along, across, heel, turn) of states.csv, by difference quotients, which know no level axes."""
    M = {
        name: np.array(ship["inertia"])
        for name, ship in json.loads((heeled / "bodies.json").read_text())["ships"].items()
    }
    with (heeled / "states.csv").open(newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    times, curves = kinetic(heeled)
    for name, values in curves.items():
        for time in TIMES:
            k = next(k for k, row in enumerate(rows) if row["time"] == time)
            step = {
                key: (rows[k + 1][f"{name}.{key}"] - rows[k - 1][f"{name}.{key}"])
                / (rows[k + 1]["time"] - rows[k - 1]["time"])
                for key in ("position.north", "position.east", "attitude.roll", "attitude.yaw")
            }
            psi = rows[k][f"{name}.attitude.yaw"]
            north, east = step["position.north"], step["position.east"]
            motion = np.array([
                north * np.cos(psi) + east * np.sin(psi), east * np.cos(psi) - north * np.sin(psi), 0.0,
                step["attitude.roll"], 0.0, step["attitude.yaw"],
            ])  # fmt: skip
            energy = 0.5 * motion @ M[name] @ motion
            assert np.interp(time, times, values) == pytest.approx(energy, rel=0.005)
