"""Minorsky (1959): the central right-angled impact, whose energy his correlation of damage is built on.

    E = M_A M_B (V sin theta)^2 / (2 M_B + 1.43 M_A)     A strikes at the angle theta, B is struck; her m_y = 0.4

2/1.4 = 1.4286: it is the energy of a plastic impact along one line of M_A and 1.4 M_B.
"""

from __future__ import annotations

from math import pi

import pytest

from shipcollision_fmu.collision.four_dof import FourDofShip, four_dof_impact

CASES = [(1e7, 1e7, 5.0), (4e7, 1e7, 3.0), (2e6, 3e8, 8.0)]


def central(M_A: float, M_B: float, V: float, m_x: float, m_y: float, beta: float, mu: float) -> float:
    """Energy [J] that a plastic impact takes: A's stem hits B amidships, in line with both centres."""
    A = FourDofShip(M_A * (1 + m_x), M_A * (1 + m_y), M_A * 1e3, M_A * 60.0, x=-80.0, y=0.0, u=V)
    B = FourDofShip(M_B * (1 + m_x), M_B * (1 + m_y), M_B * 1e3, M_B * 60.0, x=15.0, y=0.0)
    r = four_dof_impact(A, B, 0.0, 0.0, pi / 2, beta, mu, 0.0)
    return r.E_xi + r.E_eta


@pytest.mark.parametrize(("M_A", "M_B", "V"), CASES)
def test_energy_of_the_right_angled_central_impact(M_A: float, M_B: float, V: float) -> None:
    E = M_A * M_B * V**2 / (2.0 * M_B + 2.0 / 1.4 * M_A)
    assert central(M_A, M_B, V, 0.0, 0.4, pi / 2, 0.3) == pytest.approx(E, rel=1e-12)
    minorskys = M_A * M_B * V**2 / (2.0 * M_B + 1.43 * M_A)
    assert minorskys == pytest.approx(E, rel=1e-3)
    end_on = 0.5 * M_A * M_B / (M_A + M_B) * V**2  # B's surge, which has none
    assert central(M_A, M_B, V, 0.0, 0.4, pi, 0.3) == pytest.approx(end_on, rel=1e-12)


@pytest.mark.parametrize(("M_A", "M_B", "V"), CASES)
def test_without_friction_only_the_speed_across_counts(M_A: float, M_B: float, V: float) -> None:
    """A moves at 60 deg to B's side: (V sin theta)^2. The normal is across B, alpha turns it away from A's bow."""
    theta = pi / 3
    alpha = theta  # from A's forward axis to B's side
    A = FourDofShip(M_A, M_A, M_A * 1e30, M_A * 1e30, x=0.0, y=0.0, u=V)
    B = FourDofShip(M_B, 1.4 * M_B, M_B * 1e30, M_B * 1e30, x=0.0, y=0.0)
    r = four_dof_impact(A, B, 0.0, 0.0, alpha, alpha, 0.0, 0.0)
    expected = M_A * M_B * (V * 0.75**0.5) ** 2 / (2.0 * M_B + 2.0 / 1.4 * M_A)
    assert r.E_xi == pytest.approx(expected, rel=1e-12)
    assert r.E_eta == 0.0
