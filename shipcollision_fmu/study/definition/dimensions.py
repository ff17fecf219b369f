"""list_dimensions(): what a study draws at random, in the order of the dimensions of a sampler."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from .distributions import Constant, Distribution, TableColumn
from .fleet import Fleet

__all__ = ["list_dimensions"]


def list_dimensions(
    tables: Iterable[str], fleets: Mapping[str, Fleet], variables: Mapping[str, Distribution], grid: Iterable[str]
) -> list[str]:  # fmt: skip
    """Names of tables, of ships and of variables that have more than one value."""
    ships = [f"{role}.ship" for role, fleet in fleets.items() if fleet.column is None and fleet.size > 1]
    crossed = set(grid)
    drawn = [
        name for name, given in variables.items()
        if name not in crossed and not isinstance(given, Constant | TableColumn)
    ]  # fmt: skip
    return [*(f"table.{name}" for name in tables), *ships, *drawn]
