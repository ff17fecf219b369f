"""What a host makes of our FMU's refusal: of a parameter that cannot be, and of a step that cannot be made.

FMI 2.0 through pythonfmu has two answers, fmi2Fatal at initialisation and fmi2Discard in a step. Hosts differ in what
they show of the line that goes with it; Ecos shows nothing and drops the status, so that the line is wanted on stderr.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from .encounter import Encounter
from .masters import MASTERS, libtbb

REFUSED = "unknown ship 'guan2014_oown': did you mean guan2014_own?"


def said_by(code: str, *arguments: object, **environment: str) -> tuple[int, str]:
    """Exit status and output of Python code in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)],
        capture_output=True, text=True, check=False, timeout=600, env=os.environ | environment,
    )  # fmt: skip
    return done.returncode, done.stdout + done.stderr


@pytest.mark.slow
def test_fmpy_raises_and_its_log_has_the_line(encounters: dict[str, Encounter]) -> None:
    code = """
import sys
from fmpy import simulate_fmu
try:
    simulate_fmu(sys.argv[1], start_values={"ship": "guan2014_oown"}, stop_time=0.1, debug_logging=True)
except Exception as error:
    print("RAISED", error)
"""
    status, said = said_by(code, encounters["guan2014"].folder / "osp" / "own.fmu")
    assert status == 0
    assert "RAISED fmi2ExitInitializationMode failed with status 4 (fatal)." in said
    assert f"ShipManoeuvring cannot be initialised: {REFUSED}" in said


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in ("libcosim",) if f"{name}-osp" in MASTERS])
def test_libcosim_logs_the_line_and_ends_the_process(
    encounters: dict[str, Encounter], tmp_path: Path, name: str
) -> None:
    """It throws on a worker thread, where nothing catches: std::terminate is libcosim's doing."""
    shutil.copytree(encounters["guan2014"].folder / "osp", tmp_path / name)
    system = tmp_path / name / "OspSystemStructure.xml"
    system.write_text(system.read_text().replace('<String value="guan2014_own"', '<String value="guan2014_oown"'))
    code = """
import sys
from libcosimpy.CosimExecution import CosimExecution
CosimExecution.from_osp_config_file(sys.argv[1]).step()
"""
    status, said = said_by(code, tmp_path / name)
    assert status == -6
    assert f"[FMI status=error, category=logStatusError] {REFUSED}" in said
    assert "what():  Model error: Fatal py exception encountered: [exitInitializationMode]" in said


ECOS = """
import ctypes, sys
ctypes.CDLL(sys.argv[3])
from ecospy import EcosSimulation
simulation = EcosSimulation(0.05, ssp_path=sys.argv[1])
if sys.argv[2] == "parameter":
    simulation.set_string("own::ship", "guan2014_oown")
print("INIT", simulation.init())
if sys.argv[2] == "step":
    simulation.set_real("own::force.surge", float("nan"))
simulation.step()
print("NORTH", simulation.get_real("own::position.north"))
simulation.terminate()
simulation.free()
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "line", "north"),
    [
        ("parameter", f"own.fmu: {REFUSED}", "nan"),
        ("step", "own.fmu: force = [nan, 0.0, 0.0, 0.0, 0.0, 0.0] at t = 0 s must be finite", "as at the start"),
    ],
)
def test_ecos_hides_the_line_unless_it_is_wanted_on_stderr(
    encounters: dict[str, Encounter], fault: str, line: str, north: str
) -> None:
    """Ecos calls an instance by the path of its FMU."""
    package = encounters["guan2014"].folder / "package.ssp"
    with ThreadPoolExecutor(2) as pool:
        hidden = pool.submit(said_by, ECOS, package, fault, libtbb())
        status, said = said_by(ECOS, package, fault, libtbb(), SHIPCOLLISION_LOG="stderr")
    assert status == 0
    assert line in said
    start = encounters["guan2014"].scenario.ships["own"].start.position[0]
    assert f"NORTH {start if north == 'as at the start' else north}\n" in said
    _, said = hidden.result()
    assert "INIT True" in said
    assert line not in said
