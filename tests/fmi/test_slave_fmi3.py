"""What a host sees of an FMI 3.0 slave, through fmpy: arrays, statuses, log, values, state, unsupported calls.

Of the slave in Python and of its twin in C++, but for what the wrapper of Python does in its own way (OF_PYTHON).
"""

from __future__ import annotations

import math
import signal
import subprocess
import sys
from collections.abc import Callable
from ctypes import byref, c_bool, c_char_p, c_double, c_size_t, c_uint, c_void_p
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from .conftest import OF_PYTHON
from .hosts import Host

OK, WARNING, DISCARD, ERROR, FATAL = 0, 1, 2, 3, 4
Make = Callable[..., Any]


def test_the_description_is_valid_and_has_arrays(unpacked3: Path) -> None:
    assert validate_fmu(str(unpacked3)) == []
    description = read_model_description(str(unpacked3))
    shapes = {v.name: [int(d.start) for d in v.dimensions] for v in description.modelVariables}
    assert shapes["place"] == shapes["push"] == [3]
    assert shapes["steps"] == shapes["gain.first"] == []
    assert [v.name for v in description.modelVariables if v.causality == "independent"] == ["time"]
    assert [[d.name for d in u.dependencies] for u in description.initialUnknowns if u.variable.name == "place"] == [
        ["gain.first", "gain.second"]
    ]
    assert all(unknown.dependencies == [] for unknown in description.outputs)


def test_start_values_in_the_xml_are_those_of_an_instance(host3: Make) -> None:
    a = host3()
    for name, variable in a.variables.items():
        if variable.causality not in ("input", "parameter"):
            assert variable.start is None
            continue
        values = a.get(name)
        if variable.type == "String":
            assert values == [variable.start]
        elif variable.type == "Boolean":
            assert [str(value).lower() for value in values] == [variable.start]
        else:
            assert [float(value) for value in values] == [float(text) for text in variable.start.split()]


def test_runs_with_arrays_as_the_fmi2_slave_does_with_scalars(host3: Make, unpacked: Path) -> None:
    a, b = host3(), Host(unpacked, "two")
    try:
        a.set("gain.second", math.pi)
        b.fmu.setReal(b.reference("gain.second"), [math.pi])
        assert (a.begin(), b.begin()) == (OK, OK)
        for k in range(20):
            a.set("push", 0.1 * k, -1.0, 1e-300)
            b.fmu.setReal(b.reference("push.x", "push.y", "push.z"), [0.1 * k, -1.0, 1e-300])
            status, _, last = a.step_from(k * 0.1, 0.1)
            assert (status, b.step(k)) == (OK, OK)
            assert a.get("place") == b.place()
        assert a.get("time") == [last] == [19 * 0.1 + 0.1]
        assert a.get("steps") == [23]
        assert a.get("moving") == [True]
        assert a.get("said") == [f"start {19 * 0.1}"]
        assert a.get("phase") == [2]
        assert a.get("gain.first", "place") == [0.1, *b.place()]
    finally:
        b.free()
    assert a.messages == []


def test_enumerations_count_from_one(host3: Make) -> None:
    a = host3()
    a.set("method", 3)
    assert a.get("method") == [3]
    a.begin()
    a.set("open", True)
    a.step(0)
    assert a.get("phase") == [3]


@OF_PYTHON
def test_a_second_initialisation_is_fatal(host3: Make) -> None:
    a = host3()
    a.begin()
    assert a.begin() == FATAL  # initialised already
    assert a.messages[-1][0] == FATAL


@pytest.mark.usefixtures("_tidy_path")
def test_fmpy_simulates_it(unpacked3: Path) -> None:
    rows = simulate_fmu(str(unpacked3), stop_time=1.0, output_interval=0.1, start_values={"push": [1.0, 0.0, -1.0]})
    assert rows["place"].shape == (11, 3)
    np.testing.assert_allclose(
        rows["place"][-1] - rows["place"][0] - rows["place"][-1, 1], [0.9, -0.1, -1.1], rtol=1e-9
    )


def test_a_reservation_of_the_model_is_logged_as_a_warning_and_the_step_is_made(host3: Make) -> None:
    a = host3()
    a.begin()
    a.set("word", "doubt")
    assert a.step(0) == OK
    assert a.messages == [(WARNING, "only 90% right at t = 0.0 s")]


def test_what_happens_is_logged_as_an_event_once(host3: Make) -> None:
    a = host3()
    a.begin()
    a.set("word", "bang")
    a.step(0)
    a.set("word", "start")
    a.step(1)
    assert a.messages == [(OK, "100% happened at t = 0.0 s")]


