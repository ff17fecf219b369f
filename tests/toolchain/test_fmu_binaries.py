"""The libraries inside native FMUs, for every platform: what they export, and that they need the C library alone."""

from __future__ import annotations

import re

import pytest

from shipcollision_fmu.toolchain import libraries
from shipcollision_fmu.toolchain.fmu_binaries import build_binaries, choose_platforms
from shipcollision_fmu.toolchain.platforms import PLATFORMS
from shipcollision_fmu.toolchain.sources import FMUS, find_fmi_headers
from tests.conftest import NATIVE_CACHE
from tests.toolchain.binary_files import list_glibc_versions, read_library

pytestmark = pytest.mark.slow

OLDEST_GLIBC = (2, 17)
LOADS = {".so": {"libc.so.6"}, ".dll": {"ucrtbase.dll"}, ".dylib": {"/usr/lib/libSystem.B.dylib"}}
OF_THE_LINKER = {"__dso_handle", "_mh_dylib_header"}
"""Names that every library of macOS has."""


def declared(version: int) -> set[str]:
    """Names of the functions that a version of FMI declares."""
    text = (find_fmi_headers() / f"fmi{version}Functions.h").read_text(encoding="utf-8")
    return set(re.findall(rf"^\s*FMI{version}_Export\s+\w+\s+(fmi{version}\w+);", text, re.MULTILINE))


@pytest.mark.parametrize("name", FMUS)
def test_every_platform_exports_fmi_alone_and_needs_the_c_library_alone(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
    built = build_binaries(name, choose_platforms(tuple(PLATFORMS)))
    assert {one.folder for one in built[2]} == set(PLATFORMS)
    functions = declared(2) | declared(3)
    assert len(functions) > 100
    for one in built[3]:
        found = read_library(one.content)
        assert found.exports - OF_THE_LINKER <= functions, one.folder
        assert {"fmi2DoStep", "fmi3DoStep", "fmi2GetFMUstate", "fmi3GetClock"} <= found.exports, one.folder
        assert found.loads == LOADS[one.suffix], one.folder
        assert all(version <= OLDEST_GLIBC for version in list_glibc_versions(one.content)), one.folder
        assert found.is_signed == (one.folder == "aarch64-darwin")  # its loader refuses what is not
    universal = next(one for one in built[2] if one.folder == "darwin64")
    for one in built[3]:
        assert one.folder.endswith("-darwin") == (one.content in universal.content)
