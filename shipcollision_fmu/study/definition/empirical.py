"""Empirical tables: a CSV or Parquet file whose lines are drawn as a whole, so that correlation between columns stays.

    line    the one in whose share of the weights u lies; all alike without weights

A column holds numbers or words. Columns of ints are read as floats.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import StudyError
from ...ship.frames import Array
from ...ship.loading.messages import suggest_or_list
from ..extra import import_pyarrow
from .distributions import cumulate

__all__ = ["EmpiricalTable", "is_number", "read_empirical_table"]

MOST_LINES = 10_000_000
"""Lines of the largest table: it is kept in the memory of every worker, 80 MB for each column of numbers."""


@dataclass(frozen=True, eq=False)
class EmpiricalTable:
    """The columns of a table by name, arrays (n,), and the cumulated shares of its lines (n,)."""

    name: str
    columns: dict[str, npt.NDArray[Any]]
    cumulated: Array

    def find_lines(self, u: Array) -> npt.NDArray[np.intp]:
        """The numbers of the lines at these shares u in (0, 1)."""
        return np.searchsorted(self.cumulated, u, side="right")


def read_empirical_table(name: str, path: Path, weight: str | None, place: str) -> EmpiricalTable:
    """The table in a file. `place` begins each message, "mine.toml: [tables.traffic]".

    Raises StudyError for a file that cannot be read, and for one that is no table.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise StudyError(
            f"{place} file = {path.name!r} cannot be read in {path.parent}: {error.strerror}: give the path of a CSV "
            "or Parquet file, from the study file's folder"
        ) from None
    said = f"{place} file = {path.name!r}"
    is_parquet = path.suffix.lower() in (".parquet", ".pq") or content[:4] == b"PAR1"
    columns = _read_parquet(content, said) if is_parquet else _read_csv(content, said)
    lines = len(next(iter(columns.values())))
    if not 0 < lines <= MOST_LINES:
        raise StudyError(f"{said} has {lines} lines, must have 1 to {MOST_LINES}: give another file")
    return EmpiricalTable(name, columns, _cumulate_weights(columns, weight, lines, place))


def _cumulate_weights(columns: dict[str, npt.NDArray[Any]], weight: str | None, lines: int, place: str) -> Array:
    if weight is None:
        return cumulate(np.ones(lines))
    if weight not in columns:
        raise StudyError(f"{place} weight = {weight!r} is no column:{suggest_or_list(weight, list(columns))}")
    weights = columns[weight]
    said = f"{place} weight = {weight!r} is"
    if weights.dtype.kind != "f":
        line = next(i for i, value in enumerate(weights.tolist(), 2) if not is_number(value))
        raise StudyError(
            f"{said} {str(weights[line - 2])!r} in line {line}, must be a number of at least 0: correct the line, or "
            "take another column"
        )
    if (weights < 0.0).any():
        line = int(np.argmax(weights < 0.0))
        raise StudyError(f"{said} {weights[line]:g} in line {line + 2}, must be at least 0: correct the line")
    if not weights.sum() > 0.0:
        raise StudyError(
            f"{said} 0 in all {lines} lines, must be above 0 in one at least: correct it, or leave weight out"
        )
    return cumulate(weights)


def is_number(value: str) -> bool:
    """Whether a value of a column of words is a number."""
    try:
        float(value)
    except ValueError:
        return False
    return True


def _read_csv(content: bytes, said: str) -> dict[str, npt.NDArray[Any]]:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise StudyError(f"{said} is not UTF-8 text (byte {error.start}): save it as UTF-8") from None
    header, *lines = [line for line in csv.reader(io.StringIO(text)) if line] or [[]]
    names = [name.strip() for name in header]
    _check_names(names, said)
    if not lines:
        raise StudyError(f"{said} has 0 lines below its names, must have 1 to {MOST_LINES}: give another file")
    for number, line in enumerate(lines, 2):
        if len(line) != len(names):
            raise StudyError(
                f"{said} line {number} has {len(line)} values, must have {len(names)} as its first line: complete it, "
                "with commas between values"
            )
    return {name: _as_column(values, name, said) for name, values in zip(names, zip(*lines, strict=True), strict=True)}


def _check_names(names: list[str], said: str) -> None:
    if not names:
        raise StudyError(f"{said} is empty: give a file with a line of column names at its top")
    for sign, word in ((";", "semicolons"), ("\t", "tabs")):
        if len(names) == 1 and sign in names[0]:
            raise StudyError(f"{said} is separated by {word}: save it with commas between values and points in numbers")
    if "" in names:
        raise StudyError(f"{said} has no name for column {names.index('') + 1} in line 1: give it one")
    for name in names:
        if names.count(name) > 1:
            raise StudyError(f"{said} has the column name {name!r} twice in line 1: give each column a name of its own")


def _as_column(values: Sequence[str], name: str, said: str) -> npt.NDArray[Any]:
    """Numbers where all values are numbers, else words."""
    try:
        numbers = [float(value) for value in values]
    except ValueError:
        return np.array([value.strip() for value in values])
    for line, number in enumerate(numbers, 2):
        if not isfinite(number):
            raise StudyError(f"{said} column {name!r} line {line} is {number}, must be finite: remove the line")
    return np.array(numbers)


def _read_parquet(content: bytes, said: str) -> dict[str, npt.NDArray[Any]]:
    pa, parquet = import_pyarrow(), import_pyarrow("pyarrow.parquet")
    try:
        table = parquet.read_table(pa.BufferReader(content))
    except (pa.ArrowInvalid, OSError) as error:
        raise StudyError(f"{said} is not Parquet: {str(error).splitlines()[0]}: write it again") from None
    if not table.column_names:
        raise StudyError(f"{said} has no columns: give another file")
    columns: dict[str, npt.NDArray[Any]] = {}
    for name in table.column_names:
        column = table.column(name)
        if column.null_count:
            raise StudyError(f"{said} column {name!r} has {column.null_count} empty values: remove their lines")
        values = column.to_pylist()
        if all(isinstance(value, str) for value in values):
            columns[name] = np.array(values)
        elif all(isinstance(value, (int, float)) for value in values):
            columns[name] = _as_column([repr(float(value)) for value in values], name, said)
    return columns or {"": np.zeros(0)}