def test_nan_discards_the_step_and_keeps_the_state_before(host3: Make, form: str) -> None:
    a, b = host3("a"), host3("b")
    for instance in (a, b):
        instance.begin()
        instance.step(0)
    before = a.everything()
    a.set("push", 0.0, math.nan, 0.0)
    status, flags, last = a.step_from(0.1, 0.1)
    assert (status, last) == (DISCARD, 0.1)
    assert form == "Python" or flags == [False] * 3  # no event, no end, no early return; pythonfmu3 writes one alone
    assert a.messages == [(ERROR, "push = [0.0, nan, 0.0] is not finite at t = 0.1 s; check what is connected to it")]
    a.set("push", 0.0, 0.0, 0.0)
    assert a.everything() == before
    status, _, last = a.step_from(0.1, math.nan)
    assert (status, last) == (DISCARD, 0.1)
    status, _, last = a.step_from(0.1, 0.1)
    assert (status, last) == (OK, 0.2)
    assert b.step(1) == OK
    assert a.everything() == b.everything()


@OF_PYTHON
def test_initialisation_that_fails_is_fatal_with_the_reason(host3: Make) -> None:
    a = host3()
    for _ in range(20):  # every exception costs pythonfmu3's wrapper a reference to instance, class and log
        a.set("name", "bad")
        assert a.begin() == FATAL
        status, message = a.messages[-1]
        assert status == FATAL
        assert message.endswith("Dummy cannot be initialised: name = 'bad' is 100% wrong; call it 'good'")
        a.fmu.reset()
    assert a.begin() == OK
    assert a.step(0) == OK


REFUSED = [
    (lambda a: a.fmu.setFloat64(a.reference("place"), [1.0, 2.0, 3.0]), "place.x is an output and cannot be set"),
    (lambda a: a.fmu.setFloat64(a.reference("push"), [1.0]), "1 values for 3 variables"),
    (lambda a: a.fmu.setFloat64([99], [1.0]), "value reference 99 is unknown; it has 0 to 15"),
    (lambda a: a.fmu.setFloat64([4294967295], [1.0]), "value reference -1 is unknown"),
    (lambda a: a.fmu.setFloat64([0], [1.0]), "time (value reference 0) is the independent variable"),
    (lambda a: a.fmu.setFloat64(a.reference("number"), [1.0]), "number (value reference 7) is Int32, not Float64"),
    (lambda a: a.fmu.setFloat64(a.reference("gain.first"), [1.0]), "parameter gain.first is fixed since"),
    (lambda a: a.fmu.setInt32(a.reference("push"), [1]), "push (value reference 6) is Float64, not Int32"),
    (lambda a: a.fmu.setInt32(a.reference("method"), [1]), "method (value reference 15) is Enumeration, not Int32"),
    (lambda a: a.fmu.setInt64(a.reference("number"), [1]), "number (value reference 7) is Int32, not Enumeration"),
    (lambda a: a.fmu.setUInt64(a.reference("number"), [1]), "has no variables of type UInt64"),
    (lambda a: a.fmu.setBoolean(a.reference("quick"), [False]), "parameter quick is fixed since initialisation"),
    (lambda a: a.fmu.setString(a.reference("open"), ["x"]), "is Boolean, not String"),
    (lambda a: a.fmu.getFloat64([1, 99], nValues=4), "value reference 99 is unknown"),
    (lambda a: a.fmu.getInt32([0]), "time (value reference 0) is the independent variable"),
    (lambda a: a.fmu.getInt64(a.reference("push")), "push (value reference 6) is Float64, not Enumeration"),
    (lambda a: a.fmu.getBoolean([77]), "value reference 77 is unknown"),
    (lambda a: a.fmu.getString([1]), "place (value reference 1) is Float64, not String"),
    (lambda a: a.dll.fmi3UpdateDiscreteStates(a.component, *[byref(c_bool()) for _ in range(5)], byref(c_double())),
     "Dummy is for co-simulation and has no event mode"),
    (lambda a: a.dll.fmi3SetTime(a.component, c_double(1.0)), "has no time of its own"),
    (lambda a: a.dll.fmi3GetContinuousStates(a.component, (c_double * 3)(), 3), "has no continuous states"),
    (lambda a: a.dll.fmi3GetContinuousStateDerivatives(a.component, (c_double * 3)(), 3), "has no continuous states"),
    (lambda a: a.dll.fmi3GetEventIndicators(a.component, (c_double * 3)(), 3), "has no event indicators"),
    (lambda a: a.dll.fmi3EnterInitializationMode(a.component, False, 0.0, 0.0, False, 0.0), "the instance is running"),
    (lambda a: a.restore(b"not a state"), "this is not a saved state of it"),
    (lambda a: a.restore(b"\xff\x00"), "this is not a saved state of it"),
]  # fmt: skip


