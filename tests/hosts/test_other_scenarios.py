"""What else a package can hold, in one host each: orders in time, hulls from a mesh, ships that take forces."""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shipcollision_fmu.scenario.scenario import Scenario, load_scenario, parse_scenario
from shipcollision_fmu.ship.loading.library import find_models
from shipcollision_fmu.toolchain import libraries
from tests.conftest import NATIVE_CACHE

from .encounter import Encounter, Rows, run_master
from .masters import MASTERS, libtbb
from .test_encounters import JITTER

ORDERS = """
[scenario]
name = "orders"
duration = 3.0

[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 90.0
speed = 5.0
hydrodynamics = true
orders = [{ time = 0.0, rev_per_s = 0.769 }, { time = 0.5, rudder_deg = 20.0 }, { time = 1.52, rev_per_s = -0.5 }]

[ships.target]
ship = "kvlcc2"
position = [800.0, 0.0]
heading_deg = 0.0
"""

CHANGES = """
[environment]
wind = { speed = 12.0, from_deg = 300.0 }
changes = [
  { time = 0.5, current = { speed = 1.0, towards_deg = 200.0 } },
  { time = 1.5, wind = { speed = 25.0, from_deg = 80.0 } },
]
"""

MESH = """
[scenario]
name = "mesh"
duration = 2.0

[ships.own]
ship = "./mine.toml"
position = [-78.0, 0.0]
heading_deg = 0.0
speed = 4.0

[ships.target]
ship = "guan2014_target"
position = [0.0, 0.0]
heading_deg = 90.0

[collision]
feedback = "force"
"""


def differences(
    host: str, told: Scenario, folder: Path, gone: Path | None = None, native: tuple[str, ...] = (), **more: str
) -> tuple[Rows, Rows]:
    """Relative differences from our own master, by column; and our rows. The folder `gone` is removed in between."""
    encounter = Encounter.packaged(told, folder, native)
    (ours, _, _), case = encounter.ours(), encounter.case(**more)
    if gone is not None:
        shutil.rmtree(gone)
    (result,) = run_master(host, [case], folder)
    rows = encounter.rows(result)
    seen = ~np.isnan(rows).any(axis=1)
    vectors = np.abs(ours).max(axis=0).reshape(-1, 3).max(axis=1).repeat(3)
    return np.abs(rows[seen] - ours[seen]) / np.where(vectors > 0.0, vectors, 1.0), ours


@pytest.mark.slow
@pytest.mark.parametrize("host", [host for host in MASTERS if host == "libcosim-osp"])
def test_orders_in_time_reach_the_ship_in_libcosim(tmp_path: Path, host: str) -> None:
    scenario = parse_scenario(ORDERS, "orders.toml")
    found, ours = differences(host, scenario, tmp_path, scenario=str(tmp_path / "osp" / "scenario.json"))
    assert found.max() <= JITTER
    heading = ours[:, 5]
    assert abs(heading[11] - heading[0]) < 1e-3 * abs(heading[-1] - heading[0])  # the rudder order did something


@pytest.mark.slow
@pytest.mark.parametrize("native", [(), ("linux64",)])
@pytest.mark.parametrize("host", [host for host in MASTERS if host == "libcosim-osp"])
def test_wind_and_current_that_change_reach_the_ship_in_libcosim(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, host: str, native: tuple[str, ...]
) -> None:
    monkeypatch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
    scenario = parse_scenario(ORDERS + CHANGES, "changes.toml")
    place = str(tmp_path / "osp" / "scenario.json")
    found, ours = differences(host, scenario, tmp_path, native=native, scenario=place)
    assert found.max() <= JITTER
    calm = Encounter(parse_scenario(ORDERS + CHANGES.partition("changes")[0], "calm.toml"), tmp_path).ours()[0]
    assert np.abs(ours[-1] - calm[-1]).max() > 1e-3


@pytest.mark.slow
@pytest.mark.parametrize(
    "hull",
    ["convex", "example"],  # example is cut into convex parts first: seconds
)
def test_a_ship_file_with_a_mesh_and_forces_for_feedback(tmp_path: Path, hull: str) -> None:
    """In Ecos, from a folder of its own: the package holds ship file and mesh, both are gone where they were."""
    models, home = find_models(), tmp_path / "home"
    home.mkdir()
    text = (models / "ships" / "mesh_example.toml").read_text()
    (home / "mine.toml").write_text(text.replace("../hulls/example.obj", "hull.obj"))
    if hull == "convex":  # in millimetres from the keel amidships, as the example
        solid = trimesh.creation.box((120e3, 20e3, 12e3), trimesh.transformations.translation_matrix([60e3, 0, 6e3]))
        solid.export(home / "hull.obj")
    else:
        shutil.copy(models / "hulls" / "example.obj", home / "hull.obj")
    (home / "mesh.toml").write_text(MESH)
    found, ours = differences("ecos-ssp", load_scenario(home / "mesh.toml"), tmp_path, gone=home)
    assert found.max() == 0.0
    assert ours[-1, -12:].any()


@pytest.mark.slow
def test_an_edited_parameter_set_reaches_a_host_that_reads_it(encounters: dict[str, Encounter], tmp_path: Path) -> None:
    """Ecos applies the set whose name it is given, else the FMU's start values hold."""
    with zipfile.ZipFile(encounters["guan2014"].folder / "package.ssp") as package:
        files = {name: package.read(name) for name in package.namelist()}
    friction, was = encounters["guan2014"].scenario.collision.friction, files["resources/collision.ssv"].decode()
    assert f'value="{friction}"' in was
    files["resources/collision.ssv"] = was.replace(f'value="{friction}"', 'value="0.5"').encode()
    with zipfile.ZipFile(tmp_path / "edited.ssp", "w") as package:
        for name, data in files.items():
            package.writestr(name, data)
    code = """
import ctypes, sys
ctypes.CDLL(sys.argv[2])
from ecospy import EcosSimulation
for name in (None, "scenario"):
    simulation = EcosSimulation(0.05, ssp_path=sys.argv[1])
    simulation.init(parameter_set=name)
    print(simulation.get_real("collision::friction"))
    simulation.terminate()
    simulation.free()
"""
    done = subprocess.run(
        [sys.executable, "-c", code, tmp_path / "edited.ssp", libtbb()],
        capture_output=True, text=True, check=True, timeout=600,
    )  # fmt: skip
    assert done.stdout.split() == [str(friction), "0.5"]
