"""What an FMU is made from: a name, a table of variables, and the model behind it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .variable_access import Model, VariableAccess
from .variables import Table

__all__ = ["SHIPS", "Interface"]

SHIPS = ("own", "target")
"""Names of the ships in the default build."""


@dataclass(frozen=True)
class Interface:
    """An FMU, before it is one. `table` and `model` take the names of the ships; a model of one ship ignores them."""

    name: str
    description: str
    table: Callable[[tuple[str, ...]], Table]
    model: Callable[[tuple[str, ...]], Model]
    step_size: float = 0.05

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
