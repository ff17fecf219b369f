"""Pedersen and Zhang (1998), Marine Structures 11:429-449: closed-form energy of planar impacts.

    D_xi = W_nn    K_eta = W_tt    D_eta = K_xi = W_nt                     no roll
    mu*  = (eta_0 D_xi - (1+e) xi_0 D_eta) / ((1+e) xi_0 K_eta - eta_0 K_xi)        impulse ratio at stick
    E_xi  = (1 - e^2) xi_0^2 / (2 (D_xi + mu D_eta))         where it slides, mu with the sign of the slip
    E_eta = (eta_0^2 - eta_f^2) / (2 (K_xi/mu + K_eta))

The formulae are quoted from secondary sources. Their result table, two supply vessels over angles and places of impact,
is not at hand, so nothing of it is compared.
"""

from __future__ import annotations

from dataclasses import replace
from math import copysign, cos, radians, sin

import pytest

from tests.oracles.guan2014 import GuanImpact, GuanShip, solve_guan_impact

MASS, LENGTH = 4000e3, 82.5
VESSEL = GuanShip(
    M_x=1.05 * MASS, M_y=1.85 * MASS, J_z=1.21 * MASS * (0.25 * LENGTH) ** 2, J_x=float("inf"), x=0.0, y=0.0
)  # fmt: skip
"""Their supply vessel: 82.5 m, 4000 t, added mass 0.05, 0.85, 0.21."""


def struck(angle_deg: float, place: float, mu: float, e: float) -> GuanImpact:
    """A's stem, at 4.5 m/s, hits the side of B, also at 4.5 m/s, at `place` [m] ahead of B's centre; angle of headings.

    A's centre lies half a length behind the contact, B's off it along B's axis and half her breadth across.
    """
    beta = radians(angle_deg)  # from A's forward axis to B's, clockwise
    u_B, v_B = (cos(beta), -sin(beta)), (sin(beta), cos(beta))
    side = 9.4  # to port of B lies +v; A strikes her port side: n = -v
    A = replace(VESSEL, x=-0.5 * LENGTH, u=4.5)
    B = replace(VESSEL, x=-(place * u_B[0] + side * v_B[0]), y=-(place * u_B[1] + side * v_B[1]), u=4.5)
    alpha = beta + radians(180.0)  # n = (sin alpha, cos alpha) = -v_B
    if sin(alpha) < 0.0:
        B = replace(B, x=-(place * u_B[0] - side * v_B[0]), y=-(place * u_B[1] - side * v_B[1]))
        alpha = beta
    return solve_guan_impact(A, B, 0.0, 0.0, alpha, beta, mu, e)


GRID = [(angle, place) for angle in (30.0, 60.0, 90.0, 120.0, 150.0) for place in (-30.0, -15.0, 0.0, 15.0, 30.0)]


@pytest.mark.parametrize(("angle", "place"), GRID)
@pytest.mark.parametrize("e", [0.0, 0.3])
def test_ratio_and_energies(angle: float, place: float, e: float) -> None:
    for mu in (0.05, 0.3, 0.6):
        r = struck(angle, place, mu, e)
        assert r.xi_0 > 0.0
        D_xi, K_eta, D_eta = r.W_nn, r.W_tt, r.W_nt
        ratio = (r.eta_0 * D_xi - (1 + e) * r.xi_0 * D_eta) / ((1 + e) * r.xi_0 * K_eta - r.eta_0 * D_eta)
        assert r.stick_ratio == pytest.approx(ratio, rel=1e-12)
        assert r.stuck == (abs(ratio) <= mu)
        if not r.stuck:
            signed = copysign(mu, r.eta_0)
            E_xi = (1 - e**2) * r.xi_0**2 / (2.0 * (D_xi + signed * D_eta))
            E_eta = (r.eta_0**2 - r.eta_f**2) / (2.0 * (D_eta / signed + K_eta))
            assert r.E_xi == pytest.approx(E_xi, rel=1e-12)
            assert r.E_eta == pytest.approx(E_eta, rel=1e-10)


def test_grid_has_both_stick_and_slide() -> None:
    found = [struck(angle, place, 0.6, 0.0).stuck for angle, place in GRID]
    assert 3 <= sum(found) <= len(GRID) - 3


@pytest.mark.parametrize(("angle", "place"), GRID)
def test_plastic_stick_takes_the_energy_of_the_relative_motion(angle: float, place: float) -> None:
    r = struck(angle, place, 1e9, 0.0)
    assert r.stuck
    D = r.W_nn * r.W_tt - r.W_nt**2
    E = (r.W_tt * r.xi_0**2 - 2.0 * r.W_nt * r.xi_0 * r.eta_0 + r.W_nn * r.eta_0**2) / (2.0 * D)
    assert r.E_xi + r.E_eta == pytest.approx(E, rel=1e-12)
    assert (r.xi_f, r.eta_f) == pytest.approx((0.0, 0.0), abs=1e-12)