@OF_PYTHON
@pytest.mark.parametrize(("call", "reason"), REFUSED)
def test_a_refused_call_changes_nothing_and_discards_the_next_step(host3: Make, call: Any, reason: str) -> None:
    a = host3()
    a.begin()
    before = a.everything()
    call(a)
    assert a.messages[-1][0] == ERROR
    assert reason in a.messages[-1][1]
    assert a.everything() == before
    assert a.step(0) == DISCARD
    assert "no step at t = 0.0 s after a refused call" in a.messages[-1][1]
    assert a.step(0) == OK


@OF_PYTHON
def test_a_reference_that_is_wrong_spoils_its_own_values_alone(host3: Make) -> None:
    a = host3()
    a.begin()
    *place, nothing, number, gain = a.fmu.getFloat64(
        [*a.reference("place"), 99, *a.reference("number", "gain.first")], nValues=6
    )
    assert [*place, gain] == [0.1] * 4
    assert math.isnan(nothing)
    assert math.isnan(number)  # an Int32
    assert list(a.fmu.getInt32([99, *a.reference("number")], nValues=2)) == [0, 7]
    assert list(a.fmu.getInt64([*a.reference("phase"), 99], nValues=2)) == [1, 0]
    assert list(a.fmu.getBoolean([99, *a.reference("quick")], nValues=2)) == [False, True]
    assert [status for status, _ in a.messages] == [ERROR] * 4
    assert a.step(0) == DISCARD
    assert a.step(0) == OK


@OF_PYTHON
def test_time_begins_where_the_first_step_does(host3: Make) -> None:
    """pythonfmu3 drops the start time that the host gives; the first step tells it."""
    a = host3()
    assert a.get("time") == [0.0]
    a.begin()
    assert a.step(50) == OK
    assert a.get("time") == [50 * 0.1 + 0.1]
    assert a.messages == []
    assert a.step(60) == OK
    ((status, message),) = a.messages
    assert status == WARNING
    assert message.startswith("a step begins at t = 6 s, but the last one ended at 5.1 s")


def test_the_scalar_flavour_gives_the_same_values(host3: Make) -> None:
    a, b = host3("a"), host3("b", "3-scalar")
    assert (a.begin(), b.begin()) == (OK, OK)
    for k in range(3):
        a.set("push", 0.1 * k, -1.0, 1e-300)
        for name, value in zip("xyz", (0.1 * k, -1.0, 1e-300), strict=True):
            b.set(f"push.{name}", value)
        assert (a.step(k), b.step(k)) == (OK, OK)
    assert [b.get(f"place.{name}")[0] for name in "xyz"] == a.get("place")
    for name in ("time", "steps", "moving", "said", "phase", "number", "method"):
        assert a.get(name) == b.get(name), name
    assert b.restore(a.saved()) == OK
    assert b.messages == []


def test_a_step_after_the_end_is_refused(host3: Make, form: str) -> None:
    a = host3()
    a.begin()
    a.step(0)
    saved = a.saved()
    a.fmu.terminate()
    last = a.everything()
    assert a.step(1) == (DISCARD if form == "Python" else ERROR)
    assert a.messages[-1][1] == "Dummy is terminated at t = 0.1 s: reset it or restore a state"
    assert a.everything() == last
    assert a.restore(saved) == OK
    assert a.step(1) == OK
    a.fmu.terminate()
    a.fmu.reset()
    assert a.begin() == OK
    assert a.step(0) == OK


def test_serialised_state_goes_into_a_fresh_instance_and_keeps_the_time(host3: Make) -> None:
    a, b = host3("a"), host3("b")
    a.set("gain.second", math.e)
    a.set("method", 2)
    a.begin()
    a.set("push", -0.0, 1 / 3, 1e-310)
    for k in range(7):
        a.step(k)
    data = a.saved()
    assert b.restore(data) == OK
    assert b.everything() == a.everything()
    assert b.saved() == data
    assert b.get("time") == [6 * 0.1 + 0.1]
    for k in range(7, 12):
        assert (a.step(k), b.step(k)) == (OK, OK)
    assert b.everything() == a.everything()
    assert b.saved() == a.saved()


