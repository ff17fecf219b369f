"""Surfaces with the light that reaches each corner, cut finer where it changes within a triangle."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from hashlib import blake2b
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from ...ship.hull.convex import Indices
from .shade import CELL, UNLIT, Shade, cast_shade
from .solids import Shape
from .surface import Surface, compute_corner_normals, drop_flat_triangles

__all__ = ["Corners", "find_face_shares", "is_shaded", "shade_ship", "shade_surface"]

OUTSIDE = ("topsides", "stripe", "boot-top", "naval", "livery")
"""First words of paints of the outside of a hull, which nothing is near."""

CUT = ("deck", "deck-red", "deck-grey", "house", "grey", "hatch", "bulwark")
"""Paints of large plane faces, which are cut finer: shade is interpolated between the corners of a triangle."""
PASSES = 4
"""Greatest number of times that an edge is halved."""
STEP = 0.15
"""Change of the light within an edge, against the mean of its ends, from which it is halved."""
SHORTEST = 2.0
"""[m] Least length of an edge that is halved, where cells have half a metre."""
LONGEST = 40.0
"""[m] Length from which edges are halved in any case, so that nothing is missed between their ends and middle."""
INSET = 1.2
"""Distance from a corner, in cells, at which its light is found: at the corner itself, other faces are too near."""
MOST_KEPT = 8
"""Ships whose light is kept, some hundred kB each. To find it takes half a second."""


class Corners(NamedTuple):
    """Vertices (n, 3), normals (n, 3), share of the light (n,), and triangles (m, 3)."""

    vertices: Array
    normals: Array
    shares: Array
    triangles: Indices


def is_shaded(paint: str) -> bool:
    """Whether a paint has ambient occlusion."""
    return paint not in UNLIT and not paint.startswith(OUTSIDE)


_kept: OrderedDict[bytes, list[Corners | None]] = OrderedDict()


def shade_ship(shapes: Sequence[Shape], breadth: float) -> list[Corners | None]:
    """The shapes of a ship of that breadth [m], each with its light; None for one that has none.

    Ships that look the same share what was found, in one scene and in those that come after it.
    """
    key = _digest(shapes, breadth)
    if key not in _kept:
        shade = cast_shade(shapes, breadth)
        _kept[key] = [
            shade_surface(surface, shade, paint in CUT) if is_shaded(paint) and len(surface.triangles) else None
            for paint, surface in shapes
        ]
    _kept.move_to_end(key)
    while len(_kept) > MOST_KEPT:
        _kept.popitem(last=False)
    return _kept[key]


def find_face_shares(surface: Surface, shade: Shade) -> Array:
    """Share of the light (m,) of each triangle as a whole, for pictures that have one colour for each."""
    solid = surface.vertices[surface.triangles]
    across = np.cross(solid[:, 1] - solid[:, 0], solid[:, 2] - solid[:, 0])
    size = np.linalg.norm(across, axis=1, keepdims=True)
    normals = np.where(size > 1e-9, across / np.maximum(size, 1e-9), [0.0, 0.0, -1.0])
    shares: Array = _find_shares(solid, solid, np.repeat(normals[:, None], 3, axis=1), shade).mean(axis=1)
    return shares


def shade_surface(surface: Surface, shade: Shade, is_cut: bool) -> Corners:
    """The surface with its light; corners with the same place and normal are one, with the mean of their light."""
    solid = drop_flat_triangles(surface)
    places, normals = solid.vertices[solid.triangles], compute_corner_normals(solid)
    for _ in range(PASSES if is_cut else 0):
        halved = _choose_edges(places, normals, shade)
        if not halved.any():
            break
        places, normals = _halve(places, normals, halved)
    shares = _find_shares(places, places, normals, shade)
    _, first, place = np.unique(
        np.round(np.concatenate([places, normals], axis=2).reshape(-1, 6), 6),
        axis=0, return_index=True, return_inverse=True,
    )  # fmt: skip
    place = place.reshape(-1)
    mean = np.bincount(place, shares.reshape(-1)) / np.bincount(place)
    return Corners(
        places.reshape(-1, 3)[first], normals.reshape(-1, 3)[first], mean, place.reshape(-1, 3).astype(np.int64)
    )


def _digest(shapes: Sequence[Shape], breadth: float) -> bytes:
    """Of all that the light of a ship depends on."""
    sizes = [(paint, len(surface.vertices), len(surface.triangles)) for paint, surface in shapes]
    digest = blake2b(repr((breadth, sizes)).encode())
    for _, surface in shapes:
        digest.update(np.ascontiguousarray(surface.vertices).tobytes())
        digest.update(np.ascontiguousarray(surface.triangles).tobytes())
    return digest.digest()


def _find_shares(places: Array, triangles: Array, normals: Array, shade: Shade) -> Array:
    """Shares (m, 3) at places (m, 3, 3) of triangles (m, 3, 3), a little within them."""
    inwards = triangles.mean(axis=1, keepdims=True) - places
    length = np.linalg.norm(inwards, axis=2, keepdims=True)
    points = places + inwards * np.minimum(1.0, INSET * shade.cell / np.maximum(length, 1e-9))
    return shade.find_share(points.reshape(-1, 3), normals.reshape(-1, 3)).reshape(-1, 3)


def _choose_edges(places: Array, normals: Array, shade: Shade) -> npt.NDArray[np.bool_]:
    """Edges (m, 3), from corner k to k + 1, that are to be halved; the same in both triangles of an edge."""
    ends = np.roll(places, -1, axis=1)
    length = np.linalg.norm(ends - places, axis=2) * CELL / shade.cell
    long = length > SHORTEST
    halved = np.zeros(long.shape, dtype=bool)
    rows = long.any(axis=1)
    at_corners = _find_shares(places[rows], places[rows], normals[rows], shade)
    middle, upright = _find_middles(places[rows], normals[rows])
    at_middles = _find_shares(middle, places[rows], upright, shade)
    change = np.abs(at_middles - 0.5 * (at_corners + np.roll(at_corners, -1, axis=1)))
    halved[rows] = long[rows] & ((change > STEP) | (length[rows] > LONGEST))
    # An edge of one triangle alone is the border of the surface, where another paint begins: it stays whole.
    _, number = np.unique(np.round(places.reshape(-1, 3), 5), axis=0, return_inverse=True)
    a = number.reshape(-1, 3)
    b = np.roll(a, -1, axis=1)
    _, edge, count = np.unique(
        np.minimum(a, b) * len(number) + np.maximum(a, b), return_inverse=True, return_counts=True
    )
    chosen = np.bincount(edge.reshape(-1), halved.reshape(-1)) > 0
    result: npt.NDArray[np.bool_] = (chosen & (count > 1))[edge.reshape(-1)].reshape(-1, 3)
    return result


def _find_middles(places: Array, normals: Array) -> tuple[Array, Array]:
    middle = 0.5 * (places + np.roll(places, -1, axis=1))
    upright = normals + np.roll(normals, -1, axis=1)
    return middle, upright / np.linalg.norm(upright, axis=2, keepdims=True)


_PARTS = {0: ((0, 1, 2),), 1: ((0, 3, 2), (3, 1, 2)), 2: ((3, 1, 4), (0, 3, 4), (0, 4, 2)),
          3: ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))}  # fmt: skip
"""Parts of a triangle of which the first k edges are halved: corners 0 to 2, middles 3 to 5."""


def _halve(places: Array, normals: Array, halved: npt.NDArray[np.bool_]) -> tuple[Array, Array]:
    """Triangles whose chosen edges are halved."""
    found = []
    for count, parts in _PARTS.items():
        rows = np.flatnonzero(halved.sum(axis=1) == count)
        # Turned so that the chosen edges come first.
        start = (
            halved[rows].argmax(axis=1) if count == 1 else (halved[rows].argmin(axis=1) + 1) % 3 if count == 2 else 0
        )
        turn = (np.reshape(start, (-1, 1)) + np.arange(3)) % 3 + np.zeros((len(rows), 1), dtype=np.int64)
        p, n = places[rows[:, None], turn], normals[rows[:, None], turn]
        middle, upright = _find_middles(p, n)
        both = np.concatenate([np.concatenate([p, n], axis=2), np.concatenate([middle, upright], axis=2)], axis=1)
        found += [both[:, list(part)] for part in parts]
    joined = np.concatenate(found)
    return joined[..., :3], joined[..., 3:]
