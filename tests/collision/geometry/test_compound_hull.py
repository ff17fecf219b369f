"""Convex parts of one hull are joined: nothing inside a hull gives a contact, and a face in pieces is one face."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision import bodies
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.geometry.compound_hull import CompoundHull
from shipcollision_fmu.collision.geometry.detection import Detector
from shipcollision_fmu.ship.hull.convex import half_spaces
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.tables.hull import HullTable

BOX = HullTable(shape="box", depth=20.0)
HIGH = HullTable(shape="box", depth=26.0)
WEDGE = HullTable(shape="parametric", depth=20.0, bow_length=40.0, bow_exponent=1.5, stern_length=50.0)
FLARED = HullTable(shape="parametric", depth=20.0, bow_length=40.0, stern_length=50.0, flare_deg=8.0)
PIECES = 5


def hull(table: HullTable) -> HullMesh:
    return build_hull(200.0, 30.0, 10.0, table)


def in_pieces(cuts: Sequence[float]) -> HullMesh:
    """The box hull, cut across at the stations x = cuts [m]."""
    whole = hull(BOX)
    stations = sorted([-100.0, *cuts, 100.0])
    parts, planes = [], []
    for aft, fore in pairwise(stations):
        part = whole.vertices.copy()
        part[:, 0] = np.where(part[:, 0] > 0.0, fore, aft)
        parts.append(part)
        planes.append(half_spaces(part, whole.triangles))
    return HullMesh(whole.vertices, whole.triangles, tuple(parts), tuple(planes))


FIVE = in_pieces([-60.0, -20.0, 20.0, 60.0])


def as_one_part(mesh: HullMesh) -> HullMesh:
    """The convex hull of a hull: the same solid where the knuckle is not involved."""
    return HullMesh(mesh.vertices, mesh.triangles, (mesh.vertices,))


def state(x: float, y: float, z: float = 0.0, heading: float = 0.0) -> BodyState:
    return BodyState.at(np.array([x, y, z]), np.array([0.0, 0.0, heading]), np.zeros(6), np.eye(6))


WEST = -np.pi / 2
Pair = Callable[[HullMesh, HullMesh], Detector]


@pytest.fixture
def pair() -> Iterator[Pair]:
    made: list[Detector] = []

    def make(one: HullMesh, other: HullMesh) -> Detector:
        made.append(Detector([one, other]))
        return made[-1]

    yield make
    for detector in made:
        detector.narrow_phase.close()


def touch(
    detector: Detector, one: BodyState, other: BodyState, last_normals: dict[Any, Any] | None = None
) -> list[list[float]]:
    """Contacts as rows (point, normal, gap), sorted."""
    contacts = detector.contacts(0, 1, [one, other], {} if last_normals is None else last_normals)
    return sorted([*np.round(c.point, 9).tolist(), *np.round(c.normal, 9).tolist(), c.gap] for c in contacts)


# -- geometry ---------------------------------------------------------------------------------------


def test_joints_are_no_outer_faces() -> None:
    joined = CompoundHull(FIVE)
    assert sorted(len(joined.outer_normals(i)) for i in range(PIECES)) == [4, 4, 4, 5, 5]
    flared = CompoundHull(hull(FLARED))
    assert not any(np.allclose(n, [0, 0, -1]) for n in flared.outer_normals(0))  # the lower part has no deck
    assert not any(np.allclose(n, [0, 0, 1]) for n in flared.outer_normals(1))  # nor the upper one a keel


def test_the_parts_of_a_hull_are_joined_once(pair: Pair) -> None:
    """Two models of the same ship share what is worked out of its hull; another hull has its own."""
    one, other = pair(FIVE, FIVE), pair(FIVE, hull(FLARED))
    (first, second), (third, flared) = one._compounds, other._compounds
    assert first is second is third
    assert flared is not first
    assert len(flared.parts) == 2


@pytest.mark.one_in(3)
@pytest.mark.parametrize("x", [-60.0, -59.99, -20.3, 0.0, 19.999, 20.001, 20.2, 59.5, 60.0])
@pytest.mark.parametrize("depth", [0.01, 0.3])
def test_a_stem_on_a_side_in_pieces_touches_it_as_on_one_box(pair: Pair, x: float, depth: float) -> None:
    """Near a joint the least way out of one piece is along the side, through its neighbour."""
    where = state(0, 0), state(x, 115.0 - depth, z=3.0, heading=WEST)
    whole, pieces = (touch(pair(solid, hull(WEDGE)), *where) for solid in (hull(BOX), FIVE))
    assert len(whole) == 2
    np.testing.assert_allclose(pieces, whole, atol=1e-6)


@pytest.mark.parametrize("x", [-20.0, 0.0, 33.0])
def test_side_on_side_gives_the_corners_of_the_common_area_only(pair: Pair, x: float) -> None:
    where = state(0, 0), state(x, 29.95, z=2.0)
    expected = touch(pair(hull(BOX), hull(BOX)), *where)
    assert len(expected) == 4
    for one, other in ((FIVE, hull(BOX)), (hull(BOX), FIVE), (FIVE, FIVE), (FIVE, in_pieces([0.0, 50.0]))):
        np.testing.assert_allclose(touch(pair(one, other), *where), expected, atol=1e-6)


def test_a_corner_on_a_side_in_pieces_touches_it_as_on_one_box(pair: Pair) -> None:
    """From the middle of a piece to beyond its joint: the normal stays that of the side."""
    heading = np.radians(40.0)
    corner = np.array(
        [-100.0 * np.cos(heading) + 15.0 * np.sin(heading), -100.0 * np.sin(heading) - 15.0 * np.cos(heading)]
    )
    whole, pieces = pair(hull(BOX), hull(BOX)), pair(FIVE, hull(BOX))
    for x in np.linspace(15.0, 25.0, 21):
        where = state(0, 0), state(x - corner[0], 14.97 - corner[1], heading=heading)
        expected = touch(whole, *where)
        np.testing.assert_allclose([row[3:6] for row in expected], [[0, 1, 0]] * len(expected), atol=1e-6)
        np.testing.assert_allclose(touch(pieces, *where), expected, atol=1e-6)


def test_deep_overlap_is_that_of_one_box(pair: Pair) -> None:
    """The last normal is that of the side, and pieces that lie inside have no contact of their own."""
    results = []
    for solid in (hull(BOX), FIVE):
        detector, last_normals = pair(solid, hull(WEDGE)), {}
        for depth in (0.2, 0.45, 1.0, 3.0):
            rows = touch(detector, state(0, 0), state(20.05, 115.0 - depth, heading=WEST), last_normals)
        results.append(rows)
    np.testing.assert_allclose(results[1], results[0], atol=1e-6)


def test_parts_without_planes_stand_for_themselves() -> None:
    loose = CompoundHull(HullMesh(FIVE.vertices, FIVE.triangles, FIVE.parts))
    assert loose.whole
    assert loose.supports(1, np.array([-60.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]))
    joined = CompoundHull(FIVE)
    assert not joined.supports(1, np.array([-60.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0]))


# -- impacts ----------------------------------------------------------------------------------------


@pytest.fixture
def sailed(make_ship: Callable[..., str], world: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Sails ships whose hulls are given as solids; returns the world after it."""

    def sail(solids: list[HullMesh], start: list[dict[str, Any]], duration: float, **parameters: float) -> Any:
        ships = [make_ship(f"ship{i}", hull='shape = "box"\ndepth = 20.0') for i in range(len(solids))]
        waiting = list(solids)
        monkeypatch.setattr(bodies, "build_hull", lambda *_: waiting.pop(0))
        return world(ships, start, degrees_of_freedom=3, **parameters).run(duration, 0.05)

    return sail


