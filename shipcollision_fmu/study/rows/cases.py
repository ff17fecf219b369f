"""draw_cases(): the values of all variables and the ships in some rows of a study."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np
import numpy.typing as npt

from ...encounters.request import KINDS
from ...ship.frames import Array
from ..definition.distributions import Constant, TableColumn
from ..definition.study import Study
from ..definition.variables import NUMBERS, SAILED, SITUATION, acts_with
from .sampling import Sampler

__all__ = ["Cases", "draw_cases"]


@dataclass(frozen=True)
class Cases:
    """Cases of a study.

    rows      their numbers (n,)
    kind, side   words (n,)
    situation    name of the file of traffic (n,), empty without one
    numbers   by variable (n,), NaN where a variable does not act
    ships     by role the numbers of the ships in their fleets (n,)
    """

    rows: npt.NDArray[np.int64]
    kind: npt.NDArray[Any]
    side: npt.NDArray[Any]
    situation: npt.NDArray[Any]
    numbers: dict[str, Array]
    ships: dict[str, npt.NDArray[np.int64]]

    def __len__(self) -> int:
        return len(self.rows)


def draw_cases(study: Study, first: int, count: int) -> Cases:
    """The cases of the rows first to first + count - 1."""
    sampler = Sampler(study.header.sampler, study.seed, study.rows, study.dimensions)
    rows = np.arange(first, first + count, dtype=np.int64)
    lines = {
        name: table.find_lines(sampler.draw(f"table.{name}", first, count)) for name, table in study.tables.items()
    }
    given = _cross(study, rows)

    def draw_column(of: TableColumn) -> npt.NDArray[Any]:
        return study.tables[of.table].columns[of.column][lines[of.table]]

    for name, distribution in study.variables.items():
        if name in given:
            continue
        if isinstance(distribution, TableColumn):
            given[name] = draw_column(distribution)
        elif isinstance(distribution, Constant):
            given[name] = np.full(count, distribution.value)
        else:
            given[name] = distribution.quantile(sampler.draw(name, first, count))
    ships = {}
    for role, fleet in (("own", study.own), ("target", study.target)):
        if fleet.column is not None:
            ships[role] = fleet.find_named(draw_column(fleet.column))
        elif fleet.size > 1:
            ships[role] = fleet.choose(sampler.draw(f"{role}.ship", first, count))
        else:
            ships[role] = np.zeros(count, np.int64)
    situation = given.pop("situation", np.full(count, ""))
    kind, side = given.pop("kind", np.full(count, SITUATION)), given.pop("side", np.full(count, ""))
    return Cases(rows, kind, side, situation, _complete(study.level, kind, given), ships)


def _cross(study: Study, rows: npt.NDArray[np.int64]) -> dict[str, npt.NDArray[Any]]:
    """The values of the grid: the last name varies fastest, and the whole grid is repeated."""
    cells = prod(len(values) for values in study.grid.values())
    number, given = rows % cells, {}
    for name, values in reversed(study.grid.items()):
        given[name] = np.asarray(values)[number % len(values)]
        number = number // len(values)
    return given


def _complete(level: str, kind: npt.NDArray[Any], given: dict[str, npt.NDArray[Any]]) -> dict[str, Array]:
    """All numbers that act at the level; what is not given is that of the kind."""
    numbers = {}
    masks = {str(name): kind == name for name in np.unique(kind)}
    for name, of in NUMBERS.items():
        if level not in of.levels:
            continue
        if name in given:
            values = np.array(given[name], np.float64)
        elif of.default is not None:
            values = np.full(len(kind), of.default)
        else:
            values = np.zeros(len(kind))
            for word, is_kind in masks.items():
                values[is_kind] = getattr(KINDS.get(word), name, np.nan)
        for word, is_kind in masks.items():
            if not acts_with(name, word):
                values[is_kind] = np.nan
        numbers[name] = values
    if level != SAILED and SITUATION not in masks:
        _add_drift_speed(numbers)
    return numbers


def _add_drift_speed(numbers: dict[str, Array]) -> None:
    """Where the target drifts, the drift is its own speed: in calm water it keeps its heading."""
    drifts = np.isfinite(numbers["drift_speed"])
    speed, towards = numbers["drift_speed"][drifts], np.radians(numbers["drift_deg"][drifts])
    numbers["target_speed"][drifts] = speed * np.cos(towards)
    numbers["target_sway"][drifts] += speed * np.sin(towards)
