"""Values of native FMUs by FMI 2.0: the Python dummy is their oracle. FMPy simulates them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from fmpy import simulate_fmu

from shipcollision_fmu.fmi.variable_access import VariableAccess
from tests.fmi.Dummy import INTERFACE
from tests.fmi.hosts import Host

from .fmi2_calls import OK, Make


def test_every_value_is_that_of_the_python_model(host: Make) -> None:
    a, python = host(), INTERFACE.make_access()
    a.begin()
    python.initialise()
    (push,) = python.references(["push.x"])
    (open_,) = python.references(["open"])
    for k in range(50):
        for access in (a.fmu.setReal, python.set_real):
            access([push], [math.sin(k)])
        a.fmu.setBoolean([open_], [k % 2])
        python.set_boolean([open_], [bool(k % 2)])
        assert a.step(k) == OK
        python.do_step(k * 0.1, 0.1)
    assert read_everything(a) == read_python(python)
    assert a.messages == []


def read_everything(a: Host) -> list[Any]:
    return [
        [value.hex() for value in a.fmu.getReal(a.kinds["Real"])],
        a.fmu.getInteger(a.kinds["Integer"] + a.kinds["Enumeration"]),
        a.fmu.getBoolean(a.kinds["Boolean"]),
        [text.decode() for text in a.fmu.getString(a.kinds["String"])],
    ]


def read_python(access: VariableAccess) -> list[Any]:
    def of(*kinds: str) -> list[int]:
        return [k for kind in kinds for k, line in enumerate(access.table) if line.kind == kind]

    return [
        [value.hex() for value in access.get_real(of("Real"))],
        access.get_integer(of("Integer", "Enumeration")),
        access.get_boolean(of("Boolean")),
        access.get_string(of("String")),
    ]


def test_start_values_are_those_of_the_table(host: Make) -> None:
    assert read_everything(host()) == read_python(INTERFACE.make_access())


def test_fmpy_simulates_it(native_dummies: dict[str, Path]) -> None:
    rows = {name: simulate_fmu(str(folder), stop_time=1.0, output_interval=0.1, start_values={"push.x": 2.0})
            for name, folder in native_dummies.items() if name != "3"}  # fmt: skip
    assert len(rows["2"]) == 11
    assert rows["2"]["place.x"].tolist() == rows["3-scalar"]["place.x"].tolist()
    arrays = simulate_fmu(str(native_dummies["3"]), stop_time=1.0, output_interval=0.1,
                          start_values={"push": [2.0, 0.0, 0.0]})  # fmt: skip
    assert [row[1][0] for row in arrays.tolist()] == rows["2"]["place.x"].tolist()
