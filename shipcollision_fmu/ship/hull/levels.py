"""The level polygons of a hull from a few numbers; hull.py has the drawing and the formulas.

All levels have the corners of the deck's polygon, each of whose edges is moved inwards, parallel to itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, tan

import numpy as np
import numpy.typing as npt

from ..frames import Array
from ..tables.hull import HullTable

__all__ = ["Level", "draw_levels", "has_every_edge"]

BOW_EDGES = 12
"""Edges of the waterline from shoulder to stem, per side: a chord error of B/2 / (4 x 12^2), about 4 cm on 50 m."""
STERN_EDGES = 6

Level = tuple[float, float, float, float]
"""z, shift aft of the bow, inward offset of the bow, inward offset of all but the transom [m]."""


@dataclass(frozen=True)
class Plan:
    """Convex deck polygon, from the stem along starboard and back along port, and what each edge belongs to."""

    corners: Array  # (n, 2)
    is_bow: npt.NDArray[np.bool_]  # (n,) edge i runs from corner i to corner i + 1
    is_transom: npt.NDArray[np.bool_]


def draw_levels(L_oa: float, B: float, T: float, table: HullTable) -> tuple[Plan, list[Level], list[Array]]:
    """The polygon of the deck, the levels from keel to deck, and the corners (n, 3) of each."""
    if table.shape == "box":
        plan, levels = _draw_box(L_oa, B), [(T, 0.0, 0.0, 0.0), (T - table.depth, 0.0, 0.0, 0.0)]
    else:
        plan, levels = _draw_ship(L_oa, B, table), _place_levels(T, table)
    return plan, levels, [_offset_ring(plan, z, rake, flare, bilge) for z, rake, flare, bilge in levels]


def has_every_edge(L_oa: float, B: float, T: float, table: HullTable) -> bool:
    """Whether every level has all edges of the deck, each of a length above zero."""
    plan, _, rings = draw_levels(L_oa, B, T, table)
    return min(float(_measure_edges(ring, plan).min()) for ring in rings) > 0.0


def _draw_box(L: float, B: float) -> Plan:
    x, y = L / 2, B / 2
    corners = np.array([[x, -y], [x, y], [-x, y], [-x, -y]])
    return Plan(corners, np.zeros(4, bool), np.zeros(4, bool))


def _draw_ship(L_oa: float, B: float, table: HullTable) -> Plan:
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
    return Plan(np.vstack([starboard, port]), (i < bow_edges) | (i >= 2 * n - 1 - bow_edges), i == n - 1)


def _place_levels(T: float, table: HullTable) -> list[Level]:
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


def _offset_ring(plan: Plan, z: float, rake: float, flare: float, bilge: float) -> Array:
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


def _measure_edges(ring: Array, plan: Plan) -> Array:
    """Signed length of each edge along the deck's edge: not positive when an edge has vanished."""
    edges = np.roll(plan.corners, -1, axis=0) - plan.corners
    ours = (np.roll(ring, -1, axis=0) - ring)[:, :2]
    lengths: Array = np.einsum("ij,ij->i", edges, ours) / np.linalg.norm(edges, axis=1)
    return lengths
