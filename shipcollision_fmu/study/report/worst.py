"""The cases that lose most energy, and the commands that run one of them again."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...errors import ShipCollisionError
from ..definition.study import read_study
from .study_table import StudyTable

__all__ = ["COLUMNS", "Worst", "can_repeat", "find_worst", "format_commands"]

COLUMNS = (
    "energy", "own_ship", "target_ship", "kind", "angle_deg", "at", "own_speed", "target_speed", "closing_speed",
)  # fmt: skip


class Worst(NamedTuple):
    """A case: its row, its values by column."""

    row: int
    values: dict[str, Any]


def find_worst(table: StudyTable, count: int = 10) -> list[Worst]:
    """The cases of most energy, the worst first; of equal ones the lower row first."""
    order = np.lexsort((table.row, -table.energy))[:count]
    rows = [int(row) for row in table.row[order]]
    return [Worst(row, values) for row, values in zip(rows, table.read_cases(rows, COLUMNS), strict=True)]


def format_commands(name: str, row: int) -> str:
    """The line that runs a row again, in the folder of the study: a scenario file is written, then run."""
    return (
        f"shipcollision study study.toml --row {row} --out cases && "
        f"shipcollision run cases/{name}_{row}.toml --out cases/{name}_{row}"
    )


def can_repeat(table: StudyTable) -> bool:
    """Whether study.toml in the folder is the whole study: it names no files that lie beside the original alone."""
    try:
        return read_study(table.folder / "study.toml").fingerprint == table.fingerprint
    except ShipCollisionError:
        return False