@pytest.mark.slow
def test_a_stem_slides_along_five_pieces_as_along_one(sailed: Any) -> None:
    """Pressed on the side while it slides 60 m across two joints, without friction: no impulse along the side."""
    start = [
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (-30.0, 115.0, 0), "attitude": (0, 0, WEST), "nu": (0.05, 6.0, 0, 0, 0, 0)},
    ]
    worlds = [sailed([solid, hull(WEDGE)], start, 10.0, friction=0.0, restitution=0.0) for solid in (hull(BOX), FIVE)]
    whole, pieces = (np.array(w.model.outputs.ships[0].impulse) for w in worlds)
    assert whole[1] < -1e5
    np.testing.assert_allclose(pieces, whole, rtol=0.01, atol=1e-6 * abs(whole[1]))
    assert abs(pieces[0]) < 1e-5 * abs(pieces[1])  # along the side
    assert worlds[1].x[1][0] > 20.0  # both joints are behind it
    assert worlds[1].model.outputs.collision_count == worlds[0].model.outputs.collision_count


@pytest.mark.parametrize("friction", [pytest.param(0.0, marks=pytest.mark.slow), 0.3])
def test_a_corner_scrapes_along_five_pieces_as_along_one(sailed: Any, friction: float) -> None:
    start = [
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (30.0, 115.0, 0), "attitude": (0, 0, WEST + 0.4), "nu": (1.0, -4.0, 0, 0, 0, 0)},
    ]
    worlds = [sailed([s, hull(BOX)], start, 12.0, friction=friction, restitution=0.0) for s in (hull(BOX), FIVE)]
    whole, pieces = (np.concatenate(w.nu) for w in worlds)
    assert np.abs(whole[:6]).max() > 1e-3
    np.testing.assert_allclose(pieces, whole, rtol=0.01, atol=1e-4 * np.abs(whole).max())


