"""`coasting = "straight"`: CG goes straight, the angular velocity stays."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin

import numpy as np
import pytest

from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.ship.loading.library import load_ship

Start = Callable[..., ShipManoeuvring]
R_BG = load_ship("kvlcc2").r_bg


def steps(model: ShipManoeuvring, n: int, h: float) -> None:
    for k in range(n):
        model.step(k * h, h)


def pose(model: ShipManoeuvring) -> tuple[Array, Array]:
    return np.array(model.outputs.position), rotation(model.outputs.attitude)


def test_straight_line(start: Start) -> None:
    ship = start(coasting="straight", position=[10.0, -20.0, 0.5], attitude=[0.0, 0.0, 0.6], velocity=[5.0, -1.0, 0.0])
    steps(ship, 400, 0.05)
    expected = [10.0 + 20 * (5 * cos(0.6) + sin(0.6)), -20.0 + 20 * (5 * sin(0.6) - cos(0.6)), 0.5]
    np.testing.assert_allclose(ship.outputs.position, expected, rtol=1e-12)
    assert ship.outputs.attitude == [0.0, 0.0, 0.6]
    assert ship.outputs.velocity == [5.0, -1.0, 0.0]


def test_turning_ship_moves_its_CG_straight(start: Start) -> None:
    """Two and a half turns about the vertical: the heading counts on, CO circles about CG."""
    r, psi_0, t = 0.05, 3.0, 100.0 * pi
    ship = start(coasting="straight", attitude=[0.0, 0.0, psi_0], velocity=[4.0, 0.7, 0.0], rate=[0.0, 0.0, r])
    v_g_b = np.array([4.0, 0.7 + r * R_BG[0], 0.0])
    steps(ship, 1000, t / 1000)
    assert ship.outputs.attitude[2] == pytest.approx(psi_0 + r * t, rel=1e-12)
    assert r * t > 2.4 * 2 * pi
    p, R = pose(ship)
    R_0 = rotation([0.0, 0.0, psi_0])
    np.testing.assert_allclose(p + R @ R_BG, R_0 @ R_BG + t * (R_0 @ v_g_b), rtol=1e-11, atol=1e-9)
    np.testing.assert_allclose(R @ (ship.outputs.velocity + np.cross([0.0, 0.0, r], R_BG)), R_0 @ v_g_b, atol=1e-12)


def test_rotation_about_a_tilted_axis_in_one_step_or_many(start: Start) -> None:
    keys = {"attitude": [0.2, -0.1, 1.0], "velocity": [4.0, 0.7, -0.2], "rate": [0.05, -0.03, 0.04]}
    one, many = start(**keys, coasting="straight"), start(**keys, coasting="straight")
    one.step(0.0, 20.0)
    steps(many, 400, 0.05)
    np.testing.assert_allclose(many.outputs.position, one.outputs.position, rtol=1e-12)
    np.testing.assert_allclose(many.outputs.attitude, one.outputs.attitude, rtol=1e-11)
    np.testing.assert_allclose(many.outputs.velocity, one.outputs.velocity, rtol=1e-11)
    assert one.outputs.rate == many.outputs.rate == keys["rate"]


def test_angular_velocity_is_constant_in_n(start: Start) -> None:
    keys = {"attitude": [0.2, -0.1, 1.0], "velocity": [4.0, 0.7, -0.2], "rate": [0.05, -0.03, 0.04]}
    ship = start(**keys, coasting="straight")
    omega_n = rotation(keys["attitude"]) @ keys["rate"]
    v_g_n = rotation(keys["attitude"]) @ (keys["velocity"] + np.cross(keys["rate"], R_BG))
    steps(ship, 100, 0.3)
    _, R = pose(ship)
    np.testing.assert_allclose(R @ ship.outputs.rate, omega_n, atol=1e-15)
    np.testing.assert_allclose(R @ (ship.outputs.velocity + np.cross(ship.outputs.rate, R_BG)), v_g_n, atol=1e-13)


def test_more_than_half_a_turn_in_a_step(start: Start) -> None:
    ship = start(coasting="straight", rate=[0.0, 0.0, -1.5])
    ship.step(0.0, 5.0)
    assert ship.outputs.attitude[2] == pytest.approx(-7.5, rel=1e-14)


def test_heading_passes_north_without_a_jump(start: Start) -> None:
    ship = start(coasting="straight", attitude=[0.0, 0.0, 2 * pi - 0.01], rate=[0.0, 0.0, 0.1])
    ship.step(0.0, 0.2)
    assert ship.outputs.attitude[2] == pytest.approx(2 * pi + 0.01, rel=1e-14)


def test_actuators_and_forces_rest(start: Start) -> None:
    ship = start(velocity=[5.0, 0.0, 0.0], orders=[0.5, 1.0], current=[1.0, 1.0])
    ship.step(0.0, 1.0)
    o = ship.outputs
    assert o.rudder_angle == o.propeller_speed == 0.0
    assert o.hull == o.propeller == o.rudder == [0.0] * 6
    assert o.velocity == [5.0, 0.0, 0.0]
