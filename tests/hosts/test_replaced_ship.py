"""A vessel of somebody else's in place of a ship, in Ecos and libcosim: it gets what contact gives, in b and in n."""

from __future__ import annotations

import subprocess
import sys
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.packaging.foreign_ship import read_foreign_ship
from shipcollision_fmu.packaging.osp import write_osp
from shipcollision_fmu.packaging.ssp import write_ssp
from shipcollision_fmu.scenario.scenario import load_scenario
from tests.ship_files import NO_ADDED_MASS, ship_toml

from .encounter import run_master

pytestmark = pytest.mark.slow

MASS, STEP, HEADING = 8.2e6, 0.01, pi / 2 - 0.2
VESSEL = f"""
from math import cos, sin
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Vessel(Fmi2Slave):
    '''A mass in the plane that keeps its heading. It gives velocity and takes force in n, and both in b, too.'''

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.north, self.east, self.heading, self.rate = 5.0, -64.0, {HEADING}, 0.0
        self.vn, self.ve = 4.0 * cos(self.heading), 4.0 * sin(self.heading)
        self.u, self.v = 4.0, 0.0
        self.X = self.Y = self.N = self.Fn = self.Fe = 0.0
        for name in ("north", "east", "heading", "rate", "vn", "ve", "u", "v"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))
        for name in ("X", "Y", "N", "Fn", "Fe"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))

    def do_step(self, t, h):
        c, s = cos(self.heading), sin(self.heading)
        self.vn += h * (self.Fn + c * self.X - s * self.Y) / {MASS}
        self.ve += h * (self.Fe + s * self.X + c * self.Y) / {MASS}
        self.u, self.v = c * self.vn + s * self.ve, -s * self.vn + c * self.ve
        self.north += h * self.vn
        self.east += h * self.ve
        return True
"""
POSE = """
position = ["north", "east", ""]
attitude = ["", "", "heading"]
rate = ["", "", "rate"]
moment = ["", "", "N"]
"""
WIRING = {
    "b": POSE + 'velocity = ["u", "v", ""]\nforce = ["X", "Y", ""]\n',
    "n": POSE + 'velocity = ["vn", "ve", ""]\nforce = ["Fn", "Fe", ""]\nvelocity_frame = "n"\nforce_frame = "n"\n',
}
SCENARIO = f"""
[scenario]
name = "foreign"
duration = 2.0
step = {STEP}

[ships.own]
ship = "./barge.toml"
position = [5.0, -64.0]
heading_deg = {HEADING * 180.0 / pi!r}
speed = 4.0
degrees_of_freedom = 3

[ships.target]
ship = "./barge.toml"
position = [0.0, 0.0]
heading_deg = 0.0
speed = 1.0
degrees_of_freedom = 3

[collision]
friction = 0.3
"""
OBSERVED = [
    *(("own", name) for name in ("vn", "ve", "heading")),
    *(("target", name) for name in ("attitude.yaw", "velocity.surge", "velocity.sway")),
    ("collision", "energy.dissipated"),
]


@pytest.fixture(scope="module")
def packed(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Folder with package.ssp and osp/, by the frame that the vessel speaks."""
    home = tmp_path_factory.mktemp("foreign")
    (home / "Vessel.py").write_text(VESSEL)
    subprocess.run([sys.executable, "-m", "pythonfmu", "build", "-f", "Vessel.py"], cwd=home, check=True)
    (home / "barge.toml").write_text(ship_toml(particulars={"mass": MASS}, added_mass=NO_ADDED_MASS))
    (home / "foreign.toml").write_text(SCENARIO)
    scenario = load_scenario(home / "foreign.toml")
    folders = {}
    for frame, wiring in WIRING.items():
        folders[frame] = home / frame
        folders[frame].mkdir()
        (folders[frame] / "Vessel.fmu").write_bytes((home / "Vessel.fmu").read_bytes())
        (folders[frame] / "Vessel.toml").write_text(wiring)
        foreign = {"own": read_foreign_ship(folders[frame] / "Vessel.fmu")}
        write_ssp(scenario, folders[frame] / "package.ssp", foreign=foreign)
        write_osp(scenario, folders[frame] / "osp", foreign=foreign)
    return folders


@pytest.mark.parametrize("host", ["ecos-ssp", "libcosim-osp"])
def test_momentum_in_n_goes_over_to_the_vessel(packed: dict[str, Path], host: str, tmp_path: Path) -> None:
    """m dv of the vessel and m dv of the barge it strikes add up to nothing in n, whichever frame it speaks. The
    vessel keeps its heading, so that no turn between force and answer blurs the sum. Its force in n is turned at the
    attitude that the collision expects at the end of the step, which is 5e-9 away."""
    cases = [
        {"ssp": str(folder / "package.ssp"), "osp": str(folder / "osp"), "instances": ["own", "target", "collision"],
         "steps": round(2.0 / STEP), "step": STEP, "observed": OBSERVED, "record": True, "connections": []}
        for folder in packed.values()
    ]  # fmt: skip
    ends = []
    for found in run_master(host, cases, tmp_path):
        assert found["impacts"] == 1
        rows = np.array([row for row in found["rows"] if row is not None])
        vn, ve, heading, yaw, u, v, energy = rows[-1]
        assert heading == HEADING
        gained = MASS * np.array([vn - 4.0 * cos(HEADING), ve - 4.0 * sin(HEADING)])
        given = MASS * np.array([u * cos(yaw) - v * sin(yaw) - 1.0, u * sin(yaw) + v * cos(yaw)])
        assert np.linalg.norm(given) > MASS  # more than 1 m/s: it was struck
        np.testing.assert_allclose(gained, -given, atol=1e-3 * np.linalg.norm(given))
        assert energy > 0.0
        ends.append([vn, ve])
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-6)
