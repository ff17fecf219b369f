"""The columns of the tables of batches, from the lists that make their types."""

from __future__ import annotations

from collections.abc import Sequence

from shipcollision_fmu.batch.encounter_columns import COLLISION_COLUMNS, ENCOUNTER_COLUMNS, SHIP_COLUMNS
from shipcollision_fmu.batch.impact_columns import COLUMNS, Column

from .markdown import cell, table

__all__ = ["collisions", "encounters", "impacts", "ships"]


def impacts() -> str:
    """The columns of the table that impact() returns."""
    return _describe(COLUMNS)


def encounters() -> str:
    """The columns of the encounters of run_encounters()."""
    return _describe(ENCOUNTER_COLUMNS)


def ships() -> str:
    """The columns of their ships."""
    return _describe(SHIP_COLUMNS)


def collisions() -> str:
    """The columns of their collisions."""
    return _describe(COLLISION_COLUMNS)


def _describe(columns: Sequence[Column]) -> str:
    rows = [
        (f"`{column.name}`", column.type if column.size == 1 else f"{column.size} {column.type}", column.unit,
         cell(column.meaning))
        for column in columns
    ]  # fmt: skip
    return table(("column", "type", "unit", "meaning"), rows)
