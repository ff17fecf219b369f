"""Parts of a system: instances of FMUs with their start values, and connections between them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..cosim.component import Value
from ..fmi.builder.native_fmus import native_instance_fmu
from ..fmi.builder.package import instance_fmu
from ..fmi.interface import Interface
from ..fmi.variables import Table, Variable

__all__ = ["COLLISION", "Connection", "Instance"]

COLLISION = "collision"
"""Name of the collision's instance, which no ship may have."""


@dataclass(frozen=True)
class Connection:
    """A connection from a Real output of one instance to a Real input of another."""

    source: str
    output: str
    target: str
    input: str


@dataclass(frozen=True)
class Instance:
    """An FMU of the system.

    start   start values by variable; an item of an enumeration by its name
    shown   variables that a user would change: parameters, orders, wind and current
    files   files in its resources, by path
    fmi     version of FMI; FMI 3.0 without arrays, which SSP 1.0 and OSP cannot connect
    native  platforms of an FMU without Python; none for one that runs Python
    """

    name: str
    interface: Interface
    ships: tuple[str, ...]
    start: Mapping[str, Value]
    shown: tuple[str, ...]
    files: Mapping[str, bytes]
    fmi: int = 2
    native: tuple[str, ...] = ()

    @property
    def model(self) -> str:
        """ShipManoeuvring or ShipCollision."""
        return self.interface.name

    @property
    def table(self) -> Table:
        """The table of its variables."""
        return self.interface.table(self.ships)

    def build_fmu(self) -> bytes:
        """The FMU file."""
        parts = (self.interface, self.ships, self.start, self.files, self.fmi, self.fmi == 3)
        return native_instance_fmu(*parts, self.native) if self.native else instance_fmu(*parts)

    def list_shown_values(self) -> list[tuple[Variable, Value]]:
        """The variables of `shown` with their start values, in the order of the table."""
        return [(variable, self.start[variable.name]) for variable in self.table if variable.name in self.shown]
