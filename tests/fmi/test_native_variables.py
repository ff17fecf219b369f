"""The table of variables as a native FMU reads it, read back by rules of this test."""

from __future__ import annotations

import shlex
from types import ModuleType
from zlib import crc32

import pytest

from shipcollision_fmu.fmi.arrays import gather_arrays
from shipcollision_fmu.fmi.builder.native_variables import native_variables
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.variable_access import VariableAccess


def split(data: bytes) -> list[list[str]]:
    return [shlex.split(line) for line in data.decode().splitlines()]


@pytest.mark.parametrize("interface", [MANOEUVRING, COLLISION])
@pytest.mark.parametrize(("fmi", "scalar"), [(2, False), (3, False), (3, True)])
def test_a_line_for_each_scalar_and_each_value_reference(interface: object, fmi: int, scalar: bool) -> None:
    assert isinstance(interface, type(MANOEUVRING))
    ships = ("own", "target")
    data = native_variables(interface, ships, fmi=fmi, token="{1}", build="0.1 ab", scalar=scalar)  # type: ignore[arg-type]  # 2 or 3
    lines = split(data)
    table = interface.table(ships)
    assert lines[:3] == [["shipcollision", "variables", "2"], ["fmu", interface.name], ["fmi", str(fmi)]]
    assert lines[4:8] == [["build", "0.1 ab"], ["token", "{1}"], ["ships", *ships], ["scalars", str(len(table))]]
    for line, variable in zip(lines[8:], table, strict=False):
        assert line[:5] == [variable.kind, variable.causality, variable.variability, variable.name, variable.path]
        assert line[5] == ("-" if variable.index is None else str(variable.index))
        assert tuple(line[9:]) == variable.items
        assert (line[6] == "-") == (variable.causality == "output")
    arrays = gather_arrays(table, scalar) if fmi == 3 else ()
    after = lines[8 + len(table) :]
    assert after[:2] == [["presets"], ["references", str(len(arrays))]]
    assert after[2:-1] == [[array.name, *map(str, array.references)] for array in arrays]
    before, _, digest = data.rpartition(b"crc32 ")
    assert int(digest, 16) == crc32(before)
    assert len(digest) == 9


def test_start_values_are_exact_and_limits_are_there(dummy: ModuleType, access: VariableAccess) -> None:
    starts = {"name": 'a "b" \\ ä\n', "method": "bullet", "gain.first": -0.1, "quick": False}
    data = native_variables(dummy.INTERFACE, (), fmi=2, token="", build="", starts=starts)
    lines = {line[3]: line for line in split(data) if len(line) > 8}
    assert float.fromhex(lines["gain.first"][6]) == -0.1
    assert float.fromhex(lines["gain.second"][6]) == 1.0 / 3.0
    assert lines["gain.first"][7:] == [(-1e300).hex(), "-"]
    assert lines["count"][6:] == ["3", "0", "99"]
    assert lines["quick"][6] == "false"
    assert lines["method"][6:] == ["3", "-", "-", "pgs", "closed_form", "bullet"]
    assert rb' "a \"b\" \\ ' + "ä".encode() + rb'\n" ' in data
    assert split(data)[3] == ["tag", access.tag]
    presets = next(line for line in split(data) if line[0] == "presets")
    assert presets[1:] == sorted((str(reference) for reference in access.references(list(starts))), key=int)
