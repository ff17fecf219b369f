"""Run a scenario: instances, the step loop, and the results.

    for k = 0 .. steps-1:     send the orders of k;   one step of the algorithm;   record k+1

The run goes through the FMUs with FMPy, or, in process, drives the same models through the same variables without FMI.
Both give the same bits. FMUs without Python give the same events, and states to 1e-6 of their size or better.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from math import radians
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from ..collision.responses import require_adapter
from ..errors import ScenarioError
from ..files import check_writable
from ..fmi.builder.package import VERSIONS
from ..results.bodies import build_bodies
from ..results.events import build_events
from ..results.record import Record
from ..results.summary import build_summary
from ..scenario.scenario import Scenario, load_scenario
from ..ship.ship import Ship
from .earlier_run import refuse_foreign_files
from .factories import Factories, fmu_factories, model_factories
from .fmu_files import ready_fmus
from .folder_lock import hold_folder
from .interrupt import delay_interrupts
from .native_fmu_files import write_native_fmus
from .parameters import tabulate_surroundings
from .prepared_files import PreparedFiles, prepare_files
from .run import RUN_FILES, Run
from .stepper import Stepper

__all__ = ["ENGINES", "Progress", "build_run", "run_steps", "simulate"]

ENGINES = ("python", "native")
"""What the FMUs of a run have inside."""

Progress = Callable[[int, int], None]
"""Called after every step with the steps done and the steps in all."""


def simulate(
    scenario: Scenario | str | Path,
    *,
    algorithm: str | None = None,
    step: float | None = None,
    in_process: bool = False,
    engine: str = "python",
    fmi: int = 2,
    out: str | Path | None = None,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Run:
    """The finished run of a scenario, of its name or of its path; written into the folder `out`, if given.

    There it replaces the files of an earlier run; files of other origin only with `overwrite`.

    `algorithm` ("gauss-seidel" or "jacobi") and `step` [s] replace those of the scenario; `fmi` is the version of the
    FMUs, 2 or 3, which give the same bits. FMUs are built when they are missing or older than the sources. With
    `engine` "native" in place of "python" the FMUs run without Python, with the contact response "pgs" alone. Raises
    ScenarioError for options that do not fit, StepError when a model refuses a step, HostError when a package is
    missing or a file cannot be used; nothing is written then.
    """
    if not isinstance(scenario, Scenario):
        scenario = load_scenario(scenario)
    scenario = scenario.changed(algorithm=algorithm, step=step)
    _check_fmi(fmi, in_process)
    _check_engine(engine, in_process)
    if engine == "python":
        require_adapter(scenario.collision.response)  # else the FMU refuses to initialise; the wrapper answers fatal
    prepared = prepare_files(scenario, "engine = 'python'") if engine == "native" else None
    if out is not None:
        check_writable(Path(out))
        if not overwrite:
            refuse_foreign_files(Path(out), RUN_FILES)
    ships, names = scenario.load_ships(), tuple(scenario.ships)
    with ExitStack() as stack:
        if out is not None:
            stack.enter_context(hold_folder(Path(out)))
        if in_process:
            factories = model_factories(names, stack)
        elif prepared is not None:
            folder = Path(stack.enter_context(TemporaryDirectory(prefix="shipcollision-")))
            factories = fmu_factories(write_native_fmus(folder, names, prepared, fmi), stack, names, fmi)
        else:
            factories = fmu_factories(ready_fmus(names, fmi), stack, names, fmi)
        record, wall_time = run_steps(scenario, ships, factories, progress, prepared)
        run = build_run(scenario, ships, record, _name_mode(engine, fmi, in_process), wall_time, engine)
        if out is not None:
            run.write(out)
    return run


def _check_fmi(fmi: int, in_process: bool) -> None:
    if fmi not in VERSIONS:
        raise ScenarioError(f"fmi = {fmi!r} must be 2 or 3, the version of FMI that the FMUs are built for")
    if in_process and fmi != 2:
        raise ScenarioError(f"fmi = {fmi} with in_process = True: there is no FMI in process; leave one of the two out")


def _check_engine(engine: str, in_process: bool) -> None:
    if engine not in ENGINES:
        raise ScenarioError(f"engine = {engine!r} must be one of {', '.join(map(repr, ENGINES))}")
    if in_process and engine != "python":
        raise ScenarioError(
            f"engine = {engine!r} with in_process = True: in process Python runs; leave one of them out"
        )


def _name_mode(engine: str, fmi: int, in_process: bool) -> str:
    """What ran, for timing.json."""
    if in_process:
        return "in process"
    kind = "native FMU" if engine == "native" else "FMU"
    return kind if fmi == 2 else f"{kind}, FMI {fmi}.0"


def build_run(
    scenario: Scenario,
    ships: Mapping[str, Ship],
    record: Record,
    mode: str,
    wall_time: float,
    engine: str = "python",
) -> Run:
    """The run of a record; `mode` says in words what ran, `wall_time` how long [s]."""
    free = {name: start.free for name, start in scenario.ships.items()}
    headings = {name: radians(table.heading_deg) for name, table in scenario.obstacles.items()}
    events = build_events(record, ships, free, scenario.collision.damage, headings, scenario.tracks)
    return Run(
        states=record.states,
        contacts=record.contacts,
        events=events,
        summary=build_summary(scenario, ships, record, events, engine),
        signals=record.signals,
        machinery=record.machinery,
        surroundings=tabulate_surroundings(scenario),
        bodies=build_bodies(ships, free, scenario.obstacles),
        timing={
            "mode": mode,
            "wall_time": wall_time,
            "real_time_factor": scenario.step * scenario.steps / wall_time,
        },
    )


def run_steps(
    scenario: Scenario,
    ships: Mapping[str, Ship],
    factories: Factories,
    progress: Progress | None = None,
    prepared: PreparedFiles | None = None,
) -> tuple[Record, float]:
    """The record of a run with components from `factories`, and the wall time of the step loop [s]; prepared: files of
    native FMUs."""
    stepper, steps = Stepper(scenario, ships, factories, prepared), scenario.steps
    begin = perf_counter()
    with delay_interrupts() as raise_if_interrupted:
        for _ in range(steps):
            stepper.advance()
            if progress is not None:
                progress(stepper.k, steps)
            raise_if_interrupted()
    return stepper.recorder.build_record(), perf_counter() - begin
