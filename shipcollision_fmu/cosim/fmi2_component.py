"""An FMU instance as a Component: FMI 2.0 co-simulation through FMPy's library loader, called with preallocated arrays.

A connection is one fmi2GetReal into a buffer and one fmi2SetReal from the same buffer; FMPy's own wrappers, which make
new arrays at every call, cost several times as much.
"""

from __future__ import annotations

import re
import shutil
import sys
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from ctypes import Array, c_char_p, c_double, c_int, c_uint
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from fmpy import extract, read_model_description
from fmpy.fmi2 import (
    FMU2Slave,
    addLoggerProxy,
    byref,
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Error,
    fmi2Warning,
)

from ..errors import HostError, StepError
from .component import Buffer, Group, Value, item_number

__all__ = ["REMEDY", "FmuComponent", "UnpackedFmu", "told"]

REMEDY = "build it again with `shipcollision build`"
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


class FmuComponent:
    """An instance of an FMU for co-simulation, FMI 2.0, called through ctypes with preallocated arrays."""

    def __init__(self, name: str, fmu: UnpackedFmu) -> None:
        self.name = name
        self._variables = fmu.variables
        self._messages: deque[str] = deque(maxlen=8)
        self._initialised = False
        description = fmu.description
        try:
            self._fmu = FMU2Slave(
                guid=description.guid,
                unzipDirectory=str(fmu.directory),
                modelIdentifier=description.coSimulation.modelIdentifier,
                instanceName=name,
            )
            self._callbacks = self._logger()
            self._fmu.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as error:
            said = self._said(fmi2Error) if self._messages else error
            raise HostError(f"{name}: {fmu.file.name} cannot be instantiated: {said}") from None
        self._component: Any = self._fmu.component
        self._do_step = self._fmu.dll.fmi2DoStep

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        """See Component."""
        buffer = (c_double * len(names))() if values is None else values
        return _FmuGroup(self, "Real", self._references(names, {"Real"}), buffer)

    def integers(self, names: Sequence[str]) -> Group:
        """See Component."""
        return _FmuGroup(self, "Integer", self._references(names, {"Integer", "Enumeration"}), (c_int * len(names))())

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        """See Component."""
        for name, value in parameters.items():
            self._set(name, value)
        dll, component = self._fmu.dll, self._component
        self.check(dll.fmi2SetupExperiment(component, 0, 0.0, 0.0, 1, stop_time), "setup")
        self.check(dll.fmi2EnterInitializationMode(component), "initialisation")
        for group in inputs:
            group.write()
        self.check(dll.fmi2ExitInitializationMode(component), "initialisation")
        self._initialised = True

    def step(self, t: float, h: float) -> None:
        """See Component."""
        status = self._do_step(self._component, t, h, 1)
        if status > fmi2Warning:
            self._initialised = status < fmi2Error  # FMI 2.0, section 4.2.4: no terminate after an error
            raise StepError(f"{self.name}: {self._said(status, f'step at t = {t:g} s ')}")

    def close(self) -> None:
        """See Component."""
        if self._component is None:
            return
        with suppress(Exception):  # the run has ended either way; a complaint now would hide its real error
            if self._initialised:
                self._fmu.terminate()
        with suppress(Exception):  # also after fmi2Fatal, which FMI forbids: our slaves see to it that this is safe
            self._fmu.freeInstance()
        self._component = None

    def check(self, status: int, doing: str) -> None:
        """Raise HostError, with the FMU's own message, for a status beyond warning."""
        if status > fmi2Warning:
            self._initialised = False
            raise HostError(f"{self.name}: {doing} failed: {self._said(status)}")

    def _set(self, name: str, value: Value) -> None:
        if name not in self._variables:
            raise HostError(f"{self.name}: the FMU has no variable {name!r}; {REMEDY}")
        variable = self._variables[name]
        reference = (c_uint * 1)(variable.valueReference)
        dll, component = self._fmu.dll, self._component
        if variable.type == "Real":
            status = dll.fmi2SetReal(component, reference, 1, (c_double * 1)(float(value)))
        elif variable.type == "Boolean":
            status = dll.fmi2SetBoolean(component, reference, 1, (c_int * 1)(int(bool(value))))
        elif variable.type == "String":
            status = dll.fmi2SetString(component, reference, 1, (c_char_p * 1)(str(value).encode()))
        else:
            if isinstance(value, str):
                value = item_number(self.name, name, value, [item.name for item in variable.declaredType.items])
            status = dll.fmi2SetInteger(component, reference, 1, (c_int * 1)(int(value)))
        self.check(status, f"setting {name} = {value!r}")

    def _references(self, names: Sequence[str], types: set[str]) -> Array[c_uint]:
        references = (c_uint * len(names))()
        for i, name in enumerate(names):
            variable = self._variables.get(name)
            if variable is None or variable.type not in types:
                kind = " or ".join(sorted(types))
                raise HostError(f"{self.name}: the FMU has no {kind} {name!r}; {REMEDY}")
            references[i] = variable.valueReference
        return references

    def _logger(self) -> fmi2CallbackFunctions:
        """Callbacks that keep the FMU's last messages, for the error that may follow."""
        messages = self._messages

        def keep(environment: Any, instance: bytes, status: int, category: bytes, message: bytes) -> None:
            del environment, instance, category
            if status > fmi2Warning and message:
                messages.append(message.decode("utf-8", "replace").strip())

        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(keep)
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        addLoggerProxy(byref(callbacks))
        return callbacks

    def _said(self, status: int, doing: str = "") -> str:
        return told(self._messages, status, doing)


def told(messages: Sequence[str], status: int, doing: str = "") -> str:
    """An FMU's last message, in one line, without what the wrapper puts before it."""
    if not messages:
        return f"{doing}{_SILENT[status]}, without a message"
    return _WRAPPER.sub("", " ".join(messages[-1].split()))


class _FmuGroup:
    def __init__(self, owner: FmuComponent, kind: str, references: Array[c_uint], values: Buffer) -> None:
        self.values = values
        self._owner, self._references, self._size = owner, references, len(references)
        self._get = getattr(owner._fmu.dll, f"fmi2Get{kind}")
        self._set = getattr(owner._fmu.dll, f"fmi2Set{kind}")

    def read(self, count: int | None = None) -> None:
        size = self._size if count is None else count
        status = self._get(self._owner._component, self._references, size, self.values)
        if status > fmi2Warning:
            self._owner.check(status, "reading outputs")

    def write(self) -> None:
        status = self._set(self._owner._component, self._references, self._size, self.values)
        if status > fmi2Warning:
            self._owner.check(status, "writing inputs")
