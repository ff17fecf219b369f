"""build_tables(): cases and their results as the two tables of a study."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ...errors import ShipError
from ..definition.study import Study
from ..definition.variables import IMPACT
from ..extra import import_pyarrow
from .columns import COLLISIONS, ENCOUNTERS, StudyColumn, make_schema
from .fleet_ships import find_ship
from .results import Results

__all__ = ["RowTables", "build_tables"]

Values = npt.NDArray[Any]

AT_END = 1.0
"""[s] before the end. Hulls that lie along each other part and touch again several times a second."""
ROUNDING = 1e-6
"""[s] of times that are sums of steps."""


class RowTables(NamedTuple):
    """Two pyarrow.Tables: a line for each row of the study, sorted, and a line for each collision."""

    encounters: Any
    collisions: Any


def build_tables(study: Study, results: Results) -> RowTables:
    """The tables, with all columns of columns.py. Raises HostError without pyarrow."""
    cases = results.cases
    n, refused = len(cases), np.array([bool(reason) for reason in results.reasons])
    given: dict[str, Values] = {
        "row": cases.rows, "status": np.where(refused, "refused", "done"), "kind": cases.kind,
        "side": _as_words(cases.side),
        "situation": _as_words(cases.situation),
        "reason": np.array([reason or None for reason in results.reasons], object),
        "level": np.full(n, study.level), "engine": np.full(n, results.engine), **cases.numbers, **results.numbers,
    }  # fmt: skip
    if study.level != IMPACT:
        given["contact_at_end"] = _find_contact_at_end(results, study.run.separation)
    for role in ("own", "target"):
        given.update(_describe_ships(study, role, cases.ships[role]))
    return RowTables(_make_table(ENCOUNTERS, given, n), _make_collisions(results))


def _find_contact_at_end(results: Results, separation: float | None) -> Values:
    """1 for the cases that ended with hulls that touch, 0 for the others, NaN for those that are refused. A case that
    ends after a separation shorter than AT_END has none."""
    duration = results.numbers.get("duration", np.full(len(results.cases), np.nan))
    last = np.full(len(duration), -np.inf)
    for part in results.collisions:
        np.maximum.at(last, part["case"].astype(np.int64), part["end"])
    within = AT_END if separation is None else min(AT_END, separation)
    found: Values = np.where(np.isnan(duration), np.nan, duration - last < within - ROUNDING)
    return found


def _as_words(values: Values) -> Values:
    """The words with None, which becomes null, in place of empty ones."""
    return np.where(values == "", np.array(None, object), values.astype(object))


def _describe_ships(study: Study, role: str, numbers: npt.NDArray[np.int64]) -> dict[str, Values]:
    """Columns of the ships of a role; none where they are those of the situations."""
    if not getattr(study, role).size:
        return {}
    found, places = np.unique(numbers, return_inverse=True)
    ships = [find_ship(study, role, int(number)) for number in found]
    values: dict[str, list[Any]] = {name: [] for name in ("ship", "L_pp", "B", "T", "C_b", "mass")}
    for ship in ships:
        values["ship"].append(ship.label)
        for name in ("L_pp", "B", "T", "C_b", "mass"):
            try:
                values[name].append(getattr(ship.loaded, name))
            except ShipError:
                values[name].append(np.nan)
    return {f"{role}_{name}": np.array(of)[places.ravel()] for name, of in values.items()}


def _make_collisions(results: Results) -> Any:
    parts = [part for part in results.collisions if len(part["case"])]
    if not parts:
        return _make_table(COLLISIONS, {}, 0)
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    order = np.lexsort((joined["collision"], joined["case"]))
    joined = {name: values[order] for name, values in joined.items()}
    joined["row"] = results.cases.rows[joined["case"].astype(np.int64)]
    return _make_table(COLLISIONS, joined, len(order))


def _make_table(columns: tuple[StudyColumn, ...], given: dict[str, Values], n: int) -> Any:
    """The table of n lines; a column that is not given is null."""
    pa, schema = import_pyarrow(), make_schema(columns)
    arrays = []
    for field in schema:
        values = given.get(field.name)
        if values is None:
            arrays.append(pa.nulls(n, field.type))
        elif values.dtype.kind == "f":
            missing = np.isnan(values)
            kind = {pa.int32(): np.int32, pa.bool_(): np.bool_}.get(field.type, np.float64)
            arrays.append(pa.array(np.where(missing, 0.0, values).astype(kind), field.type, mask=missing))
        else:
            arrays.append(pa.array(values, field.type))
    return pa.Table.from_arrays(arrays, schema=schema)
