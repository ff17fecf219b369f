"""Run a scenario: instances, the step loop, and what comes out.

    for k = 0 .. steps-1:     give the orders of k;   one step of the algorithm;   record k+1

The run goes through the FMUs with FMPy, or, in process, drives the same models through the same variables without FMI.
Both give the same bits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack, closing
from math import radians
from pathlib import Path
from time import perf_counter

from ..errors import ScenarioError
from ..files import check_writable
from ..fmi.builder.package import VERSIONS
from ..fmi.interface import SHIPS, Interface
from ..fmi.ship_collision import INTERFACE as COLLISION
from ..fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from ..results.bodies import bodies
from ..results.events import events
from ..results.record import Record
from ..results.summary import summary
from ..scenario.scenario import Scenario, load_scenario
from .component import Component, InProcessComponent
from .fmi2_component import Fmi2Component
from .fmi3_component import Fmi3Component
from .fmu_files import ready_fmus, require_pybullet
from .fmu_instance import UnpackedFmu
from .interrupt import held_back
from .master import ALGORITHMS
from .recorder import Recorder
from .run import Run
from .wiring import MakeCollision, MakeShip, connected

__all__ = ["Factories", "Progress", "as_models", "simulate", "stepped", "through_fmus"]

Progress = Callable[[int, int], None]
"""Called after every step with the steps done and the steps in all."""
Factories = tuple[MakeShip, MakeCollision]
"""What makes the components of a run, and sees to it that they are closed."""


def simulate(
    scenario: Scenario | str,
    *,
    algorithm: str | None = None,
    step: float | None = None,
    in_process: bool = False,
    fmi: int = 2,
    out: str | Path | None = None,
    progress: Progress | None = None,
) -> Run:
    """Run a scenario (or the one of that name or path), through the FMUs or in process; write it to `out` if given.

    `algorithm` ("gauss-seidel" or "jacobi") and `step` [s] replace those of the scenario; `fmi` is the version of the
    FMUs, 2 or 3, which give the same bits. FMUs are built when they are missing or older than the sources. Raises
    ScenarioError for options that do not fit, StepError when a model refuses a step, HostError when the machine does
    not do what is needed; then nothing is written.
    """
    if isinstance(scenario, str):
        scenario = load_scenario(scenario)
    scenario = scenario.changed(algorithm=algorithm, step=step)
    if fmi not in VERSIONS or (in_process and fmi != 2):
        raise ScenarioError(f"fmi = {fmi!r} with in_process = {in_process}: 2 or 3, and only for a run through FMUs")
    require_pybullet()
    if out is not None:
        check_writable(Path(out))
    ships = scenario.load_ships()
    with ExitStack() as stack:
        if in_process:
            factories = as_models(scenario, stack)
        else:
            factories = through_fmus(ready_fmus(tuple(scenario.ships), fmi), stack, tuple(scenario.ships), fmi)
        record, wall_time = stepped(scenario, factories, progress)
    free = {name: start.free for name, start in scenario.ships.items()}
    headings = {name: radians(table.heading_deg) for name, table in scenario.obstacles.items()}
    found = events(record, ships, free, scenario.collision.damage, headings)
    duration = scenario.step * scenario.steps
    run = Run(
        states=record.states,
        contacts=record.contacts,
        events=found,
        summary=summary(scenario, ships, record, found),
        signals=record.signals,
        bodies=bodies(ships, free, scenario.obstacles),
        timing={
            "mode": "in process" if in_process else "FMU" if fmi == 2 else f"FMU, FMI {fmi}.0",
            "wall_time": wall_time,
            "real_time_factor": duration / wall_time,
        },
    )
    if out is not None:
        run.write(out)
    return run


def stepped(scenario: Scenario, factories: Factories, progress: Progress | None = None) -> tuple[Record, float]:
    """The record of a run with components from `factories`, and the wall time of the step loop [s]."""
    system, helms = connected(scenario, *factories)
    recorder = Recorder(system, list(scenario.ships), scenario.step, scenario.steps, list(scenario.obstacles))
    advance, step, steps = ALGORITHMS[scenario.algorithm], scenario.step, scenario.steps
    recorder.record(0)
    begin = perf_counter()
    with held_back() as interrupted:
        for k in range(steps):
            for helm in helms:
                helm.give(k)
            advance(system, k * step, step)
            recorder.record(k + 1)
            if progress is not None:
                progress(k + 1, steps)
            interrupted()
    return recorder.finished(), perf_counter() - begin


def as_models(scenario: Scenario, stack: ExitStack) -> Factories:
    """Components that are the models themselves; `stack` closes all."""

    def make_ship(name: str) -> Component:
        return stack.enter_context(closing(InProcessComponent(name, MANOEUVRING.ports())))

    def make_collision() -> Component:
        return stack.enter_context(closing(InProcessComponent("collision", COLLISION.ports(tuple(scenario.ships)))))

    return make_ship, make_collision


def through_fmus(fmus: Mapping[str, Path], stack: ExitStack, ships: tuple[str, ...] = SHIPS, fmi: int = 2) -> Factories:
    """Components from the files "ShipManoeuvring" and "ShipCollision", unpacked once each; `stack` closes all. FMUs of
    FMI 3.0 must have been built for `ships`."""
    unpacked = {name: stack.enter_context(closing(UnpackedFmu(path))) for name, path in fmus.items()}

    def made(name: str, made_from: Interface) -> Component:
        fmu = unpacked[made_from.name]
        if fmi == 3:
            return stack.enter_context(closing(Fmi3Component(name, fmu, made_from.table(ships))))
        return stack.enter_context(closing(Fmi2Component(name, fmu)))

    return lambda name: made(name, MANOEUVRING), lambda: made("collision", COLLISION)
