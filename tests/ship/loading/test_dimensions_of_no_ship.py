"""Main dimensions that are no ship's, such as millimetres, are refused where they enter; unusual ones are warned of."""

from __future__ import annotations

from itertools import product
from math import isfinite
from typing import Any

import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.loading.library import list_ship_names, load_ship
from tests.ship_files import ship_tables

SIZE = {"L_pp": 120.0, "B": 20.0, "T": 6.0, "C_b": 0.61}
NO_SHIPS: list[tuple[dict[str, float], str]] = [
    ({"L_pp": 120000.0}, r"L_pp = 120000 m must be 0.5 to 500 m: give metres"),
    ({"L_pp": 20000.0}, r"L_pp = 20000 m must be 0.5 to 500 m: give metres"),
    ({"L_pp": 0.12}, r"L_pp = 0.12 m must be 0.5 to 500 m: give metres"),
    ({"L_pp": 120e3, "B": 20e3, "T": 6e3}, r"L_pp = 120000 m must be .*, B = 20000 m must be .*, T = 6000 m must be"),
    ({"T": 6000.0}, r"T = 6000 m must be 0.01 to 250 m: give metres"),
    ({"T": 60.0}, r"B = 20 m over T = 60 m is 0.333, must be 0.5 to 60: give both in metres"),
    ({"T": 0.06}, r"B = 20 m over T = 0.06 m is 333, must be 0.5 to 60: give both in metres"),
    ({"B": 200.0}, r"L_pp = 120 m over B = 200 m is 0.6, must be 1 to 40: give both in metres"),
    ({"L_pp": 12.0}, r"L_pp = 12 m over B = 20 m is 0.6, must be 1 to 40: give both in metres"),
    ({"L_oa": 125e3}, r"L_oa = 125000 m over L_pp = 120 m is 1.04e\+03, must be 0.5 to 2: give both in metres"),
    ({"k_zz": 30e3}, r"k_zz = 30000 m over L_pp = 120 m is 250, must be 0 to 1: give both in metres"),
]


@pytest.mark.parametrize(("change", "line"), NO_SHIPS)
def test_dimensions_of_no_ship_are_refused_with_limit_and_remedy(change: dict[str, float], line: str) -> None:
    with pytest.raises(ShipError, match=rf"^ship given as a dict: \[particulars\] {line}[^;]*$"):
        load_ship({"particulars": {**SIZE, **change}})


@pytest.mark.parametrize("change", [{"B": 200.0}, {"L_pp": 2000.0}, {"T": 600.0}])
def test_with_a_reason_a_body_that_is_no_ship_coasts(change: dict[str, float]) -> None:
    particulars = {**SIZE, **change, "allow_inconsistent": "a raft"}
    assert load_ship({"particulars": particulars}).manoeuvring is None
    with pytest.raises(ShipError, match=r"for a body that is no ship and coasts, give the reason"):
        load_ship({"particulars": particulars, "manoeuvring": {"estimate": True}})


def test_a_depth_in_millimetres_is_refused() -> None:
    with pytest.raises(ShipError, match=r"depth = 8000.0 m must be at most 50 times the draught T = 5.0 m: give both"):
        load_ship(ship_tables(hull={"depth": 8000.0}))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"T": 1.0}, "B/T = 20 is outside 1.5 to 12"), ({"B": 100.0, "T": 20.0}, "L_pp/B = 1.2 is outside 2 to 12"),
        ({"L_pp": 480.0, "B": 60.0, "T": 20.0}, "L_pp = 480 m is more than 460 m"), ({}, ""), ({"B": 40.0}, ""),
    ],
)  # fmt: skip
def test_unusual_dimensions_are_warned_of_once(change: dict[str, float], said: str) -> None:
    notes = load_ship({"particulars": {**SIZE, **change}}).suspicious
    assert len(notes) == bool(said)
    assert said in "".join(notes)


def test_no_shipped_ship_is_warned_of() -> None:
    assert not any(load_ship(name).suspicious for name in list_ship_names())


def test_whatever_is_accepted_can_be_propelled() -> None:
    """Within the limits the estimated resistance stays below that of a plate dragged broadside, R_0 of 2."""
    for L, slenderness, flatness, C_b in product(
        (2.0, 120.0, 500.0), (2.0, 12.0, 40.0), (0.5, 8.0, 60.0), (0.41, 0.89)
    ):
        B = L / slenderness
        size: dict[str, Any] = {"L_pp": L, "B": B, "T": B / flatness, "C_b": C_b}
        if not 0.01 <= size["T"] <= 250.0:
            continue
        ship = load_ship({"particulars": size})
        assert ship.manoeuvring is not None
        assert 0.0 < ship.manoeuvring.R_0 < 2.0, size
        assert ship.propeller is not None
        assert isfinite(ship.propeller.service_rev_per_s or 0.0)


def test_a_ship_prints_as_three_lines() -> None:
    text = repr(load_ship("kvlcc2"))
    assert text.startswith("KVLCC2, tanker (VLCC): L_pp = 320 m, B = 58 m, T = 20.8 m, 320415 t, manoeuvres\n")
    assert text.count("\n") == 2
    assert "None" not in text
    assert repr(load_ship({"ship": {"name": "a\nb"}, "particulars": SIZE})).startswith("a b, ")
