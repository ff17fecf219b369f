"""native/collision: one step from each state of whole runs, beside the Python model from the same state.

The runs are those of the Python model, so that no difference is carried from step to step. Where rounding chooses among
equal features the answers differ: such a step is explained by the Python model itself (one_step.py).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import pi

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.collision.model import ShipCollision
from tests.collision.conftest import World
from tests.collision.test_random_encounters import encounter
from tests.native.collision.one_step import CLOSE, OneStep, Tally

pytestmark = pytest.mark.needs("pybullet")

H = 0.2
SPACING = 340.0
"""Of the places at which ships of a harbour start [m]. They are 325 m from corner to corner: none starts in another."""
EVERY = 20
"""Of the far steps of random encounters, one of so many is compared."""
DIFFERING = 0.001
"""Largest share of the steps in which rounding chooses."""
LONG_CONTACTS = 0.005
"""The same for 100 of the 10 000 encounters: in some there is a long contact whose every step has the choice."""


@contextmanager
def compared(tally: Tally) -> Iterator[None]:
    """Meanwhile each step of each Python model with the response `pgs` is compared."""
    step: Callable[..., None] = ShipCollision.step
    beside: dict[ShipCollision, OneStep] = {}

    def step_both(model: ShipCollision, t: float, H: float) -> None:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(ShipCollision, "step", step)
            if model not in beside:
                beside[model] = OneStep(model, tally)
            beside[model].step(model.step, t, H)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ShipCollision, "step", step_both)
        yield
    for each in beside.values():
        each.close()


def run_encounter(seed: int, tally: Tally) -> None:
    """A random encounter, answered by pgs; ships that coast straight, or by Kirchhoff's equations."""
    names, starts, parameters = encounter(random.Random(seed))
    duration, plane = parameters.pop("time"), parameters["degrees_of_freedom"] == 3
    law = "straight" if seed % 2 else "kirchhoff" if plane else "free"
    w = World(names, starts, **{"coasting": law, **parameters, "response": "pgs"})
    beside, take = OneStep(w.model, tally, seed, EVERY), w.model.step
    w.model.step = lambda t, H: beside.step(take, t, H)
    while w.t < duration and all(abs(ship.attitude[0]) < 1.0 for ship in w.model.outputs.ships):
        w.step(H)
    w.model.close()
    beside.close()


def check(tally: Tally, differing: float = DIFFERING) -> None:
    print(tally.describe())  # noqa: T201  # of a soak
    assert tally.left == []
    assert len(tally.differ) <= max(1.0, differing * tally.taken)
    assert tally.residual <= 1.0 + CLOSE  # both answers obey the law of contact alike
    assert tally.touched > 0


@pytest.mark.parametrize(
    ("name", "algorithm"),
    [
        ("guan2014_added_mass", "jacobi"),
        pytest.param("guan2014_added_mass", "gauss-seidel", marks=pytest.mark.slow),
        pytest.param("guan2014", "gauss-seidel", marks=pytest.mark.slow),
        pytest.param("guan2014", "jacobi", marks=pytest.mark.slow),
    ],
)
def test_each_step_of_a_published_collision(name: str, algorithm: str) -> None:
    """The response of guan2014 is PyBullet's own, and pgs here."""
    tally, scenario = Tally(), load_scenario(name)
    collision = scenario.collision.model_copy(update={"response": "pgs"})
    with compared(tally):
        simulate(scenario.model_copy(update={"collision": collision}), algorithm=algorithm, in_process=True)
    check(tally)
    assert tally.compared == tally.taken == 120


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_each_step_of_a_crossing(algorithm: str) -> None:
    tally = Tally()
    with compared(tally):
        simulate("kvlcc2_crossing", algorithm=algorithm, in_process=True)
    check(tally)
    assert tally.touched > 200


def run_harbour(count: int, steps: int, tally: Tally) -> None:
    """Ships of one kind, whose decks are level, in a square, on courses of their own; they coast."""
    draw, side = random.Random(count), round(count**0.5)
    starts = [
        {
            "position": (SPACING * (i // side), SPACING * (i % side), 0.0),
            "attitude": (0.0, 0.0, draw.uniform(-pi, pi)),
            "nu": (draw.uniform(2.0, 6.0), 0.0, 0.0, 0.0, 0.0, 0.0),
        }
        for i in range(count)
    ]
    w = World(["kvlcc2"] * count, starts, degrees_of_freedom=3)
    beside, take = OneStep(w.model, tally, count), w.model.step
    w.model.step = lambda t, H: beside.step(take, t, H)
    for _ in range(steps):
        w.step(H)
    w.model.close()
    beside.close()


@pytest.mark.slow
@pytest.mark.parametrize(("count", "steps"), [(10, 300), (40, 150)])
def test_each_step_of_a_harbour(count: int, steps: int) -> None:
    tally = Tally()
    run_harbour(count, steps, tally)
    check(tally)
    assert tally.compared == steps


def run_block(seeds: range, differing: float = DIFFERING) -> None:
    print(f"seeds {seeds.start} to {seeds.stop - 1}")  # noqa: T201  # of a soak
    tally = Tally()
    for seed in seeds:
        run_encounter(seed, tally)
    check(tally, differing)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(5))
def test_five_hundred_random_encounters(block: int) -> None:
    run_block(range(100 * block, 100 * block + 100))


@pytest.mark.soak
@pytest.mark.parametrize("block", range(100))
def test_ten_thousand_random_encounters(block: int) -> None:
    run_block(range(1000 + 100 * block, 1100 + 100 * block), LONG_CONTACTS)
