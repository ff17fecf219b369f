"""Ships from four numbers turn as published ships do, and as ships do at all; figures: benchmarks/estimated_ships.py.

Limits. Advance and tactical diameter: 30 %. The three published circles of KVLCC2 spread over 20 %, and predictions
from main dimensions at the SIMMAN 2008 workshop scattered by about a quarter (recalled). Drift: 5 deg; speed kept:
0.15; first overshoots: a factor of 2, as they scattered at that workshop. The steady radius of the tanker of 190 000
dwt is missed by 39 %, so radii are not held to a limit. Rows beyond these limits are listed in MISSED, with a reason.
"""

from __future__ import annotations

import pytest

from tests.oracles.published_turning import KVLCC2, PublishedShip

from .four_numbers import (
    COMPARED,
    TYPES,
    keep_speed_without_limit,
    sail_from_four_numbers,
    sail_type,
    zigzag_from_four_numbers,
)

SLOW = {ship.name for ship in COMPARED} - {"KVLCC2", "Esso Osaka"}
"""The first two are sailed in a default run: the others take as long, or their published set must be sailed first."""

LIMITS = {
    "advance": (0.30, 0.0),
    "tactical diameter": (0.30, 0.0),
    "drift angle": (0.0, 5.0),
    "speed kept": (0.0, 0.15),
}
"""Relative and absolute."""

MISSED = {
    ("Mariner", "speed kept"): "the published set expands the drag about the approach speed, and keeps 0.72 of it",
    ("ferry of 140 m", "tactical diameter"): "31 % too small; two propellers and rudders are estimated as one",
    ("ferry of 140 m", "speed kept"): "0.45 for 0.61: it loses more speed on its smaller circle",
    ("Fletcher class", "tactical diameter"): "at Fn 0.46 waves, sinkage and trim steady a ship; no regression has them",
    ("Yamato", "advance"): "a warship built for turning: two rudders, one of them far forward; C_b 0.65 at L/B 6.6",
    ("Yamato", "tactical diameter"): "the same",
}
"""Rows beyond the limits, and why; the table of docs/validation.md has them, too."""


