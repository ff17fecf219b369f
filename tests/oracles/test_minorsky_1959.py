"""Minorsky (1959): the central right-angled impact, whose energy his correlation of damage is built on.

    E = M_A M_B (V sin theta)^2 / (2 M_B + 1.43 M_A)     A strikes at the angle theta, B is struck; her m_y = 0.4

2/1.4 = 1.4286: it is the energy of a plastic impact along one line of M_A and 1.4 M_B.
"""

from __future__ import annotations

from math import pi
from pathlib import Path

import pytest

from tests.collision.conftest import World
from tests.oracles.guan2014 import GuanShip, solve_guan_impact
from tests.ship_files import ship_toml

CASES = [(1e7, 1e7, 5.0), (4e7, 1e7, 3.0), (2e6, 3e8, 8.0)]


def central(M_A: float, M_B: float, V: float, m_x: float, m_y: float, beta: float, mu: float) -> float:
    """Energy [J] that a plastic impact takes: A's stem hits B amidships, in line with both centres."""
    A = GuanShip(M_A * (1 + m_x), M_A * (1 + m_y), M_A * 1e3, M_A * 60.0, x=-80.0, y=0.0, u=V)
    B = GuanShip(M_B * (1 + m_x), M_B * (1 + m_y), M_B * 1e3, M_B * 60.0, x=15.0, y=0.0)
    r = solve_guan_impact(A, B, 0.0, 0.0, pi / 2, beta, mu, 0.0)
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
    A = GuanShip(M_A, M_A, M_A * 1e30, M_A * 1e30, x=0.0, y=0.0, u=V)
    B = GuanShip(M_B, 1.4 * M_B, M_B * 1e30, M_B * 1e30, x=0.0, y=0.0)
    r = solve_guan_impact(A, B, 0.0, 0.0, alpha, alpha, 0.0, 0.0)
    expected = M_A * M_B * (V * 0.75**0.5) ** 2 / (2.0 * M_B + 2.0 / 1.4 * M_A)
    assert r.E_xi == pytest.approx(expected, rel=1e-12)
    assert r.E_eta == 0.0


def _ship(name: str, mass: float) -> str:
    return ship_toml(
        ship={"name": name}, particulars={"L_pp": 200.0, "B": 30.0, "T": 10.0, "mass": mass},
        added_mass={"m_x": 0.0, "m_y": 0.4}, hull={"depth": 20.0},
    )  # fmt: skip


@pytest.mark.parametrize("response", ["pgs", "closed_form"])
@pytest.mark.parametrize(("M_A", "M_B", "V"), [(4e7, 2.5e7, 3.0), (2.5e7, 5e7, 5.0)])
@pytest.mark.parametrize("drift", [0.0, 1.0])
def test_the_collision_model_loses_minorskys_energy(
    tmp_path: Path, response: str, M_A: float, M_B: float, V: float, drift: float
) -> None:
    """Hulls that meet: A's flat stem on B's side, in line with both centres and without friction, so that a drift of B
    along her own side, which makes the course oblique, changes nothing."""
    paths = []
    for name, mass in (("striking", M_A), ("struck", M_B)):
        paths.append(tmp_path / f"{name}.toml")
        paths[-1].write_text(_ship(name, mass), encoding="utf-8")
    # The stem is a metre before the side when the ships are in line.
    start = [
        {"position": (0.0, -116.0, 0.0), "attitude": (0, 0, pi / 2), "nu": (V, 0, 0, 0, 0, 0)},
        {"position": (-drift / V, 0.0, 0.0), "nu": (drift, 0, 0, 0, 0, 0)},
    ]
    w = World([str(p) for p in paths], start, degrees_of_freedom=3, response=response, friction=0.0, restitution=0.0)
    try:
        w.run(1.0, 0.05)
        E = M_A * M_B * V**2 / (2.0 * M_B + 2.0 / 1.4 * M_A)
        assert w.model.outputs.energy.dissipated == pytest.approx(E, rel=1e-9 if drift == 0.0 else 1e-3)
        assert w.model.outputs.collision_count == 1
    finally:
        w.model.close()
