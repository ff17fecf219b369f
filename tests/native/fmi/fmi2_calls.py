"""Calls of FMI 2.0 with arguments as they are, and ways into each phase of the native dummy."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from ctypes import c_void_p as pointer
from typing import Any

from tests.fmi.hosts import Host

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
Make = Callable[..., Host]

PHASES: dict[str, Callable[[Host], object]] = {
    "instantiated": lambda a: None,
    "initialising": lambda a: (a.fmu.setupExperiment(), a.fmu.enterInitializationMode()),
    "running": lambda a: (a.begin(), a.step(0)),
    "terminated": lambda a: (a.begin(), a.step(0), raw(a, "Terminate")),
}


def handle(value: object = None) -> Any:
    return pointer(value)  # type: ignore[arg-type]  # an address or None


def library(a: Host) -> Any:
    """Its functions without the declarations, and the exceptions, of FMPy."""
    return ctypes.CDLL(a.dll._name)


def raw(a: Host, name: str, *arguments: object) -> int:
    """The status of a call with arguments as they are."""
    status: int = library(a)[f"fmi2{name}"](pointer(a.component), *arguments)
    return status
