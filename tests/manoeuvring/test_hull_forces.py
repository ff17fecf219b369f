"""Hull forces: the paper's polynomials at small drift, safe everywhere else."""

from __future__ import annotations

from math import cos, pi, radians, sin
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.hull_forces import BETA, GAMMA, HullForces, integrate_cross_flow
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship import Ship
from tests.ship_files import estimated_toml

SHIP = load_ship("kvlcc2")
assert SHIP.manoeuvring is not None
hull = HullForces(SHIP, SHIP.manoeuvring)
L, D, RHO = 320.0, 20.8, 1025.0
FORCE, MOMENT = 0.5 * RHO * L * D, 0.5 * RHO * L**2 * D


def load_hulls() -> dict[str, tuple[Ship, HullForces]]:
    """Measured sets and ships from four numbers."""
    ships = {name: load_ship(name) for name in ("kvlcc2", "kcs", "guan2014_target_manoeuvring")}
    with TemporaryDirectory() as folder:
        for name, (length, breadth, draught, C_b) in FOUR_NUMBERS.items():
            path = Path(folder) / f"{name}.toml"
            path.write_text(estimated_toml(length, breadth, draught, C_b), encoding="utf-8")
            ships[name] = load_ship(path)
    loaded = {}
    for name, ship in ships.items():
        assert ship.manoeuvring is not None
        loaded[name] = ship, HullForces(ship, ship.manoeuvring)
    return loaded


FOUR_NUMBERS = {
    "vlcc": (320.0, 58.0, 20.8, 0.81), "feeder": (130.0, 21.0, 7.4, 0.65), "trawler": (25.0, 7.8, 3.0, 0.55),
    "destroyer": (140.0, 18.0, 5.5, 0.50),
}  # fmt: skip
HULLS = load_hulls()

speed = st.floats(-12.0, 12.0)
turning = st.floats(-0.1, 0.1)


def at(U: float, beta: float, r_prime: float) -> tuple[float, float, float]:
    """hull at speed U, drift beta and r' = r L/U."""
    return hull(U * cos(beta), -U * sin(beta), r_prime * U / L)


def test_polynomials_of_the_paper() -> None:
    """KVLCC2 at beta = 12 deg, r' = 0.4, the published coefficients written out again."""
    U, v, r = 6.0, -sin(radians(12.0)), 0.4
    X = -0.00785 - 0.040 * v**2 + 0.002 * v * r + 0.011 * r**2 + 0.771 * v**4
    Y = -0.315 * v + 0.083 * r - 1.607 * v**3 + 0.379 * v**2 * r - 0.391 * v * r**2 + 0.008 * r**3
    N = -0.137 * v - 0.049 * r - 0.030 * v**3 - 0.294 * v**2 * r + 0.055 * v * r**2 - 0.013 * r**3
    expected = [FORCE * U**2 * X, FORCE * U**2 * Y, MOMENT * U**2 * N]
    np.testing.assert_allclose(at(U, radians(12.0), 0.4), expected, rtol=1e-12)


@given(speed, speed, turning)
def test_mirror_symmetry(u: float, v: float, r: float) -> None:
    X, Y, N = hull(u, v, r)
    assert hull(u, -v, -r) == pytest.approx((X, -Y, -N), rel=1e-12, abs=1e-9)


@given(speed, speed, turning, st.floats(1e-3, 10.0))
def test_forces_grow_with_the_square_of_the_motion(u: float, v: float, r: float, k: float) -> None:
    scaled = np.array(hull(k * u, k * v, k * r))
    np.testing.assert_allclose(scaled / k**2, hull(u, v, r), rtol=1e-6, atol=1e-3)


@given(speed, speed, turning)
def test_bounded_in_every_direction(u: float, v: float, r: float) -> None:
    """No direction, not even sideways, astern or spinning, has a coefficient above a few."""
    X, Y, N = hull(u, v, r)
    scale = u**2 + v**2 + (r * L) ** 2 + 1e-12
    assert abs(X) <= 1.0 * FORCE * scale
    assert abs(Y) <= 2.0 * FORCE * scale
    assert abs(N) <= 1.0 * MOMENT * scale


@pytest.mark.parametrize("nu", [(0.0, 0.0, 0.0), (1e-300, 0.0, 0.0), (0.0, -0.0, 1e-300), (-0.0, 0.0, 0.0)])
def test_at_rest_there_is_no_force(nu: tuple[float, float, float]) -> None:
    assert hull(*nu) == (0.0, 0.0, 0.0)


def damp_yawing(forces: HullForces, length: float, beta_deg: float) -> float:
    """-dN'/dr' at r' = 0 over 1/2 rho L^2 d U^2, but for the density and the draught."""
    beta, small = radians(beta_deg), 1e-6
    (_, _, up), (_, _, down) = (forces(cos(beta), -sin(beta), sign * small / length) for sign in (1.0, -1.0))
    return (down - up) / (2.0 * small)


