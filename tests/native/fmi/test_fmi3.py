"""Native FMUs answer FMI 3.0 as the standard asks: types, sizes, time, call order, what there is not.

What the Python FMU does alike is in tests/fmi/test_slave_fmi3.py, what FMI 2.0 has in common in test_fmi2_*.py.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from ctypes import c_bool, c_double, c_int32, c_int64, c_size_t, c_uint, c_uint8
from ctypes import c_void_p as pointer
from typing import Any

import pytest

from tests.fmi.hosts import Host3

from .native_fmus import TOKEN

OK, WARNING, DISCARD, ERROR = range(4)
Make = Callable[..., Host3]
TIME, PLACE, STEPS, MOVING, SAID, PHASE, PUSH, NUMBER = range(8)


def raw(a: Host3, name: str, *arguments: object) -> int:
    """The status of a call with arguments as they are, without FMPy's declarations."""
    status: int = ctypes.CDLL(a.dll._name)[f"fmi3{name}"](pointer(a.component), *arguments)
    return status


def values(a: Host3, name: str, references: list[int], given: Any, size: int | None = None) -> int:
    """fmi3GetX or fmi3SetX."""
    asked = (c_uint * len(references))(*references)
    return raw(a, name, asked, c_size_t(len(references)), given, c_size_t(len(given) if size is None else size))


def test_several_variables_in_one_call(host3: Make) -> None:
    a = host3()
    a.begin()
    given = (c_double * 7)()
    assert values(a, "GetFloat64", [PLACE, TIME, PUSH], given) == OK
    assert list(given) == [0.1, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0]
    assert values(a, "SetFloat64", [PUSH, PUSH], (c_double * 6)(1, 2, 3, 4, 5, 6)) == OK
    assert a.get("push") == [4.0, 5.0, 6.0]


REFUSED: list[tuple[str, list[int], Any, int | None, str]] = [
    ("GetFloat64", [PLACE], (c_double * 2)(5, 5), None, "2 values for 3 variables"),
    ("GetFloat64", [PLACE], (c_double * 4)(5, 5, 5, 5), None, "4 values for 3 variables"),
    ("GetFloat64", [PUSH, 16], (c_double * 4)(5, 5, 5, 5), None, "value reference 16 is unknown; it has 0 to 15"),
    ("GetFloat64", [STEPS], (c_double * 1)(5), None, "steps (value reference 2) is Int32, not Float64"),
    ("GetFloat32", [PLACE], (ctypes.c_float * 3)(5, 5, 5), None, "place (value reference 1) is Float64, not Float32"),
    ("GetInt32", [PHASE], (c_int32 * 1)(5), None, "phase (value reference 5) is Enumeration, not Int32"),
    ("GetInt64", [STEPS], (c_int64 * 1)(5), None, "steps (value reference 2) is Int32, not Enumeration"),
    ("GetUInt8", [99], (c_uint8 * 1)(5), None, "Dummy has no variables of type UInt8"),
    ("SetFloat64", [TIME], (c_double * 1)(5), None, "time (value reference 0) is the independent variable: it is only "
     "read"),
    ("SetFloat64", [PUSH, PLACE], (c_double * 6)(*[5] * 6), None, "place.x is an output and cannot be set"),
    ("SetFloat64", [PUSH], (c_double * 2)(5, 5), None, "2 values for 3 variables"),
    ("SetInt64", [15], (c_int64 * 1)(1), None, "parameter method is fixed since initialisation; reset to set it"),
    ("SetUInt64", [PUSH], (c_int64 * 1)(1), None, "push (value reference 6) is Float64, not UInt64"),
    ("SetBoolean", [MOVING], (c_bool * 1)(True), None, "moving is an output and cannot be set"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "references", "given", "size", "reason"), REFUSED)
def test_a_refused_call_changes_nothing(
    host3: Make, name: str, references: list[int], given: Any, size: int | None, reason: str
) -> None:
    a = host3()
    a.begin()
    before, kept = a.saved(), list(given)
    assert values(a, name, references, given, size) == ERROR
    assert a.messages == [(ERROR, reason if reason.startswith("Dummy has") else f"Dummy: {reason}")]
    assert a.saved() == before
    assert list(given) == kept
    assert a.step(0) == OK


def test_an_enumeration_is_one_of_its_items_in_64_bits(host3: Make) -> None:
    a = host3()
    for number in (0, 4, -(2**63), 2**63 - 1, 2**32 + 1):
        assert values(a, "SetInt64", [15], (c_int64 * 1)(number)) == ERROR
        assert a.messages[-1][1] == f"Dummy: method = {number} is not one of 1 (pgs), 2 (closed_form), 3 (bullet)"
    assert values(a, "SetInt64", [15], (c_int64 * 1)(3)) == OK
    assert a.get("method") == [3]


