"""compute_rows(): some rows of a study as two tables, by their numbers alone.

    draw_cases   the values of all variables            cases.py
    run          level impact, encounter or sailed      impact_rows.py, encounter_rows.py, sailed_rows.py
                 or files of traffic                    situation_rows.py
    build        the two tables                         tables.py

Rows of two calls are those of one call over both: bit for bit, whatever was computed before.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ...errors import HostError, StudyError
from ...toolchain.load import load_library
from ..definition.study import Study
from ..definition.variables import COASTING, IMPACT, SAILED
from .cases import Cases, draw_cases
from .encounter_rows import run_coasting
from .impact_rows import run_impacts
from .results import Results
from .sailed_rows import run_sailed
from .situation_rows import run_situations
from .tables import RowTables, build_tables

__all__ = ["ENGINES", "choose_engine", "compute_rows"]

ENGINES = ("auto", "native", "python")

LEVEL_RUNNERS: dict[str, Callable[[Study, Cases, str], Results]] = {
    IMPACT: run_impacts, COASTING: run_coasting, SAILED: run_sailed,
}  # fmt: skip
"""What computes cases, by level of detail."""


def compute_rows(study: Study, first: int, count: int, engine: str = "auto") -> RowTables:
    """The tables of the rows first to first + count - 1. Raises StudyError for rows that the study does not have,
    HostError without pyarrow, and where the engine "native" has no library."""
    if not isinstance(study, Study):
        raise StudyError(f"study = {study!r} is no Study: give what read_study() returns")
    is_whole = all(isinstance(number, int | np.integer) for number in (first, count))
    if not (is_whole and first >= 0 and count >= 1 and first + count <= study.rows):
        raise StudyError(
            f"{study.source}: first = {first!r}, count = {count!r} are no rows of the study: give whole numbers, it "
            f"has rows 0 to {study.rows - 1}"
        )
    run = run_situations if study.situations else LEVEL_RUNNERS[study.level]
    return build_tables(study, run(study, draw_cases(study, first, count), choose_engine(engine)))


def choose_engine(engine: str) -> str:
    """ "native", or "python" where `engine` is "auto" and there is no native library. Raises StudyError, HostError."""
    if engine not in ENGINES:
        raise StudyError(f"engine = {engine!r} is unknown: take one of {', '.join(ENGINES)}")
    if engine == "native":
        load_library()
    return _find_engine() if engine == "auto" else engine


@lru_cache
def _find_engine() -> str:
    try:
        load_library()
    except HostError:
        return "python"
    return "native"
