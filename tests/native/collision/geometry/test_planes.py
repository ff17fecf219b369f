"""native/collision/geometry: plane features and the broad phase beside their Python twins, on random input."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.contact_frame import contact_axes
from shipcollision_fmu.collision.geometry.broad_phase import near_pairs
from shipcollision_fmu.collision.geometry.clipping import common_corners, convex_polygon
from shipcollision_fmu.collision.geometry.contact_place import contact_manifold, facing_features
from shipcollision_fmu.collision.geometry.plan_overlap import least_overlap
from shipcollision_fmu.ship.frames import Array
from tests.native.collision.kernels import evaluate
from tests.native.comparison import assert_close

MOST = 12


def draw_points(random: np.random.Generator) -> Array:
    """1 to MOST points of a plane: anywhere, on a grid (on one line, twice the same), on a line."""
    count = int(random.integers(1, MOST + 1))
    points = random.normal(0.0, 3.0, (count, 2))
    kind = random.integers(4)
    if kind == 1:
        return np.asarray(np.round(points / 2.0))
    if kind == 2:
        return np.asarray(points[:, :1] * [1.0, 0.5] + random.choice([0.0, 1e-8]) * points + random.integers(2))
    return np.asarray(points + random.choice([0.0, 5.0]))


def fill(points: Array, width: int) -> list[float]:
    """Number of points, and their numbers in a row of that many."""
    return [len(points), *points.ravel(), *[0.0] * (width - points.size)]


def put(points: object, width: int) -> list[float]:
    """What a kernel writes of points: their number, and their numbers; the rest is nan."""
    flat = np.array(points, dtype=float).reshape(-1, 2)
    return [len(flat), *flat.ravel(), *[np.nan] * (width - flat.size)]


def test_polygons_and_their_common_corners() -> None:
    random = np.random.default_rng(1)
    sets = [(draw_points(random), draw_points(random)) for _ in range(800)]
    polygons = [put(convex_polygon(map(tuple, p.tolist())), 2 * MOST) for p, _ in sets]
    found = evaluate("geometry", "polygon", [fill(p, 2 * MOST) for p, _ in sets], 1 + 2 * MOST)
    assert np.array_equal(found, polygons, equal_nan=True)
    corners = [put(common_corners(map(tuple, p.tolist()), map(tuple, q.tolist())), 4 * MOST) for p, q in sets]
    rows = [fill(p, 2 * MOST) + fill(q, 2 * MOST) for p, q in sets]
    assert np.array_equal(evaluate("geometry", "corners", rows, 1 + 4 * MOST), corners, equal_nan=True)
    assert len({row[0] for row in corners}) > 5


def draw_part(random: np.random.Generator, side: float, normal: Array) -> Array:
    """Corners of a part before or behind the origin: in a plane, nearly in a plane, a rod, anywhere."""
    count = int(random.integers(1, MOST + 1))
    points = random.normal(0.0, 2.0, (count, 3))
    flat = points - np.outer(points @ normal, normal) * random.choice([0.0, 1.0, 0.99])
    if random.random() < 0.2:
        flat = np.outer(flat[:, 0], np.cross(normal, [0.3, 0.5, 0.7]))
    return np.asarray(flat + side * random.uniform(-0.2, 1.0) * normal)


def test_contact_manifolds_and_plan_overlaps() -> None:
    random, rows, expected = np.random.default_rng(2), [], []
    for _ in range(500):
        normal = random.normal(0.0, 1.0, 3)
        normal /= np.linalg.norm(normal)
        depth = float(random.choice([0.05, 1.0]))
        a, b = draw_part(random, -1.0, normal), draw_part(random, 1.0, normal)
        rows.append([depth, *normal, *fill(a, 3 * MOST), *fill(b, 3 * MOST)])
        places = contact_manifold(*facing_features(a, b, normal, depth), contact_axes(normal))
        flat = [x for point, gap in places for x in (*point, gap)]
        least, direction, carrier = least_overlap(a, b)
        expected.append([len(places), *flat, *[np.nan] * (16 - len(flat)), least, *direction, carrier])
    found = evaluate("geometry", "manifold", rows, 22)
    assert {row[0] for row in expected} == {0, 1, 2, 3, 4}
    assert_close(found[:, :21], np.array(expected)[:, :21], 1e-12)
    # Two sides of the same direction, one of either plan: rounding decides whose it is.
    assert np.mean(found[:, 21] != np.array(expected)[:, 21]) < 0.01


@pytest.mark.parametrize("count", [1, 20, 64, 65, 300])
def test_near_pairs(count: int) -> None:
    """Ships alone, and among quays of which one is as long as all the harbour."""
    random = np.random.default_rng(count)
    moving = int(random.integers(0, count + 1))
    places = np.round(random.uniform(-4000.0, 4000.0, (count, 2)), -1)
    sizes = random.uniform(10.0, 500.0, (count, 2))
    sizes[-1] = 3e4, 20.0
    rectangles = np.stack([places[:, 0], places[:, 0] + sizes[:, 0], places[:, 1], places[:, 1] + sizes[:, 1]], axis=1)
    expected = near_pairs([tuple(row) for row in rectangles.tolist()], moving)
    found = evaluate("geometry", "near", [[count, moving, *rectangles.ravel()]], 1 + 2 * len(expected) + 2)[0]
    assert found[0] == len(expected)
    assert [tuple(pair) for pair in found[1:-2].reshape(-1, 2).tolist()] == expected
    assert np.isnan(found[-2:]).all()
