"""Random encounters of the native collision under the sanitizers of addresses and of undefined behaviour."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.objects import compile_object
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import Part, list_library_parts
from tests.compiler import compile_c
from tests.native.collision.kernels import CACHE, HERE
from tests.native.fmi.test_exercise import CONTACT

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library of load_kernels(), compiled under sanitizers but for the code of others."""
    target, made = find_own_target(), tmp_path_factory.mktemp("sanitized") / "library.so"
    assert target is not None
    compiler = find_compiler(target, prefer_system=True)
    files = tuple(sorted(path.name for path in HERE.glob("kernels_*.cpp")))
    sources = [
        (part if "-w" in part.flags else replace(part, flags=(*part.flags, *CONTACT)), file)
        for part in (*list_library_parts(CACHE), Part(HERE, files))
        for file in part.files
    ]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        objects = list(pool.map(lambda source: compile_object(*source, target, compiler, CACHE / "objects"), sources))
    compile_c(*CONTACT, "-shared", *objects, "-o", made)
    return made


@pytest.mark.needs("g++")
@pytest.mark.parametrize(
    ("first", "last"),
    [pytest.param(0, 200, marks=pytest.mark.slow)]
    + [pytest.param(1000 * k, 1000 * (k + 1), marks=pytest.mark.soak) for k in range(10)],
)
def test_random_encounters(library: Path, first: int, last: int) -> None:
    found = [
        subprocess.run(
            ["gcc", f"-print-file-name={name}.so"], capture_output=True, text=True, check=True
        ).stdout.strip()
        for name in ("libasan", "libubsan")
    ]
    environment = {**os.environ, "LD_PRELOAD": " ".join(found), "ASAN_OPTIONS": "detect_leaks=0"}  # Python's own remain
    command = [sys.executable, "-m", "tests.native.collision.sanitized_encounters", str(library), str(first), str(last)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=3600)
    assert (done.returncode, done.stderr[-3000:]) == (0, "")
    numbers = re.fullmatch(r"(\d+) encounters, (\d+) with contact\n", done.stdout)
    assert numbers is not None
    encounters, touched = map(int, numbers.groups())
    assert encounters == last - first
    assert touched > 0.2 * encounters
