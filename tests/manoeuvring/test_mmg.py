"""The MMG model: signs, current, equilibrium, convergence, standstill."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, hypot, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.loading.library import load_ship

from .conftest import started

Start = Callable[..., ShipManoeuvring]
MMG = {"degrees_of_freedom": 3, "hydrodynamics": True}


def sail(model: ShipManoeuvring, duration: float, h: float = 0.5) -> None:
    for k in range(round(duration / h)):
        model.step(k * h, h)


@pytest.mark.parametrize("side", [1, -1], ids=["starboard", "port"])
def test_rudder_turns_to_its_side(start: Start, side: int) -> None:
    ship = start(**MMG, velocity=[7.0, 0.0, 0.0], orders=[side * 0.3, 1.2])
    sail(ship, 60.0)
    assert side * ship.outputs.attitude[2] > 0.1
    assert side * ship.outputs.position[1] > 0.0
    assert side * ship.outputs.velocity[1] < 0.0  # drifts outwards
    assert side * ship.outputs.rudder[5] > 0.0
    assert side * ship.outputs.rudder[1] < 0.0


@pytest.mark.parametrize("side", [1, -1], ids=["starboard", "port"])
def test_push_moves_to_its_side(start: Start, side: int) -> None:
    pushed = start(**MMG, force=[0.0, side * 1e6, 0.0, 0.0, 0.0, 0.0])
    sail(pushed, 10.0)
    struck = start(**MMG, velocity=[7.0, 0.0, 0.0], orders=[0.0, 1.2], impulse=[0.0, side * 1e8, 0.0, 0.0, 0.0, 0.0])
    sail(struck, 1.0)
    for ship in (pushed, struck):
        assert side * ship.outputs.velocity[1] > 0.0
        assert side * ship.outputs.position[1] > 0.0


def test_bow_pushed_to_starboard_turns_to_starboard(start: Start) -> None:
    ship = start(**MMG, impulse=[0.0, 5e7, 0.0, 0.0, 0.0, 5e7 * 150.0])
    sail(ship, 1.0)
    assert ship.outputs.rate[2] > 0.0
    assert ship.outputs.attitude[2] > 0.0


def test_current_carries_a_drifting_ship_along(start: Start) -> None:
    ship = start(**MMG, attitude=[0.0, 0.0, 0.8], current=[0.6, -0.8], substep=0.5)
    sail(ship, 1200.0)
    psi, (u, v, _) = ship.outputs.attitude[2], ship.outputs.velocity
    north, east = u * cos(psi) - v * sin(psi), u * sin(psi) + v * cos(psi)
    assert ship.outputs.position[0] > 100.0
    assert ship.outputs.position[1] < -100.0
    assert 0.4 < north * 0.6 - east * 0.8 <= 1.0  # well on the way to the water's own 1 m/s, never above


def test_manoeuvre_in_a_current_is_the_same_manoeuvre_carried_along(start: Start) -> None:
    """Galilei: a uniform current only moves the water the ship turns in."""
    c_n, c_e, psi, T = 0.7, -0.4, 0.9, 300.0
    still = start(**MMG, attitude=[0.0, 0.0, psi], velocity=[6.0, 0.2, 0.0], orders=[0.5, 1.1])
    u_c, v_c = c_n * cos(psi) + c_e * sin(psi), c_e * cos(psi) - c_n * sin(psi)
    carried = start(
        **MMG, attitude=[0.0, 0.0, psi], velocity=[6.0 + u_c, 0.2 + v_c, 0.0], orders=[0.5, 1.1], current=[c_n, c_e]
    )
    sail(still, T)
    sail(carried, T)
    expected = np.array(still.outputs.position) + np.array([c_n * T, c_e * T, 0.0])
    np.testing.assert_allclose(carried.outputs.position, expected, atol=1e-6)
    np.testing.assert_allclose(carried.outputs.attitude, still.outputs.attitude, atol=1e-9)
    np.testing.assert_allclose(carried.outputs.hull, still.outputs.hull, rtol=1e-6, atol=1e-3)


def test_service_speed_is_the_equilibrium(start: Start) -> None:
    """KVLCC2's service_rev_per_s is the file's own self-propulsion point."""
    table = load_ship("kvlcc2").propeller
    assert table is not None
    assert table.service_speed is not None
    assert table.service_rev_per_s is not None
    ship = start(**MMG, velocity=[table.service_speed, 0.0, 0.0], orders=[0.0, table.service_rev_per_s])
    assert ship.outputs.propeller[0] + ship.outputs.hull[0] == pytest.approx(0.0, abs=1e-4 * ship.outputs.propeller[0])
    sail(ship, 600.0)
    assert ship.outputs.velocity[0] == pytest.approx(table.service_speed, rel=1e-3)
    assert ship.outputs.position[1] == 0.0
    assert ship.outputs.attitude == [0.0, 0.0, 0.0]


def test_equations_of_motion_of_the_paper(start: Start) -> None:
    """Accelerations over an instant, from the forces that the model itself reports."""
    u, v, r, h = 5.0, -0.8, 0.012, 1e-6
    ship = start(**MMG, velocity=[u, v, 0.0], rate=[0.0, 0.0, r], orders=[0.0, 1.2])
    o = ship.outputs
    X, Y, N = (o.hull[i] + o.propeller[i] + o.rudder[i] for i in (0, 1, 5))
    L, d, m, x_G = 320.0, 20.8, 320.415e6, 11.2
    unit = 0.5 * 1025.0 * L**2 * d
    m_x, m_y, J_z, I_zG = 0.022 * unit, 0.223 * unit, 0.011 * unit * L**2, m * 80.0**2
    ship.step(0.0, h)
    u_dot, v_dot, r_dot = (np.array([*o.velocity[:2], o.rate[2]]) - [u, v, r]) / h
    assert (m + m_x) * u_dot - (m + m_y) * v * r - x_G * m * r**2 == pytest.approx(X, rel=1e-3, abs=1e3)
    assert (m + m_y) * v_dot + (m + m_x) * u * r + x_G * m * r_dot == pytest.approx(Y, rel=1e-3)
    assert (I_zG + x_G**2 * m + J_z) * r_dot + x_G * m * (v_dot + u * r) == pytest.approx(N, rel=1e-3)


def test_forces_at_the_end_of_a_step_are_those_of_its_state(start: Start) -> None:
    ship = start(**MMG, velocity=[7.0, 0.0, 0.0], orders=[0.3, 1.2], current=[0.5, 0.5])
    sail(ship, 20.0)
    o = ship.outputs
    twin = start(**MMG, attitude=o.attitude, velocity=o.velocity, rate=o.rate, orders=[0.0, 1.2], current=[0.5, 0.5])
    assert twin.outputs.hull == o.hull
    assert twin.outputs.propeller == o.propeller


def _after_a_minute(substep: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    ship = started(
        **MMG, velocity=[6.0, -1.2, 0.0], rate=[0.0, 0.0, 0.008], orders=[0.0, 1.2], substep=substep
    )  # rudder amidships: a kink in the rudder's motion would hide the order
    ship.step(0.0, 64.0)
    return np.array([*ship.outputs.position, *ship.outputs.attitude, *ship.outputs.velocity])


@pytest.mark.usefixtures("engine")
def test_converges_with_the_fourth_power_of_the_substep() -> None:
    exact = _after_a_minute(0.125)
    errors = [np.linalg.norm(_after_a_minute(s) - exact) for s in (8.0, 4.0, 2.0)]
    assert errors[0] / errors[1] > 10.0
    assert errors[1] / errors[2] > 10.0


def test_communication_step_does_not_matter(start: Start) -> None:
    """Steps of a whole number of substeps give the same bits, whatever their length."""
    one, many = (start(**MMG, velocity=[7.0, 0.0, 0.0], orders=[0.3, 1.2], substep=0.0625) for _ in range(2))
    one.step(0.0, 16.0)
    sail(many, 16.0, 0.0625)
    assert one.outputs.position == many.outputs.position
    assert one.outputs.velocity == many.outputs.velocity


@pytest.mark.usefixtures("engine")
@settings(max_examples=20, deadline=None)
@given(st.floats(-8.0, 8.0), st.floats(-5.0, 5.0), st.floats(-0.03, 0.03))
def test_without_propulsion_the_kinetic_energy_only_falls(u: float, v: float, r: float) -> None:
    ship = started(**MMG, velocity=[u, v, 0.0], rate=[0.0, 0.0, r], substep=0.5, again=True)
    M = load_ship("kvlcc2").M

    def energy() -> float:
        nu = np.array(ship.outputs.velocity + ship.outputs.rate)
        return float(0.5 * nu @ M @ nu)

    before = energy()
    for k in range(100):
        ship.step(2.0 * k, 2.0)
        after = energy()
        assert after <= before * (1.0 + 1e-12)
        before = after


def test_long_drift_at_rest_stays_at_rest(start: Start) -> None:
    ship = start(**MMG, attitude=[0.0, 0.0, 1.0], substep=1.0)
    sail(ship, 3600.0, 60.0)
    assert ship.outputs.position == [0.0, 0.0, 0.0]
    assert ship.outputs.velocity == [0.0, 0.0, 0.0]


def test_astern(start: Start) -> None:
    """The engine reversed stops the ship and then moves it astern, slower than it goes ahead."""
    ship = start(**MMG, velocity=[4.0, 0.0, 0.0], orders=[0.0, 0.6], substep=0.5)
    ship.inputs.propeller_order = -0.8
    sail(ship, 1800.0)
    assert -6.0 < ship.outputs.velocity[0] < -1.0


def test_a_blow_abeam_at_speed_stays_bounded(start: Start) -> None:
    """3 m/s sideways and a spin at once: the ship slows down and sails on."""
    ship = start(**MMG, velocity=[7.0, 0.0, 0.0], orders=[0.0, 1.2])
    ship.inputs.impulse[:] = [-2e9, 1.7e9, 0.0, 0.0, 0.0, 6e10]
    sail(ship, 600.0, 0.05)
    assert hypot(*ship.outputs.velocity[:2]) < 9.0
    assert abs(ship.outputs.rate[2]) < 0.02
