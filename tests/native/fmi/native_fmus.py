"""Native FMUs of the test models, as a host unpacks them: a library, its resources and its description."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Literal

from shipcollision_fmu.fmi.builder.model_description import to_bytes
from shipcollision_fmu.fmi.builder.model_description_fmi2 import model_description as model_description_fmi2
from shipcollision_fmu.fmi.builder.model_description_fmi3 import model_description as model_description_fmi3
from shipcollision_fmu.fmi.builder.native_variables import VARIABLES, native_variables
from shipcollision_fmu.fmi.interface import Interface
from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.libraries import build_library
from shipcollision_fmu.toolchain.objects import compile_object
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import Part, find_fmi_headers, find_native
from tests.compiler import compile_c

__all__ = ["BUILD", "TOKEN", "build_exercise", "build_test_library", "list_test_sources", "write_fmu"]

HERE = Path(__file__).resolve().parent
TOKEN = "{00000000-1111-2222-3333-444444444444}"
BUILD = "0.1.0 of the tests"
_MODELS = ("fmi/framed_collision.cpp", "fmi/ship_collision.cpp", "fmi/ship_manoeuvring.cpp")
"""Sources whose place the test models take."""
_BINARIES: dict[int, str] = {2: "linux64", 3: "x86_64-linux"}


def list_test_sources() -> list[Part]:
    """All that a library of the test models is made from."""
    native = find_native()
    found = (path.relative_to(native) for path in native.rglob("*.cpp"))
    layer = [path.as_posix() for path in found if path.parts[0] in ("fmi", "numbers", "files.cpp", "memory.cpp")]
    files = tuple(sorted(name for name in layer if name not in _MODELS))
    return [Part(native, files, includes=(find_fmi_headers(),)), Part(HERE, ("models.cpp",), includes=(native,))]


def build_test_library(cache: Path) -> Path:
    """The library of the test models for this machine."""
    target = find_own_target()
    assert target is not None
    return build_library("Dummy", list_test_sources(), target, ("fmi2*", "fmi3*"), cache=cache, prefer_system=True)


def write_fmu(
    folder: Path, library: Path | None, interface: Interface, fmi: Literal[2, 3] = 2, *, scalar: bool = False
) -> Path:
    """The folder of an FMU of that interface; without a library its binaries are left out."""
    describe = model_description_fmi2 if fmi == 2 else model_description_fmi3
    options = {"scalar": scalar} if fmi == 3 else {}
    description = describe(interface, (), TOKEN, **options)
    description_capabilities = description.find("CoSimulation")
    assert description_capabilities is not None
    description_capabilities.attrib.pop("needsExecutionTool", None)
    (folder / "resources").mkdir(parents=True)
    (folder / "modelDescription.xml").write_bytes(to_bytes(description))
    table = native_variables(interface, (), fmi=fmi, token=TOKEN, build=BUILD, scalar=scalar)
    (folder / "resources" / VARIABLES).write_bytes(table)
    if library is not None:
        binaries = folder / "binaries" / _BINARIES[fmi]
        binaries.mkdir(parents=True)
        shutil.copy(library, binaries / f"{interface.name}.so")
    return folder


def build_exercise(
    cache: Path, folder: Path, *flags: str, parts: Sequence[Part] | None = None, token: str = TOKEN
) -> Path:
    """The program exercise.c, linked with the FMI layer by g++, with flags for both, such as of a sanitizer.

    `parts` are sources in place of those of the test models, `token` that of the FMUs made of them.
    """
    target, headers = find_own_target(), find_fmi_headers()
    assert target is not None
    compiler = find_compiler(target, prefer_system=True)
    sources = [
        (part if "-w" in part.flags else replace(part, flags=(*part.flags, *flags)), file)  # not code of others
        for part in parts or list_test_sources()
        for file in part.files
    ]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        objects = list(pool.map(lambda source: compile_object(*source, target, compiler, cache / "objects"), sources))
    program = folder / "exercise"
    options = "-std=c11", "-D_GNU_SOURCE", "-O2", *flags, f'-DTOKEN="{token}"', f"-I{headers}"
    compile_c(*options, HERE / "exercise.c", *objects, "-o", program, "-lm", "-lpthread")
    return program
