"""The type of a ship decides its fittings, which stand on its deck."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from shipcollision_fmu.ship.ship_type import SHIP_TYPES
from shipcollision_fmu.show.scene.palette import convert_to_display, find_paint
from shipcollision_fmu.show.scene.ship_style import choose_type

from .drawn_ships import Drawn, draw_ship, to_solid


@pytest.mark.one_in(2)
@pytest.mark.parametrize("kind", SHIP_TYPES)
@pytest.mark.parametrize("L", [16.0, 120.0])
def test_fittings_of_every_type_stand_on_deck_and_closed_ones_face_outwards(kind: str, L: float) -> None:
    drawn = draw_ship(kind, L)
    assert bool(drawn.looks.fittings) == (kind != "speed boat")
    for fitting in drawn.looks.fittings:
        assert fitting.surface.vertices[:, 2].max() <= drawn.z_deck + 0.15  # a sloping rod has its foot in the deck
        if fitting.is_closed:
            solid = to_solid(fitting.surface)
            assert solid.is_watertight, fitting.part
            assert solid.volume > 0.0, fitting.part


def parts_of(drawn: Drawn, part: str) -> list[trimesh.Trimesh]:
    return [
        trimesh.Trimesh(f.surface.vertices, f.surface.triangles, process=False)
        for f in drawn.looks.fittings
        if f.part.startswith(part)
    ]


@pytest.mark.parametrize("kind", ["ferry", "tanker", "container ship", "tug"])
def test_windows_are_on_the_walls_not_inside(kind: str) -> None:
    """A hand's breadth behind each there is a house, before it there is none."""
    drawn = draw_ship(kind)
    houses = [to_solid(f.surface) for f in drawn.looks.fittings if f.part == "house" and f.is_closed]
    panes = [f.surface for f in drawn.looks.fittings if f.part == "windows" and not f.is_closed]
    assert sum(len(pane.triangles) for pane in panes) > 30
    inside = outside = total = 0
    for pane in panes:
        corners = pane.vertices[pane.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        middle = corners.mean(axis=1)
        total += len(middle)
        inside += int(_are_within(houses, middle - 0.1 * normals).sum())
        outside += int((~_are_within(houses, middle + 0.02 * normals)).sum())
    assert inside == total
    assert outside > 0.8 * total  # the rest look at the wall of a casing


def _are_within(convex_solids: list[trimesh.Trimesh], points: np.ndarray) -> np.ndarray:
    """Whether points lie in one of some convex solids: behind all of its faces."""
    within = np.zeros(len(points), dtype=bool)
    for solid in convex_solids:
        reach = np.einsum("ij,ij->i", solid.face_normals, solid.triangles[:, 0])
        within |= (points @ solid.face_normals.T <= reach + 1e-9).all(axis=1)
    return within


@pytest.mark.parametrize("L", [100.0, 200.0, 300.0])
def test_containers_stand_within_the_deck_and_face_outwards(L: float) -> None:
    drawn = draw_ship("container ship", L, breadth=0.14)
    edge = drawn.hull.vertices[drawn.hull.vertices[:, 2] < drawn.z_deck + 1e-6]
    edge = edge[edge[:, 1] > -1e-9][np.argsort(edge[edge[:, 1] > -1e-9][:, 0])]
    boxes = parts_of(drawn, "container-")
    assert len(boxes) >= 5
    corners = np.vstack([box.vertices for box in boxes])
    assert (np.abs(corners[:, 1]) <= np.interp(corners[:, 0], edge[:, 0], edge[:, 1]) + 1e-6).all()
    assert corners[:, 0].min() > edge[:, 0].min()
    tops = sum(float(box.area_faces[box.face_normals[:, 2] < -0.9].sum()) for box in boxes)
    bottoms = sum(float(box.area_faces[box.face_normals[:, 2] > 0.9].sum()) for box in boxes)
    assert tops > 0.25 * drawn.L * drawn.B > bottoms == 0.0
    gap = parts_of(drawn, "gap")[0]
    assert gap.vertices[:, 2].min() > corners[:, 2].min()  # dark faces are behind, not before


def test_cargo_is_stowed_by_the_name() -> None:
    """The same name gives the same ship, another one another."""
    first, again, other = (draw_ship.__wrapped__("container ship", 120.0, name) for name in ("Anna", "Anna", "Berta"))
    stowed = [np.vstack([box.vertices for box in parts_of(drawn, "container-")]) for drawn in (first, again, other)]
    assert np.array_equal(stowed[0], stowed[1])
    assert not np.array_equal(stowed[0], stowed[2])


def test_kinds_of_ship_look_different() -> None:
    """Ferry, tanker, bulk carrier, container ship, tug and naval ship."""
    looks = {}
    for kind in ("ferry", "tanker", "bulk carrier", "container ship", "tug", "naval ship"):
        drawn = draw_ship(kind)
        parts = {fitting.part for fitting in drawn.looks.fittings}
        walls = [f.surface.vertices[:, 0].mean() for f in drawn.looks.fittings if f.part in ("house", "grey")]
        looks[kind] = (parts, float(np.mean(walls)) / (0.5 * drawn.L))
    sets = [frozenset(parts) for parts, _ in looks.values()]
    assert len(set(sets)) == 6
    assert "lifeboat" in looks["ferry"][0] & looks["tanker"][0]
    assert "pipe" in looks["tanker"][0]
    assert "hatch" in looks["bulk carrier"][0]
    assert looks["tanker"][1] < -0.6 < 0.05 < looks["tug"][1]  # the house: aft and forward


@pytest.mark.parametrize(
    ("kind", "L", "B", "depth", "drawn"),
    [
        ("", 30.0, 10.0, 5.0, "tug"), ("thing", 200.0, 32.0, 30.0, "car carrier"),
        ("thing", 150.0, 23.0, 12.0, "cargo vessel, loaded"),
        ("motor tanker", 30.0, 10.0, 5.0, "tanker, loaded"), ("ferry", 200.0, 32.0, 30.0, "ferry"),
    ],
)  # fmt: skip
def test_a_ship_of_unknown_kind_is_drawn_by_its_proportions(
    kind: str, L: float, B: float, depth: float, drawn: str
) -> None:
    assert choose_type(kind, L, B, depth) == drawn


@pytest.mark.parametrize("kind", SHIP_TYPES)
def test_a_ship_has_a_bounded_number_of_triangles(kind: str) -> None:
    """Pictures are drawn by processors without a graphics card, and pages hold many ships."""
    drawn = draw_ship(kind, 300.0)
    surfaces = [surface for _, surface in drawn.looks.shell] + [f.surface for f in drawn.looks.fittings]
    assert 4000 < sum(len(surface.triangles) for surface in surfaces) < 25000


def test_a_naval_ship_is_grey_with_the_colour_of_its_curves_on_boot_topping_stripe_and_funnel() -> None:
    """Beside it, a ship of any other kind has topsides in its colour."""
    grey, other = draw_ship("naval ship"), draw_ship("cargo vessel")
    sides = {paint: trimesh.Trimesh(s.vertices, s.triangles, process=False).area for paint, s in grey.looks.shell}
    assert "topsides" not in sides
    assert sides["naval"] > 3.0 * sides["livery"] > 0.0
    red, green, blue = (255.0 * c for c in convert_to_display(find_paint("naval").colour))
    assert max(red, green, blue) - min(red, green, blue) < 25.0
    assert 90.0 < green < 170.0
    assert {fitting.part for fitting in grey.looks.fittings} >= {"livery", "grey"}
    assert {"topsides", "naval"} & {paint for paint, _ in other.looks.shell} == {"topsides"}
