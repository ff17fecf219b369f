"""What a communication step costs, part by part, beside FMUs with the same variables and an empty step.

    python benchmarks/communication_step.py [SCENARIO]          default: kvlcc2_crossing

Both are run through the same master and recorder, in turns, in one process; each figure is the least of ROUNDS. What
the empty FMUs cost is FMI, pythonfmu and the master; the ratio says what the physics adds. The clock's own cost
(two readings a call) is in both.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from shipcollision_fmu import load_scenario
from shipcollision_fmu.cli.console import print_table, say
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.cosim.component import Buffer, Component, Group, Value
from shipcollision_fmu.cosim.factories import fmu_factories
from shipcollision_fmu.cosim.fmu_files import ready_fmus
from shipcollision_fmu.cosim.simulate import run_steps
from shipcollision_fmu.fmi.builder.package import FMUS, fmu_bytes
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.scenario.scenario import Scenario

ROUNDS = 3

EMPTY_SLAVE = """
from dataclasses import replace

from shipcollision_fmu.fmi.{module} import INTERFACE
from shipcollision_fmu.fmi.slave import ModelSlave


def empty(ships):
    model = INTERFACE.model(ships)
    model.step = lambda t, h: None
    return model


class Empty{name}(ModelSlave):
    interface = replace(INTERFACE, name="Empty{name}", model=empty)
"""
"""The slave of an FMU with the same variables, which initialises as ours does and then never moves."""


class Clock:
    """Seconds by part: set, doStep of the ships and of the collision, get."""

    def __init__(self) -> None:
        self.parts = dict.fromkeys(("set", "doStep ships", "doStep collision", "get"), 0.0)


class TimedGroup:
    """A Group whose calls are on the clock."""

    def __init__(self, group: Group, clock: Clock) -> None:
        self._group, self._parts = group, clock.parts
        self.values = group.values

    def read(self, count: int | None = None) -> None:
        begin = perf_counter()
        self._group.read(count)
        self._parts["get"] += perf_counter() - begin

    def write(self) -> None:
        begin = perf_counter()
        self._group.write()
        self._parts["set"] += perf_counter() - begin


class Timed:
    """A Component whose calls are on the clock."""

    def __init__(self, component: Component, clock: Clock) -> None:
        self._component, self._clock = component, clock
        self.name = component.name
        self._step = "doStep collision" if component.name == "collision" else "doStep ships"

    def reals(self, names: Sequence[str], values: Buffer | None = None) -> Group:
        return TimedGroup(self._component.reals(names, values), self._clock)

    def integers(self, names: Sequence[str]) -> Group:
        return TimedGroup(self._component.integers(names), self._clock)

    def initialise(self, parameters: Mapping[str, Value], stop_time: float, inputs: Sequence[Group] = ()) -> None:
        self._component.initialise(parameters, stop_time, inputs)

    def step(self, t: float, h: float) -> None:
        begin = perf_counter()
        self._component.step(t, h)
        self._clock.parts[self._step] += perf_counter() - begin

    def close(self) -> None:
        self._component.close()


def timed(scenario: Scenario, fmus: Mapping[str, Path]) -> tuple[dict[str, float], float]:
    """Microseconds per step and part, and the share of steps with contact."""
    clock = Clock()
    with ExitStack() as stack:
        make_ship, make_collision = fmu_factories(fmus, stack)

        def ship(name: str) -> Component:
            return Timed(make_ship(name), clock)

        def collision() -> Component:
            return Timed(make_collision(), clock)

        record, total = run_steps(scenario, scenario.load_ships(), (ship, collision))
    parts = clock.parts | {"master and recorder": total - sum(clock.parts.values()), "total": total}
    steps = scenario.steps
    return {part: 1e6 * seconds / steps for part, seconds in parts.items()}, len(record.issued) / steps


def empty_fmus(folder: Path, ships: tuple[str, ...]) -> dict[str, Path]:
    """FMUs with our variables and an empty step, by the names of ours."""
    paths = {}
    for interface in (COLLISION, MANOEUVRING):
        text = EMPTY_SLAVE.format(name=interface.name, module=FMUS[interface.name])
        path = folder / f"Empty{interface.name}.fmu"
        path.write_bytes(fmu_bytes(replace(interface, name=f"Empty{interface.name}"), text.encode(), ships))
        paths[interface.name] = path
    return paths


def main() -> None:
    """Measure, and print a table of microseconds per step."""
    scenario = load_scenario(sys.argv[1] if len(sys.argv) > 1 else "kvlcc2_crossing")
    ships = tuple(scenario.ships)
    with tempfile.TemporaryDirectory() as folder:
        rivals = {"ours": ready_fmus(ships), "empty": empty_fmus(Path(folder), ships)}
        best: dict[str, dict[str, float]] = {}
        contact = 0.0
        for _ in range(ROUNDS):
            for name, fmus in rivals.items():
                parts, share = timed(scenario, fmus)
                contact = max(contact, share)
                before = best.get(name, parts)
                best[name] = {part: min(value, before[part]) for part, value in parts.items()}
    instances = len(ships) + 1
    shown = make_table(
        "part", ">ours [us/step]", ">empty [us/step]", ">ratio",
        title=f"{scenario.name}: {scenario.steps} steps, {instances} instances, {contact:.0%} of the steps in contact",
    )  # fmt: skip
    for part, value in best["ours"].items():
        shown.add_row(part, f"{value:.1f}", f"{best['empty'][part]:.1f}", f"{value / best['empty'][part]:.2f}")
    print_table(shown)
    whole = best["ours"]["total"] * scenario.steps / 1e6
    say(f"the whole run: {whole:.2f} s for {scenario.step * scenario.steps:g} s of simulated time")


main()
