"""Part: a fixed range of rows, which has one file in each table's folder.

The length of a part depends on the study's level alone. Batches, workers and resumption do not change it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

__all__ = ["PART_ROWS", "Part", "count_parts", "get_part", "list_parts"]

PART_ROWS = {"impact": 20_000, "encounter": 2_000, "sailed": 200}
"""Rows of a part by level: some seconds of one core, or some tens. Longer parts lose more when a study is interrupted;
shorter ones make more files. A change makes folders of earlier versions unreadable for --resume."""
DIGITS = 12
"""Digits of a row number in a file's name, so that names sort as rows do."""


@dataclass(frozen=True)
class Part:
    """Rows first to last, both included."""

    number: int
    first: int
    last: int

    @property
    def count(self) -> int:
        """Number of rows."""
        return self.last - self.first + 1

    @property
    def file(self) -> str:
        """Name of its file in each table's folder."""
        return f"part-{self.first:0{DIGITS}d}-{self.last:0{DIGITS}d}.parquet"


def count_parts(rows: int, level: str) -> int:
    """Number of parts of a study with so many rows."""
    return -(-rows // PART_ROWS[level])


def get_part(number: int, rows: int, level: str) -> Part:
    """The part of a number, counted from zero."""
    length = PART_ROWS[level]
    return Part(number, number * length, min((number + 1) * length, rows) - 1)


def list_parts(rows: int, level: str) -> Iterator[Part]:
    """All parts in the order of rows, made one by one."""
    return (get_part(number, rows, level) for number in range(count_parts(rows, level)))
