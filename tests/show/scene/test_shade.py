"""Ambient occlusion against its integral before a wall, and on ships: corners and what is overhung are dark."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence

import numpy as np
import pytest

from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.show.scene import shaded
from shipcollision_fmu.show.scene.parts import join_fittings, join_shapes
from shipcollision_fmu.show.scene.shade import CELL, DEPTH, REACH, Shade, cast_shade
from shipcollision_fmu.show.scene.shaded import (
    MOST_KEPT,
    Corners,
    find_face_shares,
    is_shaded,
    shade_ship,
    shade_surface,
)
from shipcollision_fmu.show.scene.solids import Shape, join_surfaces, make_box, make_faces
from shipcollision_fmu.show.scene.surface import Surface

from .drawn_ships import draw_ship, to_solid

UP = np.array([0.0, 0.0, -1.0])
COARSE = 0.08
"""Error of a share by cells, half of which are 0.05 below a deck, and by RAYS rays, of which each counts for 0.03."""


def expect_before_wall(distance: float) -> float:
    """Share of the light on level ground at a distance [m] before an endless upright wall.

    By Nusselt's analogon the component x of cosine-weighted unit vectors has the density 2/pi sqrt(1 - x^2) over
    -1..1; a ray meets the wall after distance/x.
    """
    near = distance / (REACH * CELL)
    x = np.linspace(near, 1.0, 2001)
    weight = (1.0 - near / x) * 2.0 / np.pi * np.sqrt(1.0 - x**2)
    return 1.0 - DEPTH * float(((weight[1:] + weight[:-1]) / 2.0 * np.diff(x)).sum())


def list_floor(x: Array) -> tuple[Array, Array]:
    """Points on the floor at stations x, and their normals."""
    return np.column_stack([x, 0.3 + 0 * x, 0 * x]), np.tile(UP, (len(x), 1))


def test_a_floor_before_a_wall_has_the_light_of_the_integral() -> None:
    floor, wall = make_box((-15.0, 0.0), (-15.0, 15.0), (0.0, 1.0)), make_box((0.0, 1.0), (-15.0, 15.0), (-15.0, 1.0))
    shade = cast_shade([("deck", floor), ("house", wall)], 20.0)
    distance = np.array([0.7, 1.2, 2.2, 3.2, 4.7, 8.2])
    shares = shade.find_share(*list_floor(-distance))
    assert shares == pytest.approx([expect_before_wall(d) if d < REACH * CELL else 1.0 for d in distance], abs=COARSE)
    assert shares[0] < 0.85


def test_under_a_roof_it_is_dark_and_beyond_reach_it_is_not() -> None:
    """Under an endless roof every ray is stopped: at a height h after h/cos, cos^2 being uniform from 0 to 1."""
    floor = make_box((-15.0, 15.0), (-15.0, 15.0), (0.0, 1.0))
    for height in (1.85, 3.35, 7.0):
        roof = make_box((-15.0, 15.0), (-15.0, 15.0), (-height - 0.75, -height))
        shares = cast_shade([("deck", floor), ("house", roof)], 20.0).find_share(*list_floor(np.array([0.2, 3.4])))
        near = min(1.0, height / (REACH * CELL))
        mean = (1.0 - near**2) - near * 2.0 * (1.0 - near)  # of 1 - near/cos over cos^2 from near^2 to 1
        assert shares == pytest.approx(1.0 - DEPTH * mean, abs=COARSE)


def test_letters_and_rails_take_no_light() -> None:
    floor, roof = make_box((-9.0, 9.0), (-9.0, 9.0), (0.0, 1.0)), make_box((-9.0, 9.0), (-9.0, 9.0), (-3.0, -2.0))
    assert cast_shade([("deck", floor), ("rail", roof)], 20.0).find_share(*list_floor(np.zeros(1))) == 1.0


def make_deck(thickness: float) -> Surface:
    """A deck of strips across, 80 m by 18 m, at z = 0: a closed solid, or without thickness its top alone."""
    x = np.linspace(40.0, -40.0, 21)
    pairs = np.stack([x[:-1], x[1:]], axis=1)
    edge = [(0, -9.0), (1, -9.0), (1, 9.0), (0, 9.0)]
    top = np.array([[(p[i], y, 0.0) for i, y in edge] for p in pairs])
    if not thickness:
        return make_faces(top)
    bottom = top[:, ::-1] + [0.0, 0.0, thickness]
    walls = [
        np.array([top[:, j], top[:, i], top[:, i] + [0, 0, thickness], top[:, j] + [0, 0, thickness]]).transpose(
            1, 0, 2
        )
        for i, j in ((0, 1), (2, 3))
    ]
    ends = [
        np.array([[top[0, 0], top[0, 3], top[0, 3] + [0, 0, thickness], top[0, 0] + [0, 0, thickness]]]),
        np.array([[top[-1, 2], top[-1, 1], top[-1, 1] + [0, 0, thickness], top[-1, 2] + [0, 0, thickness]]]),
    ]
    return make_faces(np.concatenate([top, bottom, *walls, *ends]))


HOUSE = make_box((-8.0, 8.0), (-5.0, 5.0), (-9.0, -0.1))


def shade_deck(deck: Surface) -> Corners:
    """The deck's light, with a house on it."""
    return shade_surface(deck, cast_shade([("deck", deck), ("house", HOUSE)], 18.0), is_cut=True)


