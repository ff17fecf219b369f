"""Native FMUs answer a wrong call of FMI 2.0.4 with an error and one line, and nothing is changed."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import byref, c_double, c_int, c_size_t, c_uint
from typing import Any

import pytest

from .fmi2_calls import ERROR, OK, Make, handle, library, raw

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
