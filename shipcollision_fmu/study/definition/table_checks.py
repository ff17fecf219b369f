"""Checks of a study that need its tables: columns that exist, and hold what their variables take."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from ...errors import StudyError
from ...ship.loading.messages import suggest_or_list
from .distributions import Distribution, TableColumn
from .empirical import EmpiricalTable, is_number
from .fleet_tables import LIMITS
from .study_file import StudyFile
from .variables import NUMBERS, WORDS

__all__ = ["check_columns"]


def check_columns(file: StudyFile, tables: Mapping[str, EmpiricalTable], source: str) -> None:
    """Raise StudyError for a column that is missing, or whose values are beyond the limits of their variable."""
    for place, key, given in _list_variables(file):
        if not isinstance(given, TableColumn):
            continue
        at = f"{source}: [{place}] {key}"
        if given.table not in tables:
            known = suggest_or_list(given.table, list(tables)) if tables else " add a table [tables.NAME] with file"
            raise StudyError(f"{at}: table = {given.table!r} is not in [tables]:{known}")
        columns = tables[given.table].columns
        if given.column not in columns:
            near = suggest_or_list(given.column, list(columns))
            raise StudyError(f"{at}: column = {given.column!r} is not in table {given.table!r}:{near}")
        _check_values(at, key, given, tables[given.table])


def _list_variables(file: StudyFile) -> Iterator[tuple[str, str, Distribution | None]]:
    for name, given in file.encounter.list_given():
        yield "encounter", name, given
    for role, fleet in (("own", file.own), ("target", file.target)):
        if fleet is None:
            continue
        yield role, "ships", fleet.ships if isinstance(fleet.ships, TableColumn) else None
        for i, pool in enumerate(fleet.sampled):
            for name in LIMITS:
                yield role, f"sampled[{i}].{name}", getattr(pool, name)


def _check_values(at: str, key: str, given: TableColumn, table: EmpiricalTable) -> None:
    values, key = table.columns[given.column], key.rpartition(".")[2]
    where = f"column {given.column!r} of table {given.table!r}"
    if key in WORDS or key == "ships":
        if values.dtype.kind != "U":
            raise StudyError(f"{at}: {where} holds numbers, must hold words: take another column")
        unknown = sorted(set(values.tolist()) - set(WORDS.get(key, values.tolist())))
        if unknown:
            raise StudyError(f"{at}: {where} holds {unknown[0]!r}:{suggest_or_list(unknown[0], WORDS[key])}")
        return
    if values.dtype.kind != "f":
        wrong = [i for i, value in enumerate(values.tolist()) if not is_number(value)]
        remedy = "take another column" if len(wrong) == len(values) else "correct the line, or remove it"
        raise StudyError(
            f"{at}: {where} holds {str(values[wrong[0]])!r} in line {wrong[0] + 2}, must hold numbers: {remedy}"
        )
    least, most = LIMITS[key] if key in LIMITS else (NUMBERS[key].least, NUMBERS[key].most)
    outside = np.flatnonzero((values < least) | (values > most))
    if len(outside):
        raise StudyError(
            f"{at}: {where} holds {values[outside[0]]:g} in line {outside[0] + 2}, must be {least:g} to {most:g}: "
            "remove the line, or convert the column's unit"
        )
