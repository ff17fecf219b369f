"""What a study costs beside its cases: scheduler, client, files, and what a second worker brings.

    python benchmarks/study_engine.py

1. Empty work: batches of one row that cost nothing. Batches per second are what one scheduler and one client can do.
2. Impacts of the shipped study `million`, so many of its rows by one worker and by two, in turns. The ratio is that of
   rows per second, which needs two idle cores. On a busy machine the share of their time that workers spend on batches
   says what client and scheduler cost them, and the processor time of both what they take.
3. Memory of the client and of its workers after a quarter of the rows and after all: it must not grow.

All in one run, on a local cluster. Figures are medians of turns.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

import numpy as np
import psutil
import pyarrow as pa

from shipcollision_fmu import read_study, run_study
from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.study.engine import batches, parts
from shipcollision_fmu.study.rows.compute import compute_rows

TURNS = 3
EMPTY_ROWS, IMPACT_ROWS = 1_000, 100_000
SCHEMA = pa.schema([("row", pa.int64()), ("status", pa.string())])


@dataclass(frozen=True)
class Empty:
    """A study whose rows cost nothing."""

    rows: int
    text: str = ""
    fingerprint: str = "empty"
    level: str = "sailed"


@dataclass(frozen=True)
class Tables:
    """The tables of a range of rows."""

    encounters: pa.Table
    collisions: pa.Table


def compute_nothing(study: Empty, first: int, count: int, engine: str) -> Tables:
    """Rows with their numbers alone."""
    rows = np.arange(first, first + count)
    return Tables(pa.table({"row": rows, "status": ["done"] * count}, schema=SCHEMA), SCHEMA.empty_table())


@dataclass(frozen=True)
class Turn:
    """One run of a study."""

    rate: float
    """Rows per second, from the first answer to the last."""
    driver: float
    """Processor time [s] of client and scheduler in between."""
    seconds: float
    busy: float
    """Share of their time that workers spend on batches; the rest they wait for the client."""
    memory: list[tuple[int, int]]
    """Resident memory [bytes] of the client and of its largest worker, at each answer."""


def run(study: Any, workers: int, compute: Callable[..., Any]) -> Turn:
    """A study on a new local cluster."""
    at: list[tuple[int, float, float]] = []
    memory: list[tuple[int, int]] = []
    client = psutil.Process()

    def watch(done: int, rows: int) -> None:
        at.append((done, perf_counter(), process_time()))
        if not memory or done - watched[-1] >= rows // 40:
            watched.append(done)
            children = [child.memory_info().rss for child in client.children(recursive=True) if child.is_running()]
            memory.append((client.memory_info().rss, max(children, default=0)))

    watched = [0]
    with TemporaryDirectory() as folder:
        result = run_study(study, Path(folder, "study"), workers=workers, compute=compute, progress=watch)
    busy = result.busy / (workers * (at[-1][1] - at[0][1]))
    begun = next(entry for entry in at if entry[0] > 0)
    rows, seconds, driver = (last - first for first, last in zip(begun, at[-1], strict=True))
    return Turn(rows / seconds, driver, seconds, busy, memory)


def measure_empty() -> tuple[float, float]:
    """Batches per second, and processor time [s] of client and scheduler for one."""
    before = batches.FIRST_ROWS, batches.TARGET
    batches.FIRST_ROWS, batches.TARGET = 1, 1e-12
    try:
        turns = [run(Empty(EMPTY_ROWS), 1, compute_nothing) for _ in range(TURNS)]
    finally:
        batches.FIRST_ROWS, batches.TARGET = before
    return median(turn.rate for turn in turns), median(turn.driver for turn in turns) / EMPTY_ROWS


def measure_loop(study: Any) -> float:
    """Time [s] of a row by compute_rows() alone."""
    compute_rows(study, 0, 100)
    begin = perf_counter()
    compute_rows(study, 0, parts.PART_ROWS["impact"])
    return (perf_counter() - begin) / parts.PART_ROWS["impact"]


def main() -> None:
    """Measures and prints."""
    study = replace(read_study("million"), rows=IMPACT_ROWS)
    per_second, per_batch = measure_empty()
    loops, one, two = [], [], []
    for _ in range(TURNS):
        loops.append(measure_loop(study))
        one.append(run(study, 1, compute_rows))
        two.append(run(study, 2, compute_rows))
    ratio = median(t.rate / o.rate for o, t in zip(one, two, strict=True))
    share = median(t.driver / (t.driver + 2 * t.seconds) for t in two)
    table = make_table("", ">figure")
    table.add_row("batches of one row per second", f"{per_second:.0f}")
    table.add_row("processor time of client and scheduler for a batch, ms", f"{1e3 * per_batch:.2f}")
    table.add_row("impact by compute_rows() alone, ms", f"{1e3 * median(loops):.3f}")
    table.add_row("impacts per second, one worker", f"{median(o.rate for o in one):.0f}")
    table.add_row("impacts per second, two workers", f"{median(t.rate for t in two):.0f}")
    table.add_row("two workers against one, by the clock", f"{ratio:.2f}")
    for name, turns in (("one worker", one), ("two workers", two)):
        table.add_row(f"time that {name} spend on batches", f"{100 * median(turn.busy for turn in turns):.1f} %")
    table.add_row("share of client and scheduler, two workers", f"{100 * share:.1f} %")
    table.add_row("client and scheduler for 1000 rows, ms", f"{1e6 * median(t.driver for t in two) / IMPACT_ROWS:.1f}")
    for name, number in (("client", 0), ("worker", 1)):
        quarter, end = two[-1].memory[len(two[-1].memory) // 4][number], two[-1].memory[-1][number]
        table.add_row(
            f"memory of the {name} after a quarter and at the end, MB", f"{quarter / 1e6:.0f}, {end / 1e6:.0f}"
        )
    print_table(table)
    print(f"load of this machine beside it: {os.getloadavg()[0]:.1f}")  # noqa: T201


if __name__ == "__main__":
    main()
