"""The ship model in its forms: the Python model, and the FMUs made of it behind the same face.

A test asks make_model() for a ship, and the fixture `engine` (tests/conftest.py) says of which form it is. What holds
for the model then is tested of the FMUs as well, and is written once.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave, byref, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from shipcollision_fmu.errors import ScenarioError, ShipError, StepError
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE
from shipcollision_fmu.manoeuvring.interface import ShipInputs, ShipOutputs, ShipParameters
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring

__all__ = ["ENGINES", "OF_THE_OBJECT", "ModelOfFmu", "RefusedError", "make_model", "reuse_model", "use_engine"]

ENGINES = ("Python", "Python FMU", "native FMU")
OF_THE_OBJECT = pytest.mark.parametrize("engine", ["Python"], indirect=True)
"""Marks what FMI has no word for, or another: it is tested of the Python model alone."""
OK, WARNING = 0, 1


class RefusedError(ShipError, ScenarioError, StepError):
    """What an FMU refused; FMI has no kinds of it."""


@dataclass
class _Engine:
    make: Callable[[], Any] = ShipManoeuvring
    reused: Any = None


_now = _Engine()


def use_engine(make: Callable[[], Any]) -> None:
    """From here on make_model() makes such models."""
    _now.make, _now.reused = make, None


def make_model() -> Any:
    """A ship of the engine in use: a ShipManoeuvring, or a ModelOfFmu."""
    return _now.make()


def reuse_model() -> Any:
    """The same ship at each call, which spares making one for each example of a property."""
    if _now.reused is None:
        _now.reused = make_model()
    return _now.reused


@dataclass
class ModelOfFmu:
    """ShipManoeuvring behind FMI 2.0: fill parameters and inputs, initialise(), then step(t, h), as of the model.

    unpacked: the folder of the FMU. find_ship: the text for its parameter `ship`, from the name or path that a test
    has.
    """

    unpacked: Path
    find_ship: Callable[[str], str] = lambda ship: ship
    parameters: ShipParameters = field(default_factory=ShipParameters)
    inputs: ShipInputs = field(default_factory=ShipInputs)
    outputs: ShipOutputs = field(default_factory=ShipOutputs)
    warning: str = ""

    def __post_init__(self) -> None:
        self._said: list[tuple[int, str]] = []
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._hear)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        description = read_model_description(str(self.unpacked))
        self._guid = description.guid
        self._identifier = description.coSimulation.modelIdentifier
        self._fmu = self._instantiate()
        self._running = False

    def __del__(self) -> None:
        with suppress(AttributeError):
            self._fmu.freeInstance()

    def _instantiate(self) -> Any:
        fmu = FMU2Slave(
            guid=self._guid, unzipDirectory=str(self.unpacked), modelIdentifier=self._identifier, instanceName="ship"
        )
        fmu.instantiate(callbacks=self._callbacks, loggingOn=True)
        return fmu

    def _hear(self, _environment: Any, _name: bytes, status: int, _category: bytes | None, message: bytes) -> None:
        self._said.append((status, message.decode().replace("%%", "%")))

    def initialise(self) -> None:
        """In a new instance, which takes the place of the old one when it is initialised."""
        fmu, self._said[:] = self._instantiate(), []
        try:
            self._set(fmu, "parameter")
            self._set(fmu, "input")
            fmu.setupExperiment(startTime=0.0)
            fmu.enterInitializationMode()
            if fmu.dll.fmi2ExitInitializationMode(fmu.component) != OK:
                raise RefusedError(self._reason())
        except BaseException:
            fmu.freeInstance()
            raise
        self._fmu.freeInstance()
        self._fmu, self._running = fmu, True
        self._take()

    def step(self, t: float, h: float) -> None:
        self._said.clear()
        if not self._running:
            raise RefusedError("step before initialise: call initialise() first")
        self._set(self._fmu, "input")
        if self._fmu.dll.fmi2DoStep(self._fmu.component, t, h, 1) != OK:
            raise RefusedError(self._reason())
        self._take()

    def get_state(self) -> dict[str, Any]:
        if not self._running:
            return {}
        self._set(self._fmu, "input")
        state = self._fmu.getFMUstate()
        data: bytes = self._fmu.serializeFMUstate(state)
        self._fmu.freeFMUstate(state)
        return {"bytes": data.hex()}

    def set_state(self, state: dict[str, Any]) -> None:
        self._said.clear()
        self._running = bool(state)
        if not state:
            return
        handle = self._fmu.deSerializeFMUstate(bytes.fromhex(state["bytes"]))
        status = self._fmu.dll.fmi2SetFMUstate(self._fmu.component, handle)
        self._fmu.dll.fmi2FreeFMUstate(self._fmu.component, byref(handle))
        if status != OK:
            raise RefusedError(self._reason())
        self._take()

    def _reason(self) -> str:
        """The last refusal. A wrapper of Python may put a line of its own before it."""
        last = next((message for status, message in reversed(self._said) if status > WARNING), "nothing was said")
        return last.splitlines()[-1]

    def _set(self, fmu: Any, causality: str) -> None:
        setters = {"Real": fmu.setReal, "Integer": fmu.setInteger, "Boolean": fmu.setBoolean, "String": fmu.setString,
                   "Enumeration": fmu.setInteger}  # fmt: skip
        values: dict[str, tuple[list[int], list[Any]]] = {kind: ([], []) for kind in setters}
        for reference, variable in enumerate(TABLE):
            if variable.causality == causality:
                value = self._value(variable.path, variable.index)
                if variable.path == "parameters.ship":
                    value = self.find_ship(value)
                if variable.kind == "Enumeration":
                    value = variable.items.index(value) + 1
                values[variable.kind][0].append(reference)
                values[variable.kind][1].append(float(value) if variable.kind == "Real" else value)
        for kind, (references, listed) in values.items():
            if references:
                setters[kind](references, listed)

    def _value(self, path: str, index: int | None) -> Any:
        part, name = path.split(".")
        value = getattr(getattr(self, part), name)
        return value if index is None else value[index]

    def _take(self) -> None:
        """The outputs, and what was warned of."""
        references = [reference for reference, variable in enumerate(TABLE) if variable.causality == "output"]
        for reference, value in zip(references, self._fmu.getReal(references), strict=True):
            variable = TABLE[reference]
            name = variable.path.removeprefix("outputs.")
            if variable.index is None:
                setattr(self.outputs, name, value)
            else:
                getattr(self.outputs, name)[variable.index] = value
        self.warning = "; ".join(message for status, message in self._said if status == WARNING)


TABLE = INTERFACE.table(())
