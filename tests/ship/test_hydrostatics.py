"""Hydrostatics and seakeeping constants against KVLCC2's known figures and the geometry of a box."""

from __future__ import annotations

from math import pi, sqrt
from pathlib import Path

import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.hydrostatics import compute_hydrostatics
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.seakeeping import compute_seakeeping


def test_kvlcc2() -> None:
    """KG = 18.6 m; 163 MN/m in heave."""
    water = compute_hydrostatics(320.0, 58.0, 20.8, 0.81, 20.8 - 18.6)
    assert pytest.approx(5.2, abs=0.05) == water.GM_T
    assert pytest.approx(379.0, abs=1.0) == water.GM_L
    assert 1025.0 * 9.81 * water.A_wp == pytest.approx(163e6, rel=0.005)
    assert water.volume == pytest.approx(312_600, rel=0.001)


def test_a_box_is_exact() -> None:
    """C_b = 1: KB = T/2, BM = B^2/(12 T)."""
    L, B, T = 100.0, 20.0, 5.0
    water = compute_hydrostatics(L, B, T, 1.0, 0.0)
    assert water.A_wp == L * B
    assert pytest.approx(B**2 / 12 / T) == water.BM_T
    assert pytest.approx(L**2 / 12 / T) == water.BM_L
    assert pytest.approx(T / 2 + B**2 / 12 / T - T) == water.GM_T


def test_a_GM_that_is_known_is_kept() -> None:
    water = compute_hydrostatics(100.0, 20.0, 5.0, 0.8, 0.0, GM_T=1.5, GM_L=120.0)
    assert (water.GM_T, water.GM_L) == (1.5, 120.0)


@pytest.mark.parametrize(("i", "period"), [(2, 12.6), (3, 21.2), (4, 12.0)], ids=["heave", "roll", "pitch"])
def test_natural_periods_of_kvlcc2(i: int, period: float) -> None:
    """2 pi sqrt(M_ii/K_ii) [s]; roll with the sway added mass at its depth."""
    ship = load_ship("kvlcc2")
    sea = compute_seakeeping(ship)
    K = {2: sea.K_33, 3: sea.K_44, 4: sea.K_55}[i]
    assert 2 * pi * sqrt(ship.M[i, i] / K) == pytest.approx(period, abs=0.06)


def written(folder: Path, changes: str) -> str:
    path = folder / "variant.toml"
    path.write_text(f'extends = "guan2014_own_manoeuvring"\n{changes}', encoding="utf-8")
    return str(path)


def test_what_is_estimated_is_said() -> None:
    said = load_ship("guan2014_own_manoeuvring").estimated
    assert "GM_T = KB + BM_T - KG = 4.54 m" in said
    for text in ("zeta_heave = 0.2", "zeta_roll = 0.05", "zeta_pitch = 0.25", "zeta_roll_per_rad = 0.3", "z_H = T/2"):
        assert text in said
    assert not any("GM_T" in text for text in load_ship("kvlcc2").estimated)


def test_a_ship_that_would_capsize_is_refused(tmp_path: Path) -> None:
    """CG 4 m above the water: GM_T below zero. It can be loaded, to coast or to sail in the plane."""
    ship = load_ship(written(tmp_path, "[particulars]\nr_bg = [0.0, 0.0, -4.0]\n"))
    with pytest.raises(
        ShipError, match=r"GM_T = -2\.06 m|GM_T = -\d\.\d+ m, estimated with KG = 20\.10 m, must be at "
    ):
        compute_seakeeping(ship)


def test_a_GM_of_next_to_nothing_is_refused(tmp_path: Path) -> None:
    with pytest.raises(
        ShipError, match=r"GM_T = 0\.050 m, must be at least 0\.002 B = 0\.088 m.*give \[particulars\] GM_T"
    ):
        compute_seakeeping(load_ship(written(tmp_path, "[particulars]\nGM_T = 0.05\n")))


def test_an_impossible_displacement_is_refused() -> None:
    with pytest.raises(
        ShipError, match=r"'Guan 2014 own ship': C_b = .* = 1\.247 is outside 0\.40 to 0\.90, .*= 3, or"
    ):
        compute_seakeeping(load_ship("guan2014_own"))