def test_a_deck_is_cut_where_its_light_changes_and_stays_the_same_deck() -> None:
    deck = make_deck(2.0)
    cut = shade_deck(deck)
    assert 1.15 * len(deck.triangles) < len(cut.triangles) < 6 * len(deck.triangles)
    before, after = to_solid(deck), to_solid(Surface(cut.vertices, cut.triangles))
    assert before.is_watertight
    assert after.is_watertight
    assert after.is_winding_consistent
    assert after.area == pytest.approx(before.area)
    assert after.volume == pytest.approx(before.volume)
    x, y = np.abs(cut.vertices[:, 0]), np.abs(cut.vertices[:, 1])
    level = cut.normals[:, 2] < -0.9
    beside, away = level & (x < 7.0) & (y > 4.4) & (y < 7.0), level & (x > 18.0)
    assert beside.sum() > 3
    assert cut.shares[beside].max() < 0.85 < 0.95 < cut.shares[away].min()


def test_the_border_of_a_paint_stays_whole() -> None:
    """Another paint begins there, whose edges are not halved: between the two there would be cracks."""
    deck = make_deck(0.0)
    cut = shade_deck(deck)
    assert len(cut.triangles) > 1.3 * len(deck.triangles)
    on_border = np.abs(cut.vertices[:, 1]) == 9.0
    assert len(np.unique(np.round(cut.vertices[on_border], 6), axis=0)) == 2 * 21


@pytest.mark.parametrize("kind", ["tug", "container ship"])
def test_ships_are_dark_below_and_light_on_top(kind: str) -> None:
    drawn = draw_ship(kind, 32.0 if kind == "tug" else 180.0)
    shapes = [*join_shapes(drawn.looks.shell), *join_fittings(drawn.looks.fittings)]
    shade = cast_shade(shapes, drawn.B)
    houses = [surface for part, surface in shapes if part == "house"]
    house = shade_surface(join_surfaces(houses), shade, is_cut=True)
    walls = np.abs(house.normals[:, 2]) < 0.1
    foot = walls & (house.vertices[:, 2] > drawn.z_deck - 0.5)
    assert house.shares[foot].mean() < 0.75
    assert house.shares.max() > 0.95
    faces = find_face_shares(join_surfaces(houses), shade)
    assert 1.0 - DEPTH <= faces.min() < 0.6 < 0.95 < faces.max() <= 1.0


def test_the_outside_of_a_hull_has_no_shade() -> None:
    assert not any(map(is_shaded, ("topsides 0", "naval", "boot-top", "antifouling", "windows", "rail")))
    assert all(map(is_shaded, ("deck-red", "house", "container-a", "trim")))


def test_ships_that_look_the_same_share_their_light(monkeypatch: pytest.MonkeyPatch) -> None:
    """And no more than some are kept."""
    cast: list[float] = []

    def count(shapes: Sequence[Shape], breadth: float) -> Shade:
        cast.append(breadth)
        return cast_shade(shapes, breadth)

    monkeypatch.setattr(shaded, "_kept", OrderedDict())
    monkeypatch.setattr(shaded, "cast_shade", count)
    lengths = [1.0 + k for k in range(MOST_KEPT + 1)]
    houses = [[("house", make_box((0.0, length), (0.0, 5.0), (-5.0, 0.0)))] for length in lengths]
    again = [("house", make_box((0.0, 1.0), (0.0, 5.0), (-5.0, 0.0)))]
    assert shade_ship(houses[0], 20.0) is shade_ship(again, 20.0)
    assert cast == [20.0]
    for shapes in houses:
        shade_ship(shapes, 20.0)
    assert len(cast) == MOST_KEPT + 1
    shade_ship(again, 20.0)
    shade_ship(again, 5.0)
    assert len(cast) == MOST_KEPT + 3
