"""An FMU instance as a Component: FMI 2.0 co-simulation through FMPy's library loader, called with preallocated arrays.

A connection is one fmi2GetReal into a buffer and one fmi2SetReal from the same buffer; FMPy's own wrappers, which make
new arrays at every call, cost several times as much.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import Array, c_char_p, c_double, c_int, c_uint
from pathlib import Path
from typing import Any
from weakref import WeakValueDictionary

from fmpy.fmi2 import (
    FMU2Slave,
    addLoggerProxy,
    byref,
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2CoSimulation,
    printLogMessage,
)

from ..errors import HostError
from ..fmi.builder.resource_uri import locate_resources
from .component import Buffer, Group, Value, item_number
from .fmu_instance import REMEDY, WARNING, FmuInstance, UnpackedFmu

__all__ = ["Fmi2Component"]


class Fmi2Component(FmuInstance):
    """An instance of an FMU for co-simulation, FMI 2.0, called through ctypes with preallocated arrays."""

    def __init__(self, name: str, fmu: UnpackedFmu) -> None:
        self._variables = fmu.variables
        super().__init__(name, fmu)
        self._do_step, self._step_options = self._fmu.dll.fmi2DoStep, (1,)

    def _instantiate(self, arguments: Mapping[str, str]) -> Any:
        fmu = FMU2Slave(**arguments)
        self._callbacks = self._logger()  # the library holds them by address
        location = locate_resources(Path(fmu.unzipDirectory))
        fmu.component = fmu.fmi2Instantiate(
            fmu.instanceName.encode(), fmi2CoSimulation, fmu.guid.encode(), location.encode(),
            byref(self._callbacks), 0, 1,
        )  # fmt: skip
        if fmu.component is None:
            raise HostError("fmi2Instantiate returned NULL")
        return fmu

    def _enter_initialisation(self, stop_time: float) -> None:
        dll, component = self._fmu.dll, self._component
        self.check(dll.fmi2SetupExperiment(component, 0, 0.0, 0.0, 1, stop_time), "setup")
        self.check(dll.fmi2EnterInitializationMode(component), "initialisation")

    def _exit_initialisation(self) -> int:
        status: int = self._fmu.dll.fmi2ExitInitializationMode(self._component)
        return status

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        """See Component."""
        buffer = (c_double * len(names))() if values is None else values
        return _Group(self, "Real", self._references(names, {"Real"}), buffer)

    def integers(self, names: Sequence[str]) -> Group:
        """See Component."""
        return _Group(self, "Integer", self._references(names, {"Integer", "Enumeration"}), (c_int * len(names))())

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
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = _LOGGER
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        callbacks.componentEnvironment = id(self)
        _LISTENERS[id(self)] = self
        addLoggerProxy(byref(callbacks))
        return callbacks


_LISTENERS: WeakValueDictionary[int, Fmi2Component] = WeakValueDictionary()
"""The components of this process by what their FMUs give as componentEnvironment."""


def _hear(environment: int | None, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    listener = None if environment is None else _LISTENERS.get(environment)
    if listener is None:  # an FMU of another master in this process
        printLogMessage(environment, instance, status, category, message)
    else:
        listener._remember(status, message)


_LOGGER = fmi2CallbackLoggerTYPE(_hear)
"""One for all components, and never collected: FMPy's proxy keeps the address of the last logger that it was given, and
calls it for every FMU of the process, also when the component that gave it is gone."""


class _Group:
    def __init__(self, owner: Fmi2Component, kind: str, references: Array[c_uint], values: Buffer) -> None:
        self.values = values
        self._owner, self._references, self._size = owner, references, len(references)
        self._get = getattr(owner._fmu.dll, f"fmi2Get{kind}")
        self._set = getattr(owner._fmu.dll, f"fmi2Set{kind}")

    def read(self, count: int | None = None) -> None:
        size = self._size if count is None else count
        status = self._get(self._owner._component, self._references, size, self.values)
        if status > WARNING:
            self._owner.check(status, "reading outputs")

    def write(self) -> None:
        status = self._set(self._owner._component, self._references, self._size, self.values)
        if status > WARNING:
            self._owner.check(status, "writing inputs")
