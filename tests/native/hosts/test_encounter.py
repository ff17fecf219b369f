"""Three native FMUs, two ships and their collision, in a host in C with nothing around it (examples/host.c)."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from fmpy import extract

import shipcollision_fmu
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.fmi.names import STATE, named
from shipcollision_fmu.packaging.osp import write_osp
from shipcollision_fmu.scenario.scenario import Scenario, load_scenario
from shipcollision_fmu.toolchain import libraries
from tests.compiler import compile_c, compile_for_windows
from tests.conftest import NATIVE_CACHE

from .test_platforms import ROOT, TARGETS

pytestmark = pytest.mark.slow

HOST = Path(shipcollision_fmu.__file__).resolve().parent.parent / "examples" / "host.c"
PLATFORMS = [
    "linux64", pytest.param("win64", marks=pytest.mark.needs("wine")),
    pytest.param("aarch64-linux", marks=pytest.mark.needs("qemu-aarch64")),
]  # fmt: skip


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    return load_scenario("guan2014_added_mass").changed(algorithm="jacobi")


@pytest.fixture(scope="module")
def package(scenario: Scenario, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folders of the three unpacked FMUs, with libraries for three platforms."""
    folder = tmp_path_factory.mktemp("package")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
        write_osp(scenario, folder / "osp", native=tuple(TARGETS))
    for name in (*scenario.ships, "collision"):
        extract(str(folder / "osp" / f"{name}.fmu"), str(folder / "unpacked" / name))
    return folder / "unpacked"


@pytest.fixture(scope="module")
def ours(scenario: Scenario) -> Run:
    """What our own parallel master makes of native FMUs."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
        return simulate(scenario, engine="native")


@pytest.mark.parametrize("platform", PLATFORMS)
def test_an_encounter_without_python_has_our_masters_bits(
    platform: str, scenario: Scenario, package: Path, ours: Run, wine: Callable[[], dict[str, str]], tmp_path: Path
) -> None:
    program, command, environment, drive = tmp_path / "host.exe", list[str](), dict[str, str](), ""
    if platform == "win64":
        compile_for_windows(program, HOST)
        command, environment, drive = ["wine"], wine(), "Z:"
    else:
        compile_c("-O2", "-o", program, HOST, target=TARGETS[platform])
    if platform == "aarch64-linux":
        command = [str(shutil.which("qemu-aarch64")), "-L", ROOT]
    arguments = [f"{drive}{package}", str(scenario.step), str(scenario.steps), *scenario.ships]
    done = subprocess.run(
        [*command, str(program), *arguments], env=environment, capture_output=True, text=True, check=False, timeout=600
    )
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == 2
    for line in lines:
        name, *values = line.split()
        assert list(map(float, values[:12])) == [ours.states[-1][variable] for variable in named(name, STATE)]
        assert list(map(float, values[12:])) == ours.summary["ledger"][name]["applied"]
    assert "collision" in done.stderr  # the event
