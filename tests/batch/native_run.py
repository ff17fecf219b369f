"""Runs in which the ordinary master steps the native models: called from Python one by one, or as FMUs."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import Any

from shipcollision_fmu.cosim.component import Component, InProcessComponent
from shipcollision_fmu.cosim.factories import Factories, fmu_factories
from shipcollision_fmu.cosim.simulate import build_run, run_steps
from shipcollision_fmu.fmi.framed_collision import Frames
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.scenario.scenario import Scenario
from shipcollision_fmu.toolchain.load import load_library
from tests.native.native_collision import NativeCollision
from tests.native.native_ship import NativeShip

__all__ = ["simulate_native", "simulate_native_fmus"]


def simulate_native(scenario: Scenario) -> Any:
    """The Run of a scenario."""
    library, names = load_library(), tuple(scenario.ships)

    def make_ship(name: str) -> Component:
        access = VariableAccess(MANOEUVRING.name, MANOEUVRING.table(()), NativeShip(library))
        return InProcessComponent(name, access)

    def make_collision() -> Component:
        model: Any = NativeCollision(library, names)
        model.frames = [Frames() for _ in names]
        return InProcessComponent("collision", VariableAccess(COLLISION.name, COLLISION.table(names), model))

    return _finish(scenario, (make_ship, make_collision))


def simulate_native_fmus(scenario: Scenario, ship: Path, collision: Path) -> Any:
    """The Run of a scenario through these FMUs, of ships in their resources."""
    with ExitStack() as stack:
        fmus = {MANOEUVRING.name: ship, COLLISION.name: collision}
        return _finish(scenario, fmu_factories(fmus, stack, tuple(scenario.ships)))


def _finish(scenario: Scenario, factories: Factories) -> Any:
    ships = scenario.load_ships()
    record, _ = run_steps(scenario, ships, factories)
    return build_run(scenario, ships, record, "native", 1.0)
