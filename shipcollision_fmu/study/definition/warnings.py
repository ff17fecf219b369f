"""list_warnings(): what a study may be without being wrong, and hardly is on purpose."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi, prod
from typing import Any

from .distributions import Distribution
from .empirical import EmpiricalTable
from .level_checks import find_limits

__all__ = ["list_warnings"]


def list_warnings(
    rows: int, dimensions: list[str], grid: Mapping[str, list[Any]], variables: Mapping[str, Distribution],
    tables: Mapping[str, EmpiricalTable],
) -> Iterator[str]:  # fmt: skip
    """A line for rows that are all alike, and one for angles that look like radians."""
    cells = prod(len(values) for values in grid.values())
    if rows > cells and not dimensions:
        alike = f"all {rows} rows are" if cells == 1 else f"each of the {cells} cells has {rows // cells} rows that are"
        yield (
            f"{alike} alike, as no variable has a distribution and there is one ship of each role: give one, or fewer "
            "rows"
        )
    limits = find_limits("angle_deg", grid, variables, tables)
    if limits is not None and 0.0 < limits[1] <= pi:
        yield f"angle_deg is at most {limits[1]:.4g} degrees in all rows: give degrees if these are radians"
