"""Rudders by type, against the rule they come from and rudders of ships that were built or tested."""

from __future__ import annotations

import pytest

from shipcollision_fmu.ship.loading.motora_charts import Dimensions
from shipcollision_fmu.ship.loading.rudder_estimate import AREA, estimate_rudder
from shipcollision_fmu.ship.ship_type import SHIP_TYPES


def share(d: Dimensions, ship_type: str) -> float:
    return estimate_rudder(d, ship_type, 0.3)["A_R"] / (d.L * d.T)


@pytest.mark.parametrize(
    ("ship_type", "L", "B", "T", "area"),
    [
        ("tanker, loaded", 320.0, 58.0, 20.8, 112.5),  # KVLCC2, movable
        ("tanker, loaded", 325.0, 53.0, 21.73, 119.8),  # Esso Osaka
        ("container ship, loaded", 230.0, 32.2, 10.8, 45.28),  # KCS, movable
        ("container ship, loaded", 175.0, 25.4, 8.5, 33.04),  # S-175
    ],
)
def test_areas_of_known_ships(ship_type: str, L: float, B: float, T: float, area: float) -> None:
    """Within a quarter; DNV's least area alone is a third too small for S-175."""
    assert estimate_rudder(Dimensions(L, B, T, 0.7, 0.0, 1025.0), ship_type, 0.3)["A_R"] == pytest.approx(
        area, rel=0.25
    )


@pytest.mark.parametrize("ship_type", SHIP_TYPES)
def test_never_below_the_classification_rule(ship_type: str) -> None:
    """Det Norske Veritas: L T/100 (1 + 25 (B/L)^2); and every type has an area of its own."""
    assert ship_type in AREA
    for L, B, T in ((12.0, 4.0, 1.5), (90.0, 16.0, 6.0), (250.0, 44.0, 15.0)):
        assert share(Dimensions(L, B, T, 0.6, 0.0, 1025.0), ship_type) >= 0.01 * (1.0 + 25.0 * (B / L) ** 2) - 1e-12


def test_small_ships_have_larger_and_quicker_rudders() -> None:
    """Coasters 2.8 % of L T for a large ship's 1.75 %; SOLAS' 65 deg in 28 s, and at 15 m twice that."""
    small, large = Dimensions(15.0, 2.5, 1.0, 0.6, 0.0, 1025.0), Dimensions(150.0, 25.0, 10.0, 0.6, 0.0, 1025.0)
    assert share(small, "cargo vessel, loaded") == pytest.approx(0.028)
    assert share(large, "cargo vessel, loaded") == pytest.approx(0.0175)
    assert estimate_rudder(large, "ferry", 0.3)["rate_deg_per_s"] == pytest.approx(65.0 / 28.0)
    assert estimate_rudder(small, "ferry", 0.3)["rate_deg_per_s"] == pytest.approx(2.0 * 65.0 / 28.0)


def test_lift_slope_is_fujiis() -> None:
    """6.13 Lam/(Lam + 2.25) at Lam = 1.8: 2.724."""
    made = estimate_rudder(Dimensions(250.0, 32.0, 11.0, 0.6, 0.0, 1025.0), "container ship, loaded", 0.3)
    assert made["H_R"] ** 2 / made["A_R"] == pytest.approx(1.8)
    assert made["f_alpha"] == pytest.approx(2.7244, abs=1e-4)
    assert made["H_R"] < 0.9 * 11.0
