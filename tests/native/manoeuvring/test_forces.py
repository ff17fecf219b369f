"""The parts of native/manoeuvring/ beside their Python twins, on random input."""

from __future__ import annotations

from math import pi
from random import Random
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.manoeuvring.actuators import Actuator, make_engine, make_steering_gear
from shipcollision_fmu.manoeuvring.hull_forces import HullForces
from shipcollision_fmu.manoeuvring.mmg import Machines, Mmg, Orders, Six, Surroundings
from shipcollision_fmu.manoeuvring.mmg_3dof import Mmg3Dof
from shipcollision_fmu.manoeuvring.mmg_6dof import Mmg6Dof
from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.manoeuvring.propeller import Propeller
from shipcollision_fmu.manoeuvring.rudder import Rudder
from shipcollision_fmu.manoeuvring.wind import WindForces
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.windage import compute_windage
from tests.native.comparison import assert_close
from tests.native.kernels import evaluate
from tests.native.random_ships import draw_sailing_ship

COUNT = 300
SHIPS: list[Any] = ["kvlcc2", "guan2014_own_manoeuvring", draw_sailing_ship(Random(1)), draw_sailing_ship(Random(2))]


def draw_velocities(random: np.random.Generator, count: int) -> Array:
    """u, v [m/s] and r [rad/s]: ahead, drifting, astern, spinning on the spot and at rest."""
    velocities = random.normal(0.0, 1.0, (count, 3)) * [6.0, 2.0, 0.02]
    return velocities * random.choice([0.0, 1e-3, 1.0], (count, 3), p=[0.1, 0.2, 0.7])


def test_actuators() -> None:
    random = np.random.default_rng(1)
    inputs = np.hstack([
        -random.random((COUNT, 1)), random.random((COUNT, 2)), random.uniform(-2.0, 2.0, (COUNT, 2)),
        random.exponential(1.0, (COUNT, 1)),
    ])  # fmt: skip
    expected = [(Actuator(a, b, c).follow(x, o, t), Actuator(a, b, c).limit(o)) for a, b, c, x, o, t in inputs.tolist()]
    assert_close(evaluate("actuator", b"", inputs, 2), expected, 0.0)


@pytest.mark.parametrize("ship", SHIPS)
def test_engines_and_steering_gear(ship: Any) -> None:
    random, loaded = np.random.default_rng(2), load_ship(ship)
    engine, gear = make_engine(loaded.engine), make_steering_gear(loaded.rudder)
    inputs = np.hstack([
        random.uniform(-2.0, 2.0, (COUNT, 1)), random.choice([-1.0, 0.0, 1.0], (COUNT, 1)),
        random.uniform(0.0, 30.0, (COUNT, 1)), random.uniform(-3.0, 3.0, (COUNT, 1)),
        10.0 ** random.uniform(-2.0, 2.5, (COUNT, 1)),
    ])  # fmt: skip
    inputs[::5, 3] = 0.0
    expected = []
    for n, side, waited, order, time in inputs.tolist():
        speed, moved = engine.follow(n, (side, waited), order, time)
        expected.append((speed, *moved, *engine.find_gear(n), gear.follow(n, order, time)))
    assert_close(evaluate("engine", prepare_ship(ship), inputs, 6), expected, 0.0)


@pytest.mark.parametrize("ship", SHIPS)
def test_hull_forces(ship: Any) -> None:
    loaded, inputs = load_ship(ship), draw_velocities(np.random.default_rng(3), COUNT)
    assert loaded.manoeuvring is not None
    hull = HullForces(loaded, loaded.manoeuvring)
    assert_close(evaluate("hull_forces", prepare_ship(ship), inputs, 3), [hull(*row) for row in inputs.tolist()])


@pytest.mark.parametrize("ship", SHIPS)
def test_propellers_and_torque_limits(ship: Any) -> None:
    loaded, random = load_ship(ship), np.random.default_rng(4)
    assert loaded.propeller is not None
    assert loaded.engine is not None
    propeller = Propeller(loaded, loaded.propeller)
    velocities = draw_velocities(random, COUNT)
    inputs = np.hstack([
        velocities[:, :1], np.hypot(velocities[:, :1], velocities[:, 1:2]), random.uniform(-pi / 2, pi / 2, (COUNT, 1)),
        velocities[:, 2:], random.uniform(-12.0, 12.0, (COUNT, 1)), random.uniform(-3.0, 3.0, (COUNT, 1)),
    ])  # fmt: skip
    inputs[::9, 4:] = 0.0
    expected = [(propeller.compute_inflow(*row[:4]), propeller.compute_thrust(*row[4:])) for row in inputs.tolist()]
    # The place in the table of the series is right to rounding, and so a difference of two entries.
    assert_close(evaluate("propeller", prepare_ship(ship), inputs, 2), expected, 2e-13)
    limit = propeller.limit_torque(loaded.engine)
    if limit is None:
        return
    places = random.uniform(-30.0, 30.0, (COUNT, 3))
    free = [(*limit.find_range(u_P), limit.is_surely_free(u, n / 20.0)) for u_P, u, n in places.tolist()]
    found = evaluate("torque_limit", prepare_ship(ship), places * [1.0, 1.0, 0.05], 3)
    assert_close(found, free)


