"""The cases that lose most energy, and the command that runs one of them again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from .study_table import StudyTable

__all__ = ["COLUMNS", "Worst", "find_worst", "format_command"]

COLUMNS = (
    "energy", "situation", "own_ship", "target_ship", "kind", "angle_deg", "at", "own_speed",
    "target_speed", "closing_speed",
)  # fmt: skip


class Worst(NamedTuple):
    """A case: its row, its values by column."""

    row: int
    values: dict[str, Any]


def find_worst(table: StudyTable, ships: Mapping[str, str], count: int = 10) -> list[Worst]:
    """The cases of most energy, the worst first; of equal ones the lower row first. ships: names by label."""
    order = np.lexsort((table.row, -table.energy))[:count]
    rows = [int(row) for row in table.row[order]]
    cases = table.read_cases(rows, COLUMNS)
    for case in cases:
        case |= {key: ships.get(case.get(key, ""), case.get(key)) for key in ("own_ship", "target_ship")}
    return [Worst(row, values) for row, values in zip(rows, cases, strict=True)]


def format_command(row: int) -> str:
    """The line that computes a row again in the folder of the study, and writes its replay."""
    return f"shipcollision show . --row {row}"
