"""What native FMUs log by FMI 2.0.4, and where."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_double, c_size_t, c_uint

import pytest

from tests.fmi.hosts import Host

from .fmi2_calls import ERROR, OK, WARNING, Make, raw


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
