"""The hull of a ship from a few numbers: a closed mesh, and the convex parts that contact detection works on.

A hull is a stack of level polygons whose corresponding edges are parallel. Then every face of the shell is plane, a
change of an edge's distance with height is rake, flare or bilge, and where these distances are concave in height the
stack is convex:

            deck      z = T - depth        plan of the deck (x forward, y starboard)
            waterline z = 0
            bilge     z = T - bilge          transom |‾‾‾‾stern‾‾‾‾‾ midbody ‾‾‾‾‾ bow ‾‾>  stem
            keel      z = T

    bow     y = B/2 (1 - s^p),                       s = 0 at the end of the midbody, 1 at the stem
    stern   y = B/2 (1 - (1 - transom_fraction) s^p),  s = 0 at the midbody, 1 at the transom
    rake    the bow edges shift aft by tan(stem_rake) per metre below the deck
    flare   the bow edges move inwards by tan(flare) per metre from the deck down to the waterline
    bilge   all edges but the transom move inwards by `bilge` at the keel, over the height `bilge`

A hull from a user's own mesh file is made in mesh.py. Frame b about CO [m]. Every triangle's normal points outwards.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from ...errors import ShipError
from ..file_stamp import digest_content
from ..frames import Array
from ..tables.hull import HullTable
from .convex import Indices, half_spaces
from .levels import Level, draw_levels
from .room_for_the_bow import describe_lack_of_room
from .solid import HullMesh

__all__ = ["HULLS_KEPT", "build_hull"]

HULLS_KEPT = 32
"""Hulls that are kept in memory. With fewer than a run has ships, a mesh is read and cut again for every use."""


@dataclass(frozen=True)
class _Form:
    """What a hull is built from, compared by its numbers and by the content of the mesh file."""

    L_oa: float
    B: float
    T: float
    table: HullTable = field(compare=False)
    key: str  # the table's text
    digest: str  # of the mesh file


def build_hull(L_oa: float, B: float, T: float, table: HullTable) -> HullMesh:
    """Hull of a ship of length over all L_oa, breadth B, draught T [m] in the shape that `table` describes.

    The same content gives the same hull, whose arrays are read-only. Raises ShipError when the shape's parameters
    exclude each other, or the mesh is refused.
    """
    digest = ""
    if table.file is not None:
        try:
            digest = digest_content(Path(table.file))
        except OSError:  # build_mesh_hull refuses the file by name
            return _build(L_oa, B, T, table)
    return _build_once(_Form(L_oa, B, T, table, table.model_dump_json(), digest))


@lru_cache(maxsize=HULLS_KEPT)
def _build_once(form: _Form) -> HullMesh:
    hull = _build(form.L_oa, form.B, form.T, form.table)
    for array in (hull.vertices, hull.triangles, *hull.parts, *hull.planes):
        array.flags.writeable = False
    return hull


def _build(L_oa: float, B: float, T: float, table: HullTable) -> HullMesh:
    if table.shape == "mesh":
        from .mesh import build_mesh_hull

        return build_mesh_hull(L_oa, B, T, table)
    plan, levels, rings = draw_levels(L_oa, B, T, table)
    if table.shape == "parametric" and (lack := describe_lack_of_room(L_oa, B, T, table)):
        raise ShipError(lack)
    vertices = np.vstack(rings) + [table.trim_x, 0.0, 0.0]
    n = len(plan.corners)
    parts = _join_convex_bands(vertices, rings, levels)
    planes = tuple(half_spaces(part, _connect_rings(len(part) // n, n)) for part in parts)
    return HullMesh(vertices, _connect_rings(len(rings), n), parts, planes)


def _connect_rings(levels: int, n: int) -> Indices:
    """Shell between consecutive rings, bottom and deck; outward normals (z down, rings from the keel up)."""
    shell = []
    for level in range(levels - 1):
        for i in range(n):
            a, b = level * n + i, level * n + (i + 1) % n
            c, d = a + n, b + n
            shell += [(a, d, b), (a, c, d)]
    top = (levels - 1) * n
    bottom = [(0, i, i + 1) for i in range(1, n - 1)]
    deck = [(top, top + i + 1, top + i) for i in range(1, n - 1)]
    return np.array(shell + bottom + deck, dtype=np.int64)


def _join_convex_bands(vertices: Array, rings: list[Array], levels: list[Level]) -> tuple[Array, ...]:
    """Bands of levels joined while convex together: only a flare's knuckle at the waterline splits the hull."""
    n = len(rings[0])
    knuckle = [len(levels) - 2] if len(levels) > 2 and levels[-2][0] == 0.0 else []
    bounds = [0, *knuckle, len(levels) - 1]
    return tuple(vertices[start * n : (end + 1) * n] for start, end in pairwise(bounds))
