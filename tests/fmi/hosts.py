"""Instances of an FMU as a host sees them, through fmpy: by FMI 2.0, and by FMI 3.0."""

from __future__ import annotations

import json
from collections import defaultdict
from ctypes import byref, c_bool, c_double
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave


class Host:
    """An instance, its variables by name, and what it logged as (status, message).

    refusal: the status of a step that the standard calls an error; Python's wrapper has Discard alone to answer with.
    """

    refusal = 0

    def __init__(self, unpacked: Path, name: str, logging: bool = True) -> None:
        description = read_model_description(str(unpacked))
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.kinds: dict[str, list[int]] = defaultdict(list)
        for variable in description.modelVariables:
            self.kinds[variable.type].append(variable.valueReference)
        self.messages: list[tuple[int, str]] = []
        self.categories: list[str] = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._take)
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=str(unpacked),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu.instantiate(callbacks=callbacks, loggingOn=logging)
        self.dll: Any = self.fmu.dll
        self.component: Any = self.fmu.component

    def _take(self, env: Any, who: bytes, status: int, category: bytes | None, message: bytes) -> None:
        self.messages.append((status, message.decode()))
        self.categories.append((category or b"").decode())

    def free(self) -> None:
        if self.component is not None:
            self.fmu.freeInstance()
            self.component = None

    def reference(self, *names: str) -> list[int]:
        return [self.references[name] for name in names]

    def reals(self, *names: str) -> list[float]:
        values: list[float] = self.fmu.getReal(self.reference(*names))
        return values

    def place(self) -> list[float]:
        return self.reals("place.x", "place.y", "place.z")

    def begin(self, start: float = 0.0, stop: float | None = None) -> int:
        """Through initialisation; the status of its end."""
        self.fmu.setupExperiment(startTime=start, stopTime=stop)
        self.fmu.enterInitializationMode()
        status: int = self.dll.fmi2ExitInitializationMode(self.component)
        return status

    def step(self, k: int, h: float = 0.1) -> int:
        status: int = self.dll.fmi2DoStep(self.component, k * h, h, 1)
        return status

    def everything(self) -> str:
        """All values, exactly."""
        return json.dumps([
            self.fmu.getReal(self.kinds["Real"]),
            self.fmu.getInteger(self.kinds["Integer"] + self.kinds["Enumeration"]),
            self.fmu.getBoolean(self.kinds["Boolean"]),
            [text.decode() for text in self.fmu.getString(self.kinds["String"])],
        ])  # fmt: skip

    def saved(self) -> bytes:
        """The whole state as bytes."""
        state = self.fmu.getFMUstate()
        try:
            data: bytes = self.fmu.serializeFMUstate(state)
        finally:
            self.fmu.freeFMUstate(state)
        return data

    def restore(self, data: bytes) -> int:
        state = self.fmu.deSerializeFMUstate(data)
        status: int = self.dll.fmi2SetFMUstate(self.component, state)
        self.dll.fmi2FreeFMUstate(self.component, byref(state))
        return status


class Host3:
    """An instance, its variables by name, and what it logged as (status, message)."""

    def __init__(self, unpacked: Path, name: str) -> None:
        description = read_model_description(str(unpacked))
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.messages: list[tuple[int, str]] = []
        self.fmu = FMU3Slave(
            guid=description.guid,
            unzipDirectory=str(unpacked),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        log = lambda env, status, category, message: self.messages.append((status, message.decode()))  # noqa: E731  # short, and used once
        self.fmu.instantiate(loggingOn=True, logMessage=log)
        self.dll: Any = self.fmu.dll
        self.component: Any = self.fmu.component

    def free(self) -> None:
        if self.component is not None:
            self.fmu.freeInstance()
            self.component = None

    def reference(self, *names: str) -> list[int]:
        return [self.variables[name].valueReference for name in names]

    def get(self, *names: str) -> list[Any]:
        first = self.variables[names[0]]
        suffix = "Int64" if first.type == "Enumeration" else first.type
        size = sum(int(np.prod([int(d.start) for d in self.variables[name].dimensions])) for name in names)
        values: list[Any] = getattr(self.fmu, f"get{suffix}")(self.reference(*names), nValues=size)
        return values

    def set(self, name: str, *values: Any) -> None:
        kind = self.variables[name].type
        getattr(self.fmu, f"set{'Int64' if kind == 'Enumeration' else kind}")(self.reference(name), list(values))

    def begin(self) -> int:
        self.fmu.enterInitializationMode()
        status: int = self.dll.fmi3ExitInitializationMode(self.component)
        return status

    def step_from(self, t: float, h: float) -> tuple[int, list[bool], float]:
        """Its status, its three flags, and the time where it stands."""
        flags, last = [c_bool(True) for _ in range(3)], c_double(-7.0)
        status: int = self.dll.fmi3DoStep(
            self.component, c_double(t), c_double(h), True, *map(byref, flags), byref(last)
        )
        return status, [flag.value for flag in flags], last.value

    def step(self, k: int, h: float = 0.1) -> int:
        return self.step_from(k * h, h)[0]

    def everything(self) -> str:
        """All values, exactly."""
        return json.dumps({name: [str(v) for v in self.get(name)] for name in self.variables})

    def saved(self) -> bytes:
        state = self.fmu.getFMUState()
        try:
            data: bytes = self.fmu.serializeFMUState(state)
        finally:
            self.fmu.freeFMUState(state)
        return data

    def restore(self, data: bytes) -> int:
        state = self.fmu.deserializeFMUState(data)
        status: int = self.dll.fmi3SetFMUState(self.component, state)
        self.fmu.freeFMUState(state)
        return status
