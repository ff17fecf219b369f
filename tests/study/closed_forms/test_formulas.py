"""The closed forms against cases by hand, and against solutions of the same problem that share no line with them."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, radians, sin

import numpy as np
import pytest

from shipcollision_fmu import load_ship
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.study.closed_forms.minorsky import minorsky_energy
from shipcollision_fmu.study.closed_forms.pedersen_zhang import pedersen_zhang, pedersen_zhang_ships
from shipcollision_fmu.study.closed_forms.planar_impact import PlanarImpacts, PlanarShips
from shipcollision_fmu.study.closed_forms.popov import popov_energy, popov_ships
from tests.oracles.guan2014 import GuanShip, solve_guan_impact
from tests.oracles.test_popov_1967 import BOWS

SUPPLY = pedersen_zhang_ships(np.array([82.5]), np.array([4e6]))
"""The supply vessel of Pedersen and Zhang's examples: 82.5 m, 18.8 m, 4000 t."""


def fixed(*of: float) -> Array:
    return np.array([of])


def make(
    angle_deg: float, own_point: Array, target_point: Array, own_speed: float, target_speed: float, normal: Array,
    friction: float, own: PlanarShips = SUPPLY, target: PlanarShips = SUPPLY,
) -> PlanarImpacts:  # fmt: skip
    """One impact of ships that run straight ahead."""
    return PlanarImpacts(
        own, target, np.array([radians(angle_deg)]), own_point, target_point, fixed(own_speed, 0.0, 0.0),
        fixed(target_speed, 0.0, 0.0), normal, np.array([friction]),
    )  # fmt: skip


def at_the_side(angle_deg: float, own_speed: float, target_speed: float, friction: float) -> PlanarImpacts:
    """The stem of one supply vessel amidships on the port side of the other."""
    return make(
        angle_deg, fixed(41.25, 0.0), fixed(0.0, -9.4), own_speed, target_speed, fixed(0.0, 1.0), friction
    )  # fmt: skip


def light(mass: float) -> PlanarShips:
    """A point without added mass."""
    return PlanarShips(np.array([mass]), np.array([mass]), np.array([np.inf]), np.zeros(1))


def test_minorsky_by_hand() -> None:
    """10 000 t on 10 000 t at 5 m/s: 10^14 25/(3.43 10^7) J; at 30 degrees a quarter; a heavy ship drops out."""
    mass, speed = np.array([1e7]), np.array([5.0])
    assert minorsky_energy(mass, mass, speed, np.array([pi / 2])) == pytest.approx(72.8863e6, rel=1e-6)
    assert minorsky_energy(mass, mass, speed, np.array([pi / 6])) == pytest.approx(18.2216e6, rel=1e-5)
    heavy, across = np.array([1e15]), np.array([pi / 2])
    assert minorsky_energy(mass, heavy, speed, across) == pytest.approx(125e6, rel=1e-6)  # 1/2 M V^2
    assert minorsky_energy(heavy, mass, speed, across) == pytest.approx(174.825e6, rel=1e-5)  # 1/2 1.4 M V^2


def test_a_central_blow_sticks_and_takes_the_energy_along_one_line() -> None:
    """Right-angled, the struck ship at rest: 1/2 V^2 / (1/(1.05 M) + 1/(1.85 M)) = 27.13 MJ, whatever the friction."""
    for friction in (0.1, 0.6):
        answer = pedersen_zhang(at_the_side(90.0, 4.5, 0.0, friction))
        assert answer.sticks.all()
        assert answer.energy == pytest.approx(27.128e6, rel=1e-4)
        assert answer.ratio == pytest.approx(0.0, abs=1e-12)


def test_head_on_ships_end_together() -> None:
    """Stem on stem at 4.5 m/s each: half of 1.05 M at 9 m/s, 1/2 2100 t (9 m/s)^2 = 85.05 MJ; without yaw or sway."""
    of = make(180.0, fixed(41.25, 0.0), fixed(41.25, 0.0), 4.5, 4.5, fixed(-1.0, 0.0), 0.3)
    assert pedersen_zhang(of).energy == pytest.approx(85.05e6, rel=1e-9)
    assert popov_energy(replace(of, own=light(4e6), target=light(4e6))) == pytest.approx(81e6, rel=1e-9)


