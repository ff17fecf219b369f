"""Steps of native FMUs by FMI 2.0.4, where they answer otherwise than the Python FMU (tests/fmi/test_slave.py)."""

from __future__ import annotations

import ctypes
import math
from ctypes import byref, c_double, c_int

import pytest

from .fmi2_calls import DISCARD, ERROR, OK, Make, raw


@pytest.mark.parametrize("start", [math.nan, math.inf])
def test_a_start_that_is_not_finite_is_refused(host: Make, start: float) -> None:
    a = host()
    assert raw(a, "SetupExperiment", 0, c_double(0), c_double(start), 0, c_double(0)) == ERROR
    assert a.messages == [(ERROR, f"the experiment cannot start at {start} s: give a finite start time")]


def test_the_status_of_the_last_step_is_kept(host: Make) -> None:
    a = host()
    a.begin(0.0, 1.0)
    for push, length, status in ((math.nan, 0.1, DISCARD), (0.0, 0.1, OK), (0.0, 9.0, ERROR)):
        a.fmu.setReal(a.reference("push.y"), [push])
        assert raw(a, "DoStep", c_double(0.0), c_double(length), 1) == status
        assert a.fmu.getStatus(0) == status  # fmi2DoStepStatus


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
