"""The examples run as a user runs them, and do what they say."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract

import shipcollision_fmu
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.fmi.names import STATE, named
from shipcollision_fmu.packaging.osp import write_osp
from shipcollision_fmu.scenario.scenario import load_scenario
from tests.compiler import compile_c
from tests.needs import shared_libpython

EXAMPLES = Path(shipcollision_fmu.__file__).resolve().parent.parent / "examples"
NUMBER = r"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"


def said(*command: object, **environment: str) -> str:
    """What a command prints; it must end well."""
    done = subprocess.run(
        list(map(str, command)), capture_output=True, text=True, check=False, timeout=1200,
        env=os.environ | environment, cwd="/",
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def numbers(pattern: str, text: str) -> list[tuple[float, ...]]:
    """The numbers of every line that matches, in which # stands for one."""
    return [tuple(map(float, found.groups())) for found in re.finditer(pattern.replace("#", NUMBER), text)]


def test_own_loop() -> None:
    text = said(sys.executable, EXAMPLES / "own_loop.py")
    ((time, angle),) = numbers(r"impact at # s, # rad", text)
    assert time == pytest.approx(8.21, abs=0.02)
    assert angle == pytest.approx(np.pi / 2, abs=1e-3)
    lines = numbers(r"# m/s ahead, # m/s to starboard; issued - applied: # N s", text)
    assert [line[2] for line in lines] == [0.0, 0.0]
    assert lines[0][0] < 3.0  # own came with 5 m/s
    assert lines[1][1] < -1.0  # and the target is pushed to port


def test_a_foreign_vessel_takes_the_force() -> None:
    text = said(sys.executable, EXAMPLES / "foreign_vessel.py")
    assert numbers(r"impact at # s", text)[0][0] > 8.0
    impulses = numbers(r"issued # MN s, force times time # MN s", text)
    assert len(impulses) == 2
    assert all(issued == taken != 0.0 for issued, taken in impulses)
    own, target = numbers(r"# m/s ahead, # m/s to starboard", text)
    assert own[0] < 3.0
    assert target[1] < -1.0


def test_a_simulator_adopts_the_state() -> None:
    text = said(sys.executable, EXAMPLES / "adopt_state.py")
    ((time, steps),) = numbers(r"impact at # s, # steps in contact", text)
    assert time == pytest.approx(8.21, abs=0.02)
    assert steps >= 1
    assert numbers(r"energy lost: # MJ", text)[0][0] > 1000.0
    own, target = numbers(r"# m/s ahead, # m/s to starboard", text)
    assert own[0] < 3.0
    assert target[1] < -1.0


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMUs of guan2014's package, unpacked."""
    folder = tmp_path_factory.mktemp("native")
    write_osp(load_scenario("guan2014"), folder / "osp")
    for name in ("own", "target", "collision"):
        extract(str(folder / "osp" / f"{name}.fmu"), str(folder / "unpacked" / name))
    return folder / "unpacked"


@pytest.mark.slow
@pytest.mark.needs("pybullet")
def test_libcosim_steps_the_folder_as_our_parallel_master_does(unpacked: Path) -> None:
    """And the guide shows the example's code."""
    text = said(sys.executable, EXAMPLES / "osp_folder.py", unpacked.parent / "osp")
    ours = simulate(load_scenario("guan2014").changed(algorithm="jacobi"), in_process=True)
    ((energy,),) = numbers(r"energy lost to contact: # MJ", text)
    lost = ours.summary["energy"]["dissipated"]
    assert energy == pytest.approx(lost / 1e6, abs=6e-4)
    code = (EXAMPLES / "osp_folder.py").read_text(encoding="utf-8").split('"""', 2)[2].strip()
    assert code in (EXAMPLES.parent / "docs" / "guide" / "hosts.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """examples/host.c compiled."""
    program = tmp_path_factory.mktemp("host") / "host"
    compile_c("-O2", "-o", program, EXAMPLES / "host.c", "-ldl")
    return program


@pytest.mark.needs("libpython", "pybullet")
def test_a_host_in_c_gives_our_bits(host: Path, unpacked: Path) -> None:
    """In the environment in which a native host finds Python and the packages."""
    scenario = load_scenario("guan2014").changed(algorithm="jacobi")
    environment = {"LD_PRELOAD": str(shared_libpython()), "PYTHONPATH": sysconfig.get_path("purelib")}
    text = said(host, unpacked, scenario.step, scenario.steps, *scenario.ships, **environment)
    ours = simulate(scenario, in_process=True)
    for line in text.splitlines():
        name, *values = line.split()
        states, applied = list(map(float, values[:12])), list(map(float, values[12:]))
        assert states == [ours.states[-1][variable] for variable in named(name, STATE)]
        assert applied == ours.summary["ledger"][name]["applied"]
    assert len(text.splitlines()) == 2


def test_a_host_in_c_that_lacks_python_says_so(host: Path, unpacked: Path) -> None:
    done = subprocess.run([host, unpacked, "0.05", "1", "own", "target"], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "undefined symbol: _Py_NoneStruct" in done.stderr
