"""A host in C (host.c) runs native FMUs in an empty environment, where no Python can be found."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from shipcollision_fmu.toolchain.sources import find_fmi_headers
from tests.compiler import compile_c
from tests.fmi.Dummy import INTERFACE
from tests.toolchain.binary_files import read_library

from .native_fmus import TOKEN

HERE = Path(__file__).resolve().parent


@pytest.fixture(scope="session")
def c_host(tmp_path_factory: pytest.TempPathFactory) -> Path:
    program = tmp_path_factory.mktemp("host") / "host"
    compile_c("-std=c11", "-D_GNU_SOURCE", "-O2", f"-I{find_fmi_headers()}", HERE / "host.c", "-o", program, "-ldl")
    return program


def run(host: Path, folder: Path, fmi: int, location: str, *references: int) -> list[list[str]]:
    library = next((folder / "binaries").glob("*/*.so"))
    done = subprocess.run(
        ["env", "-i", host, library, str(fmi), TOKEN, location, "0.1", "9", *map(str, references)],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    return [line.split() for line in done.stdout.splitlines()]


@pytest.mark.parametrize(("flavour", "first"), [("2", 0), ("3-scalar", 1)])
def test_an_empty_environment_gives_the_values_of_python(
    c_host: Path, native_dummies: dict[str, Path], flavour: str, first: int
) -> None:
    folder, fmi = native_dummies[flavour], int(flavour[0])
    resources = folder / "resources"
    location = resources.as_uri() if fmi == 2 else f"{resources}/"
    rows = run(c_host, folder, fmi, location, first, first + 1, first + 13)
    python = INTERFACE.make_access()
    python.initialise()
    for k, row in enumerate(rows):
        assert [float.fromhex(text) for text in row] == python.get_real([0, 1, 13])
        python.do_step(k * 0.1, 0.1)
    assert len(rows) == 10


def test_the_library_needs_the_c_library_alone(test_library: Path) -> None:
    contents = read_library(test_library.read_bytes())
    assert contents.loads <= {"libc.so.6", "libm.so.6"}
    declared = {
        name
        for header in ("fmi2Functions.h", "fmi3Functions.h")
        for name in re.findall(r"^\s*FMI[23]_Export \w+TYPE\s+(\w+);", (find_fmi_headers() / header).read_text(), re.M)
    }
    assert contents.exports == declared
    assert len(declared) == 44 + 75
