"""Closest points on the platforms that can be run here: PyBullet's bits on each."""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.geometry.bullet import BulletAdapter
from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.objects import compile_object
from shipcollision_fmu.toolchain.platforms import PLATFORMS
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


def compile_program(platform: str, folder: Path) -> Path:
    """closest.cpp with the sources of closest points, for a platform, by Zig."""
    target = PLATFORMS[platform].targets[0]
    compiler = find_compiler(target)
    native, (_, collision, bullet) = find_native(), list_library_parts(CACHE)
    parts = [
        Part(native, ("memory.cpp",)), collision, bullet,
        Part(Path(__file__).parent, ("closest.cpp",), includes=(native,)),
    ]  # fmt: skip
    objects = [compile_object(part, file, target, compiler, CACHE / "objects") for part in parts for file in part.files]
    program = folder / ("closest.exe" if target.is_windows else "closest")
    subprocess.run([*compiler.link, *objects, "-o", program], env=os.environ | dict(compiler.environment), check=True)
    return program


@pytest.mark.parametrize(
    "platform",
    [
        pytest.param("win64", marks=pytest.mark.needs("wine")),
        pytest.param("aarch64-linux", marks=pytest.mark.needs("qemu-aarch64")),
    ],
)
def test_closest_points_have_pybullets_bits(platform: str, hulls: list, tmp_path: Path) -> None:
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
    command, environment = [str(compile_program(platform, tmp_path))], dict(os.environ)
    if platform == "win64":
        environment |= {"WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all"}
        subprocess.run(["wine", "wineboot", "--init"], env=environment, capture_output=True, check=True, timeout=600)
        command = ["wine", *command]
    if platform == "aarch64-linux":
        command = [str(shutil.which("qemu-aarch64")), "-L", ROOT, *command]
    done = subprocess.run(
        command, input="\n".join(told), capture_output=True, text=True, timeout=300, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == expected
    assert len(expected) > 1700  # 832 closest points in 1000 questions