@pytest.mark.parametrize("friction", [0.1, 0.4, 1.0])
def test_the_boundary_of_stick_and_slide(friction: float) -> None:
    """Points of the mass m: W is 2/m in all directions, so that they stick while eta_0 <= mu xi_0.

    Stuck, they lose 1/2 (m/2) v^2; sliding, with P_n = m xi_0/2, m xi_0^2/4 and mu P_n (eta_0 - mu xi_0/2).
    """
    m, xi = 2e6, 3.0
    for over, sticks in ((1.0 - 1e-9, True), (1.0 + 1e-9, False), (3.0, False)):
        eta = friction * xi * over
        of = replace(
            make(90.0, fixed(0.0, 0.0), fixed(0.0, 0.0), xi, -eta, fixed(0.0, 1.0), friction), own=light(m),
            target=light(m),
        )  # fmt: skip
        answer = pedersen_zhang(of)
        expected = 0.25 * m * (xi**2 + eta**2)
        if not sticks:
            expected = 0.25 * m * xi**2 + friction * 0.5 * m * xi * (eta - 0.5 * friction * xi)
        assert answer.sticks == [sticks]
        assert np.abs(answer.ratio) == pytest.approx(eta / xi, rel=1e-12)
        assert answer.energy == pytest.approx(expected, rel=1e-12)
        assert not answer.turns_back


def test_ships_that_part_have_no_energy() -> None:
    parting = at_the_side(90.0, -1.0, 0.0, 0.3)
    assert np.isnan(pedersen_zhang(parting).energy).all()
    assert np.isnan(popov_energy(parting)).all()


def test_friction_that_would_press_the_hulls_on_sticks() -> None:
    """A rod of 1 kg and of the radius of gyration 10 m strikes a wall with its point (20, 40) m: D_xi = 1 + 2^2 = 5,
    K_eta = 1 + 4^2 = 17, |D_eta| = 2 x 4 = 8; mu = 3.

    Scraping one way, 5 - 3 x 8 < 0: it sticks and loses 1/2 v' W^-1 v, however fast. The other way it slides with
    I_xi = xi_0/(5 + 3 x 8), although an impulse that pulls would stop it: mu* = (5 eta_0 - 8)/(17 - 8 eta_0) = -0.63.
    """
    rod = PlanarShips(np.array([1.0]), np.array([1.0]), np.array([100.0]), np.zeros(1))
    of = make(0.0, fixed(20.0, 40.0), fixed(0.0, 0.0), 0.0, 0.0, fixed(0.0, 1.0), 3.0, rod, light(np.inf))
    fast, slow = (replace(of, own_motion=fixed(way, 1.0, 0.0)) for way in (50.0, -50.0))
    if pedersen_zhang(fast).sticks[0]:
        fast, slow = slow, fast
    I_xi = 1.0 / 29.0
    eta_f = 50.0 - 8.0 * I_xi - 17.0 * 3.0 * I_xi
    slides, sticks = pedersen_zhang(fast), pedersen_zhang(slow)
    assert (slides.sticks[0], sticks.sticks[0]) == (False, True)
    assert slides.ratio[0] == pytest.approx(-242.0 / 383.0 * np.sign(fast.slip[0]))
    assert slides.energy[0] == pytest.approx(0.5 * I_xi + 0.5 * 3.0 * I_xi * (50.0 + eta_f), rel=1e-12)
    W_inverse = np.array([[17.0, 8.0], [8.0, 5.0]]) / (5.0 * 17.0 - 64.0)  # slip and D_eta have opposite signs
    assert sticks.energy[0] == pytest.approx(0.5 * np.array([1.0, 50.0]) @ W_inverse @ np.array([1.0, 50.0]), rel=1e-12)


GRID = [
    (angle, place, friction)
    for angle in (20.0, 60.0, 90.0, 130.0, 160.0)
    for place in (-0.4, 0.0, 0.3)
    for friction in (0.05, 0.3, 0.8)
]  # fmt: skip


