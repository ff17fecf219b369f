"""Impulses and forces: M nu changes by exactly what was given, once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.degrees_of_freedom import FREE
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.loading.library import load_ship

from .conftest import started

Start = Callable[..., ShipManoeuvring]
INSTANT = 1e-16
"""A step [s] too short for anything but the strike at its start to be seen."""

M = load_ship("kvlcc2").M
SPEEDS = np.sqrt(M[0, 0] / np.diag(M))
"""Twist components of the energy of 1 m/s in surge: makes them comparable [m/s, rad/s]."""
SCALE = np.diag(M) * SPEEDS
"""Impulses that cause about them [N s, N m s]."""


def twist(model: ShipManoeuvring) -> Array:
    return np.array(model.outputs.velocity + model.outputs.rate)


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
@pytest.mark.parametrize("component", range(6))
def test_one_component_from_rest(start: Start, component: int, degrees_of_freedom: int) -> None:
    P = np.zeros(6)
    P[component] = SCALE[component]
    ship = start(degrees_of_freedom=degrees_of_freedom, impulse=P)
    ship.step(0.0, INSTANT)
    free = list(FREE[degrees_of_freedom])
    taken = M[np.ix_(free, free)] @ twist(ship)[free]
    np.testing.assert_allclose(taken / SCALE[free], (P / SCALE)[free], atol=1e-13)
    held = [i for i in range(6) if i not in free]
    np.testing.assert_allclose(twist(ship)[held], 0.0, atol=1e-17)  # rolling turns a little sway into heave
    assert ship.outputs.impulse_applied == list(P)


@pytest.mark.usefixtures("engine")
@given(st.lists(st.floats(-2.0, 2.0), min_size=6, max_size=6), st.lists(st.floats(-2.0, 2.0), min_size=6, max_size=6))
def test_any_impulse_from_any_motion(P: list[float], nu: list[float]) -> None:
    nu_before = np.array(nu) * SPEEDS
    ship = started(
        velocity=nu_before[:3], rate=nu_before[3:], attitude=[0.1, -0.05, 2.0], impulse=np.array(P) * SCALE,
        again=True,
    )  # fmt: skip
    ship.step(0.0, INSTANT)
    np.testing.assert_allclose(M @ (twist(ship) - nu_before) / SCALE, P, atol=1e-12)


@pytest.mark.usefixtures("engine")
@given(st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3))
def test_sailing_ship_takes_the_impulse_alike(P: list[float]) -> None:
    given_impulse = np.zeros(6)
    given_impulse[[0, 1, 5]] = np.array(P) * SCALE[[0, 1, 5]]
    ship = started(
        degrees_of_freedom=3, hydrodynamics=True, velocity=[7.0, 0.5, 0.0], rate=[0.0, 0.0, 0.005], orders=[0.3, 1.2],
        impulse=given_impulse, again=True,
    )  # fmt: skip
    change = twist(ship)
    ship.step(0.0, INSTANT)
    change = twist(ship) - change
    np.testing.assert_allclose((M @ change)[[0, 1, 5]] / SCALE[[0, 1, 5]], P, atol=1e-12)
    assert not change[2:5].any()


def test_energy_is_what_M_says(start: Start) -> None:
    """The work of an impulse on a ship at rest, 1/2 P' nu, is its kinetic energy 1/2 nu' M nu."""
    P = SCALE * [1.0, -0.5, 0.3, 0.2, -0.7, 0.4]
    ship = start(impulse=P)
    ship.step(0.0, INSTANT)
    nu = twist(ship)
    assert 0.5 * nu @ M @ nu == pytest.approx(0.5 * P @ nu, rel=1e-13)


def test_the_same_sample_twice_changes_nothing(start: Start) -> None:
    ship = start(impulse=SCALE)
    ship.step(0.0, INSTANT)
    after_one = twist(ship)
    ship.step(0.0, INSTANT)
    np.testing.assert_array_equal(twist(ship), after_one)


def test_a_lost_sample_loses_nothing(start: Start) -> None:
    """The impulse grows in three parts; one ship sees all, the other only the last."""
    parts = [SCALE * k for k in (0.25, 0.75, 1.5)]
    all_seen, last_seen = start(), start()
    for P in parts:
        all_seen.inputs.impulse[:] = P
        all_seen.step(0.0, INSTANT)
    last_seen.inputs.impulse[:] = parts[-1]
    last_seen.step(0.0, INSTANT)
    np.testing.assert_allclose(twist(all_seen), twist(last_seen), rtol=1e-12)
    assert all_seen.outputs.impulse_applied == last_seen.outputs.impulse_applied == list(parts[-1])


def test_no_impulse_leaves_the_twist_to_the_bit(start: Start) -> None:
    ship = start(velocity=[5.1, 0.3, 0.0], coasting="straight")
    before = twist(ship)
    ship.step(0.0, 0.05)
    np.testing.assert_array_equal(twist(ship), before)


def test_strike_comes_at_the_start_of_the_step(start: Start) -> None:
    """A surge impulse moves the ship through the whole step."""
    P = np.zeros(6)
    P[0] = 2.0 * M[0, 0]
    ship = start(degrees_of_freedom=3, impulse=P)
    ship.step(0.0, 0.5)
    assert ship.outputs.position[0] == pytest.approx(2.0 * 0.5, rel=1e-14)


@pytest.mark.parametrize("hydrodynamics", [False, True])
@pytest.mark.parametrize("component", [0, 1, 5])
def test_force_changes_momentum_by_F_h(start: Start, component: int, hydrodynamics: bool) -> None:
    """From rest, where the water resists with the square of a tiny speed."""
    h, F = 1e-4, np.zeros(6)
    F[component] = 1e-4 * SCALE[component]
    ship = start(degrees_of_freedom=3, hydrodynamics=hydrodynamics, force=F)
    ship.step(0.0, h)
    free = [0, 1, 5]
    np.testing.assert_allclose((M @ twist(ship) / SCALE)[free], (F * h / SCALE)[free], rtol=1e-9, atol=1e-18)


@pytest.mark.parametrize("degrees_of_freedom", [4, 6])
def test_force_in_the_other_degrees_of_freedom(start: Start, degrees_of_freedom: int) -> None:
    h, F = 1e-6, SCALE * [1.0, -0.5, 0.3, 0.2, -0.7, 0.4]
    ship = start(degrees_of_freedom=degrees_of_freedom, force=F, coasting="free")
    ship.step(0.0, h)
    free = list(FREE[degrees_of_freedom])
    taken = M[np.ix_(free, free)] @ twist(ship)[free]
    np.testing.assert_allclose(taken / SCALE[free], (F * h / SCALE)[free], rtol=1e-9)


def test_constant_force_gives_constant_acceleration(start: Start) -> None:
    a, h, n = 0.01, 0.5, 20
    F = np.zeros(6)
    F[0] = a * M[0, 0]
    ship = start(degrees_of_freedom=3, velocity=[3.0, 0.0, 0.0], force=F)
    for k in range(n):
        ship.step(k * h, h)
    t = n * h
    assert ship.outputs.velocity[0] == pytest.approx(3.0 + a * t, rel=1e-13)
    assert ship.outputs.position[0] == pytest.approx(3.0 * t + 0.5 * a * t**2, rel=1e-13)
