"""Indicative damage against the figures of its formulae."""

from __future__ import annotations

from math import pi, radians

import pytest

from shipcollision_fmu.errors import InputError
from shipcollision_fmu.results.damage import (
    bow_crush,
    bow_force,
    crush_duration,
    estimate_damage,
    minorsky_volume,
    wedge_penetration,
    woisin_volume,
)


def test_minorskys_constants_are_his_own_in_si() -> None:
    """E = 414.5 R_T + 121 900 in long tons knots^2 and ft2 in."""
    unit = 1016.0469 * 0.514444**2  # of energy [J]
    assert 414.5 * unit / (0.3048**2 * 0.0254) / 1e6 == pytest.approx(47.2, abs=0.05)
    assert 121_900 * unit / 1e6 == pytest.approx(32.7, abs=0.1)


@pytest.mark.parametrize(("energy", "volume"), [(0.0, 0.0), (32.7e6, 0.0), (79.9e6, 1.0), (504.7e6, 10.0)])
def test_minorsky_volume(energy: float, volume: float) -> None:
    assert minorsky_volume(energy) == pytest.approx(volume, abs=1e-12)


def test_woisin_replaces_the_constant_by_the_shells() -> None:
    """Two shells of 10 m by 20 mm take 1/2 10 2^2 = 20 MJ each."""
    assert woisin_volume(87.2e6, [(10.0, 0.02), (10.0, 0.02)]) == pytest.approx(1.0)
    assert woisin_volume(39e6, [(10.0, 0.02), (10.0, 0.02)]) == 0.0
    assert woisin_volume(47.2e6, []) == pytest.approx(1.0)


@pytest.mark.parametrize(("energy", "force", "crush"), [(110e6, 134e6, 1.29), (1e9, 403e6, 3.9), (5e9, 613e6, 12.8)])
def test_bow_of_a_288_m_ship(energy: float, force: float, crush: float) -> None:
    assert bow_force(energy, 288.0) == pytest.approx(force, rel=3e-3)
    assert bow_crush(energy, 288.0) == pytest.approx(crush, rel=5e-3)


@pytest.mark.parametrize("length", [60.0, 150.0, 275.0, 350.0])
def test_branches_of_the_bow_force_meet(length: float) -> None:
    meet = 1425e6 * (length / 275.0) ** 2.6
    below, above = bow_force(meet * (1 - 1e-9), length), bow_force(meet * (1 + 1e-9), length)
    assert below == pytest.approx(above, rel=2.5e-3)


def test_bow_crush_is_the_energy_of_a_quarter_sine() -> None:
    """s = pi E/(2 P): a force that rises as a sine to P does the work 2/pi P s."""
    E, L = 200e6, 200.0
    assert 2.0 / pi * bow_force(E, L) * bow_crush(E, L) == pytest.approx(E, rel=1e-12)
    assert crush_duration(2.0, 5.0) == pytest.approx(0.668)
    assert bow_crush(0.0, L) == 0.0


def test_wedge_penetration_fills_its_volume() -> None:
    assert wedge_penetration(10.0, 0.1, radians(45.0)) == pytest.approx(10.0)
    assert wedge_penetration(0.0, 0.1, 0.5) == 0.0


def test_report_names_each_formula_and_says_that_it_is_indicative() -> None:
    damage = estimate_damage(110e6, 0.1, radians(30.0), bow_length=288.0, closing_speed=3.5, shells=[(8.0, 0.02)])
    assert damage["indicative"] is True
    assert set(damage) == {"indicative", "energy", "minorsky_1959", "woisin_1979", "pedersen_1993", "wedge"}
    methods = [value for value in damage.values() if isinstance(value, dict)]
    assert all(method["formula"] for method in methods)
    assert damage["minorsky_1959"]["destroyed_volume"] == pytest.approx((110 - 32.7) / 47.2)
    assert damage["pedersen_1993"]["duration"] == pytest.approx(1.67 * 1.29 / 3.5, rel=5e-3)
    assert damage["wedge"]["penetration"] == pytest.approx(5.33, abs=0.01)


def test_no_bow_no_crush_and_no_penetration() -> None:
    damage = estimate_damage(110e6, 0.1, 0.5, bow_length=None, closing_speed=None)
    assert set(damage) == {"indicative", "energy", "minorsky_1959"}


def test_unknown_closing_speed_leaves_the_duration_open() -> None:
    assert estimate_damage(1e8, 0.1, 0.5, bow_length=100.0, closing_speed=None)["pedersen_1993"]["duration"] is None


@pytest.mark.parametrize(
    ("t_eq", "half_angle", "message"),
    [(0.0, 0.5, "t_eq = 0 m must be > 0"), (0.1, 0.0, "half angle = 0 rad must be"), (0.1, 2.0, "half angle = 2 rad")],
)
def test_refusals(t_eq: float, half_angle: float, message: str) -> None:
    with pytest.raises(InputError, match=message):
        estimate_damage(1e8, t_eq, half_angle, bow_length=100.0, closing_speed=1.0)
