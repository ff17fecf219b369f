"""Run a scenario: instances, the step loop, and what comes out.

    for k = 0 .. steps-1:     give the orders of k;   one step of the algorithm;   record k+1

The run goes through the FMUs with FMPy, or, in process, drives the same models through the same variables without FMI.
Both give the same bits.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from math import radians
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import ScenarioError
from ..files import check_writable, write_files
from ..fmi.interface import SHIPS, Interface
from ..fmi.package import VERSIONS
from ..fmi.ship_collision import INTERFACE as COLLISION
from ..fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from ..results.bodies import bodies
from ..results.events import events
from ..results.record import Record
from ..results.summary import summary
from ..scenario.scenario import Scenario, load_scenario
from .component import Component, InProcessComponent
from .fmi2_component import FmuComponent, UnpackedFmu
from .fmi3_component import Fmi3Component
from .fmu_files import ready_fmus, require_pybullet
from .interrupt import held_back
from .master import ALGORITHMS
from .recorder import Recorder
from .wiring import MakeCollision, MakeShip, connected

__all__ = ["Factories", "Progress", "Run", "as_models", "simulate", "stepped", "through_fmus"]

Progress = Callable[[int, int], None]
"""Called after every step with the steps done and the steps in all."""
Factories = tuple[MakeShip, MakeCollision]
"""What makes the components of a run, and sees to it that they are closed."""


@dataclass(frozen=True)
class Run:
    """A finished run.

    states, contacts    NumPy structured arrays; the columns are those of states.csv and contacts.csv
    events, summary     what is in events.json and summary.json
    signals             structured array, that of signals.csv: clearance and dissipated energy over time
    bodies              what is in bodies.json: hulls, inertias and obstacles
    timing              what differs between runs of the same thing: mode, wall time [s], real-time factor
    """

    states: npt.NDArray[Any]
    contacts: npt.NDArray[Any]
    events: dict[str, Any]
    summary: dict[str, Any]
    signals: npt.NDArray[Any]
    bodies: dict[str, Any]
    timing: dict[str, Any] = field(compare=False)

    def write(self, out: str | Path) -> None:
        """Write the run's files into the folder `out`, all or none. Raises HostError.

        Everything but timing.json is the same, to the byte, for the same scenario and software.
        """
        write_files(Path(out), {
            "states.csv": _csv(self.states),
            "contacts.csv": _csv(self.contacts),
            "events.json": _json(self.events),
            "summary.json": _json(self.summary),
            "signals.csv": _csv(self.signals),
            "bodies.json": _json(self.bodies),
            "timing.json": _json(self.timing),
        })  # fmt: skip


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
        bodies=bodies(ships, scenario.obstacles),
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
        return stack.enter_context(closing(FmuComponent(name, fmu)))

    return lambda name: made(name, MANOEUVRING), lambda: made("collision", COLLISION)


def _csv(rows: npt.NDArray[Any]) -> str:
    """Header and rows; floats as repr, so that reading them back gives the same double."""
    assert rows.dtype.names is not None
    lines = [",".join(rows.dtype.names), *(",".join(map(_cell, row)) for row in rows.tolist())]
    return "\n".join(lines) + "\n"


def _cell(value: Any) -> str:
    return value if isinstance(value, str) else repr(value)


def _json(data: Any) -> str:
    """Indented, with a list of plain values on one line; floats as repr."""
    text = json.dumps(data, indent=1, allow_nan=False, default=_plain) + "\n"
    return re.sub(r"\[\n[^][{}]*\]", lambda found: re.sub(r"\n *", " ", found[0]).replace("[ ", "[")[:-2] + "]", text)


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} cannot be written as JSON")
