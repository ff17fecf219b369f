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
from collections.abc import Callable, Sequence
from ctypes import c_uint64
from typing import Any, TypeVar

import pythonfmu3
from pythonfmu3.enums import Fmi3Status
from pythonfmu3.fmi3slave import Fmi3Slave, Fmi3StepResult

from ..errors import InputError
from .arrays import TIME, TYPES, ArrayVariable, gather_arrays
from .slave_base import EVENTS, SlaveBase
from .undecodable import make_own, replace_undecodable
from .variables import Kind

__all__ = ["ModelSlave3"]

T = TypeVar("T")

_SPARE = 256
"""Values beyond what an answer must have."""
_GETTERS: dict[Kind, str] = {
    "Real": "get_real", "Integer": "get_integer", "Enumeration": "get_integer", "Boolean": "get_boolean",
    "String": "get_string",
}  # fmt: skip
"""Getters of a VariableAccess by kind."""
_PLANS = 1000
"""So many sets of value references are remembered."""


class ModelSlave3(SlaveBase, Fmi3Slave):  # type: ignore[misc]  # pythonfmu3 has no type information
    """An Interface as an FMI 3.0 slave: see SlaveBase."""

    wrapper = f"pythonfmu3 {pythonfmu3.__version__}"

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Text that is not UTF-8 reaches a slave's own set_string alone."""
        super().__init_subclass__(**kwargs)
        make_own(cls, "set_string")

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._arrays = gather_arrays(self.access.table, self._scalar)
        self._plans: dict[tuple[str | int, ...], list[int]] = {}

    def do_step(self, current_time: float, step_size: float) -> Fmi3StepResult:
        """One step; fmi3Discard when it could not be made."""
        made = self.try_step(current_time, step_size)
        return Fmi3StepResult(status=Fmi3Status.ok if made else Fmi3Status.discard)

    # Values. ------------------------------------------------------------------------------

    def get_float64(self, vrs: list[int]) -> list[float]:
        """Values of Float64; NaN when refused."""
        if TIME in vrs:
            time = [self.experiment.time]
            return [value for vr in vrs for value in (time if vr == TIME else self._values([vr], "Real", math.nan))]
        return self._values(vrs, "Real", math.nan)

    def get_int32(self, vrs: list[int]) -> list[int]:
        """Values of Int32; 0 when refused."""
        return self._values(vrs, "Integer", 0)

    def get_int64(self, vrs: list[int]) -> list[int]:
        """Values of Enumerations; 0 when refused."""
        return self._values(vrs, "Enumeration", 0)

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Values of Booleans; false when refused."""
        return self._values(vrs, "Boolean", False) + [False] * _SPARE

    def get_string(self, vrs: list[int]) -> list[str]:
        """Values of Strings; empty when refused."""
        return self._values(vrs, "String", "") + [""] * _SPARE

    def get_uint64(self, vrs: list[int]) -> list[c_uint64]:
        """There are none."""
        if vrs:
            self._note_unanswered(self._no_uint64())
        return [c_uint64(0)] * (_SPARE + len(self.access.table))

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
        replace_undecodable(values)
        self.set_values(lambda vrs, values: self.access.set_string(self._scalars(vrs, "String"), values), vrs, values)

    def set_uint64(self, vrs: list[int], values: list[int]) -> None:
        """There are none."""
        del values
        if vrs:
            self._refuse(self._no_uint64())

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

    # Inside. ------------------------------------------------------------------------------

    def report(self, line: str) -> None:
        """Log a line as an error."""
        self.log(line, Fmi3Status.error)

    def warn(self, line: str) -> None:
        """Log a line as a warning."""
        self.log(line, Fmi3Status.warning)

    def tell(self, line: str) -> None:
        """Log a line as an event."""
        self.log(line, Fmi3Status.ok, EVENTS)

    def _values(self, vrs: list[int], kind: Kind, missing: T) -> list[T]:
        """Values of all elements, one after the other; `missing` for a reference that is wrong.

        How many values the host expects of that one is unknown where it is no variable at all: the answer is longer
        than it need be.
        """
        get: Callable[[Sequence[int]], list[Any]] = getattr(self.access, _GETTERS[kind])
        try:
            return self.get_values(get, self._scalars(vrs, kind), (kind,), missing)
        except InputError as error:
            self._note_unanswered(error)
        values: list[T] = []
        for vr in vrs:
            if 1 <= vr <= len(self._arrays) and self._arrays[vr - TIME - 1].line.kind == kind:
                values += self.get_values(get, self._scalars([vr], kind), (kind,), missing)
            else:
                values += [missing] * (self._arrays[vr - TIME - 1].size if 1 <= vr <= len(self._arrays) else 1)
        return values + [missing] * (_SPARE + len(self.access.table))

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

    def _no_uint64(self) -> InputError:
        return InputError(f"{self._made_from.name} has no variables of type UInt64")
