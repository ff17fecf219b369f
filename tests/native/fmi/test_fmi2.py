"""Native FMUs answer FMI 2.0 as the standard (2.0.4) asks: values, call order, time, states.

What the Python dummy computes is the oracle of the values; the standard that of every status.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Sequence
from ctypes import byref, c_double, c_int, c_size_t, c_uint
from ctypes import c_void_p as pointer
from pathlib import Path
from typing import Any

import pytest
from fmpy import simulate_fmu
from fmpy.fmi2 import fmi2CallbackFunctions

from shipcollision_fmu.fmi.variable_access import VariableAccess
from tests.fmi.conftest import Host
from tests.fmi.Dummy import INTERFACE

from .native_fmus import TOKEN

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
Make = Callable[..., Host]
TERMINATED = "Dummy is terminated at t = 0.1 s: reset it or restore a state"
GARBAGE = ctypes.create_string_buffer(64)


def handle(value: object = None) -> Any:
    return pointer(value)  # type: ignore[arg-type]  # an address or None


def library(a: Host) -> Any:
    """Its functions without the declarations, and the exceptions, of FMPy."""
    return ctypes.CDLL(a.dll._name)


def raw(a: Host, name: str, *arguments: object) -> int:
    """The status of a call with arguments as they are."""
    status: int = library(a)[f"fmi2{name}"](pointer(a.component), *arguments)
    return status


def saved(a: Host) -> Any:
    state = handle()
    assert raw(a, "GetFMUstate", byref(state)) == OK
    return state


# Values. ------------------------------------------------------------------------------------------------------------


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


# Refused calls: an error, one line, and nothing is changed. -----------------------------------------------------------

REFUSED: list[tuple[str, Sequence[int], Sequence[Any], str]] = [
    ("SetReal", [7, 0], [5.0, 1.0], "place.x is an output and cannot be set"),
    ("SetReal", [7, 99], [5.0, 1.0], "value reference 99 is unknown; it has 0 to 18"),
    ("SetReal", [4294967295], [1.0], "value reference 4294967295 is unknown; it has 0 to 18"),
    ("SetReal", [7, 10], [5.0, 1.0], "number (value reference 10) is Integer, not Real"),
    ("SetReal", [7, 13], [5.0, 1.0], "parameter gain.first is fixed since initialisation; reset to set it"),
    ("SetInteger", [10, 7], [1, 1], "push.x (value reference 7) is Real, not Integer"),
    ("SetInteger", [6], [1], "phase is an output and cannot be set"),
    ("SetInteger", [18], [1], "parameter method is fixed since initialisation; reset to set it"),
    ("SetBoolean", [17], [0], "parameter quick is fixed since initialisation; reset to set it"),
    ("SetString", [11], [b"x"], "open (value reference 11) is Boolean, not String"),
    ("SetString", [12], [b"x" * 4096], "a string has more than 4095 bytes, the longest that a variable can hold"),
    ("SetString", [12], [None], "a null pointer is not a string"),
    ("GetReal", [0, 99], [0.5, 0.5], "value reference 99 is unknown; it has 0 to 18"),
    ("GetReal", [0, 10], [0.5, 0.5], "number (value reference 10) is Integer, not Real"),
    ("GetInteger", [10, 7], [9, 9], "push.x (value reference 7) is Real, not Integer"),
    ("GetBoolean", [11, 77], [9, 9], "value reference 77 is unknown; it has 0 to 18"),
    ("GetString", [0], [None], "place.x (value reference 0) is Real, not String"),
]
TYPES = {"Real": c_double, "Integer": c_int, "Boolean": c_int, "String": ctypes.c_char_p}


@pytest.mark.parametrize(("name", "references", "values", "reason"), REFUSED)
def test_a_refused_call_changes_nothing(
    host: Make, name: str, references: list[int], values: list[Any], reason: str
) -> None:
    a = host()
    a.begin()
    before = a.everything()
    given = (TYPES[name[3:]] * len(values))(*values)
    asked = (c_uint * len(references))(*references)
    assert raw(a, name, asked, c_size_t(len(references)), given) == ERROR
    assert a.messages == [(ERROR, f"Dummy: {reason}")]
    assert a.categories == ["logStatusError"]
    assert list(given) == values
    assert a.everything() == before
    assert a.step(0) == OK


def test_an_enumeration_is_one_of_its_items(host: Make) -> None:
    a = host()
    two = (c_uint * 2)(*a.reference("count", "method"))
    for number in (0, 4, -1, 2**31 - 1):
        assert raw(a, "SetInteger", two, c_size_t(2), (c_int * 2)(50, number)) == ERROR
        assert a.messages[-1][1] == f"Dummy: method = {number} is not one of 1 (pgs), 2 (closed_form), 3 (bullet)"
    assert a.fmu.getInteger(a.reference("count", "method")) == [3, 1]
    assert a.begin() == OK


@pytest.mark.parametrize("name", ["GetReal", "GetInteger", "GetBoolean", "GetString", "SetReal", "SetInteger"])
def test_null_pointers_are_refused(host: Make, name: str) -> None:
    a = host()
    reference = (c_uint * 1)(0)
    assert library(a)[f"fmi2{name}"](None, reference, c_size_t(1), byref(c_double())) == ERROR
    assert raw(a, name, None, c_size_t(1), byref(c_double())) == ERROR
    assert raw(a, name, reference, c_size_t(1), None) == ERROR
    assert raw(a, name, None, c_size_t(0), None) == OK
    assert {line for _, line in a.messages} <= {
        "Dummy: a null pointer in place of value references or values", "Dummy: place.x is an output and cannot be set",
        "Dummy: place.x (value reference 0) is Real, not Integer",
    }  # fmt: skip


NO_INSTANCE = [
    "EnterInitializationMode", "ExitInitializationMode", "Terminate", "Reset", "GetFMUstate", "SetFMUstate",
    "FreeFMUstate", "CancelStep", "SetupExperiment", "DoStep", "GetStatus", "GetRealStatus", "SetDebugLogging",
    "SerializedFMUstateSize", "SerializeFMUstate", "DeSerializeFMUstate", "GetStringStatus",
]  # fmt: skip


@pytest.mark.parametrize("name", NO_INSTANCE)
def test_no_instance_is_an_error(host: Make, name: str) -> None:
    assert library(host())[f"fmi2{name}"](*[handle()] * 6) == ERROR


UNSUPPORTED = {
    "CancelStep": "step to cancel: it has ended when doStep returns",
    "GetDirectionalDerivative": "directional derivatives",
    "SetRealInputDerivatives": "derivatives of inputs: they are held over the step",
    "GetRealOutputDerivatives": "derivatives of outputs",
    "EnterEventMode": "model exchange: it is for co-simulation",
    "NewDiscreteStates": "model exchange: it is for co-simulation",
    "EnterContinuousTimeMode": "model exchange: it is for co-simulation",
    "CompletedIntegratorStep": "model exchange: it is for co-simulation",
    "SetTime": "model exchange: it is for co-simulation",
    "SetContinuousStates": "model exchange: it is for co-simulation",
    "GetDerivatives": "model exchange: it is for co-simulation",
    "GetEventIndicators": "model exchange: it is for co-simulation",
    "GetContinuousStates": "model exchange: it is for co-simulation",
    "GetNominalsOfContinuousStates": "model exchange: it is for co-simulation",
}


@pytest.mark.parametrize(("name", "feature"), UNSUPPORTED.items())
def test_what_is_not_supported_is_an_error(host: Make, name: str, feature: str) -> None:
    a = host()
    a.begin()
    assert raw(a, name, *[handle()] * 6) == ERROR
    assert a.messages == [(ERROR, f"Dummy has no {feature}")]
    assert a.step(0) == OK


# Call order. ---------------------------------------------------------------------------------------------------------

PHASES: dict[str, Callable[[Host], object]] = {
    "instantiated": lambda a: None,
    "initialising": lambda a: (a.fmu.setupExperiment(), a.fmu.enterInitializationMode()),
    "running": lambda a: (a.begin(), a.step(0)),
    "terminated": lambda a: (a.begin(), a.step(0), raw(a, "Terminate")),
}
CALLS: dict[str, tuple[Callable[[Host], int], dict[str, str]]] = {
    "setupExperiment": (
        lambda a: raw(a, "SetupExperiment", 0, c_double(0), c_double(0), 0, c_double(0)),
        {"initialising": "", "running": "", "terminated": ""},
    ),
    "enter": (
        lambda a: raw(a, "EnterInitializationMode"), {"initialising": "", "running": "", "terminated": ""}
    ),
    "exit": (
        lambda a: raw(a, "ExitInitializationMode"), {"instantiated": "", "running": "", "terminated": ""}
    ),
    "step": (lambda a: a.step(1), {"instantiated": "", "initialising": "", "terminated": TERMINATED}),
    "terminate": (
        lambda a: raw(a, "Terminate"), {"instantiated": "", "initialising": "", "terminated": ""}
    ),
    "reset": (lambda a: raw(a, "Reset"), {}),
    "set parameter": (
        lambda a: raw(a, "SetReal", byref(c_uint(13)), c_size_t(1), byref(c_double(2))),
        {"running": "", "terminated": TERMINATED},
    ),
    "set input": (
        lambda a: raw(a, "SetReal", byref(c_uint(7)), c_size_t(1), byref(c_double(2))),
        {"terminated": TERMINATED},
    ),
    "get": (lambda a: raw(a, "GetReal", byref(c_uint(0)), c_size_t(1), byref(c_double())), {}),
    "save": (lambda a: raw(a, "GetFMUstate", byref(handle())), {}),
    "status": (lambda a: raw(a, "GetRealStatus", 2, byref(c_double())), {}),
}  # fmt: skip


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("call", CALLS)
def test_the_order_of_calls(host: Make, phase: str, call: str) -> None:
    a = host()
    PHASES[phase](a)
    assert a.messages == []
    before = a.saved()
    make, refused = CALLS[call]
    assert make(a) == (ERROR if phase in refused else OK)
    if phase in refused:
        ((status, line),) = a.messages
        assert status == ERROR
        assert refused[phase] in line
        assert a.saved() == before
    else:
        assert a.messages == []


def test_initialisation_that_fails_is_an_error_and_can_be_corrected(host: Make) -> None:
    a = host()
    a.fmu.setString(a.reference("name"), ["bad"])
    assert a.begin() == ERROR
    assert a.messages == [(ERROR, "Dummy cannot be initialised: name = 'bad' is 100%% wrong; call it 'good'")]
    a.fmu.setString(a.reference("name"), ["good"])
    assert raw(a, "ExitInitializationMode") == OK
    assert a.step(0) == OK


def test_a_failing_initialisation_is_logged_once_while_a_host_reads(host: Make) -> None:
    a = host()
    a.fmu.setString(a.reference("name"), ["bad"])
    for _ in range(30):
        assert raw(a, "GetReal", byref(c_uint(0)), c_size_t(1), byref(c_double())) == ERROR
    assert a.messages == [(ERROR, "name = 'bad' is 100%% wrong; call it 'good'")]


def test_reset_is_a_fresh_start(host: Make) -> None:
    a = host()
    fresh = a.saved()
    a.begin(5.0, 6.0)
    a.fmu.setReal(a.reference("push.x"), [3.0])
    a.step(50)
    assert raw(a, "Reset") == OK
    assert a.saved() == fresh
    a.begin()
    b = host()
    b.begin()
    assert (a.step(0), b.step(0)) == (OK, OK)
    assert a.saved() == b.saved()


# Steps. --------------------------------------------------------------------------------------------------------------


def test_a_discarded_step_keeps_the_state_before(host: Make) -> None:
    a, b = host("a"), host("b")
    for instance in (a, b):
        instance.begin()
        instance.step(0)
    before = a.everything()
    a.fmu.setReal(a.reference("push.y"), [math.nan])
    assert a.step(1) == DISCARD
    assert a.fmu.getRealStatus(2) == 0.1  # fmi2LastSuccessfulTime
    assert a.fmu.getBooleanStatus(3) == 0  # fmi2Terminated: no end that was planned
    assert a.fmu.getStatus(0) == DISCARD  # fmi2DoStepStatus
    assert a.messages == [
        (ERROR, "push = [0.0, nan, 0.0] is not finite at t = 0.1 s; check what is connected to it")
    ]  # fmt: skip
    a.fmu.setReal(a.reference("push.y"), [0.0])
    assert a.everything() == before
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert a.saved() == b.saved()
    assert a.fmu.getStatus(0) == OK


def test_the_stop_time_is_an_error_and_rounding_is_not(host: Make) -> None:
    a = host()
    a.begin(0.0, 1.0)
    t = 0.0
    for _ in range(10):
        assert raw(a, "DoStep", c_double(t), c_double(0.1), 1) == OK
        t += 0.1
    assert raw(a, "DoStep", c_double(t), c_double(0.1), 1) == ERROR  # FMI 2.0.4, fmi2SetupExperiment
    assert a.messages == [
        (ERROR, "a step from t = 1 s by 0.1 s ends after the stop time 1 s of the experiment: end there, or set the "
                "experiment up without a stop time")
    ]  # fmt: skip
    assert a.fmu.getStatus(0) == ERROR


def test_a_gap_is_warned_of_once(host: Make) -> None:
    a = host()
    a.begin()
    assert [a.step(k) for k in (0, 1, 5, 9)] == [OK] * 4
    assert a.messages == [
        (WARNING, "a step begins at t = 0.5 s, but the last one ended at 0.2 s: ships and collision then lose count "
                  "of the time; step from where the last step ended, or restore a state")
    ]  # fmt: skip
    assert a.categories == ["logStatusWarning"]


@pytest.mark.parametrize("start", [math.nan, math.inf])
def test_a_start_that_is_not_finite_is_refused(host: Make, start: float) -> None:
    a = host()
    assert raw(a, "SetupExperiment", 0, c_double(0), c_double(start), 0, c_double(0)) == ERROR
    assert a.messages == [(ERROR, f"the experiment cannot start at {start} s: give a finite start time")]


def test_what_a_status_may_be_asked_for(host: Make) -> None:
    a = host()
    a.begin()
    assert raw(a, "GetStatus", 2, byref(c_int())) == DISCARD
    assert raw(a, "GetRealStatus", 0, byref(c_double())) == DISCARD
    assert raw(a, "GetIntegerStatus", 0, byref(c_int())) == DISCARD
    assert raw(a, "GetBooleanStatus", 1, byref(c_int())) == DISCARD
    text = ctypes.c_char_p()
    assert raw(a, "GetStringStatus", 1, byref(text)) == OK  # fmi2PendingStatus: nothing is pending
    assert text.value == b""
    assert raw(a, "GetRealStatus", 2, None) == ERROR
    assert raw(a, "GetStatus", 77, byref(c_int())) == DISCARD


# States. -------------------------------------------------------------------------------------------------------------


def test_a_restored_state_repeats_to_the_bit(host: Make) -> None:
    a, b = host("a"), host("b")
    a.begin(0.0, 9.0)
    a.step(0)
    data = a.saved()
    a.fmu.setReal(a.reference("push.x"), [1e3])
    a.step(1)
    assert a.restore(data) == OK
    assert a.saved() == data
    b.fmu.setReal(b.reference("gain.second"), [4.0])  # another parameter, which the state replaces
    b.begin()
    assert b.restore(data) == OK
    assert b.saved() == data
    assert (a.step(1), b.step(1)) == (OK, OK)
    assert a.saved() == b.saved()
    assert raw(a, "DoStep", c_double(0.2), c_double(9.0), 1) == ERROR  # the stop time was restored
    assert raw(b, "SetReal", byref(c_uint(13)), c_size_t(1), byref(c_double(2))) == ERROR  # so the phase


@pytest.mark.parametrize("phase", PHASES)
def test_a_state_of_every_phase(host: Make, phase: str) -> None:
    a, b = host("a"), host("b")
    PHASES[phase](a)
    data = a.saved()
    b.begin()
    for k in range(3):
        b.step(k)
    assert b.restore(data) == OK
    assert b.saved() == data
    assert (b.step(1) == OK) == (phase == "running")


def test_a_handle_is_used_again_and_nulled_when_freed(host: Make) -> None:
    a = host()
    a.begin()
    state = saved(a)
    address = state.value
    first = a.saved()
    a.step(0)
    assert raw(a, "GetFMUstate", byref(state)) == OK
    assert state.value == address
    second = a.saved()
    a.step(1)
    assert raw(a, "SetFMUstate", state) == OK
    assert a.saved() == second != first
    assert raw(a, "FreeFMUstate", byref(state)) == OK
    assert state.value is None
    assert raw(a, "FreeFMUstate", byref(state)) == OK
    assert raw(a, "FreeFMUstate", None) == OK
    assert a.messages == []


def test_a_handle_grows_with_the_state(host: Make) -> None:
    a = host()
    a.begin()
    state = saved(a)
    a.fmu.setString(a.reference("word"), ["w" * 4000])
    assert raw(a, "GetFMUstate", byref(state)) == OK
    a.fmu.setString(a.reference("word"), [""])
    assert raw(a, "SetFMUstate", state) == OK
    assert a.fmu.getString(a.reference("word")) == [b"w" * 4000]


FOREIGN = (
    "this is no saved state of this instance: it was freed, or another instance saved it; serialize a state to take it "
    "to another instance"
)


@pytest.mark.parametrize("which", ["null", "garbage", "another instance's", "freed"])
def test_handles_that_are_none_are_refused(host: Make, which: str) -> None:
    a, b = host("a"), host("b")
    a.begin()
    state = {
        "null": handle, "garbage": lambda: handle(ctypes.addressof(GARBAGE)), "another instance's": lambda: saved(b),
        "freed": lambda: saved(a),
    }[which]()  # fmt: skip
    if which == "freed":
        kept = handle(state.value)
        raw(a, "FreeFMUstate", byref(state))
        state = kept
    line = "a null pointer is no saved state" if which == "null" else FOREIGN
    before = a.saved()
    assert raw(a, "SetFMUstate", state) == ERROR
    assert raw(a, "SerializedFMUstateSize", state, byref(c_size_t())) == ERROR
    assert raw(a, "SerializeFMUstate", state, GARBAGE, c_size_t(64)) == ERROR
    if which != "null":
        assert raw(a, "GetFMUstate", byref(state)) == ERROR
        assert raw(a, "FreeFMUstate", byref(state)) == ERROR
        assert state.value is not None
    assert {message for _, message in a.messages} == {line}
    assert a.saved() == before


def test_damaged_bytes_are_refused(host: Make) -> None:
    a = host()
    a.begin()
    data = a.saved()
    damaged = [b"", b"not a state", data[:-1], data + b"\0", *(flip(data, k) for k in range(0, len(data), 5))]
    for wrong in damaged:
        state = handle()
        buffer = ctypes.create_string_buffer(wrong, max(len(wrong), 1))
        assert raw(a, "DeSerializeFMUstate", buffer, c_size_t(len(wrong)), byref(state)) == ERROR
        assert state.value is None
    assert {line for _, line in a.messages} == {"Dummy: bytes that are no state, or damaged ones"}
    assert a.saved() == data


def flip(data: bytes, k: int) -> bytes:
    return data[:k] + bytes([data[k] ^ 1 << k % 8]) + data[k + 1 :]


def seal(data: bytes, old: bytes, new: bytes) -> bytes:
    """A state of another FMU: the digest is that of zlib, the format that of native/fmi/saved_state.cpp."""
    from zlib import crc32

    assert len(old) == len(new)
    inside = data[16:].replace(old, new, 1)
    return data[:12] + crc32(inside).to_bytes(4, "little") + inside


def test_a_state_of_another_build_or_fmu_is_refused(host: Make) -> None:
    a = host()
    a.begin()
    data = a.saved()
    tag = INTERFACE.make_access().tag
    assert a.restore(seal(data, b"", b"")) == OK
    assert a.restore(seal(data, tag.encode(), b"Mummy" + tag[5:].encode())) == ERROR
    assert a.messages[-1][1] == f"Dummy: this is not a saved state of it (of 'Mummy{tag[5:]}', want '{tag}')"
    assert a.restore(seal(data, b"0.1.0 of", b"0.1.1 of")) == ERROR
    assert a.messages[-1][1] == (
        "Dummy: this state was saved by another build of shipcollision_fmu (0.1.1 of the tests; this one is 0.1.0 of "
        "the tests): a state can be restored only in the build that saved it"
    )
    assert a.saved() == data


def test_a_state_whose_parameters_are_refused_leaves_everything(host: Make) -> None:
    a, b = host("a"), host("b")
    b.fmu.setString(b.reference("name"), ["gut!"])
    b.begin()
    data = seal(b.saved(), b"gut!", b"bad\0")
    a.begin()
    a.step(0)
    before = a.saved()
    assert a.restore(data) == ERROR
    assert a.saved() == before
    assert a.step(1) == OK


def test_too_little_room_for_a_state_is_refused(host: Make) -> None:
    a = host()
    state, size = saved(a), c_size_t()
    assert raw(a, "SerializedFMUstateSize", state, byref(size)) == OK
    assert raw(a, "SerializedFMUstateSize", state, None) == ERROR
    few = size.value - 1
    assert raw(a, "SerializeFMUstate", state, GARBAGE, c_size_t(few)) == ERROR
    assert a.messages[-1][1] == f"Dummy: {few} bytes are too few for a state of {size.value}"


# Log. ----------------------------------------------------------------------------------------------------------------


def set_logging(a: Host, on: bool, *categories: bytes) -> int:
    names = (ctypes.c_char_p * len(categories))(*categories)
    status: int = raw(a, "SetDebugLogging", int(on), c_size_t(len(categories)), names)
    return status


def speak(a: Host) -> list[str]:
    """An event, a warning and an error."""
    a.messages.clear()
    a.categories.clear()
    raw(a, "Reset")
    a.begin()
    for k, word in enumerate(("bang", "doubt")):
        a.fmu.setString(a.reference("word"), [word])
        assert a.step(k) == OK
    raw(a, "SetReal", byref(c_uint(0)), c_size_t(1), byref(c_double(2)))
    return a.categories


def test_categories_choose_what_is_logged(host: Make) -> None:
    a = host(logging=False)
    assert speak(a) == []
    assert set_logging(a, True) == OK
    assert speak(a) == ["logEvents", "logStatusWarning", "logStatusError"]
    assert a.messages[:2] == [(OK, "100%% happened at t = 0.0 s"), (WARNING, "only 90%% right at t = 0.1 s")]
    assert set_logging(a, True, b"logEvents") == OK
    assert speak(a) == ["logEvents"]
    assert set_logging(a, True, b"logStatusWarning", b"logStatusError") == OK
    assert speak(a) == ["logStatusWarning", "logStatusError"]
    assert set_logging(a, True, b"logEvents", b"logAll") == ERROR
    assert a.messages[-1][1] == (
        "'logAll' is not a log category: one of logEvents, logStatusError, logStatusWarning"
    )  # fmt: skip
    assert speak(a) == ["logStatusWarning", "logStatusError"]
    assert raw(a, "SetDebugLogging", 1, c_size_t(2), None) == ERROR
    assert set_logging(a, False, b"logEvents") == OK
    assert speak(a) == []


def test_the_log_goes_to_stderr_on_request(
    host: Make, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SHIPCOLLISION_LOG", "stderr")
    a = host("anna", logging=False)
    speak(a)
    assert capfd.readouterr().err.splitlines() == [
        "Dummy anna: 100% happened at t = 0.0 s",
        "Dummy anna: warning: only 90% right at t = 0.1 s",
        "Dummy anna: Dummy: place.x is an output and cannot be set",
    ]
    monkeypatch.delenv("SHIPCOLLISION_LOG")
    speak(host("bert"))
    assert capfd.readouterr().err == ""


# Instances that cannot be. -------------------------------------------------------------------------------------------


def instantiate(a: Host, **changed: Any) -> tuple[Any, list[tuple[int, bytes, bytes]]]:
    """fmi2Instantiate with some arguments changed; the instance, and what was logged without logging on."""
    from fmpy.fmi2 import fmi2CallbackLoggerTYPE

    said: list[tuple[int, bytes, bytes]] = []
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda env, who, status, category, line: said.append((status, who, line)))
    resources = Path(a.fmu.unzipDirectory) / "resources"
    given = {
        "name": b"one", "type": 1, "guid": TOKEN.encode(), "location": resources.as_uri().encode(),
        "callbacks": byref(callbacks),
    } | changed  # fmt: skip
    call = library(a)["fmi2Instantiate"]
    call.restype = pointer
    made = call(*given.values(), 0, 0)
    if made is not None:
        library(a)["fmi2FreeInstance"](pointer(made))
    return made, said


@pytest.mark.parametrize(
    ("changed", "line"),
    [
        ({"name": None}, "the host gives the instance no name"),
        ({"type": 0}, "this FMU is for co-simulation alone"),
        ({"guid": None}, f"Dummy: the host's guid is missing, and this FMU has '{TOKEN}': library and model "),
        ({"guid": b"{x}"}, f"Dummy: the host's guid is '{{x}}', and this FMU has '{TOKEN}': library and model "),
        ({"location": None}, "the host gives no resource location: give the URI or the path of the FMU's folder "),
        ({"location": b""}, "the host gives no resource location: give the URI or the path of the FMU's folder "),
        ({"location": b"http://x/y"}, "'http://x/y' is not on this machine: give the resource location as file:///"),
        ({"location": b"file:///no/where"}, "/no/where/variables.txt cannot be opened: it is missing, or may not be "),
    ],
)
def test_an_instance_that_cannot_be_is_null_and_a_line(host: Make, changed: dict[str, Any], line: str) -> None:
    made, said = instantiate(host(), **changed)
    assert made is None
    ((status, _, said_line),) = said
    assert status == ERROR
    assert said_line.decode().startswith(line)
    made, said = instantiate(host(), **changed, callbacks=None)
    assert (made, said) == (None, [])
    made, said = instantiate(host(), **changed, callbacks=byref(fmi2CallbackFunctions()))
    assert (made, said) == (None, [])


def test_an_instance_needs_no_logger(host: Make) -> None:
    for callbacks in (None, byref(fmi2CallbackFunctions())):
        made, said = instantiate(host(), callbacks=callbacks)
        assert made is not None
        assert said == []


def test_versions(host: Make) -> None:
    a = host()
    for name, said in (("GetVersion", b"2.0"), ("GetTypesPlatform", b"default")):
        call = library(a)[f"fmi2{name}"]
        call.restype = ctypes.c_char_p
        assert call() == said


def test_free_of_nothing(host: Make) -> None:
    library(host())["fmi2FreeInstance"](None)


def test_fmpy_simulates_it(native_dummies: dict[str, Path]) -> None:
    rows = {name: simulate_fmu(str(folder), stop_time=1.0, output_interval=0.1, start_values={"push.x": 2.0})
            for name, folder in native_dummies.items() if name != "3"}  # fmt: skip
    assert len(rows["2"]) == 11
    assert rows["2"]["place.x"].tolist() == rows["3-scalar"]["place.x"].tolist()
    arrays = simulate_fmu(str(native_dummies["3"]), stop_time=1.0, output_interval=0.1,
                          start_values={"push": [2.0, 0.0, 0.0]})  # fmt: skip
    assert [row[1][0] for row in arrays.tolist()] == rows["2"]["place.x"].tolist()
