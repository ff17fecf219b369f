"""Native FMUs answer each call of FMI 2.0.4 in each phase as the standard asks."""

from __future__ import annotations

from collections.abc import Callable
from ctypes import byref, c_double, c_size_t, c_uint

import pytest

from tests.fmi.hosts import Host

from .fmi2_calls import ERROR, OK, PHASES, Make, handle, raw

TERMINATED = "Dummy is terminated at t = 0.1 s: reset it or restore a state"

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
