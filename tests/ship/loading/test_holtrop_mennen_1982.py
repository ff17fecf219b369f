"""Resistance against the worked example of Holtrop and Mennen (1982), and powers of ships in service."""

from __future__ import annotations

from math import sqrt
from typing import Any

import pytest

from shipcollision_fmu.ship.hydrostatics import GRAVITY
from shipcollision_fmu.ship.loading.holtrop_mennen import (
    HullForm,
    compute_form_factor,
    compute_resistance,
    compute_wave_resistance,
    compute_wetted_surface,
)
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship import Ship

KNOT = 1852.0 / 3600.0
EXAMPLE = HullForm(L=205.0, B=32.0, T=10.0, volume=37_500.0, C_M=0.98, C_W=0.75, lcb=-2.02, A_BT=20.0, h_B=4.0)
"""The hypothetical single-screw ship of the paper, 25 kn; it also has a transom of 16 m2 and a stern of type 10."""


def test_wetted_surface_of_the_example() -> None:
    assert compute_wetted_surface(EXAMPLE) == pytest.approx(7381.45, rel=1e-4)


def test_form_factor_of_the_example() -> None:
    """1.156 by their earlier formula, a stern factor of 1.03 included; the later one's stern factor is 1.11."""
    assert 0.93 + 1.11 * (compute_form_factor(EXAMPLE) - 0.93) == pytest.approx(1.156, rel=0.03)


def test_wave_resistance_of_the_example() -> None:
    """557.11 kN, of which the transom makes 1 - 0.8 16/(320 0.98) = 0.9592; the hump's formula is the later one."""
    own = compute_wave_resistance(EXAMPLE, 25.0 * KNOT) * 1025.0 * GRAVITY * 37_500.0
    assert 0.9592 * own == pytest.approx(557.11e3, rel=0.03)


def test_total_of_the_example() -> None:
    """1 793.26 kN, of which appendages 8.83 kN and the bulb 0.05 kN; a tenth of the friction is the stern's."""
    assert compute_resistance(EXAMPLE, 25.0 * KNOT, 1025.0) == pytest.approx(1784e3, rel=0.04)


def made(kind: str, L: float, B: float, T: float, C_b: float, **tables: Any) -> Ship:
    return load_ship({
        "ship": {"name": kind, "kind": kind, "source": "main dimensions"},
        "particulars": {"L_pp": L, "B": B, "T": T, "mass": 1025.0 * C_b * L * B * T},
        "hull": {"shape": "box", "depth": 1.5 * T}, "manoeuvring": {"estimate": True}, **tables,
    })  # fmt: skip


@pytest.mark.parametrize(
    ("ship", "speed", "least", "most"),
    [
        # L, B, T, C_b; service speed [kn]; installed power of such ships in service [MW], a quarter either way
        (("tanker", 320.0, 58.0, 20.8, 0.81), 15.5, 25.0, 29.0),
        (("tanker", 174.0, 32.2, 11.0, 0.79), 15.0, 8.5, 9.5),
        (("bulk carrier", 279.0, 45.0, 18.0, 0.84), 14.5, 17.0, 18.6),
        (("bulk carrier", 217.0, 32.2, 14.0, 0.86), 14.5, 9.5, 10.0),
        (("container ship", 376.0, 56.4, 15.0, 0.63), 24.5, 75.0, 80.9),
        (("cruise ship", 330.0, 47.0, 9.1, 0.72), 22.0, 60.0, 60.0),
        (("car carrier", 190.0, 32.2, 9.0, 0.58), 19.5, 13.0, 15.0),
        (("general cargo", 84.0, 13.0, 5.5, 0.75), 13.0, 1.8, 2.2),
        (("offshore supply vessel", 80.0, 18.0, 6.5, 0.72), 14.0, 4.0, 5.5),
        (("tug", 29.0, 11.0, 4.8, 0.55), 12.5, 3.0, 4.5),
        (("trawler", 28.0, 8.0, 3.5, 0.55), 11.0, 0.6, 1.0),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)  # fmt: skip
def test_power_is_that_of_ships_in_service(
    ship: tuple[str, float, float, float, float], speed: float, least: float, most: float
) -> None:
    """Typical installed powers: MAN, Propulsion trends in tankers, bulk carriers and container vessels, and ships'
    data sheets, known from secondary sources."""
    loaded = made(*ship)
    assert loaded.propeller is not None
    assert loaded.engine is not None
    assert loaded.engine.power is not None
    assert loaded.propeller.service_speed == pytest.approx(speed * KNOT, rel=0.1)
    assert 0.75 * least < loaded.engine.power / 1e6 < 1.25 * most


@pytest.mark.parametrize(
    ("ship", "speed", "least"),
    [(("ferry", 180.0, 27.5, 6.5, 0.58), 25.0, 22e6), (("destroyer", 142.0, 19.0, 6.2, 0.505), 31.0, 0.6 * 70e6)],
    ids=["ferry", "destroyer"],
)
def test_ships_whose_power_is_missed_are_too_slow_and_not_short_of_a_propeller(
    ship: tuple[str, float, float, float, float], speed: float, least: float
) -> None:
    """At the speed of such ships the power comes near theirs; with the disc of two propellers it falls."""
    slow, fast = made(*ship), made(*ship, propeller={"service_speed": speed * KNOT})
    assert slow.propeller is not None
    two = made(*ship, propeller={"D_p": slow.propeller.D_p * sqrt(2.0)})
    powers = [of.engine.power or 0.0 for of in (two, slow, fast) if of.engine is not None]
    assert 0.0 < powers[0] < powers[1] < least < powers[2]


@pytest.mark.parametrize("L", [10.0, 30.0, 100.0, 400.0])
@pytest.mark.parametrize(("LB", "BT", "C_b"), [(2.5, 2.0, 0.85), (3.0, 5.0, 0.45), (6.0, 3.0, 0.7), (9.0, 2.2, 0.42)])
def test_it_does_not_run_away(L: float, LB: float, BT: float, C_b: float) -> None:
    """At service speed, between the friction of a plank and a tenth of the weight, for tubs and needles as well."""
    ship = made("general cargo", L, L / LB, L / LB / BT, C_b)
    assert ship.propeller is not None
    assert ship.propeller.service_speed is not None
    assert ship.manoeuvring is not None
    U = ship.propeller.service_speed
    R = 0.5 * ship.rho * L * ship.T * U**2 * ship.manoeuvring.R_0
    assert 0.05 < U / sqrt(GRAVITY * L) < 0.45
    assert 0.0014 * ship.rho * U**2 / 2 * L * (ship.B + 2 * ship.T) * 0.7 < R < 0.1 * ship.mass * GRAVITY