@pytest.mark.slow
@pytest.mark.parametrize(
    "ship", [pytest.param(s, id=s.name, marks=[pytest.mark.slow] * (s.name in SLOW)) for s in COMPARED]
)
def test_turning_circles_of_published_ships(ship: PublishedShip) -> None:
    ours = sail_from_four_numbers(ship)
    for source in ship.sources:
        published = source.figures()
        for name, (relative, absolute) in LIMITS.items():
            if name in published:
                held = ours[name] == pytest.approx(published[name], rel=relative, abs=absolute)
                assert held != ((ship.name, name) in MISSED), (source.name, name, published[name], ours[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["KVLCC2", "S-175", "Mariner"])
def test_the_limit_of_torque_costs_speed_in_a_turn(name: str) -> None:
    """The published tests were run at constant revolutions."""
    (ship,) = (ship for ship in COMPARED if ship.name == name)
    assert 0.02 < keep_speed_without_limit(ship) - sail_from_four_numbers(ship)["speed kept"] < 0.10


def test_eight_ships_at_least_are_compared() -> None:
    assert len(COMPARED) >= 8
    assert {name for name, _ in MISSED} < {ship.name for ship in COMPARED}


@pytest.mark.slow
@pytest.mark.parametrize("ship", COMPARED, ids=lambda ship: ship.name)
def test_overshoots_of_published_ships(ship: PublishedShip) -> None:
    published = ship.sources[0].figures()
    for name, ours in zigzag_from_four_numbers(ship).items():
        if name in published:
            assert 0.5 * published[name] < ours < 2.0 * published[name]


def test_a_vlcc_from_four_numbers_does_not_spin() -> None:
    """Drift 33 deg and R = 0.77 L before, where KVLCC2 was measured at 20.4 deg and 1.16 L."""
    ours = sail_from_four_numbers(KVLCC2)
    assert ours["drift angle"] < 25.0
    assert ours["steady radius"] > 0.9


BIG = ("tanker", "container", "cargo", "natural gas", "car carrier", "passenger", "ferry", "drilling", "destroyer")
LENGTHS = (10.0, 60.0, 200.0, 400.0)
GRID = [
    *((name, L, 3) for name in TYPES for L in LENGTHS if L < 400.0 or any(w in name for w in BIG)),
    *((name, 60.0, degrees_of_freedom) for name in TYPES for degrees_of_freedom in (4, 6)),
]
"""Type, length [m], degrees of freedom. Working craft and boats of 400 m are left out: a trawler of that length would
still turn about its stem."""

CORNERS = {
    "car carrier": (200.0, 4), "cargo vessel, loaded": (60.0, 3), "cargo vessel, container on deck": (200.0, 6),
    "container ship, loaded": (400.0, 6), "destroyer": (200.0, 3), "diving support vessel": (60.0, 6),
    "drilling vessel": (400.0, 4), "ferry": (200.0, 6), "fishing vessel": (10.0, 4),
    "liquefied natural gas tanker": (400.0, 3), "offshore supply vessel": (60.0, 4), "passenger liner": (400.0, 4),
    "research vessel": (60.0, 3), "speed boat": (10.0, 6), "tanker, loaded": (400.0, 3),
    "tanker, in ballast": (60.0, 6), "tender": (10.0, 3),
}  # fmt: skip
"""Length [m] and degrees of freedom of each type: every type once, every length in 3, 4 and 6 degrees of freedom."""


def test_the_corners_cover_types_lengths_and_degrees_of_freedom() -> None:
    assert CORNERS.keys() == TYPES.keys()
    assert set(CORNERS.values()) == {(L, degrees_of_freedom) for L in LENGTHS for degrees_of_freedom in (3, 4, 6)}


@pytest.mark.slow
@pytest.mark.parametrize(("ship_type", "corner"), CORNERS.items())
def test_a_ship_of_every_type_turns_as_ships_do(ship_type: str, corner: tuple[float, int]) -> None:
    check_turn(sail_type(ship_type, *corner))


@pytest.mark.soak
@pytest.mark.parametrize(("ship_type", "L", "degrees_of_freedom"), GRID)
def test_every_type_turns_as_ships_do(ship_type: str, L: float, degrees_of_freedom: int) -> None:
    check_turn(sail_type(ship_type, L, degrees_of_freedom))


def check_turn(turn: dict[str, float]) -> None:
    """IMO MSC.137(76): advance 4.5 L, tactical diameter 5 L. Drift: 22.5 L/R + 1.45 deg (Principles of Naval
    Architecture III, recalled) and 6 deg. No ship spins, or loses all of its way."""
    assert 2.0 < turn["advance"] < 4.5
    assert 2.0 < turn["tactical diameter"] < 5.0
    assert turn["steady radius"] > 0.7
    assert turn["drift angle"] < 22.5 / turn["steady radius"] + 1.45 + 6.0
    assert 0.15 < turn["speed kept"] < 0.75


@pytest.mark.slow
@pytest.mark.parametrize("ship_type", ["tanker, loaded", "container ship, loaded", "ferry"])
def test_large_ships_keep_their_course(ship_type: str) -> None:
    check_overshoots(ship_type)


@pytest.mark.soak
@pytest.mark.parametrize("ship_type", TYPES)
def test_every_large_ship_keeps_its_course(ship_type: str) -> None:
    check_overshoots(ship_type)


def check_overshoots(ship_type: str) -> None:
    """IMO MSC.137(76), yaw checking: limits of the first overshoots at 200 m."""
    turn = sail_type(ship_type, 200.0, 3, zigzags=True)
    assert turn["10/10"] < 5.0 + 0.5 * min(30.0, max(10.0, turn["L/V"]))
    assert turn["20/20"] < 25.0