@pytest.mark.parametrize("ship", SHIPS)
def test_rudders_and_wind(ship: Any) -> None:
    loaded, random = load_ship(ship), np.random.default_rng(5)
    assert loaded.propeller is not None
    assert loaded.rudder is not None
    rudder = Rudder(loaded, loaded.rudder, loaded.propeller)
    inputs = random.normal(0.0, 1.0, (COUNT, 6)) * [8.0, 0.5, 0.02, 8.0, 1e6, 0.6]
    expected = [rudder(*row) for row in inputs.tolist()]
    assert_close(evaluate("rudder", prepare_ship(ship), inputs, 3), expected, 1e-13)
    wind, velocities = WindForces(compute_windage(loaded), loaded.L_oa), draw_velocities(random, COUNT)[:, :2]
    found = evaluate("wind", prepare_ship(ship), velocities, 4)
    assert_close(found, [wind(*row) for row in velocities.tolist()])


def make_six(numbers: list[float]) -> Six:
    a, b, c, d, e, f = numbers
    return a, b, c, d, e, f


def run_python(mmg: Mmg, row: list[float]) -> list[float]:
    """What the kernel `mmg` gives, by the Python model."""
    eta, nu = make_six(row[1:7]), make_six(row[7:13])
    machines = Machines(row[13], row[14], mmg.engine.find_gear(row[14]))
    around = Surroundings(*row[15:25])
    forces = mmg.compute_forces(eta, nu, machines, around)
    limited = mmg.limit_revolutions(eta, nu, row[14], around)
    after = mmg.advance(eta, nu, machines, Orders(*row[25:27]), around, row[27], int(row[28]))
    moved, twist, (delta, n, gear) = after
    return [*(x for wrench in forces for x in wrench), limited, mmg.shortest_time, *moved, *twist, delta, n, *gear]


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
@pytest.mark.parametrize("ship", SHIPS)
def test_equations_of_motion(ship: Any, degrees_of_freedom: int) -> None:
    loaded, random, count = load_ship(ship), np.random.default_rng(6), 40
    mmg = Mmg3Dof(loaded) if degrees_of_freedom == 3 else Mmg6Dof(loaded, degrees_of_freedom)
    held = 0.0 if degrees_of_freedom != 6 else 1.0
    rolls = 0.0 if degrees_of_freedom == 3 else 1.0
    motions = random.normal(0.0, 1.0, (count, 12)) * [
        100.0, 100.0, 0.5 * held, 0.2 * rolls, 0.02 * held, 3.0, 6.0, 1.0, 0.3 * held, 0.02 * rolls, 0.01 * held, 0.01,
    ]  # fmt: skip
    calm = random.random((count, 2)) < 0.4
    around = random.normal(0.0, 1.0, (count, 4)) * [1.0, 1.0, 12.0, 12.0]
    around *= np.repeat(~calm, 2, axis=1)
    weight = loaded.mass * np.array([1.0, 1.0, held, 3.0 * rolls, 30.0 * held, 30.0])
    force = random.normal(0.0, 0.01, (count, 6)) * weight * (random.random((count, 1)) < 0.5)
    h = random.uniform(0.01, 0.5, (count, 1))
    inputs = np.hstack([
        np.full((count, 1), degrees_of_freedom), motions, random.uniform(-0.6, 0.6, (count, 1)),
        random.uniform(-1.5, 1.5, (count, 1)), around, force, random.uniform(-0.7, 0.7, (count, 1)),
        random.uniform(-2.0, 2.0, (count, 1)), h, np.ceil(h / 0.05),
    ])  # fmt: skip
    expected = [run_python(mmg, row) for row in inputs.tolist()]
    assert_close(evaluate("mmg", prepare_ship(ship), inputs, 42), expected, 1e-12)