def test_it_is_the_impact_of_the_oracle() -> None:
    """Of all angles, places and frictions, with yaw rates and sway, and a normal that leans: energy, ratio and kind.

    The oracle has other axes (y to port, rates about an upward axis) and scalar formulas.
    """
    kinds = set()
    for number, (angle, place, friction) in enumerate(GRID):
        rng = np.random.default_rng(number)
        lean, (u, v, r, U, V, R) = rng.uniform(-0.3, 0.3), rng.normal(0.0, [2, 0.3, 0.01, 2, 0.3, 0.01])
        own_point = np.array([41.25, rng.uniform(-5.0, 5.0)])
        target_point, normal = np.array([place * 82.5, -9.4]), np.array([sin(lean), cos(lean)])
        motions = np.array([u + 6.0, v, r]), np.array([U, V, R])
        of = PlanarImpacts(
            SUPPLY, SUPPLY, np.array([radians(angle)]), own_point[None], target_point[None], motions[0][None],
            motions[1][None], normal[None], np.array([friction]),
        )  # fmt: skip
        beta = -radians(angle)  # from own's forward axis to the target's, clockwise
        forward, port = np.array([cos(beta), -sin(beta)]), np.array([sin(beta), cos(beta)])
        n = normal[0] * forward - normal[1] * port
        body = GuanShip(SUPPLY.M_x[0], SUPPLY.M_y[0], SUPPLY.J_z[0], np.inf, x=0.0, y=0.0)
        A = replace(body, x=-own_point[0], y=own_point[1], u=u + 6.0, v=-v, r=-r)
        B_at = -(target_point[0] * forward - target_point[1] * port)
        B = replace(body, x=B_at[0], y=B_at[1], u=U, v=-V, r=-R)
        expected = solve_guan_impact(A, B, 0.0, 0.0, float(np.arctan2(n[0], n[1])), beta, friction, 0.0)
        if expected.xi_0 <= 0.0:
            continue
        answer = pedersen_zhang(of)
        kinds.add((bool(answer.sticks[0]), bool(answer.turns_back[0])))
        assert of.closing == pytest.approx(expected.xi_0, rel=1e-12)
        assert answer.energy == pytest.approx(expected.E_xi + expected.E_eta, rel=1e-10)
        assert np.abs(answer.ratio) == pytest.approx(abs(expected.stick_ratio), rel=1e-9)
        assert answer.sticks == [expected.stuck]
        assert answer.turns_back == [not expected.stuck and expected.eta_0 * expected.eta_f < 0.0]
    assert kinds == {(True, False), (False, False), (False, True)}


@pytest.mark.parametrize("name", BOWS)
def test_popov_is_the_mass_reduction_in_plan(name: str) -> None:
    """A ship whose bow meets a heavy floe: C_o of the oracle with a level normal, and 1/2 M_e (V l)^2."""
    bow = BOWS[name]
    ships = popov_ships(*(np.array([of]) for of in (bow.L, bow.B, bow.T, bow.mass)))
    normal, point = np.array([sin(bow.a), cos(bow.a), 0.0]), np.array([*bow.point[:2], 0.0])
    of = make(0.0, point[None, :2], fixed(0.0, 0.0), bow.V, 0.0, normal[None, :2], 0.0, ships, light(np.inf))
    assert bow.mass * of.mobility(of.normal, of.normal) == pytest.approx(bow.C_o(normal, point), rel=1e-12)
    assert popov_energy(of) == pytest.approx(bow.energy(normal, point), rel=1e-12)


@pytest.mark.parametrize("name", ["kvlcc2", "kcs"])
def test_a_ship_with_its_own_inertia_is_that_of_the_model(name: str) -> None:
    """w(d, d') is that of the 3 x 3 inverse, with the coupling of sway and yaw."""
    ship = load_ship(name)
    inverse, point = free_inverse(ship.M, 3), (0.4 * ship.L_pp, -5.0)
    unit = [np.array([c, s]) for c, s in ((1.0, 0.0), (0.6, 0.8), (0.0, -1.0))]
    of = PlanarShips.of([ship])
    arm = np.array([[point[0] - of.x[0], point[1]]])
    for d in unit:
        for other in unit:
            wrench, twist = (np.array([*e, 0, 0, 0, point[0] * e[1] - point[1] * e[0]]) for e in (d, other))
            assert of.mobility(arm, d[None], other[None]) == pytest.approx(wrench @ inverse @ twist, rel=1e-9)