def test_flare_that_does_not_touch_at_its_knuckle_is_one_part(sailed: Any) -> None:
    """The deck edge of a flared bow strikes a higher side: two parts and their convex hull move on alike."""
    flared = hull(FLARED)
    assert len(flared.parts) == 2
    start = [
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (20.0, 115.5, 0), "attitude": (0, 0, WEST + 0.2), "nu": (3.0, 0, 0, 0, 0, 0)},
    ]
    worlds = [sailed([hull(HIGH), s], start, 3.0, friction=0.3, restitution=0.1) for s in (flared, as_one_part(flared))]
    in_parts, in_one = (np.concatenate(w.nu) for w in worlds)
    assert np.abs(in_one[:6]).max() > 0.1
    np.testing.assert_allclose(in_parts, in_one, atol=1e-9)


def test_flared_side_on_side_is_one_patch(pair: Pair) -> None:
    """Plumb sides above and below the waterline are one side."""
    where = state(0, 0), state(10.0, 29.96)
    flared = hull(FLARED)
    np.testing.assert_allclose(
        touch(pair(flared, hull(BOX)), *where), touch(pair(as_one_part(flared), hull(BOX)), *where), atol=1e-6
    )


def test_a_box_from_a_mesh_file_is_the_box(
    make_ship: Callable[..., str], world: Callable[..., Any], tmp_path: Path
) -> None:
    """Two boxes collide; the struck one is read from an STL file in millimetres, or is ours."""
    box = hull(BOX)
    corners = (box.vertices * [1000, -1000, -1000])[box.triangles].tolist()
    facets = (f"facet normal 0 0 0\nouter loop\n{vertices(t)}endloop\nendfacet\n" for t in corners)
    (tmp_path / "box.stl").write_text(f"solid box\n{''.join(facets)}endsolid box\n")
    tables = ['shape = "box"\ndepth = 20.0', 'shape = "mesh"\ndepth = 20.0\nfile = "box.stl"\nunit = "mm"']
    start = [
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (20.0, 115.5, 0), "attitude": (0, 0, WEST + 0.2), "nu": (3.0, 0, 0, 0, 0, 0)},
    ]
    after = []
    for k, table in enumerate(tables):
        ships = [make_ship(f"struck{k}", hull=table), make_ship(f"striking{k}", hull=tables[0])]
        after.append(np.concatenate(world(ships, start, friction=0.3, restitution=0.1).run(3.0, 0.05).nu))
    assert np.abs(after[0][:6]).max() > 0.1
    np.testing.assert_allclose(after[1], after[0], atol=1e-9)


def vertices(triangle: list[list[float]]) -> str:
    return "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in triangle)