@pytest.mark.parametrize("name", HULLS)
def test_yaw_damping_does_not_give_way_in_the_hand_over(name: str) -> None:
    """The polynomials damp yawing the more the ship drifts; handed over at 25 to 45 deg, no ship loses more than a
    tenth of the damping on the way. With the cross flow alone and C_N = 1 fine ships do, KCS among them."""
    ship, forces = HULLS[name]
    damping = [damp_yawing(forces, ship.L_pp, beta) for beta in range(15, 76)]
    largest = damping[0]
    for value in damping:
        assert value > 0.9 * largest
        largest = max(largest, value)


@pytest.mark.parametrize("name", HULLS)
def test_water_at_rest_gives_the_hull_no_energy(name: str) -> None:
    """X u + Y v + N r <= 0 in every direction of motion; and so is the rate of the kinetic energy, to which the
    equations of motion add (m_y - m_x) u v r, since the Munk moment is in N_v."""
    ship, forces = HULLS[name]
    munk = float(ship.M_A[1, 1] - ship.M_A[0, 0])
    unit = 0.5 * ship.rho * ship.L_pp * ship.T
    for beta in np.linspace(-pi, pi, 73):
        for yaw in np.linspace(-pi / 2, pi / 2, 37):
            u, v, r = cos(beta) * cos(yaw), -sin(beta) * cos(yaw), 2.0 * sin(yaw) / ship.L_pp
            X, Y, N = forces(u, v, r)
            work = X * u + Y * v + N * r
            assert work <= -0.005 * unit * abs(u) ** 3
            assert work + munk * u * v * r <= -0.005 * unit * abs(u) ** 3


@pytest.mark.parametrize("name", HULLS)
def test_no_jump_in_any_direction(name: str) -> None:
    """Round all directions of motion in steps of 0.1 deg: the forces change by less than 1/2 per radian."""
    ship, forces = HULLS[name]
    unit = 0.5 * ship.rho * ship.L_pp * ship.T * np.array([1.0, 1.0, ship.L_pp])
    step = radians(0.1)
    for r_prime in (0.0, 0.5, -2.0, 8.0):
        beta = np.arange(-pi, pi + step, step)
        values = np.array([forces(cos(b), -sin(b), r_prime / ship.L_pp) for b in beta]) / unit
        assert np.abs(np.diff(values, axis=0)).max() < 8.0 * step * (1.0 + r_prime**2)


@pytest.mark.parametrize("edge", [*BETA, -BETA[0], -BETA[1], pi])
def test_no_jump_over_drift(edge: float) -> None:
    below, above = np.array(at(5.0, edge - 1e-9, 0.2)), np.array(at(5.0, edge + 1e-9, 0.2))
    np.testing.assert_allclose(above / [FORCE, FORCE, MOMENT], below / [FORCE, FORCE, MOMENT], atol=1e-6)


@pytest.mark.parametrize("edge", GAMMA)
def test_no_jump_over_yaw(edge: float) -> None:
    below, above = np.array(at(5.0, 0.1, 2 * np.tan(edge - 1e-9))), np.array(at(5.0, 0.1, 2 * np.tan(edge + 1e-9)))
    np.testing.assert_allclose(above / [FORCE, FORCE, MOMENT], below / [FORCE, FORCE, MOMENT], atol=1e-6)


def test_sideways_is_cross_flow_drag() -> None:
    """C_D = 1 on the lateral area, against the motion, no turning moment."""
    sideways = hull(0.0, 2.0, 0.0)
    assert sideways == pytest.approx((0.0, -FORCE * 4.0, 0.0), abs=1e-6)


def test_spinning_on_the_spot_is_braked() -> None:
    """C_D = 1 over the length: N = -1/2 rho d int |x r| x r x dx = -1/2 rho L^2 d (r L)^2 / 32, times C_N: KVLCC2's
    yaw damping at 35 deg of drift, 0.049 + 0.294 sin^2, is that of the linear term and 1.105 times the cross flow's."""
    r, s = 0.02, sin(radians(35.0))
    C_N = (0.049 * (1.0 - cos(radians(35.0))) + 0.294 * s**2) / (s / 6.0)
    assert pytest.approx(1.105, abs=1e-3) == C_N
    spinning = hull(0.0, 0.0, r)
    assert spinning == pytest.approx((0.0, 0.0, -MOMENT * C_N * (r * L) ** 2 / 32.0), rel=1e-12, abs=1e-6)


def test_astern_is_braked_as_ahead() -> None:
    surge, sway, yaw = hull(-3.0, 0.0, 0.0)
    assert surge == pytest.approx(FORCE * 0.00785 * 9.0)
    assert sway == yaw == 0.0


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0))
def test_cross_flow_against_strips(v: float, s: float) -> None:
    xi = (np.arange(4000) + 0.5) / 2000.0 - 1.0
    w = v + s * xi
    drag, moment = integrate_cross_flow(v, s)
    assert drag == pytest.approx(np.mean(w * np.abs(w)), abs=1e-4)
    assert moment == pytest.approx(np.mean(0.5 * xi * w * np.abs(w)), abs=1e-4)


@given(st.floats(-5.0, 5.0))
def test_cross_flow_is_one_function_where_its_halves_meet(v: float) -> None:
    np.testing.assert_allclose(
        integrate_cross_flow(v, v * (1 + 1e-12)), integrate_cross_flow(v, v), rtol=1e-9, atol=1e-300
    )
