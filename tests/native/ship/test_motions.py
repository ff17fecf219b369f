"""The parts of native/ship/ beside their Python twins, on random input."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest

from shipcollision_fmu.errors import StepError
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.ship.coasting import coast
from shipcollision_fmu.ship.coasting_law import COASTING, make_coasting
from shipcollision_fmu.ship.damping import Damping
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse, from_level, tilted_inverse, to_level
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.restoring import Restoring
from shipcollision_fmu.ship.seakeeping import compute_seakeeping
from tests.native.comparison import assert_close
from tests.native.kernels import evaluate

COUNT = 200
SHIPS = ("kvlcc2", "kcs", "guan2014_target_added_mass")


def draw_motions(random: np.random.Generator, count: int, angle: float = 0.6) -> Array:
    """Position, attitude, velocity and rate, some of each zero, as many are."""
    motions = np.hstack([
        random.uniform(-1e3, 1e3, (count, 2)), random.uniform(-2.0, 2.0, (count, 1)),
        random.uniform(-angle, angle, (count, 2)), random.uniform(-20.0, 20.0, (count, 1)),
        random.uniform(-8.0, 8.0, (count, 3)), random.uniform(-0.1, 0.1, (count, 3)),
    ])  # fmt: skip
    still = random.random((count, 12)) < random.choice([0.0, 0.3, 0.9], (count, 1))
    return np.where(still, 0.0, motions)


def test_a_tilted_inverse() -> None:
    random, ship = np.random.default_rng(1), load_ship("kvlcc2")
    inputs = np.hstack([random.choice([3, 4, 6], (COUNT, 1)), random.uniform(-1.5, 1.5, (COUNT, 2))])
    inputs[::7, 1:] = 0.0
    expected = [tilted_inverse(free_inverse(ship.M, int(f)), int(f), [a, b, 0.3]).ravel() for f, a, b in inputs]
    found = evaluate("tilted_inverse", prepare_ship("kvlcc2"), inputs, 36)
    for free in (3, 4, 6):  # other degrees of freedom have other scales
        of = inputs[:, 0] == free
        assert_close(found[of], np.array(expected)[of], 1e-13)


def test_level_axes() -> None:
    inputs = np.random.default_rng(2).uniform(-3.0, 3.0, (COUNT, 7))
    expected = [(*to_level(tuple(row[:6]), row[6]), *from_level(tuple(row[:6]), row[6])) for row in inputs.tolist()]
    assert_close(evaluate("level", b"", inputs, 12), expected)


@pytest.mark.parametrize("name", SHIPS)
def test_straight_motion(name: str) -> None:
    random = np.random.default_rng(3)
    inputs = np.hstack([draw_motions(random, COUNT, 3.0), 10.0 ** random.uniform(-4.0, 3.0, (COUNT, 1))])
    r_bg = load_ship(name).r_bg.tolist()
    expected = []
    for row in inputs.tolist():
        moved = coast(row[:3], row[3:6], row[6:9], row[9:12], r_bg, row[12])
        expected.append([*moved[0], *moved[1], *moved[2], *row[9:12]])
    assert_close(evaluate("coast", prepare_ship(name), inputs, 12), expected, 1e-12)


@pytest.mark.parametrize("name", SHIPS[:2])
def test_restoring_and_damping(name: str) -> None:
    sea = compute_seakeeping(load_ship(name))
    restoring, damping = Restoring(sea), Damping(sea)
    random = np.random.default_rng(4)
    angles = random.uniform(-1.4, 1.4, (COUNT, 2)).tolist()
    inputs = [
        (D, sin(a), cos(a), sin(b), cos(b)) for D, (a, b) in zip(random.uniform(-3, 3, COUNT), angles, strict=True)
    ]
    expected = [(*restoring(*row), restoring.compute_roll_moment(*row[1:3])) for row in inputs]
    assert_close(evaluate("restoring", prepare_ship(name), np.array(inputs), 7), expected)
    motions = random.uniform(-1.0, 1.0, (COUNT, 3))
    found = evaluate("damping", prepare_ship(name), motions, 3)
    assert_close(found, [damping(*row) for row in motions.tolist()], 0.0)


@pytest.mark.parametrize("law", COASTING)
@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_coasting(degrees_of_freedom: int, law: str) -> None:
    """Of long and short steps, level and heeled; and too long ones are refused alike."""
    random = np.random.default_rng(5 + degrees_of_freedom)
    inputs = np.hstack([
        np.full((COUNT, 1), degrees_of_freedom), np.full((COUNT, 1), COASTING.index(law)), draw_motions(random, COUNT),
        10.0 ** random.uniform(-3.0, 1.0, (COUNT, 1)),
    ])  # fmt: skip
    inputs[0, -1] = 1e6
    for name in SHIPS:
        ship = load_ship(name)
        if name == "guan2014_target_added_mass" and law == "kirchhoff":
            continue
        coasting, expected = make_coasting(ship, degrees_of_freedom, law), []
        for row in inputs[:, 2:].tolist():
            motion = (row[:3], row[3:6], row[6:9], row[9:12])
            moved, done = [0.0] * 12, True
            try:
                moved = [*(number for part in coasting.coast(*motion, row[12]) for number in part)]
            except StepError:
                done = False
            expected.append([*moved, coasting.is_straight(*motion), coasting.keeps_course, done])
        assert_close(evaluate("coasting", prepare_ship(name), inputs, 15), expected, 1e-12)
