"""The base of the FMI 2.0 slaves: a model behind pythonfmu.

A slave in fmu_src/ is a name and an Interface. A host calls:

    get_*, set_*                    straight to the model, a few microseconds for a hundred Reals
    do_step                         fmi2OK, or fmi2Discard and one logged line; the state before the step stays

pythonfmu's wrapper has only these two and fmi2Fatal to answer with; see slave_base for what follows from that.
"""

from __future__ import annotations

import math
import sys
from typing import Any

import pythonfmu
from pythonfmu.enums import Fmi2Status
from pythonfmu.fmi2slave import Fmi2Slave

from .slave_base import EVENTS, SlaveBase, take_reference
from .undecodable import make_own, replace_undecodable

__all__ = ["ModelSlave"]


class ModelSlave(SlaveBase, Fmi2Slave):  # type: ignore[misc]  # pythonfmu has no type information
    """An Interface as an FMI 2.0 slave: see SlaveBase."""

    wrapper = f"pythonfmu {pythonfmu.__version__}"

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Keep the slave's module alive: at each instantiation pythonfmu 0.7 runs its text and drops one reference to
        its dictionary too many. Text that is not UTF-8 reaches its own set_string alone."""
        super().__init_subclass__(**kwargs)
        make_own(cls, "set_string")
        if cls.__module__ in sys.modules:
            take_reference(vars(sys.modules[cls.__module__]))

    def do_step(self, current_time: float, step_size: float) -> bool:
        """One step; False (fmi2Discard) when it could not be made."""
        return self.try_step(current_time, step_size)

    def get_real(self, vrs: list[int]) -> list[float]:
        """Values of Reals; NaN when refused."""
        return self.get_values(self.access.get_real, vrs, ("Real",), math.nan)

    def get_integer(self, vrs: list[int]) -> list[int]:
        """Values of Integers and Enumerations; 0 when refused."""
        return self.get_values(self.access.get_integer, vrs, ("Integer", "Enumeration"), 0)

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Values of Booleans; false when refused."""
        return self.get_values(self.access.get_boolean, vrs, ("Boolean",), False)

    def get_string(self, vrs: list[int]) -> list[str]:
        """Values of Strings; empty when refused."""
        return self.get_values(self.access.get_string, vrs, ("String",), "")

    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """Set Reals."""
        self.set_values(self.access.set_real, vrs, values)

    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        """Set Integers and Enumerations."""
        self.set_values(self.access.set_integer, vrs, values)

    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """Set Booleans."""
        self.set_values(self.access.set_boolean, vrs, values)

    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """Set Strings."""
        replace_undecodable(values)
        self.set_values(self.access.set_string, vrs, values)

    def report(self, line: str) -> None:
        """Log a line as an error."""
        self.log(self._text(line), Fmi2Status.error)

    def warn(self, line: str) -> None:
        """Log a line as a warning."""
        self.log(self._text(line), Fmi2Status.warning)

    def tell(self, line: str) -> None:
        """Log a line as an event."""
        self.log(self._text(line), Fmi2Status.ok, EVENTS)

    @staticmethod
    def _text(line: str) -> str:
        """FMI 2.0's logger takes a printf format: a lone percent sign would read the host's memory."""
        return line.replace("%", "%%")