def test_any_byte_is_a_boolean(host3: Make) -> None:
    a = host3()
    for byte, value in ((7, True), (0, False), (0x80, True)):
        assert values(a, "SetBoolean", [8], (c_uint8 * 1)(byte)) == OK
        assert a.get("open") == [value]


OTHER_TYPES = ["Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32", "UInt64", "Binary", "Clock"]


@pytest.mark.parametrize("verb", ["Get", "Set"])
@pytest.mark.parametrize("kind", OTHER_TYPES)
def test_types_that_no_variable_has(host3: Make, verb: str, kind: str) -> None:
    a = host3()
    assert raw(a, f"{verb}{kind}", None, c_size_t(0), None, c_size_t(0), None, None) == OK
    assert raw(a, f"{verb}{kind}", None, c_size_t(1), None, c_size_t(1), None, None) == ERROR
    assert a.messages == [(ERROR, f"Dummy has no variables of type {kind}")]
    one = (c_uint * 1)(PLACE)
    assert raw(a, f"{verb}{kind}", one, c_size_t(1), None, c_size_t(1), None, None) == ERROR
    assert a.messages[-1] == (ERROR, f"Dummy: place (value reference 1) is Float64, not {kind}")


LACKS = {
    "EnterEventMode": "event mode", "EnterStepMode": "event mode to leave: it is always in step mode",
    "UpdateDiscreteStates": "event mode", "EvaluateDiscreteStates": "event mode",
    "EnterConfigurationMode": "structural parameters to configure",
    "ExitConfigurationMode": "structural parameters to configure",
    "GetOutputDerivatives": "derivatives of outputs", "GetDirectionalDerivative": "directional derivatives",
    "GetAdjointDerivative": "adjoint derivatives", "GetNumberOfVariableDependencies": "dependencies of single elements",
    "GetVariableDependencies": "dependencies of single elements",
    "GetIntervalDecimal": "clocks", "GetIntervalFraction": "clocks", "GetShiftDecimal": "clocks",
    "GetShiftFraction": "clocks", "SetIntervalDecimal": "clocks", "SetIntervalFraction": "clocks",
    "SetShiftDecimal": "clocks", "SetShiftFraction": "clocks",
    "ActivateModelPartition": "scheduled execution: it is for co-simulation",
    **dict.fromkeys(
        ("EnterContinuousTimeMode", "CompletedIntegratorStep", "SetTime", "SetContinuousStates",
         "GetContinuousStateDerivatives", "GetEventIndicators", "GetContinuousStates", "GetNominalsOfContinuousStates",
         "GetNumberOfEventIndicators", "GetNumberOfContinuousStates"),
        "model exchange: it is for co-simulation",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("name", "feature"), LACKS.items())
def test_what_is_not_supported_is_an_error(host3: Make, name: str, feature: str) -> None:
    a = host3()
    a.begin()
    assert raw(a, name, *[pointer()] * 8) == ERROR
    assert a.messages == [(ERROR, f"Dummy has no {feature}")]
    assert ctypes.CDLL(a.dll._name)[f"fmi3{name}"](*[pointer()] * 9) == ERROR
    assert a.step(0) == OK


# Time. ---------------------------------------------------------------------------------------------------------------


def enter(a: Host3, start: float, stop: float | None = None) -> int:
    return raw(a, "EnterInitializationMode", c_bool(False), c_double(0), c_double(start), c_bool(stop is not None),
               c_double(stop or 0.0))  # fmt: skip


def test_start_and_stop_time_are_honoured(host3: Make) -> None:
    a = host3()
    assert enter(a, 100.0, 101.0) == OK
    assert a.get("time") == [100.0]
    assert raw(a, "ExitInitializationMode") == OK
    assert a.step_from(100.0, 0.75) == (OK, [False] * 3, 100.75)
    assert a.get("time") == [100.75]
    assert a.step_from(100.75, 0.5) == (ERROR, [False] * 3, 100.75)
    assert "ends after the stop time 101 s" in a.messages[-1][1]
    assert a.step_from(100.75, 0.25) == (OK, [False] * 3, 101.0)


def test_arguments_that_a_host_leaves_out(host3: Make) -> None:
    a = host3()
    a.begin()
    assert raw(a, "DoStep", c_double(0), c_double(0.1), c_bool(False), None, None, None, None) == OK


@pytest.mark.parametrize("start", [math.nan, math.inf])
def test_a_start_that_is_not_finite_does_not_enter(host3: Make, start: float) -> None:
    a = host3()
    assert enter(a, start) == ERROR
    assert enter(a, 0.0) == OK


def test_the_order_of_calls(host3: Make) -> None:
    a = host3()
    assert a.step_from(0.0, 0.1)[0] == ERROR
    assert raw(a, "ExitInitializationMode") == ERROR
    assert raw(a, "Terminate") == ERROR
    assert enter(a, 0.0) == OK
    assert enter(a, 0.0) == ERROR
    assert a.step_from(0.0, 0.1)[0] == ERROR
    assert raw(a, "ExitInitializationMode") == OK
    assert raw(a, "ExitInitializationMode") == ERROR
    assert a.step_from(0.0, 0.1)[0] == OK
    assert raw(a, "Terminate") == OK
    assert raw(a, "Terminate") == ERROR
    assert a.step_from(0.1, 0.1)[0] == ERROR
    assert values(a, "SetFloat64", [PUSH], (c_double * 3)()) == ERROR
    assert a.get("place") != [0.0] * 3
    assert raw(a, "Reset") == OK
    assert a.begin() == OK


def test_a_restored_state_has_the_stop_time(host3: Make) -> None:
    a, b = host3(), host3()
    enter(a, 3.0, 9.0)
    raw(a, "ExitInitializationMode")
    a.step_from(3.0, 0.5)
    assert b.restore(a.saved()) == OK
    assert b.get("time") == [3.5]
    assert b.step_from(3.5, 6.0)[0] == ERROR


# Instances. ----------------------------------------------------------------------------------------------------------


def instantiate(a: Host3, function: str, **changed: Any) -> tuple[bool, list[str]]:
    """Whether there is an instance, and what was logged without logging on."""
    said: list[str] = []
    log = ctypes.CFUNCTYPE(None, pointer, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)(
        lambda env, status, category, line: said.append(f"{status} {category.decode()} {line.decode()}")
    )
    no = c_bool(False)
    given = {
        "name": b"one", "token": TOKEN.encode(), "resources": f"{a.fmu.unzipDirectory}/resources/".encode(),
        "visible": no, "logging": no,
    }  # fmt: skip
    if function == "CoSimulation":
        given |= {"events": no, "early": no, "variables": None, "count": c_size_t(0), "env": None, "log": log,
                  "update": None}  # fmt: skip
    else:
        given |= {"env": None, "log": log, "update": None, "lock": None, "unlock": None}
    dll = ctypes.CDLL(a.dll._name)
    call = dll[f"fmi3Instantiate{function}"]
    call.restype = pointer
    made = call(*(given | changed).values())
    if made is not None:
        dll.fmi3FreeInstance(pointer(made))
    return made is not None, said


def test_an_instance_may_return_early_and_have_no_logger(host3: Make) -> None:
    assert instantiate(host3(), "CoSimulation") == (True, [])
    assert instantiate(host3(), "CoSimulation", early=c_bool(True)) == (True, [])
    assert instantiate(host3(), "CoSimulation", log=None) == (True, [])


@pytest.mark.parametrize(
    ("function", "changed", "line"),
    [
        ("CoSimulation", {"events": c_bool(True)}, "this FMU has no event mode: instantiate it without"),
        (
            "CoSimulation", {"variables": (c_uint * 1)(1), "count": c_size_t(1)},
            "this FMU has no intermediate update: require no variables of it",
        ),
        ("CoSimulation", {"name": None}, "the host gives the instance no name"),
        (
            "CoSimulation", {"token": b"another"},
            f"Dummy: the host's instantiation token is 'another', and this FMU has '{TOKEN}': library and model "
            "description are of different builds",
        ),
        (
            "CoSimulation", {"resources": None},
            "the host gives no resource location: give the URI or the path of the FMU's folder resources",
        ),
        ("ModelExchange", {}, "this FMU is for co-simulation, not for model exchange"),
        ("ScheduledExecution", {}, "this FMU is for co-simulation, not for scheduled execution"),
    ],
)  # fmt: skip
def test_an_instance_that_cannot_be_is_null_and_a_line(
    host3: Make, function: str, changed: dict[str, Any], line: str
) -> None:
    assert instantiate(host3(), function, **changed) == (False, [f"3 logStatusError {line}"])
    assert instantiate(host3(), function, **changed, log=None) == (False, [])


def test_percent_signs_are_left_alone(host3: Make) -> None:
    a = host3()
    a.set("name", "bad")
    assert a.begin() == ERROR
    assert a.messages == [(ERROR, "Dummy cannot be initialised: name = 'bad' is 100% wrong; call it 'good'")]


def test_the_version(host3: Make) -> None:
    call = ctypes.CDLL(host3().dll._name).fmi3GetVersion
    call.restype = ctypes.c_char_p
    assert call() == b"3.0"
