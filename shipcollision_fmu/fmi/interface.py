"""What an FMU is made from: a name, a table of variables, and the model behind it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .variable_access import Model, VariableAccess
from .variables import Table

__all__ = ["REQUIREMENTS", "SHIPS", "Interface"]

SHIPS = ("own", "target")
"""Names of the ships in the default build."""
REQUIREMENTS = ("numpy>=1.24", "pydantic>=2.7", "tomli>=2.0; python_version < '3.11'")
"""What every slave imports besides what it carries."""


@dataclass(frozen=True)
class Interface:
    """An FMU, before it is one. `table` and `model` take the names of the ships; a model of one ship ignores them.

    Step size, stop time [s] and tolerance are those of its default experiment: a proposal to the host.

    `requirements` are the packages that the host's Python must have, `instead` says what it must have where they have
    no wheels. `pythons` are the versions of CPython and `systems` the systems that it was run on: there is no library
    for another system. `terminals` takes the names of the
    ships and says how the names of a terminal's variables begin, by the name of the terminal.
    """

    name: str
    description: str
    table: Callable[[tuple[str, ...]], Table]
    model: Callable[[tuple[str, ...]], Model]
    step_size: float = 0.05
    stop_time: float = 60.0
    tolerance: float = 1e-6
    requirements: tuple[str, ...] = REQUIREMENTS
    pythons: tuple[str, str] = ("3.10", "3.13")
    systems: tuple[str, ...] = ("linux", "win")
    instead: str = ""
    terminals: Callable[[tuple[str, ...]], Mapping[str, str]] = lambda ships: {}

    def make_access(
        self, ships: tuple[str, ...] = SHIPS, start: Mapping[str, Any] | None = None, files: Path | None = None
    ) -> VariableAccess:
        """Access to a fresh model: the inside of the FMU, to be driven in process.

        `start` replaces some of the model's start values. In `files`, the FMU's resources, a model that reads files
        looks first.
        """
        model = self.model(ships)
        if files is not None and hasattr(model, "directory"):
            model.directory = files
        access = VariableAccess(self.name, self.table(ships), model)
        if start:
            access.preset(start)
        return access
