"""What a row of a study costs, by level of detail and engine, and what of it is not the impact itself.

    python benchmarks/studies.py

Processor time of rows in batches, as workers compute them, medians of turns. Of `million`, in batches of 10 000, also
the share that its impacts alone take: run_impacts() against compute_rows(). With a pool of sixty ships each batch has
all pairs, more than stay open. One of 10 000 has other ships each time.
"""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import process_time

from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.study.definition.study import parse_study, read_study
from shipcollision_fmu.study.rows.cases import draw_cases
from shipcollision_fmu.study.rows.compute import compute_rows
from shipcollision_fmu.study.rows.impact_rows import run_impacts

TURNS, BATCH = 3, 10_000

SMALL = """
[study]
name = "{level}"
level = "{level}"
rows = 100_000
[own]
ships = ["kvlcc2", "kcs"]
[run]
separation = 10.0
[encounter]
angle_deg = {{ distribution = "uniform", least = 30.0, most = 150.0 }}
own_speed = {{ distribution = "uniform", least = 4.0, most = 8.0 }}
"""
POOL = """[[own.sampled]]
kind = "bulk carrier"
count = COUNT
weight = 1000.0
L_pp = { distribution = "uniform", least = 100.0, most = 250.0 }
L_over_B = 6.0
B_over_T = 2.6
C_b = 0.8
[run]"""


def measure(work: Callable[[int], object], rows: int, turns: int = TURNS) -> float:
    """Milliseconds of processor time for a row; `work` gets the number of the turn."""
    work(turns)  # ships and pairs are opened
    times = []
    for turn in range(turns):
        begin = process_time()
        work(turn)
        times.append(process_time() - begin)
    return 1e3 * median(times) / rows


def main() -> None:
    """Print the table."""
    million, quick = read_study("million"), read_study("quick")
    rows = [
        ("million", "native", measure(lambda turn: compute_rows(million, turn * BATCH, BATCH), BATCH)),
        ("million, run_impacts() alone", "native",
         measure(lambda turn: run_impacts(million, draw_cases(million, turn * BATCH, BATCH), "native"), BATCH)),
        ("quick", "python", measure(lambda turn: compute_rows(quick, turn * 10, 10, "python"), 10)),
    ]  # fmt: skip
    for level, size in (("encounter", 40), ("sailed", 3)):
        study = parse_study(SMALL.format(level=level))
        of = measure(lambda turn, study=study, size=size: compute_rows(study, turn * size, size), size)  # type: ignore[misc]
        rows.append((level, "native", of))
    for count, size in ((60, BATCH), (10_000, 100)):
        study = parse_study(SMALL.format(level="impact").replace("[run]", POOL.replace("COUNT", str(count))))
        of = measure(lambda turn, study=study, size=size: compute_rows(study, turn * size, size), size)  # type: ignore[misc]
        rows.append((f"a pool of {count} ships", "native", of))
    table = make_table("study", "engine", ">ms a row")
    for study_name, engine, of in rows:
        table.add_row(study_name, engine, f"{of:.3g}")
    print_table(table)


if __name__ == "__main__":
    main()
