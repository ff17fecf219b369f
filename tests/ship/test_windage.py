"""What the wind finds: the type by the ship's kind, areas from the hull, and a file's own numbers first."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship_type import SHIP_TYPES
from shipcollision_fmu.ship.tables.particulars import WindType
from shipcollision_fmu.ship.windage import BLENDERMANN, compute_windage


def test_every_type_has_its_coefficients() -> None:
    assert set(get_args(WindType)) == set(BLENDERMANN)
    assert set(BLENDERMANN) <= set(SHIP_TYPES)
    for C_Dt, bow, stern, delta, kappa in BLENDERMANN.values():
        assert 0.7 <= C_Dt <= 1.0
        assert min(bow, stern) >= 0.4
        assert max(bow, stern) <= 0.925
        assert 0.1 <= delta <= 0.8
        assert 1.1 <= kappa <= 3.1


@pytest.mark.parametrize(
    ("name", "kind", "C_Dt"),
    [
        ("kvlcc2", "tanker, loaded", 0.70),
        ("kcs", "container ship, loaded", 0.90),
        ("guan2014_own_manoeuvring", "cargo vessel, loaded", 0.85),
    ],
)
def test_type_by_kind(name: str, kind: str, C_Dt: float) -> None:
    ship = load_ship(name)
    assert f"[wind] type = {kind!r}" in ship.estimated
    assert compute_windage(ship).C_Dt == C_Dt


def test_areas_are_those_of_merchant_ships() -> None:
    """A loaded VLCC shows some 1 200 m2 from ahead and 3 500 m2 from abeam, a 3 600 TEU ship 4 000 m2 from abeam."""
    vlcc, kcs = compute_windage(load_ship("kvlcc2")), compute_windage(load_ship("kcs"))
    assert vlcc.A_Fw == pytest.approx(1200.0, rel=0.25)
    assert vlcc.A_Lw == pytest.approx(3500.0, rel=0.25)
    assert kcs.A_Lw == pytest.approx(4000.0, rel=0.25)
    assert kcs.s_H > vlcc.s_H > 0.0


def test_the_files_own_numbers_come_first(tmp_path: Path) -> None:
    path = tmp_path / "windy.toml"
    path.write_text(
        'extends = "kvlcc2"\n[wind]\ntype = "ferry"\nA_Fw = 900.0\nA_Lw = 3000.0\ns_L = -5.0\ns_H = 7.0\nC_Dt = 0.8\n'
    )
    ship = load_ship(path)
    w = compute_windage(ship)
    assert (w.A_Fw, w.A_Lw, w.s_L, w.s_H) == (900.0, 3000.0, -5.0, 7.0)
    assert (w.C_Dt, w.C_Dl_bow, w.C_Dl_stern, w.delta, w.kappa) == (0.8, 0.45, 0.50, 0.80, 1.1)
    assert w.estimated == ()
    assert not any("[wind]" in text for text in ship.estimated)
