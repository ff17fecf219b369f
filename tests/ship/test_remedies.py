"""The remedy of a message is one: done, the ship is accepted. Messages of a ship's file: loading/test_ship_file.py."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.coasting_law import make_coasting
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.seakeeping import compute_seakeeping
from tests.ship_files import ship_tables

LIGHT = {"mass": 3e6, "allow_inconsistent": "a test"}
TOP_HEAVY = {"r_bg": [0.0, 0.0, -6.0]}


@pytest.mark.parametrize(
    ("particulars", "remedy", "done"),
    [
        (LIGHT, "or give a mass that fits", {"mass": 8e6}),
        (TOP_HEAVY, "give [particulars] GM_T", {**TOP_HEAVY, "GM_T": 1.0}),
        (TOP_HEAVY, "or r_bg with CG lower", {"r_bg": [0.0, 0.0, 1.0]}),
    ],
    ids=["mass", "GM_T", "r_bg"],
)
def test_a_ship_that_does_not_float_upright_does_then(
    particulars: dict[str, Any], remedy: str, done: dict[str, Any]
) -> None:
    with pytest.raises(ShipError) as raised:
        compute_seakeeping(load_ship(ship_tables(particulars=particulars)))
    assert remedy in str(raised.value)
    assert compute_seakeeping(load_ship(ship_tables(particulars=done))).GM_T > 0.0


def test_a_body_that_would_pitch_over_is_refused_by_its_GM_L() -> None:
    broad = {"L_pp": 12.0, "B": 60.0, "T": 5.0, "mass": 2.6e6, "r_bg": [0.0, 0.0, -3.0], "allow_inconsistent": "a raft"}
    with pytest.raises(ShipError, match=r"GM_L = -\d.* m must be greater than 0, .* give \[particulars\] GM_L"):
        compute_seakeeping(load_ship(ship_tables(particulars=broad)))
    assert compute_seakeeping(load_ship(ship_tables(particulars={**broad, "GM_L": 1.0}))).GM_L == 1.0


def test_without_buoyancy_it_coasts() -> None:
    ship = load_ship(ship_tables(particulars=TOP_HEAVY))
    with pytest.raises(ShipError, match=r"or let it coast without buoyancy, coasting = 'straight'"):
        make_coasting(ship, 6, "kirchhoff")
    make_coasting(ship, 6, "straight")


@pytest.mark.parametrize(("i", "j"), [(0, 1), (1, 0)], ids=["symmetric", "positive"])
def test_an_added_mass_that_is_refused_is_accepted_then(i: int, j: int) -> None:
    M_A = np.diag([5e5, 5e6, 8e6, 1e8, 5e9, 5e9])
    wrong = M_A.copy()
    wrong[0, 1] = 1e5
    if (i, j) == (1, 0):
        wrong[:2, :2] = [[5e5, 5e6], [5e6, 5e6]]
    with pytest.raises(ShipError, match=r"must be equal|added masses are positive"):
        load_ship(ship_tables(added_mass={"M_A": wrong.tolist()}))
    wrong[0, 1] = wrong[1, 0] = 1e5
    assert load_ship(ship_tables(added_mass={"M_A": wrong.tolist()})).M_A[0, 1] == 1e5
