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
from math import radians, tan
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...errors import ShipError
from ..file_stamp import digest_content
from ..frames import Array
from ..tables.hull import HullTable
from .convex import Indices, half_spaces
from .solid import HullMesh

__all__ = ["build_hull"]

BOW_EDGES = 12
"""Edges of the waterline from shoulder to stem, per side: a chord error of B/2 / (4 x 12^2), about 4 cm on 50 m."""
STERN_EDGES = 6

HULLS_KEPT = 32
"""Hulls that are kept in memory. With fewer than a run has ships, a mesh is read and cut again for every use."""


@dataclass(frozen=True)
class _Plan:
    """Convex deck polygon, from the stem along starboard and back along port, and what each edge belongs to."""

    corners: Array  # (n, 2)
    is_bow: npt.NDArray[np.bool_]  # (n,) edge i runs from corner i to corner i + 1
    is_transom: npt.NDArray[np.bool_]


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
    if table.shape == "box":
        plan, levels = _draw_box(L_oa, B), [(T, 0.0, 0.0, 0.0), (T - table.depth, 0.0, 0.0, 0.0)]
    else:
        plan, levels = _draw_ship(L_oa, B, table), _place_levels(T, table)
    rings = [_offset_ring(plan, z, rake, flare, bilge) for z, rake, flare, bilge in levels]
    if min(_measure_edges(ring, plan).min() for ring in rings) <= 0.0:
        raise ShipError(
            f"[hull]: rake, flare and bilge leave no room for the bow: bow_length = {table.bow_length} m, "
            f"stem_rake_deg = {table.stem_rake_deg}, flare_deg = {table.flare_deg}, bilge = {table.bilge} m; lengthen "
            "the bow or reduce them"
        )
    vertices = np.vstack(rings) + [table.trim_x, 0.0, 0.0]
    n = len(plan.corners)
    parts = _join_convex_bands(vertices, rings, levels)
    planes = tuple(half_spaces(part, _connect_rings(len(part) // n, n)) for part in parts)
    return HullMesh(vertices, _connect_rings(len(rings), n), parts, planes)


def _draw_box(L: float, B: float) -> _Plan:
    x, y = L / 2, B / 2
    corners = np.array([[x, -y], [x, y], [-x, y], [-x, -y]])
    return _Plan(corners, np.zeros(4, bool), np.zeros(4, bool))


def _draw_ship(L_oa: float, B: float, table: HullTable) -> _Plan:
    """Deck polygon: from the stem along starboard to the transom and back along port."""
    straight = table.transom_fraction == 1.0  # collinear edges would have no corner between them
    bow_edges = 1 if table.bow_exponent == 1.0 else BOW_EDGES
    stern_edges = 0 if straight else 1 if table.stern_exponent == 1.0 else STERN_EDGES
    s = np.linspace(0.0, 1.0, bow_edges + 1)
    bow = np.column_stack([L_oa / 2 - table.bow_length * (1 - s), B / 2 * (1 - s**table.bow_exponent)])
    s = np.linspace(0.0, 1.0, stern_edges + 1) if not straight else np.array([1.0])
    narrowing = (1 - table.transom_fraction) * s**table.stern_exponent
    stern = np.column_stack([-L_oa / 2 + table.stern_length * (1 - s), B / 2 * (1 - narrowing)])
    starboard = np.vstack([bow[::-1], stern])  # from the stem (y = 0) to the transom's corner
    port = starboard[:0:-1] * [1, -1]  # back again, without the stem
    n = len(starboard)
    i = np.arange(2 * n - 1)
    return _Plan(np.vstack([starboard, port]), (i < bow_edges) | (i >= 2 * n - 1 - bow_edges), i == n - 1)


def _place_levels(T: float, table: HullTable) -> list[tuple[float, float, float, float]]:
    """(z, shift aft of the bow, inward offset of the bow, inward offset of all but the transom) from keel to deck."""
    z_deck = T - table.depth
    rake, flare = tan(radians(table.stem_rake_deg)), tan(radians(table.flare_deg))
    heights = [(T, table.bilge)]
    if table.bilge > 0:
        heights.append((T - table.bilge, 0.0))
    if flare > 0:
        heights.append((0.0, 0.0))
    heights.append((z_deck, 0.0))
    return [(z, (z - z_deck) * rake, (min(z, 0.0) - z_deck) * flare, bilge) for z, bilge in heights]


def _offset_ring(plan: _Plan, z: float, rake: float, flare: float, bilge: float) -> Array:
    """Corners of the level at z, (n, 3): the deck's edges moved inwards and intersected again."""
    edges = np.roll(plan.corners, -1, axis=0) - plan.corners
    normal = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    inwards = plan.is_bow * (rake * normal[:, 0] + flare) + np.where(plan.is_transom, 0.0, bilge)
    reach = np.einsum("ij,ij->i", normal, plan.corners) - inwards
    before = np.roll(normal, 1, axis=0)
    corners = np.linalg.solve(
        np.stack([before, normal], axis=1), np.stack([np.roll(reach, 1), reach], axis=1)[..., None]
    )
    return np.column_stack([corners[..., 0], np.full(len(corners), z)])


def _measure_edges(ring: Array, plan: _Plan) -> Array:
    """Signed length of each edge along the deck's edge: not positive when an edge has vanished."""
    edges = np.roll(plan.corners, -1, axis=0) - plan.corners
    ours = (np.roll(ring, -1, axis=0) - ring)[:, :2]
    lengths: Array = np.einsum("ij,ij->i", edges, ours) / np.linalg.norm(edges, axis=1)
    return lengths


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


def _join_convex_bands(
    vertices: Array, rings: list[Array], levels: list[tuple[float, float, float, float]]
) -> tuple[Array, ...]:
    """Bands of levels joined while convex together: only a flare's knuckle at the waterline splits the hull."""
    n = len(rings[0])
    knuckle = [len(levels) - 2] if len(levels) > 2 and levels[-2][0] == 0.0 else []
    bounds = [0, *knuckle, len(levels) - 1]
    return tuple(vertices[start * n : (end + 1) * n] for start, end in pairwise(bounds))
