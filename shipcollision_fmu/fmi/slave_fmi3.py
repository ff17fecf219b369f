"""The base of the FMI 3.0 slaves: a model behind pythonfmu3.

The variables are those of FMI 2.0, gathered into arrays (arrays.py); values and bits are the same. A host calls:

    get_*, set_*                    arrays, straight to the model
    do_step                         fmi3OK, or fmi3Discard and one logged line; the state before the step stays

pythonfmu3 finds the class of a slave by the word Fmi3Slave among its bases, so a slave in fmu_src/fmi3/ names it. It
reads as many values from an answer as the host has asked for, and past the end of a list of Booleans or Strings it
crashes: those answers are longer than they need be.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from ctypes import c_uint64
from typing import Any

import pythonfmu3
from pythonfmu3.enums import Fmi3Status
from pythonfmu3.fmi3slave import Fmi3Slave, Fmi3StepResult

from ..errors import InputError
from .arrays import TIME, TYPES, ArrayVariable, gather_arrays
from .slave_base import SlaveBase
from .variables import Kind

__all__ = ["ModelSlave3"]

_SPARE = 256
"""Values beyond what an answer must have."""
_PLANS = 1000
"""So many sets of value references are remembered."""


class ModelSlave3(SlaveBase, Fmi3Slave):  # type: ignore[misc]  # pythonfmu3 has no type information
    """An Interface as an FMI 3.0 slave: see SlaveBase."""

    wrapper = f"pythonfmu3 {pythonfmu3.__version__}"

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._arrays = gather_arrays(self.access.table)
        self._plans: dict[tuple[str | int, ...], list[int]] = {}
        self._time = 0.0

    def do_step(self, current_time: float, step_size: float) -> Fmi3StepResult:
        """One step; fmi3Discard when it could not be made."""
        if not self.try_step(current_time, step_size):
            return Fmi3StepResult(status=Fmi3Status.discard)
        self._time = current_time + step_size
        return Fmi3StepResult(status=Fmi3Status.ok)

    # Values. ------------------------------------------------------------------------------

    def get_float64(self, vrs: list[int]) -> list[float]:
        """Values of Float64; NaN when refused."""
        if TIME in vrs:
            return [value for vr in vrs for value in ([self._time] if vr == TIME else self._float64([vr]))]
        return self._float64(vrs)

    def get_int32(self, vrs: list[int]) -> list[int]:
        """Values of Int32; 0 when refused."""
        return self._numbers(vrs, "Integer")

    def get_int64(self, vrs: list[int]) -> list[int]:
        """Values of Enumerations; 0 when refused."""
        return self._numbers(vrs, "Enumeration")

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Values of Booleans; false when refused."""
        values = self.get_values(lambda vrs: self.access.get_boolean(self._scalars(vrs, "Boolean")), vrs)
        return (values or []) + [False] * self._spare(values)

    def get_string(self, vrs: list[int]) -> list[str]:
        """Values of Strings; empty when refused."""
        values = self.get_values(lambda vrs: self.access.get_string(self._scalars(vrs, "String")), vrs)
        return (values or []) + [""] * self._spare(values)

    def get_uint64(self, vrs: list[int]) -> list[c_uint64]:
        """There are none."""
        self.get_values(lambda vrs: self._no_uint64(), vrs)
        return [c_uint64(0)] * self._spare(None)

    def set_float64(self, vrs: list[int], values: list[float]) -> None:
        """Set Float64."""
        self.set_values(lambda vrs, values: self.access.set_real(self._scalars(vrs, "Real"), values), vrs, values)

    def set_int32(self, vrs: list[int], values: list[int]) -> None:
        """Set Int32."""
        self.set_values(lambda vrs, values: self.access.set_integer(self._scalars(vrs, "Integer"), values), vrs, values)

    def set_int64(self, vrs: list[int], values: list[int]) -> None:
        """Set Enumerations."""
        self.set_values(
            lambda vrs, values: self.access.set_integer(self._scalars(vrs, "Enumeration"), values), vrs, values
        )

    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """Set Booleans."""
        self.set_values(lambda vrs, values: self.access.set_boolean(self._scalars(vrs, "Boolean"), values), vrs, values)

    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """Set Strings."""
        self.set_values(lambda vrs, values: self.access.set_string(self._scalars(vrs, "String"), values), vrs, values)

    def set_uint64(self, vrs: list[int], values: list[int]) -> None:
        """There are none."""
        self.set_values(lambda vrs, values: self._no_uint64(), vrs, values)

    # What only model exchange has. A host that calls it all the same gets an answer, and the next step fails. -------

    def get_continuous_states(self) -> list[float]:
        """There are none."""
        return self._no("continuous states")

    def get_continuous_state_derivatives(self) -> list[float]:
        """There are none."""
        return self._no("continuous states")

    def get_nominals_of_continuous_states(self, number: int) -> list[float]:
        """There are none."""
        return self._no("continuous states", number)

    def set_continuous_states(self, values: list[float]) -> None:
        """There are none."""
        self._no("continuous states")

    def get_event_indicators(self) -> list[float]:
        """There are none."""
        return self._no("event indicators")

    def set_time(self, time: float) -> None:
        """The time is that of doStep."""
        self._no("time of its own")

    def update_discrete_states(self) -> object:
        """There is no event mode."""
        return self._no("event mode")

    # The whole state. ------------------------------------------------------------------------------

    def _get_fmu_state(self) -> dict[str, Any]:
        return {**super()._get_fmu_state(), "time": self._time}

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        super()._set_fmu_state(state)
        if not self._refused:
            self._time = float(state.get("time", math.nan))  # a state of the FMI 2.0 slave has none

    # Inside. ------------------------------------------------------------------------------

    def report(self, line: str) -> None:
        """Log a line as an error."""
        self.log(line, Fmi3Status.error)

    def warn(self, line: str) -> None:
        """Log a line as a warning."""
        self.log(line, Fmi3Status.warning)

    def _float64(self, vrs: Sequence[int]) -> list[float]:
        values = self.get_values(lambda vrs: self.access.get_real(self._scalars(vrs, "Real")), vrs)
        return [math.nan] * self._spare(None) if values is None else values

    def _numbers(self, vrs: list[int], kind: Kind) -> list[int]:
        values = self.get_values(lambda vrs: self.access.get_integer(self._scalars(vrs, kind)), vrs)
        return [0] * self._spare(None) if values is None else values

    def _spare(self, values: Sequence[Any] | None) -> int:
        """Values to add to an answer. After a refusal the number that the host expects is unknown: all of the table."""
        return _SPARE if values is not None else _SPARE + len(self.access.table)

    def _scalars(self, vrs: Sequence[int], kind: Kind) -> list[int]:
        """References in the table of all elements, one after the other. Raises InputError for one of another kind."""
        request = (kind, *vrs)
        plan = self._plans.get(request)
        if plan is None:
            plan = [scalar for vr in vrs for scalar in self._array(vr, kind).references]
            if len(self._plans) >= _PLANS:
                self._plans.clear()
            self._plans[request] = plan
        return plan

    def _array(self, vr: int, kind: Kind) -> ArrayVariable:
        name = self._made_from.name
        if vr == TIME:
            raise InputError(f"{name}: time (value reference {TIME}) is the independent variable: it is only read")
        if not 1 <= vr <= len(self._arrays):
            raise InputError(f"{name}: value reference {vr} is unknown; it has 0 to {len(self._arrays)}")
        array = self._arrays[vr - TIME - 1]
        if array.line.kind != kind:
            is_, called = TYPES[array.line.kind], TYPES[kind]
            raise InputError(f"{name}: {array.name} (value reference {vr}) is {is_}, not {called}")
        return array

    def _no(self, what: str, number: int = _SPARE) -> list[float]:
        self._refuse(InputError(f"{self._made_from.name} is for co-simulation and has no {what}"))
        return [math.nan] * number

    def _no_uint64(self) -> list[Any]:
        raise InputError(f"{self._made_from.name} has no variables of type UInt64")
