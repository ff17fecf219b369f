"""The hull as drawn lies on the hull that touches along the sides, and within it at the ends and under water."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shipcollision_fmu.show.scene.hull_ends import BOW, STERN, shape_ends
from shipcollision_fmu.show.scene.hull_lines import RUN
from shipcollision_fmu.show.scene.hull_rings import read_rings
from shipcollision_fmu.show.scene.lettering import LIFT, find_letters, write_text
from shipcollision_fmu.show.scene.ship_style import choose_style, choose_type
from shipcollision_fmu.show.scene.solids import join_surfaces
from shipcollision_fmu.show.scene.surface import Surface

from .drawn_ships import KINDS, Drawn, draw_ship, to_solid

CENTIMETRE = 0.01
GUIDE = Path(__file__).parents[3] / "docs" / "guide" / "pictures.md"
UNDER_WATER = 0.25
"""Largest distance under water of the drawn hull from the hull that touches, over B; docs/guide/pictures.md."""


def skin(drawn: Drawn) -> trimesh.Trimesh:
    plating = drawn.looks.plating
    return trimesh.Trimesh(plating.vertices, plating.triangles, process=False)


def distance(surface: trimesh.Trimesh, points: np.ndarray) -> np.ndarray:
    _, away, _ = trimesh.proximity.closest_point_naive(surface, points)
    return np.asarray(away)


@cache
def measure_sides(kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Points between waterline and deck of either hull (n, 3), and their distances from the other one [m]."""
    drawn = draw_ship(kind)
    touches = trimesh.Trimesh(drawn.hull.vertices, drawn.hull.triangles, process=False)
    found, away = [], []
    for one, other in ((skin(drawn), touches), (touches, skin(drawn))):
        sampled, _ = trimesh.sample.sample_surface(one, 900, seed=3)
        points = np.vstack([sampled, [[drawn.hull.vertices[:, 0].max(), 0.0, 0.0]]])[: None if one is touches else -1]
        side = points[(points[:, 2] <= 0.0) & (points[:, 2] > drawn.z_deck + CENTIMETRE)]
        assert len(side) > 40
        found.append(side)
        away.append(distance(other, side))
    return np.vstack(found), np.concatenate(away)


@pytest.mark.parametrize("kind", KINDS)
def test_sides_between_the_ends_and_the_edge_of_the_deck_are_those_of_the_hull_that_touches(kind: str) -> None:
    """Both ways: nothing stands off, and nothing is missing."""
    drawn = draw_ship(kind)
    points, away = measure_sides(kind)
    share = points[:, 0] / drawn.L + 0.5
    middle = (share > STERN) & (share < 1.0 - BOW)
    assert middle.sum() > 40
    assert away[middle].max() < CENTIMETRE
    deck = drawn.hull.vertices[drawn.hull.vertices[:, 2] < drawn.z_deck + 1e-9]
    edge = drawn.looks.plating.vertices[np.abs(drawn.looks.plating.vertices[:, 2] - drawn.z_deck) < 1e-9]
    assert np.abs(deck[:, None] - edge[None]).max(axis=2).min(axis=1).max() < 1e-6


@pytest.mark.parametrize("kind", KINDS)
def test_ends_above_water_are_within_the_hull_that_touches_by_no_more_than_stated(kind: str) -> None:
    """docs/guide/pictures.md has the largest distance of each kind, for a ship of this size, in metres."""
    drawn = draw_ship(kind)
    rings = read_rings(drawn.hull.vertices)
    assert rings is not None
    dry = drawn.looks.plating.vertices
    for x, y, z in dry[(dry[:, 2] <= 0.0) & (dry[:, 2] >= drawn.z_deck)]:
        assert abs(y) <= float(rings.half_breadth(min(x, rings.at(z)[0, 0]), z)) + 1e-6
        assert rings.at(z)[-1, 0] - 1e-6 <= x <= rings.at(z)[0, 0] + 1e-6
    table = re.findall(r"^ *\| ([a-z ]+) \| (\d\.\d) m \|$", GUIDE.read_text(encoding="utf-8"), re.M)
    stated = float(dict(table)[kind])
    assert stated - 0.15 < measure_sides(kind)[1].max() <= stated


