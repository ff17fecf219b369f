"""The eye on the bridge, for every kind of ship."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from shipcollision_fmu.ship.ship_type import SHIP_TYPES
from shipcollision_fmu.show.scene.wheelhouse import find_wheelhouse

from .drawn_ships import draw_ship


def ship_of(kind: str, L: float) -> Any:
    drawn = draw_ship(kind, L)
    return SimpleNamespace(hull=drawn.hull, fittings=drawn.looks.fittings, B=L / 6.0)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("kind", SHIP_TYPES)
@pytest.mark.parametrize("L", [16.0, 120.0, 300.0])
def test_the_eye_is_in_the_wheelhouse_over_deck_and_within_the_hull(kind: str, L: float) -> None:
    ship = ship_of(kind, L)
    x, wing, z = find_wheelhouse(ship)
    deck, aft, fore = ship.hull.vertices[:, 2].min(), ship.hull.vertices[:, 0].min(), ship.hull.vertices[:, 0].max()
    assert aft < x < fore
    assert wing == pytest.approx(L / 12.0)
    glass = [f.surface.vertices for f in ship.fittings if f.part == "windows"]
    if not glass:
        assert z == pytest.approx(deck - 2.5)
        return
    highest = min(glass, key=lambda vertices: float(vertices[:, 2].min()))
    assert highest[:, 2].min() < z < highest[:, 2].max() < deck + 1e-9
    assert highest[:, 0].min() < x < highest[:, 0].max()


def test_a_tanker_is_conned_from_aft_and_a_tug_from_forward() -> None:
    assert find_wheelhouse(ship_of("tanker", 300.0))[0] < -100.0
    assert find_wheelhouse(ship_of("tug", 30.0))[0] > 0.0
