"""Contact detection on the platforms that can be run here: the same bits on each."""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.geometry.bullet import BulletAdapter
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.objects import compile_object
from shipcollision_fmu.toolchain.platforms import PLATFORMS, Target, find_own_target
from shipcollision_fmu.toolchain.sources import Part, find_native, list_library_parts
from tests.native.conftest import CACHE

from .test_closest_points import hulls, random_pair

__all__ = ["hulls"]

pytestmark = [pytest.mark.slow, pytest.mark.needs("pybullet")]
ROOT = "/usr/aarch64-linux-gnu"
"""Where Debian puts the C library of ARM for QEMU."""


def as_bits(numbers: object) -> str:
    """Doubles as the hexadecimal digits of their bits."""
    return " ".join(f"{struct.unpack('<Q', struct.pack('<d', one))[0]:016x}" for one in np.ravel(numbers))  # type: ignore[arg-type]  # arrays and numbers


NEEDED = ("numbers/", "ship/", "memory.", "files.", "folder.", "wide_path.")
"""Of native/, what detection needs beside its own room."""


def compile_program(name: str, target: Target, folder: Path, place: Path) -> Path:
    """A program of a place with the sources of the collision model, for a target; by Zig unless it is this machine."""
    compiler = find_compiler(target, prefer_system=target == find_own_target())
    native, (rest, collision, bullet) = find_native(), list_library_parts(CACHE)
    needed = Part(native, tuple(file for file in rest.files if file.startswith(NEEDED)))
    parts = [needed, collision, bullet, Part(place, (f"{name}.cpp",), includes=(native,))]
    objects = [compile_object(part, file, target, compiler, CACHE / "objects") for part in parts for file in part.files]
    program = folder / f"{name}{'.exe' if target.is_windows else ''}"
    subprocess.run([*compiler.link, *objects, "-o", program], env=os.environ | dict(compiler.environment), check=True)
    return program


@pytest.fixture(scope="module")
def ships(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Prepared files, of which two ships have hulls of several parts."""
    folder = tmp_path_factory.mktemp("ships")
    places = [folder / f"{name}.ship" for name in ("kvlcc2", "kcs", "guan2014_own", "buoy", "floating_log")]
    for place in places:
        place.write_bytes(prepare_ship(place.stem))
    return places


def run(
    platform: str, name: str, arguments: Sequence[str], told: str, folder: Path, place: Path = Path(__file__).parent
) -> str:
    """What a program for a platform prints."""
    command = [str(compile_program(name, PLATFORMS[platform].targets[0], folder, place)), *arguments]
    environment = dict(os.environ)
    if platform == "win64":
        prefix = folder.parent / "wine"  # one for all tests of a run
        environment |= {"WINEPREFIX": str(prefix), "WINEDEBUG": "-all"}
        if not prefix.is_dir():
            begin = ["wine", "wineboot", "--init"]
            subprocess.run(begin, env=environment, capture_output=True, check=True, timeout=600)
        command = ["wine", *command]
    if platform == "aarch64-linux":
        command = [str(shutil.which("qemu-aarch64")), "-L", ROOT, *command]
    done = subprocess.run(
        command, input=told, capture_output=True, text=True, timeout=300, env=environment, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize(
    "platform",
    [
        pytest.param("win64", marks=pytest.mark.needs("wine")),
        pytest.param("aarch64-linux", marks=pytest.mark.needs("qemu-aarch64")),
    ],
)
def test_bits_are_the_same(platform: str, hulls: list[HullMesh], ships: list[Path], tmp_path: Path) -> None:
    """Closest points are PyBullet's; contacts and first touches are those of this machine."""
    random, theirs = np.random.default_rng(18), BulletAdapter(hulls)
    parts = [part for hull in hulls for part in hull.parts]
    told = [str(len(hulls)), *(str(len(hull.parts)) for hull in hulls), *(str(len(part)) for part in parts)]
    told += map(as_bits, parts)
    expected = []
    for _ in range(1000):
        a, b, states, distance = random_pair(random, hulls)
        for ship in (a, b):
            told.append(f"{ship} {as_bits(states[ship].x)} {as_bits(states[ship].R)}")
        told.append(as_bits(distance))
        for c in theirs.closest(a, b, states, distance):
            expected.append(f"{as_bits([*c.on_a, *c.on_b, *c.normal, c.gap])} {c.part_a} {c.part_b}")
        expected.append(".")
    theirs.close()
    assert run(platform, "closest", (), "\n".join(told), tmp_path).splitlines() == expected
    assert len(expected) > 1700  # 832 closest points in 1000 questions
    detect = ["1000", *map(str, ships)]
    digest = run("linux64", "detect", detect, "", tmp_path)
    assert run(platform, "detect", detect, "", tmp_path) == digest
    contacts, touches = (int(part.split()[0]) for part in digest[17:].split(", "))
    assert contacts > 500
    assert touches > 500
