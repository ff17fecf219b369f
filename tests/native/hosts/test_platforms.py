"""The native FMU in hosts without Python on each platform that can be run here: the same bits everywhere.

linux64 runs in an empty environment, and once in a root folder that has no Python at all. win64 runs under Wine,
aarch64-linux under QEMU. The expected motion is that of the Python model.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract

from shipcollision_fmu.fmi.builder.native_fmus import build_native_fmus
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.toolchain import libraries
from shipcollision_fmu.toolchain.sources import find_fmi_headers, find_native
from tests.compiler import compile_c, compile_for_windows
from tests.native.conftest import CACHE
from tests.native.hosts.player import PLATFORMS, TARGETS, Play, Wine
from tests.native.hosts.script import STEP, from_bits, write_voyage

pytestmark = pytest.mark.slow

FLAVOURS = {"2": (2, False), "3": (3, False), "3-scalar": (3, True)}


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The native FMUs of three platforms, unpacked in folders with blanks, percent signs and letters beyond ASCII."""
    home = tmp_path_factory.mktemp("native 100% sjø")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(libraries, "native_cache", lambda: CACHE)
        return {
            flavour: Path(extract(
                build_native_fmus(
                    home, fmi=fmi, scalar=scalar, platforms=list(TARGETS), names=["ShipManoeuvring"]
                )["ShipManoeuvring"],
                home / flavour,
            ))
            for flavour, (fmi, scalar) in FLAVOURS.items()
        }  # fmt: skip


def vectors(lines: list[str]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """The twelve states at the end of what a script printed."""
    return np.array([from_bits(word) for line in lines[10:] for word in line.split()])


@pytest.fixture(scope="module")
def digests(play: Play, unpacked: dict[str, Path]) -> list[str]:
    """What linux64 prints in FMI 2.0."""
    return play("linux64", unpacked["2"], write_voyage(unpacked["2"]))


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_a_host_without_python_moves_the_ship_as_the_python_model(
    play: Play, unpacked: dict[str, Path], degrees_of_freedom: int
) -> None:
    lines = play("linux64", unpacked["2"], write_voyage(unpacked["2"], degrees_of_freedom))
    ship = ShipManoeuvring()
    p, i, o = ship.parameters, ship.inputs, ship.outputs
    p.hydrodynamics, p.degrees_of_freedom = True, degrees_of_freedom
    p.initial_velocity[0], p.initial_attitude[2] = 7.0, 0.3
    i.propeller_order, i.current[:], i.wind_speed, i.wind_direction = 1.2, [0.4, -0.7], 14.0, 2.1
    ship.initialise()
    for k in range(400):
        i.rudder_order = 0.5 if k % 200 < 120 else -0.4
        if k == 100:
            i.impulse[:] = [-3e8, 1.5e8, 1e6, 2e8, -3e8, 4e10]
        ship.step(k * STEP, STEP)
    expected = np.array([*o.position, *o.attitude, *o.velocity, *o.rate])
    scale = np.repeat([np.abs(expected[k : k + 3]).max() for k in (0, 3, 6, 9)], 3)
    assert np.abs((vectors(lines) - expected) / scale).max() < 1e-9
    assert len(set(lines[:10])) == 10


@pytest.mark.parametrize("platform", PLATFORMS)
@pytest.mark.parametrize("flavour", list(FLAVOURS))
def test_the_same_bits_on_each_platform(
    play: Play, unpacked: dict[str, Path], digests: list[str], platform: str, flavour: str
) -> None:
    """States and digests, in FMI 2.0; in FMI 3.0 a state has another table, so its digests are those of linux64."""
    script = write_voyage(unpacked[flavour])
    lines = play(platform, unpacked[flavour], script)
    assert vectors(lines).tolist() == vectors(digests).tolist()
    assert lines == (digests if flavour == "2" else play("linux64", unpacked[flavour], script))


def test_a_root_folder_without_python(
    play: Play, unpacked: dict[str, Path], digests: list[str], tmp_path: Path
) -> None:
    """Only the host, the FMU and the C library are there."""
    inside = tmp_path / "root"
    shutil.copytree(unpacked["2"], inside / "fmu")
    program = tmp_path / "host"
    compile_c("-O1", f"-I{find_fmi_headers()}", "-o", program, Path(__file__).with_name("play.c"), "-ldl")
    shutil.copy(program, inside / "host")
    needed = subprocess.run(["ldd", str(program)], capture_output=True, text=True, check=True).stdout
    for line in needed.splitlines():
        for word in line.split():
            if word.startswith("/"):
                place = inside / word[1:]
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(word, place)
    assert not list(inside.rglob("*python*"))
    script = write_voyage(unpacked["2"])
    chroot = str(shutil.which("chroot", path="/usr/sbin:/sbin:/usr/bin"))
    enter = [chroot] if os.geteuid() == 0 else [str(shutil.which("unshare")), "--map-root-user", chroot]
    library, resources = "/fmu/binaries/linux64/ShipManoeuvring.so", "file:///fmu/resources"
    done = subprocess.run(
        [*enter, str(inside), "/host", "2", library, script.token, resources], input=script.text.encode(),
        capture_output=True, check=False, timeout=600, env={},
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.decode().split("\n")[:-1] == digests


LONG = "x" * 300
WIDE = {
    "Z:/tmp/./a/../b": r"Z:\tmp\b",
    rf"Z:/tmp/sjø//{LONG}/../{LONG}": rf"\\?\Z:\tmp\sjø\{LONG}",
    rf"\\server\share/{LONG}/.": rf"\\?\UNC\server\share\{LONG}",
    rf"\\?\Z:\tmp/{LONG}": rf"\\?\Z:\tmp\{LONG}",
    r"\\?\Z:\tmp/船": r"\\?\Z:\tmp\船",
    f"Z:/{'x' * 4096}": "none",
    f"{LONG}/relative": rf"\\?\Z:\tmp\{LONG}\relative",
}
"""Paths as hosts give them, and as Windows opens them: one with the prefix is taken as it is, in its own separators."""


@pytest.mark.needs("wine")
def test_what_windows_alone_has(wine: Wine, tmp_path: Path) -> None:
    """Paths of any length, and functions whose frame is larger than the page by which a stack grows."""
    program = tmp_path / "parts.exe"
    compile_for_windows(program, Path(__file__).with_name("windows_parts.cpp"), find_native() / "wide_path.cpp")
    done = subprocess.run(
        ["wine", program, *WIDE], env=wine(), cwd="/tmp", capture_output=True, text=True, check=False, timeout=600
    )
    assert done.stdout.splitlines() == [*WIDE.values(), "frames"]
    assert (done.returncode, done.stderr) == (0, "")
