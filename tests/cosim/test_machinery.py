"""machinery.csv and surroundings.csv: rudder, revolutions, current and wind of a run, in process and through FMUs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.cosim.run import RUN_FILES
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.scenario.scenario import Scenario, parse_scenario
from shipcollision_fmu.show.scene.machinery import read_machinery, read_wind
from shipcollision_fmu.show.scene.run_folder import read_run_folder

SCENARIO = """
[scenario]
name = "turned"
duration = 30.0
step = 0.5
[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 0.0
speed = 5.0
hydrodynamics = true
orders = [{time = 0.0, rev_per_s = 0.769}, {time = 10.0, rudder_deg = 30.0, rev_per_s = 0.709}]
[ships.target]
ship = "kvlcc2"
position = [0.0, 900.0]
heading_deg = 0.0
hydrodynamics = false
[environment]
current = [0.5, 0.0]
wind = {speed = 12.0, from_deg = 90.0}
changes = [{time = 12.0, wind = {speed = 8.0, from_deg = 180.0}}, {time = 29.9, current = [0.0, 0.0]}]
"""
RUDDER_RATE, ENGINE_RATE = np.radians(2.34), 0.02
"""Of kvlcc2.toml: [rad/s], [1/s^2]."""


def turned() -> Scenario:
    return parse_scenario(SCENARIO, "turned.toml")


def test_rudder_and_revolutions_go_to_their_orders_at_their_rates() -> None:
    """From 10 s on, of the ship that sails alone: to 30 deg in 12.8 s, and from 0.769 to 0.709 1/s in 3 s."""
    run = simulate(turned(), in_process=True)
    assert run.machinery.dtype.names == ("time", "own.rudder_angle", "own.propeller_speed")
    time = run.machinery["time"]
    assert time.tolist() == run.states["time"].tolist()
    since = np.maximum(time - 10.0, 0.0)
    np.testing.assert_allclose(
        run.machinery["own.rudder_angle"], np.minimum(RUDDER_RATE * since, np.radians(30.0)), atol=1e-12
    )
    np.testing.assert_allclose(
        run.machinery["own.propeller_speed"], np.maximum(0.769 - ENGINE_RATE * since, 0.709), atol=1e-12
    )


def test_surroundings_are_those_of_the_start_and_of_each_change() -> None:
    """A change at 29.9 s would act from 30 s on, where the run is over."""
    rows = simulate(turned(), in_process=True).surroundings
    assert rows.dtype.names == ("time", "current.north", "current.east", "wind.speed", "wind.direction")
    assert rows.tolist() == [(0.0, 0.5, 0.0, 12.0, np.pi / 2), (12.0, 0.5, 0.0, 8.0, np.pi)]


def test_the_folder_gives_them_back(tmp_path: Path) -> None:
    run = simulate(turned(), in_process=True, out=tmp_path)
    folder = read_run_folder(tmp_path)
    assert list(found := read_machinery(folder)) == ["own"]
    assert found["own"][:, 0].tolist() == run.machinery["own.rudder_angle"].tolist()
    assert found["own"][:, 1].tolist() == run.machinery["own.propeller_speed"].tolist()
    wind = read_wind(folder)
    assert wind is not None
    assert wind[23].tolist() == [12.0, np.pi / 2]
    assert wind[24].tolist() == wind[-1].tolist() == [8.0, np.pi]


@pytest.mark.parametrize("fmi", [2, 3])
def test_fmus_give_the_same_bytes(tmp_path: Path, fmi: int) -> None:
    simulate(turned(), in_process=True, out=tmp_path / "a")
    simulate(turned(), fmi=fmi, out=tmp_path / "b")
    for name in set(RUN_FILES) - {"timing.json"}:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name


def test_where_no_ship_sails_there_are_no_rows(tmp_path: Path) -> None:
    scenario = parse_scenario(SCENARIO.replace("hydrodynamics = true\n", "hydrodynamics = false\n").replace(
        "orders = [{time = 0.0, rev_per_s = 0.769}, {time = 10.0, rudder_deg = 30.0, rev_per_s = 0.709}]\n", ""
    ).partition("[environment]")[0], "coasts.toml")  # fmt: skip
    simulate(scenario, in_process=True, out=tmp_path)
    assert (tmp_path / "machinery.csv").read_text() == "time\n"
    assert read_machinery(read_run_folder(tmp_path)) == {}
