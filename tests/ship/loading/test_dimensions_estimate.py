"""L, B, T and a block coefficient or mass are enough for a ship that sails and collides."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.dimensions_estimate import FORMS, estimate_hull
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship_type import SHIP_TYPES

SHIP = {"name": "Four numbers", "kind": "tanker", "source": "a sketch"}
SIZE: dict[str, Any] = {"L_pp": 320.0, "B": 58.0, "T": 20.8, "C_b": 0.81}
LEAST: dict[str, Any] = {"ship": SHIP, "particulars": SIZE}


def test_every_type_has_a_form() -> None:
    assert FORMS.keys() == SHIP_TYPES.keys()


def test_main_dimensions_alone_make_a_ship_with_its_estimates_said() -> None:
    ship = load_ship(LEAST)
    assert ship.mass == pytest.approx(1025.0 * 320.0 * 58.0 * 20.8 * 0.81, rel=1e-12)
    assert ship.hull.shape == "parametric"
    assert all(table is not None for table in (ship.manoeuvring, ship.propeller, ship.rudder, ship.engine))
    said = "; ".join(ship.estimated)
    for word in ("mass = 3.20516e+08 kg (C_b rho", "depth = 30.16 m", "bow_length = 54.4 m", "stern_length = 86.4 m"):
        assert word in said


def test_four_numbers_are_enough_and_the_kind_is_reported() -> None:
    ship = load_ship({"particulars": SIZE})
    assert (ship.name, ship.kind) == ("ship", "cargo vessel")
    assert '[ship] kind = "cargo vessel" (none is given)' in ship.estimated
    assert ship.engine is not None
    named = load_ship({"ship": {"kind": "cargo vessel"}, "particulars": SIZE})
    assert pytest.approx(ship.M) == named.M
    assert not any("none is given" in note for note in named.estimated)


@pytest.mark.parametrize("size", [{"C_b": None, "mass": 3.2e8}, {"C_b": 0.81}], ids=["mass", "C_b"])
def test_mass_and_block_coefficient_stand_for_each_other(size: dict[str, Any]) -> None:
    given = {key: value for key, value in {**SIZE, **size}.items() if value is not None}
    assert load_ship({**LEAST, "particulars": given}).C_b == pytest.approx(0.81, rel=0.002)


def test_a_ship_from_main_dimensions_sails_and_collides(tmp_path: Path) -> None:
    """It keeps the speed of its type, 15.5 kn, until it strikes a ship like it across its bow."""
    rows = [*(f'{k} = "{v}"' for k, v in SHIP.items()), "[particulars]", *(f"{k} = {v}" for k, v in SIZE.items())]
    (tmp_path / "least.toml").write_text("\n".join(["[ship]", *rows]) + "\n", encoding="utf-8")
    (tmp_path / "meet.toml").write_text(
        """[scenario]
name = "meet"
duration = 8.0
step = 0.1
[ships.own]
ship = "least.toml"
position = [0.0, 0.0]
heading_deg = 0.0
speed = 7.974
hydrodynamics = true
[ships.target]
ship = "least.toml"
position = [220.0, 0.0]
heading_deg = 90.0
speed = 0.0
hydrodynamics = true
""",
        encoding="utf-8",
    )
    run = simulate(load_scenario(tmp_path / "meet.toml"), in_process=True)
    speed = run.states["own.velocity.surge"]
    assert speed[10] == pytest.approx(7.974, rel=0.002)  # a second before anything touches
    assert speed[-1] < 7.0
    assert len(run.events["collisions"]) == 1


@pytest.mark.parametrize(
    ("kind", "L_oa", "T", "depth"),
    [
        ("tanker", 320.0, 20.8, 30.0), ("container ship", 230.0, 10.8, 19.0), ("container ship", 175.0, 8.5, 15.4),
        ("tanker", 182.5, 12.2, 17.5),
    ],
    ids=["KVLCC2", "KCS", "S-175", "47 000 dwt"],
)  # fmt: skip
def test_depth_is_that_of_published_ships(kind: str, L_oa: float, T: float, depth: float) -> None:
    """SIMMAN's KVLCC2 and KCS; ITTC's S-175; a manoeuvring booklet of a 47 000 dwt tanker."""
    assert estimate_hull(kind, L_oa, T, {})[0]["depth"] == pytest.approx(depth, rel=0.10)


@pytest.mark.parametrize("kind", FORMS)
def test_every_type_has_a_hull_with_room_for_its_bow(kind: str) -> None:
    ship = load_ship(
        {"ship": {**SHIP, "kind": kind}, "particulars": {**SIZE, "L_pp": 30.0, "B": 6.0, "T": 2.0, "C_b": 0.6}}
    )
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    assert hull.vertices[:, 2].min() < 0.0
    assert not ship.suspicious


def test_what_is_given_is_kept() -> None:
    hull = {"shape": "parametric", "bow_length": 200.0}
    ship = load_ship({**LEAST, "hull": hull})
    assert ship.hull.bow_length == 200.0
    assert 0.0 < ship.hull.stern_length < 120.0
    assert ship.manoeuvring is None  # a file with [hull] says itself whether the ship sails
    assert load_ship({**LEAST, "hull": {"shape": "box", "depth": 25.0}}).estimated[0].startswith("mass")


def test_an_unknown_kind_is_said_where_the_type_counts() -> None:
    said = load_ship({**LEAST, "ship": {**SHIP, "kind": "oil tankar"}}).suspicious
    assert len(said) == 1
    assert "kind = 'oil tankar' names no known type of ship" in said[0]
    assert said[0].endswith("did you mean tanker?")
    (said_of_others,) = load_ship({**LEAST, "ship": {**SHIP, "kind": "submarine"}}).suspicious
    assert "words for types: ferry, " in said_of_others
    assert load_ship({**LEAST, "ship": {**SHIP, "kind": "oil tanker"}}).suspicious == ()


def test_dimensions_that_are_refused_are_the_only_problem() -> None:
    with pytest.raises(ShipError, match=r"^ship given as a dict: \[particulars\] B = -58\.0 must be greater than 0"):
        load_ship({**LEAST, "particulars": {**SIZE, "B": -58.0}})