@OF_PYTHON
def test_text_that_is_not_utf8_is_refused_and_named(host3: Make) -> None:
    a = host3()
    reference = (c_uint * 1)(a.variables["word"].valueReference)
    a.dll.fmi3SetString(a.component, reference, c_size_t(1), (c_char_p * 1)(b"caf\xe9"), c_size_t(1))
    assert a.messages == [(ERROR, "Dummy: word = bytes that are no text in UTF-8 is not a string: give text in UTF-8")]
    a.dll.fmi3SetString(a.component, reference, c_size_t(1), (c_char_p * 1)("café".encode()), c_size_t(1))
    assert a.get("word") == ["café"]


def test_a_state_of_the_fmi2_slave_can_be_restored(host3: Make, host: Make) -> None:
    a, b = host3(), host()
    b.begin()
    b.step(0)
    assert a.restore(b.saved()) == OK
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert a.get("place") == b.place()


def test_raw_arrays_of_no_length(host3: Make) -> None:
    a = host3()
    a.begin()
    for name in ("Float64", "Int32", "Int64", "Boolean", "String"):
        for call in (f"fmi3Get{name}", f"fmi3Set{name}"):
            assert getattr(a.dll, call)(a.component, (c_uint * 0)(), 0, None, 0) == OK
    assert a.step(0) == OK


# Calls that pythonfmu3 does not support. ----------------------------------------------------------------------------

CALL = """
import sys
from ctypes import byref, c_bool, c_char_p, c_double, c_size_t, c_uint, c_void_p
from fmpy import read_model_description
from fmpy.fmi3 import FMU3Slave
folder, name = sys.argv[1:]
description = read_model_description(folder)
slave = FMU3Slave(guid=description.guid, unzipDirectory=folder, instanceName="one",
                  modelIdentifier=description.coSimulation.modelIdentifier)
slave.instantiate(); slave.enterInitializationMode(); slave.exitInitializationMode()
call = getattr(slave.dll, name)
call.argtypes = None
print("calls", flush=True)
print("status", call(c_void_p(slave.component), None, c_size_t(0), None, c_size_t(0), None, None, None, None, None))
slave.doStep(0.0, 0.1)
"""

ABORTING = [
    *(f"fmi3{how}{kind}" for how in ("Get", "Set")
      for kind in ("Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32", "Binary", "Clock")),
    "fmi3GetNumberOfVariableDependencies", "fmi3GetVariableDependencies", "fmi3GetAdjointDerivative",
    "fmi3GetIntervalDecimal", "fmi3GetShiftDecimal", "fmi3EvaluateDiscreteStates", "fmi3ActivateModelPartition",
]  # fmt: skip
"""What the wrapper's library throws a C++ exception at, past which no host survives."""


def called(unpacked3: Path, name: str) -> subprocess.CompletedProcess[str]:
    arguments = [sys.executable, "-c", CALL, str(unpacked3), name]
    return subprocess.run(arguments, capture_output=True, text=True, timeout=600, check=False)


def test_a_call_that_the_wrapper_does_not_have_ends_the_process(unpacked3: Path) -> None:
    """A fault of pythonfmu3 0.3.4 that nothing in an FMU's resources can mend. When this test fails, it is mended:
    take the warning out of the FMU's documentation."""
    done = called(unpacked3, "fmi3GetFloat32")
    assert done.stdout == "calls\n"
    assert done.returncode == -signal.SIGABRT
    assert "function fmi3GetFloat32 not implemented" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("name", ABORTING)
def test_all_calls_that_the_wrapper_does_not_have(unpacked3: Path, name: str) -> None:
    assert called(unpacked3, name).returncode == -signal.SIGABRT


@pytest.mark.parametrize("name", ["fmi3GetDirectionalDerivative", "fmi3GetOutputDerivatives"])
def test_other_unsupported_calls_answer_an_error(host3: Make, name: str) -> None:
    a = host3()
    a.begin()
    call = getattr(a.dll, name)
    call.argtypes = None
    none = c_size_t(0)
    assert call(c_void_p(a.component), None, none, None, none, None, none, None, none) == ERROR
    assert a.step(0) == OK


def test_the_description_gives_no_reason_for_a_call_that_aborts(unpacked3: Path) -> None:
    """No variable of such a type, and every capability behind one of these calls is declared false."""
    description = read_model_description(str(unpacked3))
    served = {"Float64", "Int32", "Boolean", "String", "Enumeration"}
    assert {variable.type for variable in description.modelVariables} <= served
    able = ElementTree.parse(unpacked3 / "modelDescription.xml").find("CoSimulation")
    assert able is not None
    for capability in (
        "providesPerElementDependencies",
        "providesAdjointDerivatives",
        "providesDirectionalDerivatives",
        "providesEvaluateDiscreteStates",
        "hasEventMode",
    ):
        assert able.get(capability) == "false"
    assert description.scheduledExecution is None
    assert description.modelExchange is None