@pytest.mark.parametrize("kind", KINDS)
def test_the_stem_is_raked_the_bow_flares_up_to_its_knuckle_and_the_transom_is_raked(kind: str) -> None:
    drawn = draw_ship(kind)
    rings = read_rings(drawn.hull.vertices)
    assert rings is not None
    style = choose_style(choose_type(kind, drawn.L, drawn.B, float(np.ptp(drawn.hull.vertices[:, 2]))))
    shaped = shape_ends(rings, style.ends)
    heights = shaped.z_deck * np.linspace(1.0, 0.0, 41)
    stem = np.array([shaped.at(z)[0, 0] for z in heights])
    transom = np.array([shaped.at(z)[-1, 0] for z in heights])
    assert stem[0] == pytest.approx(rings.edge[0, 0], abs=1e-6)
    assert stem[0] - stem[-1] > 0.1 * -shaped.z_deck
    assert (np.diff(stem) < 0.0).all()
    assert (np.diff(transom) > 0.0).all()
    half = np.array([float(shaped.half_breadth(0.42 * drawn.L, z)) for z in heights])
    above = heights < (1.0 - style.ends.knuckle) * shaped.z_deck - 1e-6
    assert half[-1] < half[0] - 0.01 * drawn.B
    lean = -np.diff(half) / np.diff(heights)
    assert lean[: max(above.sum() - 1, 0)].max(initial=0.0) < lean[above.sum() :].max()


@pytest.mark.parametrize("kind", KINDS)
def test_under_water_it_is_within_the_hull_that_touches(kind: str) -> None:
    """A bulb before the hull would seem to pass through the other ship's side."""
    drawn = draw_ship(kind)
    rings = read_rings(drawn.hull.vertices)
    assert rings is not None
    shell = join_surfaces([surface for paint, surface in drawn.looks.shell if paint != "letters"])
    wet = shell.vertices[shell.vertices[:, 2] > 0.0]
    for x, y, z in wet:
        assert abs(y) <= float(rings.half_breadth(x, z)) + CENTIMETRE
        assert rings.at(z)[-1, 0] - CENTIMETRE <= x <= rings.at(z)[0, 0] + CENTIMETRE
    touches = trimesh.Trimesh(drawn.hull.vertices, drawn.hull.triangles, process=False)
    points, _ = trimesh.sample.sample_surface(skin(drawn), 600, seed=3)
    away, wet = distance(touches, points), points[:, 2] > 0.0
    assert 0.03 < away[wet].max() / drawn.B < UNDER_WATER
    share = points[:, 0] / drawn.L + 0.5
    middle = (share > RUN) & (share < 0.65)
    assert away[wet & middle].max() < CENTIMETRE


@pytest.mark.one_in(2)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("L", [16.0, 120.0])
def test_the_shell_is_closed_faces_outwards_and_is_symmetric(kind: str, L: float) -> None:
    drawn = draw_ship(kind, L)
    names = [paint for paint, _ in drawn.looks.shell]
    parts = [s for _, s in drawn.looks.shell[: names.index("letters")]]  # plating, bulwark, deck
    solid = to_solid(join_surfaces(parts))
    assert solid.is_watertight
    assert solid.is_winding_consistent
    enclosed = trimesh.Trimesh(drawn.hull.vertices, drawn.hull.triangles).volume
    assert 0.8 * enclosed < solid.volume < 1.15 * enclosed
    points = np.round(np.vstack([s.vertices for s in parts]), 6) + 0.0
    mirrored = points * [1.0, -1.0, 1.0] + 0.0
    assert {tuple(p) for p in points} == {tuple(p) for p in mirrored}


