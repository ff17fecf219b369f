"""The unpacked FMU file and the life of an instance, the same in FMI 2.0 and 3.0.

    set parameters -> enter initialisation -> write inputs -> exit initialisation -> step ... step -> terminate, free

The numbers of a status are the same in FMI 2.0 and 3.0. A subclass gives the calls of its version.
"""

from __future__ import annotations

import re
import shutil
import sys
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from fmpy import extract, read_model_description

from ..errors import HostError, StepError
from .component import Group, Value

__all__ = ["REMEDY", "WARNING", "FmuInstance", "UnpackedFmu"]

REMEDY = "build it again with `shipcollision build`"
WARNING, ERROR = 1, 3
"""A status up to WARNING is success. After one from ERROR on, an instance may only be freed."""

_WRAPPER = re.compile(r"^Fatal py exception encountered: \[\w+\] (PyObject_CallMethod )?")
_SILENT = {2: "discarded", 3: "error", 4: "fatal error", 5: "pending"}


class UnpackedFmu:
    """An FMU file unpacked once, for any number of instances; `close` removes the directory."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self.directory = Path(mkdtemp(prefix="shipcollision-"))
        try:
            extract(file, self.directory)
            self.description = read_model_description(str(self.directory), validate=False)
        except Exception as error:  # fmpy and zipfile raise many kinds; all mean the same to a user
            self.close()
            raise HostError(f"{file} cannot be read as an FMU: {error}; {REMEDY}") from None
        self.variables = {variable.name: variable for variable in self.description.modelVariables}

    def close(self) -> None:
        """Remove the directory, and what the FMU's Python wrapper left on sys.path for it."""
        inside = str(self.directory)
        sys.path[:] = [entry for entry in sys.path if not str(entry).startswith(inside)]
        shutil.rmtree(self.directory, ignore_errors=True)


class FmuInstance(ABC):
    """An instance of an FMU for co-simulation, called through FMPy's library loader.

    Raises HostError when the FMU cannot be instantiated.
    """

    _do_step: Any
    """fmi2DoStep or fmi3DoStep of the library."""
    _step_options: tuple[Any, ...]
    """The arguments of the call after the step size."""
    _instantiated = False
    """Whether any FMU has been instantiated in this process."""

    def __init__(self, name: str, fmu: UnpackedFmu) -> None:
        self.name = name
        self._messages: deque[str] = deque(maxlen=8)
        self._initialised = False
        self._component: Any = None
        description = fmu.description
        _check_imports()
        try:
            self._fmu = self._instantiate({
                "guid": description.guid,
                "unzipDirectory": str(fmu.directory),
                "modelIdentifier": description.coSimulation.modelIdentifier,
                "instanceName": name,
            })  # fmt: skip
        except Exception as error:
            reason = self._message(ERROR) if self._messages else error
            raise HostError(f"{name}: {fmu.file.name} cannot be instantiated: {reason}") from None
        self._component = self._fmu.component
        FmuInstance._instantiated = True

    @abstractmethod
    def _instantiate(self, arguments: Mapping[str, str]) -> Any:
        """FMPy's slave for these arguments, instantiated, with `_remember` behind its logger."""

    @abstractmethod
    def _set(self, name: str, value: Value) -> None:
        """Set a parameter."""

    @abstractmethod
    def _enter_initialisation(self, stop_time: float) -> None:
        """Bring the instance into initialisation mode."""

    @abstractmethod
    def _exit_initialisation(self) -> int:
        """Leave initialisation mode; the status of the call."""

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        """See Component."""
        for name, value in parameters.items():
            self._set(name, value)
        self._enter_initialisation(stop_time)
        for group in inputs:
            group.write()
        self.check(self._exit_initialisation(), "initialisation")
        self._initialised = True

    def step(self, t: float, h: float) -> None:
        """See Component."""
        status = self._do_step(self._component, t, h, *self._step_options)
        if status > WARNING:
            self._initialised = status < ERROR  # FMI 2.0, section 4.2.4: no terminate after an error
            raise StepError(f"{self.name}: {self._message(status, f'step at t = {t:g} s ')}")

    def close(self) -> None:
        """See Component."""
        if self._component is None:
            return
        with suppress(Exception):  # the run has ended either way; a complaint now would hide its real error
            if self._initialised:
                self._fmu.terminate()
        with suppress(Exception):  # also after a fatal error, which FMI forbids: our slaves make it safe
            self._fmu.freeInstance()
        self._component = None

    def check(self, status: int, doing: str) -> None:
        """Raise HostError, with the FMU's own message, for a status beyond warning."""
        if status > WARNING:
            self._initialised = False
            raise HostError(f"{self.name}: {doing} failed: {self._message(status)}")

    def _remember(self, status: int, message: bytes) -> None:
        """Keep a message of the FMU for the error that may follow."""
        if status > WARNING and message:
            self._messages.append(message.decode("utf-8", "replace").strip())

    def _message(self, status: int, doing: str = "") -> str:
        """The FMU's last message, in one line, without what the wrapper puts before it."""
        if not self._messages:
            return f"{doing}{_SILENT[status]}, without a message"
        return _WRAPPER.sub("", " ".join(self._messages[-1].split()))


def _check_imports() -> None:
    """Raise HostError where the first FMU of a process would wait for the interpreter for ever."""
    if "coacd" in sys.modules and not FmuInstance._instantiated:
        raise HostError(
            "coacd is imported in this process, after which the first FMU of a Python wrapper waits for ever: import "
            "coacd in a process of its own or after the first run, or run the models with in_process=True"
        )
