"""Sections, places and contacts in plan: areas, places and normals of a box, and contact for every heading."""

from __future__ import annotations

from itertools import pairwise, product
from math import cos, pi, radians, sin

import numpy as np
import pytest

from shipcollision_fmu import load_ship
from shipcollision_fmu.encounters.plan_contact import (
    cut_section,
    find_contact_height,
    find_contacts,
    locate_place,
    measure_gap,
    move_polygon,
)  # fmt: skip
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh

BOX = np.array([[-50.0, -10.0], [50.0, -10.0], [50.0, 10.0], [-50.0, 10.0]])


def hull(name: str) -> HullMesh:
    ship = load_ship(name)
    return build_hull(ship.L_oa, ship.B, ship.T, ship.hull)


def area(polygon: Array) -> float:
    x, y = polygon.T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


@pytest.mark.parametrize("name", ["kvlcc2", "guan2014_own", "guan2014_target"])
def test_sections_integrate_to_the_volume(name: str) -> None:
    """Simpson's rule between the levels, where sections grow with the square of the height."""
    mesh = hull(name)
    levels = np.unique(mesh.vertices[:, 2])
    volume = 0.0
    for top, bottom in pairwise(levels):
        areas = [area(cut_section(mesh, z)) for z in (top, 0.5 * (top + bottom), bottom)]
        volume += (bottom - top) / 6.0 * (areas[0] + 4.0 * areas[1] + areas[2])
    assert volume == pytest.approx(mesh.volume, rel=1e-9)
    assert area(cut_section(mesh, 0.0)) > 0.0  # corners in the order of rising angle


def test_the_contact_height_is_the_lower_one() -> None:
    assert find_contact_height(hull("kvlcc2"), hull("guan2014_own")) == pytest.approx(20.8 - 30.0)


@pytest.mark.parametrize(
    ("x", "side", "point", "normal"),
    [
        (10.0, "starboard", (10.0, 10.0), pi / 2), (10.0, "port", (10.0, -10.0), -pi / 2),
        (50.0, "port", (50.0, 0.0), 0.0), (99.0, "starboard", (50.0, 0.0), 0.0), (-50.0, "port", (-50.0, 0.0), pi),
    ],
)  # fmt: skip
def test_places_of_a_box(x: float, side: str, point: tuple[float, float], normal: float) -> None:
    found = locate_place(BOX, x, side)  # type: ignore[arg-type]  # one of Side
    assert tuple(found.point) == point
    assert [cos(n) for n in found.normals] == pytest.approx([cos(normal)] * 2, abs=1e-12)
    assert [sin(n) for n in found.normals] == pytest.approx([sin(normal)] * 2, abs=1e-12)


def test_the_stem_has_the_normals_of_both_bows() -> None:
    outline = cut_section(hull("kvlcc2"), 0.0)
    stem = locate_place(outline, 500.0, "port")
    assert stem.point[1] == pytest.approx(0.0, abs=1e-6)
    first, last = stem.normals
    assert first == pytest.approx(-last)
    assert 0.5 < last < 1.5
    assert stem.nearest_normal(0.1) == pytest.approx(0.1)
    assert stem.nearest_normal(2.0) == pytest.approx(last)
    assert stem.nearest_normal(-2.0 - 2 * pi) == pytest.approx(first)


def test_a_box_that_touches_with_its_face_is_centred_on_the_place() -> None:
    """At right angles the flat bow lies against the side: its middle is at the place."""
    found = find_contacts(locate_place(BOX, 7.0, "starboard"), BOX, -pi / 2)[0]
    np.testing.assert_allclose(found.position, [7.0, 60.0], atol=1e-9)
    np.testing.assert_allclose(found.normals[0], [0.0, 1.0], atol=1e-12)
    np.testing.assert_allclose(found.point, [50.0, 0.0], atol=1e-9)


@pytest.mark.parametrize(("own", "target"), [("kvlcc2", "guan2014_target"), ("guan2014_own", "kvlcc2")])
def test_hulls_touch_at_the_place_and_nowhere_overlap(own: str, target: str) -> None:
    meshes = hull(own), hull(target)
    deck = find_contact_height(*meshes)
    a, b = cut_section(meshes[0], deck), cut_section(meshes[1], deck)
    for s, side, degrees in product((-0.5, -0.4, -0.1, 0.3, 0.45, 0.5), ("port", "starboard"), range(0, 360, 15)):
        heading = radians(degrees)
        struck = locate_place(b, s * load_ship(target).L_oa, side)  # type: ignore[arg-type]  # one of Side
        found = find_contacts(struck, a, heading)[0]
        theirs = move_polygon(a, found.position, heading)
        assert measure_gap(theirs, b) == pytest.approx(0.0, abs=1e-6)
        there = move_polygon(found.point[None], found.position, heading)[0]
        assert np.linalg.norm(there - struck.point) < 1e-6
        for normal in found.normals:  # every one separates them
            assert (b @ normal).max() <= (theirs @ normal).min() + 1e-6


def test_gap_is_a_distance_apart_and_negative_in_overlap() -> None:
    assert measure_gap(BOX, BOX + [0.0, 25.0]) == pytest.approx(5.0)
    assert measure_gap(BOX, BOX + [0.0, 17.0]) == pytest.approx(-3.0)
    assert measure_gap(BOX, BOX + [99.0, 19.0]) == pytest.approx(-1.0)