@pytest.mark.one_in(2)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("L", [16.0, 120.0])
def test_nothing_stands_out_beyond_the_hull_in_plan(kind: str, L: float) -> None:
    drawn = draw_ship(kind, L)
    low, high = drawn.hull.vertices.min(axis=0), drawn.hull.vertices.max(axis=0)
    points = drawn.points
    assert (points[:, :2] >= low[:2] - LIFT - 1e-6).all()
    assert (points[:, :2] <= high[:2] + LIFT + 1e-6).all()
    assert points[:, 2].max() <= high[2] + 1e-6


def test_bow_and_stern_have_what_ships_have() -> None:
    """Forecastle above the deck, bulb below the waterline ahead of the stem above it, a rudder abaft the propeller."""
    drawn = draw_ship("container ship")
    parts = dict(drawn.looks.shell)
    bow = drawn.looks.plating.vertices[drawn.looks.plating.vertices[:, 0] > 0.0]
    assert bow[:, 2].min() < drawn.z_deck - 3.0
    T = float(drawn.hull.vertices[:, 2].max())
    stem = {v: bow[np.abs(bow[:, 2] - v * T) < 0.04 * T, 0].max() for v in (0.32, 0.68)}
    assert stem[0.68] > stem[0.32] + 1.0
    wheel = parts["bronze"].vertices
    rudder = [s for paint, s in drawn.looks.shell if paint == "antifouling"][1].vertices
    assert rudder[:, 0].max() < wheel[:, 0].min()
    assert abs(wheel[:, 1].mean()) < 1e-6
    assert wheel[:, 2].max() < T


def test_a_name_is_read_from_aft_on_port_and_from_forward_on_starboard() -> None:
    """That is: from left to right on both sides. The last letter of IL has a foot to the right, so is not symmetric."""
    letters = dict(draw_ship("container ship", name="I" * 8 + "L").looks.shell)["letters"]
    faces = letters.vertices[letters.triangles]
    ahead = faces[faces[:, :, 0].mean(axis=1) > 0.3 * 120.0]
    marks = ahead[ahead[..., 2].mean(axis=1) < -3.0]
    normals = np.cross(marks[:, 1] - marks[:, 0], marks[:, 2] - marks[:, 0])
    for side, first in ((1.0, "aft"), (-1.0, "fore")):
        own = marks[np.sign(marks[:, :, 1].mean(axis=1)) == side]
        assert (side * normals[np.sign(marks[:, :, 1].mean(axis=1)) == side][:, 1] > 0.0).all()
        low = own[own[:, :, 2].min(axis=1) > own[..., 2].max() - 0.4 * np.ptp(own[..., 2])]  # the foot of the L
        foot = low.reshape(-1, 3)[:, 0].mean()
        middle = 0.5 * (own[..., 0].min() + own[..., 0].max())
        assert (foot > middle) == (first == "aft")


@pytest.mark.parametrize(
    ("name", "painted"),
    [
        ("own", "OWN"),
        ("Åse_Märthe  2", "ASE MARTHE 2"),
        ("海洋", ""),
        ("x" * 50, "X" * 20),
        ("Straße", "STRASSE"),
        ("", ""),
    ],
)
def test_names_are_painted_in_plain_capitals(name: str, painted: str) -> None:
    assert find_letters(name) == painted
    assert len(write_text(painted, 1.0)) >= 2 * len(painted.replace(" ", "").replace("1", ""))


@pytest.mark.parametrize("name", ["海洋", "A", "W" * 40])
def test_any_name_can_be_drawn(name: str) -> None:
    assert draw_ship("tug", 30.0, name=name).points.size


def test_other_shapes_have_no_rings() -> None:
    box: Surface = Surface(np.array(trimesh.creation.box().vertices), np.array(trimesh.creation.box().faces))
    assert read_rings(box.vertices) is None
    ball = trimesh.creation.icosphere()
    assert read_rings(np.array(ball.vertices)) is None
