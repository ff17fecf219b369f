"""What a substep costs with this package's own library, against PyBullet as the narrow phase, in one process.

    python benchmarks/narrow_phase.py

    near       per internal substep, hulls within reach but apart                                goal: at most 1.1
    contact    the same with hulls that are pressed together and slide: an impact in each        goal: at most 1.1
    closest    one call for the closest points of the two hulls at that gap                      goal: at most 1.1

Each figure is the least of ROUNDS, taken in turns. It needs PyBullet: CPython 3.10 or 3.11 on Linux (x86-64).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from time import perf_counter

import numpy as np

from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.geometry.adapter import CHOICE, open_narrow_phase
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship

ROUNDS, STEPS = 12, 200
SHIP, NAMES = "kvlcc2", ("own", "target")
ADAPTERS = ("library", "pybullet")


def model_step(gap: float, adapter: str) -> Callable[[int], None]:
    """A substep of a model whose ships are `gap` [m] apart, begun anew from the same state."""
    os.environ[CHOICE] = adapter
    model = ShipCollision(NAMES)
    for slot in model.parameters.ships:
        slot.ship = SHIP
    model.inputs.ships[1].position[1] = load_ship(SHIP).B + gap
    model.inputs.ships[0].velocity[:] = [2.0, 0.05, 0.0]
    model.inputs.ships[0].rate[2] = 0.001
    model.initialise()
    fresh, h = model.get_state(), model.parameters.substep

    def step(k: int) -> None:
        model.step(k * h, h)
        model.set_state(fresh)

    return step


def closest_call(gap: float, adapter: str) -> Callable[[int], None]:
    """One call for closest points; the target moves between the calls."""
    ship = load_ship(SHIP)
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    there = open_narrow_phase([hull, hull], adapter)

    def state(north: float, east: float) -> BodyState:
        return BodyState.at(np.array([north, east, 0.0]), np.zeros(3), np.zeros(6), np.zeros((6, 6)))

    places = [[state(0.0, 0.0), state(0.1 * k, ship.B + gap)] for k in range(STEPS)]
    return lambda k: (there.closest(0, 1, places[k], 1.0), None)[1]


def compare(make: Callable[[float, str], Callable[[int], None]], gap: float) -> tuple[float, ...]:
    """Least seconds per call with the library and with PyBullet."""
    calls, best = [make(gap, adapter) for adapter in ADAPTERS], [float("inf")] * 2
    for _ in range(ROUNDS):
        for i, call in enumerate(calls):
            begin = perf_counter()
            for k in range(STEPS):
                call(k)
            best[i] = min(best[i], (perf_counter() - begin) / STEPS)
    return tuple(best)


def main() -> None:
    """Measure, and print the ratios."""
    shown = make_table("case", ">library [us]", ">PyBullet [us]", ">ratio", ">goal", title="narrow phase")
    for case, make, gap in (
        ("near, per substep", model_step, 0.5),
        ("contact, per substep", model_step, -1e-4),
        ("closest points apart", closest_call, 0.5),
        ("closest points in overlap", closest_call, -0.01),
    ):
        ours, theirs = compare(make, gap)
        shown.add_row(case, f"{1e6 * ours:.1f}", f"{1e6 * theirs:.1f}", f"{ours / theirs:.2f}", "1.1")
    print_table(shown)


main()
