"""Instances of native FMUs by FMI 2.0.4, and those that cannot be: a null pointer and a line."""

from __future__ import annotations

import ctypes
from ctypes import byref
from ctypes import c_void_p as pointer
from pathlib import Path
from typing import Any

import pytest
from fmpy.fmi2 import fmi2CallbackFunctions

from tests.fmi.hosts import Host

from .fmi2_calls import ERROR, Make, library
from .native_fmus import TOKEN


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
