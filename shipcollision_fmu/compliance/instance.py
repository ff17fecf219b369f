"""An FMU instance with the calls that the probes make, in one form for FMI 2.0 and 3.0."""

from __future__ import annotations

import math
from ctypes import byref, c_bool, c_double, c_int, c_uint
from pathlib import Path
from typing import Any

from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CoSimulation
from fmpy.fmi3 import FMU3Slave

from ..errors import HostError
from ..fmi.builder.resource_uri import locate_resources

__all__ = ["DISCARD", "ERROR", "WARNING", "Instance"]

WARNING, DISCARD, ERROR = 1, 2, 3
"""Statuses: what is at most a warning succeeded; a discarded step did nothing, and FMI goes on."""


class Instance:
    """An FMU instance with the calls of the probes, in one form for both versions of FMI."""

    def __init__(
        self, folder: Path, token: str | None = None, *, by_standard: bool = False, location: str | None = None
    ) -> None:
        """by_standard: the resources are named as FMI demands, not as the wrapper can read it (FMI 2.0).
        location: they are named so (FMI 2.0)."""
        self.description = read_model_description(str(folder), validate=False)
        self.fmi = 3 if self.description.fmiVersion.startswith("3") else 2
        slave: type = FMU3Slave if self.fmi == 3 else FMU2Slave
        self.fmu: Any = slave(
            guid=self.description.guid if token is None else token,
            unzipDirectory=str(folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="one",
        )
        if self.fmi == 3 or by_standard:
            self.fmu.instantiate()
        else:
            self._instantiate(locate_resources(folder) if location is None else location)
        self.dll, self.component = self.fmu.dll, self.fmu.component

    def _instantiate(self, resources: str) -> None:
        """Instantiate an FMU of FMI 2.0 with this URI of its resources."""
        self.fmu.callbacks = defaultCallbacks
        self.fmu.component = self.fmu.fmi2Instantiate(
            self.fmu.instanceName.encode(), fmi2CoSimulation, self.fmu.guid.encode(), resources.encode(),
            byref(defaultCallbacks), 0, 0,
        )  # fmt: skip
        if self.fmu.component is None:
            raise HostError("fmi2Instantiate returned NULL")

    def call(self, name: str, *arguments: Any) -> int:
        """Call a function, by its name without prefix; returns its status."""
        status: int = getattr(self.dll, f"fmi{self.fmi}{name}")(self.component, *arguments)
        return status

    def enter(self, start: float = 0.0, stop: float | None = None) -> int:
        """Enter initialisation of an experiment from start to stop [s]; returns the status."""
        time = (start, stop is not None, stop or 0.0)
        if self.fmi == 3:
            return self.call("EnterInitializationMode", False, 0.0, *time)
        status = self.call("SetupExperiment", 0, 0.0, *time)
        return status if status > WARNING else self.call("EnterInitializationMode")

    def begin(self, start: float = 0.0, stop: float | None = None) -> int:
        """Enter and leave initialisation with the start values; returns the status."""
        status = self.enter(start, stop)
        return status if status > WARNING else self.call("ExitInitializationMode")

    def step(self, t: float, h: float) -> int:
        """Step from t by h; returns the status."""
        if self.fmi == 2:
            return self.call("DoStep", t, h, 1)
        flags = [byref(c_bool()) for _ in range(3)]
        return self.call("DoStep", t, h, True, *flags, byref(c_double()))

    def step_size(self) -> float:
        """The step size in the FMU's default experiment [s], else 0.01."""
        proposed = self.description.defaultExperiment and self.description.defaultExperiment.stepSize
        return float(proposed or 0.01)

    def set(self, variable: Any, value: float) -> int:
        """Set all elements of a Float64, Real, Int32 or Integer to a value; returns the status."""
        real = variable.type in ("Real", "Float64")
        size = math.prod(variable.shape) if self.fmi == 3 else 1
        values: Any = (c_double * size)(*[value] * size) if real else (c_int * size)(*[int(value)] * size)
        sizes = (size,) if self.fmi == 3 else ()
        return self.call(f"Set{variable.type}", (c_uint * 1)(variable.valueReference), 1, values, *sizes)

    def read_outputs(self) -> list[str]:
        """All real outputs as hexadecimal text, which is exact."""
        found = []
        for variable in self.description.modelVariables:
            if variable.type in ("Real", "Float64") and variable.causality == "output":
                size = math.prod(variable.shape) if self.fmi == 3 else 1
                values, sizes = (c_double * size)(), (size,) if self.fmi == 3 else ()
                self.call(f"Get{variable.type}", (c_uint * 1)(variable.valueReference), 1, values, *sizes)
                found += [value.hex() for value in values]
        return found

    def read(self, references: list[int]) -> tuple[int, list[float]]:
        """Status and values of scalars of type Real or Float64."""
        values, n = (c_double * len(references))(), len(references)
        sizes = (n,) if self.fmi == 3 else ()
        status = self.call(f"Get{'Float64' if self.fmi == 3 else 'Real'}", (c_uint * n)(*references), n, values, *sizes)
        return status, list(values)

    def find_variable(self, causality: str) -> Any:
        """The first numeric variable of a causality, or None."""
        for variable in self.description.modelVariables:
            if variable.causality == causality and variable.type in ("Real", "Float64", "Integer", "Int32"):
                return variable
        return None
