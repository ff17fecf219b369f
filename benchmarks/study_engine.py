"""What a study costs beside its cases: scheduler, client, files, and what a second worker brings.

    python benchmarks/study_engine.py

1. Empty work: batches of one row that cost nothing. Batches per second are what one scheduler and one client can do.
2. Whole parts of the shipped study `million` that cost nothing, since each is a copy of the first: processor time of
   client and scheduler for their rows; with workers of this machine, which write the files, and with others, which send
   them.
3. The impacts of that study by one worker and by two, in turns. The ratio of rows per second needs two idle cores. From
   processor times it follows on a busy machine, too: where W is that of a row in a worker and D that of client and
   scheduler, two cores of two workers make 2 / (W + D) rows per second, against 1 / W of one worker.
4. Memory of the client and of its workers, after a quarter of five million empty rows and after all: it must not grow.

All in one run, on a local cluster. Figures are medians of turns.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter, process_time, sleep
from typing import Any

import numpy as np
import psutil
import pyarrow as pa
import pyarrow.compute as pc

from shipcollision_fmu import read_study, run_study
from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.study.engine import batches, parts
from shipcollision_fmu.study.engine.clusters import start_local_cluster
from shipcollision_fmu.study.engine.part_file import encode_part
from shipcollision_fmu.study.rows.compute import compute_rows

TURNS = 3
EMPTY_ROWS, COPIED_ROWS, MEMORY_ROWS = 1_000, 1_000_000, 5_000_000
IDLE = 5.0
"""Time [s] in which an idle cluster is watched."""
SCHEMA = pa.schema([("row", pa.int64()), ("status", pa.string())])


@dataclass(frozen=True)
class Empty:
    """A study whose rows cost nothing."""

    rows: int
    text: str = ""
    folder: str = "."
    inputs: tuple[()] = ()
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


@cache
def compute_first_part() -> Any:
    """The tables of the first part of the study `million`."""
    return compute_rows(read_study("million"), 0, parts.PART_ROWS["impact"])


def compute_copies(study: Any, first: int, count: int, engine: str) -> Tables:
    """Rows of the first part, with the numbers of others."""
    place = first % parts.PART_ROWS["impact"]
    encounters = compute_first_part().encounters.slice(place, count)
    collisions = compute_first_part().collisions
    collisions = collisions.filter(
        pc.and_(pc.greater_equal(collisions["row"], place), pc.less(collisions["row"], place + count))
    )
    return Tables(_renumber(encounters, first - place), _renumber(collisions, first - place))


def _renumber(table: pa.Table, by: int) -> pa.Table:
    at = table.schema.get_field_index("row")
    return table.set_column(at, table.schema.field(at), pc.add(table["row"], by))


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


def run(study: Any, workers: int, compute: Callable[..., Any], scheduler: str | None = None) -> Turn:
    """A study on a new local cluster, or on that of a scheduler with so many workers."""
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
        local = workers if scheduler is None else None
        out = Path(folder, "study")
        result = run_study(study, out, workers=local, scheduler=scheduler, compute=compute, progress=watch)
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


def measure_idle() -> float:
    """Share of a core that client and scheduler of two idle workers take."""
    with start_local_cluster(2) as cluster, closing(cluster.connect(10.0)):
        sleep(1.0)
        begin = process_time()
        sleep(IDLE)
        return (process_time() - begin) / IDLE


def measure_loop(study: Any) -> float:
    """Processor time [s] of a row in a worker: compute_rows(), and the Parquet files of a part."""
    compute_rows(study, 0, 100)
    begin = process_time()
    part = parts.get_part(0, study.rows, study.level)
    encode_part(compute_rows(study, part.first, part.count), part, study.fingerprint)
    return (process_time() - begin) / part.count


def main() -> None:
    """Measures and prints."""
    study = read_study("million")
    per_second, per_batch = measure_empty()
    copied = [run(study, 2, compute_copies) for _ in range(TURNS)]
    idle, per_row = measure_idle(), median(turn.driver for turn in copied) / COPIED_ROWS
    with start_local_cluster(2) as cluster, closing(cluster.connect(10.0)) as client:
        address = client.scheduler.address
        sent = median(run(study, 2, compute_copies, address).driver for _ in range(TURNS)) / COPIED_ROWS
    memory = run(Empty(MEMORY_ROWS, level="impact"), 2, compute_nothing).memory
    loops, one, two = [], [], []
    for _ in range(TURNS):
        loops.append(measure_loop(study))
        one.append(run(study, 1, compute_rows))
        two.append(run(study, 2, compute_rows))
    work = median(loops)
    table = make_table("", ">figure")
    table.add_row("batches of one row per second", f"{per_second:.0f}")
    table.add_row("processor time of client and scheduler for a batch, ms", f"{1e3 * per_batch:.1f}")
    table.add_row("the same for 1000 rows in whole parts, ms", f"{1e6 * per_row:.2f}")
    table.add_row("the same where workers send the files, ms", f"{1e6 * sent:.2f}")
    table.add_row("the same when idle, of a core", f"{100 * idle:.1f} %")
    table.add_row("processor time of a worker for 1000 rows, ms", f"{1e6 * work:.1f}")
    table.add_row("impacts per second, one worker", f"{median(turn.rate for turn in one):.0f}")
    table.add_row("impacts per second, two workers", f"{median(turn.rate for turn in two):.0f}")
    ratio = median(t.rate / o.rate for o, t in zip(one, two, strict=True))
    table.add_row("two workers against one, by the clock", f"{ratio:.2f}")
    table.add_row("two workers against one, by processor time", f"{2 * work / (work + per_row + idle * work / 2):.2f}")
    for name, turns in (("one worker", one), ("two workers", two)):
        table.add_row(f"time that {name} spend on batches", f"{100 * median(turn.busy for turn in turns):.1f} %")
    for name, number in (("client", 0), ("worker", 1)):
        row = f"{memory[len(memory) // 4][number] / 1e6:.0f}, {memory[-1][number] / 1e6:.0f}"
        table.add_row(f"memory of the {name} after a quarter and at the end, MB", row)
    print_table(table)
    print(f"load of this machine beside it: {os.getloadavg()[0]:.1f}")  # noqa: T201


if __name__ == "__main__":
    main()
