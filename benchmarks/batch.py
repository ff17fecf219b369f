"""What a batch costs beside Python: whole encounters, and impacts alone.

    python benchmarks/batch.py

A kvlcc2_crossing of 150 s by run_encounters() against the same by simulate() in process, in turns; the goal is 1/40. A
random impact by impact(), whose goal is 100 us, against the step of the collision model in Python. Random collisions by
collide(), each up to 10 s after its contact: the shortest, the median and the longest. Then impacts and encounters per
second by two processes against one; the goal is 1.8. By the clock this needs two idle cores; by processor time it shows
on a busy machine, too, what the processes take from each other. Figures are medians of turns.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from statistics import median
from time import perf_counter, process_time
from typing import Any

import numpy as np

from shipcollision_fmu import ShipCollision, collide, impact, load_scenario, run_encounters, simulate
from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table

TURNS, IMPACTS, MODELS, COLLISIONS = 5, 4000, 60, 60
SCENARIO = "kvlcc2_crossing"


def draw_cases(count: int) -> dict[str, Any]:
    """Crossings of all angles, all of which lead to an impact."""
    rng = np.random.default_rng(1)
    return {
        "angle_deg": rng.uniform(20.0, 160.0, count), "at": rng.uniform(-0.4, 0.4, count),
        "own_speed": rng.uniform(4.0, 8.0, count), "target_speed": rng.uniform(0.0, 2.0, count),
    }  # fmt: skip


def measure(work: Callable[[], object]) -> float:
    """Seconds of a call."""
    begin = perf_counter()
    work()
    return perf_counter() - begin


def run_impacts(turns: int) -> float:
    """Processor time [s] of so many turns of impacts."""
    begin = process_time()
    for _ in range(turns):
        impact("kvlcc2", "kvlcc2", **draw_cases(IMPACTS))
    return process_time() - begin


def run_scenarios(turns: int) -> float:
    """Processor time [s] of so many turns of encounters."""
    begin = process_time()
    run_encounters([SCENARIO] * 4 * turns)
    return process_time() - begin


def step_models() -> None:
    """The impacts of some cases by the collision model in Python, from states that touch."""
    rows = impact("kvlcc2", "kvlcc2", **draw_cases(MODELS))
    model, first = ShipCollision(("own", "target")), None
    for row in rows[rows["status"] == 0]:
        for name, state in zip(("own", "target"), model.inputs.ships, strict=True):
            state.position[:], state.attitude[:] = row[f"{name}_position"], [0.0, 0.0, row[f"{name}_heading"]]
            state.velocity[:], state.rate[:] = row[f"{name}_before"][:3], row[f"{name}_before"][3:]
        if first is None:
            model.initialise()
            first = model.get_state()
        model.set_state(first)
        model.step(0.0, 1e-9)
    model.close()


def time_collisions() -> list[float]:
    """Processor time [s] of each of some collisions, less that of a call without any."""

    def run(cases: dict[str, Any]) -> float:
        begin = process_time()
        collide("kvlcc2", "kvlcc2", separation=10.0, **cases)
        return process_time() - begin

    drawn, none = draw_cases(COLLISIONS), {"own_speed": []}
    idle = median(run(none) for _ in range(TURNS))
    return sorted(run({name: values[i] for name, values in drawn.items()}) - idle for i in range(COLLISIONS))


def compare_processes(work: Callable[[int], float]) -> tuple[float, float]:
    """How many times as much two processes do as one in a second, and in a second of processor time."""
    by_clock, by_processor = [], []
    with ProcessPoolExecutor(2) as pool:
        list(pool.map(work, [1, 1]))  # starts both
        for _ in range(TURNS):
            begin = perf_counter()
            (alone,) = pool.map(work, [4])
            middle = perf_counter()
            together = list(pool.map(work, [4, 4]))
            by_clock.append(2.0 * (middle - begin) / (perf_counter() - middle))
            by_processor.append(2.0 * alone / max(together))
    return median(by_clock), median(by_processor)


def main() -> None:
    """Measure, and print two tables."""
    scenario = load_scenario(SCENARIO)
    run_scenarios(1)
    run_impacts(1)
    step_models()
    batch, python, impacts, models = [], [], [], []
    for _ in range(TURNS):
        batch.append(measure(lambda: run_encounters([scenario] * 4)) / 4)
        python.append(measure(lambda: simulate(scenario, in_process=True)))
        impacts.append(measure(lambda: run_impacts(1)) / IMPACTS * 1e6)
        models.append(measure(step_models) / MODELS * 1e6)
    table = make_table("", ">batch", ">Python", ">ratio")
    ratio = median(p / b for p, b in zip(python, batch, strict=True))
    table.add_row(f"{SCENARIO}, ms", f"{1e3 * median(batch):.1f}", f"{1e3 * median(python):.0f}", f"{ratio:.1f}")
    ratio = median(m / i for m, i in zip(models, impacts, strict=True))
    table.add_row("an impact, us", f"{median(impacts):.1f}", f"{median(models):.0f}", f"{ratio:.1f}")
    print_table(table)
    times = time_collisions()
    table = make_table("a collision, ms of processor time", ">least", ">median", ">most")
    table.add_row("", *(f"{1e3 * time:.1f}" for time in (times[0], median(times), times[-1])))
    print_table(table)
    table = make_table("two processes against one", ">by the clock", ">by processor time")
    for name, work in (("impacts", run_impacts), ("encounters", run_scenarios)):
        table.add_row(name, *(f"{ratio:.2f}" for ratio in compare_processes(work)))
    print_table(table)


if __name__ == "__main__":
    main()
