"""Three native FMUs, two ships and their collision, in a host in C with nothing around it (examples/host.c); the FMU of
the collision in FMI 3.0 as well, in play.c."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract

import shipcollision_fmu
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.fmi.builder.native_fmus import build_native_fmus
from shipcollision_fmu.fmi.names import STATE, named
from shipcollision_fmu.packaging.osp import write_osp
from shipcollision_fmu.scenario.scenario import Scenario, load_scenario
from shipcollision_fmu.toolchain import libraries
from tests.compiler import compile_c, compile_for_windows
from tests.conftest import NATIVE_CACHE

from .player import PLATFORMS, ROOT, TARGETS, Play, Wine
from .script import STEP, from_bits, write_encounter

pytestmark = pytest.mark.slow

HOST = Path(shipcollision_fmu.__file__).resolve().parent.parent / "examples" / "host.c"


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
    platform: str, scenario: Scenario, package: Path, ours: Run, wine: Wine, tmp_path: Path
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


SHIPS = {"own": "guan2014_own", "target": "kcs"}
FLAVOURS = {"2": (2, False), "3": (3, False), "3-scalar": (3, True)}
GIVEN = ("position", "attitude", "velocity", "rate")


@pytest.fixture(scope="module")
def collisions(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """FMUs of the collision by flavour, unpacked, with libraries for three platforms."""
    home, made = tmp_path_factory.mktemp("collision sjø"), dict[str, Path]()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
        for flavour, (fmi, scalar) in FLAVOURS.items():
            built = build_native_fmus(home, fmi=fmi, scalar=scalar, platforms=list(TARGETS), names=["ShipCollision"])
            made[flavour] = Path(extract(str(built["ShipCollision"]), str(home / flavour)))
    return made


@pytest.fixture(scope="module")
def collided() -> tuple[list[dict[str, list[float]]], list[float]]:
    """What the Python model receives in each of 20 steps of a bow in a side, and what it gives in the end. The ships
    adopt the states given."""
    model, received, given = ShipCollision(tuple(SHIPS)), list[dict[str, list[float]]](), list[float]()
    own, target = model.inputs.ships
    for parameters, ship in zip(model.parameters.ships, SHIPS.values(), strict=True):
        parameters.ship, parameters.feedback = ship, "state"
    own.position[:], own.attitude[:], own.velocity[:] = [0.0, -163.0, 0.0], [0.0, 0.0, 1.5], [6.0, 0.0, 0.0]
    target.position[:], target.velocity[:] = [-10.0, 0.0, 0.0], [3.0, 0.2, 0.0]
    model.initialise()
    contacts = 0
    for k in range(20):
        received.append({
            f"{name}.{part}": list(getattr(ship, part))
            for name, ship in zip(SHIPS, model.inputs.ships, strict=True) for part in GIVEN
        })  # fmt: skip
        model.step(k * STEP, STEP)
        contacts += model.outputs.contact_count > 0
        for ship, post in zip(model.inputs.ships, model.outputs.ships, strict=True):
            for part in GIVEN:
                getattr(ship, part)[:] = getattr(post, part)
    for post in model.outputs.ships:
        given += [value for part in GIVEN for value in getattr(post, part)]
    model.close()
    assert contacts > 5
    assert model.outputs.collision_count == 1
    return received, given


@pytest.mark.parametrize("platform", PLATFORMS)
@pytest.mark.parametrize("flavour", list(FLAVOURS))
def test_the_fmu_of_the_collision_has_the_same_bits_on_each_platform(
    platform: str, flavour: str, play: Play, collisions: dict[str, Path],
    collided: tuple[list[dict[str, list[float]]], list[float]],
) -> None:  # fmt: skip
    """Digests of its state are those of linux64, its outputs those of FMI 2.0 and, to 1e-9, of the Python model."""
    received, given = collided
    outputs = [f"{name}.post.{part}" for name in SHIPS for part in GIVEN]
    script = {key: write_encounter(collisions[key], SHIPS, received, outputs) for key in (flavour, "2")}
    lines, first = (play(on, collisions[key], script[key]) for on, key in ((platform, flavour), ("linux64", "2")))
    digests, values = lines[:4], [from_bits(word) for line in lines[4:] for word in line.split()]
    assert len(set(digests)) == 4
    assert digests == play("linux64", collisions[flavour], script[flavour])[:4]
    assert values == [from_bits(word) for line in first[4:] for word in line.split()]
    for k in range(0, len(given), 3):
        assert values[k : k + 3] == pytest.approx(given[k : k + 3], abs=1e-9 * np.abs(given[k : k + 3]).max())
