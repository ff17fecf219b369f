"""GM and roll period of ships from main dimensions: the Intact Stability Code 2008 and typical working values."""

from __future__ import annotations

from math import pi, sqrt
from typing import Any

import pytest

from shipcollision_fmu.ship.hydrostatics import GRAVITY
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.roll_period import compute_is_code_period, compute_natural_period
from shipcollision_fmu.ship.seakeeping import compute_seakeeping
from shipcollision_fmu.ship.ship import Ship
from shipcollision_fmu.ship.ship_type import SHIP_TYPES, find_ship_type


def made(kind: str, L: float, B: float, T: float, C_b: float, depth: float, **particulars: Any) -> Ship:
    """A ship from four numbers and its depth."""
    return load_ship({
        "ship": {"name": kind, "kind": kind, "source": "main dimensions"},
        "particulars": {"L_pp": L, "B": B, "T": T, "mass": 1025.0 * C_b * L * B * T, **particulars},
        "hull": {"shape": "box", "depth": depth},
    })  # fmt: skip


CRUISE = ("cruise ship", 290.0, 36.0, 8.2, 0.68, 11.0)
FISHING = ("fishing vessel", 24.0, 7.0, 3.0, 0.58, 3.8)


@pytest.mark.parametrize(
    ("ship", "least", "most"),
    [
        # Barrass & Derrett, Ship Stability for Masters and Mates: typical working values, fully loaded
        (("VLCC", 320.0, 58.0, 20.8, 0.81, 30.0), 2.0, 5.0),
        (("bulk carrier", 217.0, 32.2, 14.0, 0.84, 19.5), 2.0, 3.0),
        (("container ship", 230.0, 32.2, 11.0, 0.65, 19.0), 1.5, 2.5),
        (("ro-ro ship", 190.0, 28.0, 7.0, 0.58, 14.0), 1.2, 1.8),
        (("general cargo ship", 100.0, 16.0, 6.2, 0.72, 8.4), 0.3, 0.5),
        # 4 to 8 % of the breadth, as guides for officers recommend; never below the Code's 0.35 m
        (CRUISE, 0.04 * 36.0, 0.08 * 36.0),
        (FISHING, 0.35, 0.80),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)
def test_GM_is_the_typical_working_value(
    ship: tuple[str, float, float, float, float, float], least: float, most: float
) -> None:
    """CG at the waterline made it 8.6 m for the cruise ship and -0.009 m for the fishing vessel."""
    assert least <= compute_seakeeping(made(*ship)).GM_T <= most


@pytest.mark.parametrize(
    "ship", [CRUISE, FISHING, ("VLCC", 320.0, 58.0, 20.8, 0.81, 30.0), ("tug", 30.0, 11.0, 4.5, 0.6, 5.5)]
)
def test_the_ship_rolls_with_the_period_of_the_code(ship: tuple[str, float, float, float, float, float]) -> None:
    """Part A, 2.3.4, written out again: T = 2 C B/sqrt(GM); free in sway, as the model rolls. A sixth is allowed where
    the Code's coefficient asks for a k_xx that no ship has."""
    loaded = made(*ship)
    _, L, B, T, _, _ = ship
    GM = compute_seakeeping(loaded).GM_T
    code = 2.0 * (0.373 + 0.023 * (B / T) - 0.043 * (L / 100.0)) * B / sqrt(GM)
    assert compute_is_code_period(L, B, T, GM) == pytest.approx(code, rel=1e-14)
    assert compute_natural_period(loaded.M, loaded.mass, GM) == pytest.approx(code, rel=1.0 / 6.0)
    assert 0.28 - 1e-9 <= sqrt(loaded.M_RB[3, 3] / loaded.mass - loaded.r_bg[2] ** 2) / B <= 0.45 + 1e-9


def test_the_natural_period_is_that_of_the_coupled_equations() -> None:
    """Sway and roll without damping: the eigenvalue of M^-1 K that is not zero."""
    ship = load_ship("kvlcc2")
    GM = compute_seakeeping(ship).GM_T
    (a, b), (_, d) = ship.M[1, [1, 3]], ship.M[3, [1, 3]]
    w_2 = a * ship.mass * GRAVITY * GM / (a * d - b * b)
    assert compute_natural_period(ship.M, ship.mass, GM) == pytest.approx(2.0 * pi / sqrt(w_2), rel=1e-12)


def test_what_the_file_gives_is_kept() -> None:
    given = made(*CRUISE, GM_T=1.9, k_xx=14.0)
    assert compute_seakeeping(given).GM_T == 1.9
    assert given.M_RB[3, 3] == pytest.approx(given.mass * (14.0**2 + given.r_bg[2] ** 2))
    placed = made(*CRUISE, r_bg=[0.0, 0.0, -6.0])
    assert placed.r_bg.tolist() == [0.0, 0.0, -6.0]
    assert not any(note.startswith("KG = ") for note in placed.estimated)


def test_the_estimate_is_told() -> None:
    notes = made(*CRUISE).estimated
    assert any(note.startswith("KG = ") and "GM = 0.06 B of a passenger liner" in note for note in notes)
    assert any(note.startswith("k_xx = ") and "Intact Stability Code" in note for note in notes)


def test_a_shallow_barge_is_stiff() -> None:
    """A deck barge's KM is above its deck: KG is the deck's height, and GM what is left."""
    barge = made("barge", 100.0, 30.0, 3.0, 0.88, 6.0)
    assert barge.T - barge.r_bg[2] == pytest.approx(6.0)
    assert compute_seakeeping(barge).GM_T > 10.0


def test_without_hydrostatics_CG_is_at_the_waterline() -> None:
    odd = made("box", 100.0, 20.0, 5.0, 0.98, 8.0, allow_inconsistent="a box")
    assert odd.r_bg.tolist() == [0.0, 0.0, 0.0]
    assert {"r_bg = (0, 0, 0)", "k_xx = 0.37 B"} <= set(odd.estimated)


@pytest.mark.parametrize(
    ("kind", "name"),
    [("tanker (VLCC)", "tanker, loaded"), ("RoPax ferry", "ferry"), ("general cargo", "cargo vessel, loaded"),
     ("Container ship", "container ship, loaded"), ("harbour tug", "tug"), ("stern trawler", "fishing vessel"),
     ("cargo vessel, container on deck", "cargo vessel, container on deck"), ("anything", "cargo vessel, loaded"),
     ("Pleasure craft", "speed boat"),
     ("High speed craft", "speed boat"), ("Offshore vessel", "offshore supply vessel")],
)  # fmt: skip
def test_the_type_is_found_in_the_kind(kind: str, name: str) -> None:
    assert find_ship_type(kind) == SHIP_TYPES[name]
