"""The hull as drawn: plating by paint, forecastle, bulwark, deck with sheer, rudder and propeller, marks.

    above the deck       sheer, forecastle and bulwark rise on the deck's edge, not beyond it
    deck to waterline    the surface that touches, by hull_rings.py, but for the ends, by hull_ends.py
    below the waterline  within the hull that touches, by hull_lines.py

A hull of another shape (a box, a user's mesh) is drawn as it is, in bands.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from ...ship.frames import Array
from .hull_lines import FROM, POST, RUN, UnderwaterLines
from .hull_rings import HullRings
from .ship_style import Style
from .solids import Shape, join_shapes, join_surfaces, mirror_surface
from .surface import Surface, cut_into_bands, drop_flat_triangles

__all__ = ["WeatherDeck", "cut_bare_hull", "make_shell"]

UNDER = (0.06, FROM, 0.17, 0.24, 0.32, 0.42, 0.52, 0.61, 0.68, 0.75, 0.83, 0.90, 0.95, 0.98, 1.0)
"""Shares of the depth at which the hull is drawn under water."""
GAP = 0.02
"""[m] Distance of two sections at a step."""
CLOSE = 0.004
"""Least distance of two rows of the side, over the freeboard."""
SAME = 5e-4
"""Sections closer than this are one, but for the two at the stern post, in corner numbers. Closer ones would leave
holes in single precision."""
BOOT_TOP = (0.10, 0.025)
"""Upper and lower edge of the boot topping above the load line, over T."""


STRIPE = (0.10, 0.17)
"""Upper and lower edge of a stripe, over the height from the boot topping to the deck."""


@dataclass(frozen=True, eq=False)
class WeatherDeck:
    """The deck as drawn, on which fittings stand: edge (m, 2) from the stem to the transom, heights by station."""

    rings: HullRings
    style: Style

    @cached_property
    def aft(self) -> float:
        """Station of the after end [m]."""
        return float(self.rings.edge[-1, 0])

    @cached_property
    def fore(self) -> float:
        """Station of the stem [m]."""
        return float(self.rings.edge[0, 0])

    @cached_property
    def length(self) -> float:
        """Length of the deck [m]."""
        return self.fore - self.aft

    @cached_property
    def breadth(self) -> float:
        """Greatest breadth [m]."""
        return 2.0 * float(self.rings.edge[:, 1].max())

    @property
    def z(self) -> float:
        """Height of the deck amidships [m], negative."""
        return self.rings.z_deck

    @cached_property
    def unit(self) -> float:
        """Scale of all things made for people: 1 on ships broader than 9 m."""
        return min(1.0, self.breadth / 9.0)

    @cached_property
    def forecastle(self) -> float:
        """Station at which the forecastle begins [m]."""
        return self.fore - self.style.forecastle_length * self.length

    def half_breadth(self, x0: float, x1: float) -> float:
        """Least half breadth between x0 and x1 [m]: at the ends, for the deck is convex."""
        edge = self.rings.edge[::-1]
        return min(float(np.interp(x, edge[:, 0], edge[:, 1])) for x in (x0, x1))

    def height(self, x: float) -> float:
        """z of the deck at a station [m]."""
        style, share = self.style, (x - self.aft) / self.length
        rise = style.sheer_fore * max(0.0, (share - 0.5) / 0.5) ** 2 + style.sheer_aft * max(0.0, 1 - share / 0.4) ** 2
        rise *= self.breadth
        if style.forecastle and x >= self.forecastle:
            rise += style.forecastle * self.unit
        return self.z - rise

    def bulwark(self, x: float) -> float:
        """Height of the bulwark above the deck at a station [m]; without one the edge has a gunwale."""
        style, share = self.style, (x - self.aft) / self.length
        full = style.bulwark * self.unit
        ahead = np.clip((share - style.bulwark_fore) / 0.03, 0.0, 1.0)
        astern = np.clip((style.bulwark_aft - share) / 0.03, 0.0, 1.0)
        return max(0.12 * self.unit, full * float(max(ahead, astern)))

    def plan(self, aft: float, fore: float, inset: float = 0.0, half: float = np.inf) -> Array:
        """The deck's plan (k, 2) between two stations, `inset` within its edge, no broader than twice `half` [m]."""
        edge = self.rings.edge
        inner = edge[(edge[:, 0] < fore - 1e-6) & (edge[:, 0] > aft + 1e-6), 0]
        x = np.concatenate([[fore], inner, [aft]])
        y = np.interp(x, edge[::-1, 0], edge[::-1, 1])
        y = np.minimum(np.maximum(y - inset, 0.05 * self.unit), half)
        return np.vstack([np.column_stack([x, y]), np.column_stack([x, -y])[::-1]])


def make_shell(lines: UnderwaterLines, style: Style) -> list[Shape]:
    """The hull by paint: topsides, boot-top, antifouling, deck, bulwark."""
    rings = lines.rings
    deck = WeatherDeck(rings, style)
    places, before_post = _place_sections(deck, lines)
    bands = _list_bands(rings, style)
    edges = [rings.z_deck, *(z for _, z in bands)]
    between = [
        z for z in rings.corners[:, 0, 2] if z <= 0.0 and np.abs(z - np.array(edges)).min() > -CLOSE * rings.z_deck
    ]
    levels = sorted({*edges, *between})
    grid = np.array([
        [
            _above_deck(deck, place),
            *(_on_wall(rings, place, z) for z in levels),
            *(lines.point(place, share, before) for share in UNDER),
        ]
        for place, before in zip(places, before_post, strict=True)
    ])  # fmt: skip
    deck_rows = np.array([_rows_on_deck(deck, lines, point) for point in grid[:, 0]])
    rows = [0, *(1 + int(np.argmin(np.abs(np.array(levels) - z))) for _, z in bands), grid.shape[1] - 1]
    paints = [*(paint for paint, _ in bands), "antifouling"]
    shapes = join_shapes(
        (paint, _plate(grid[:, i : j + 1])) for paint, (i, j) in zip(paints, pairwise(rows), strict=True)
    )
    bottom = _span(grid[:, -1], downwards=True)
    cap, wall = _plate(np.stack([deck_rows[:, 0], grid[:, 0]], axis=1)), _plate(deck_rows[:, ::-1])
    shapes += [("antifouling", bottom), ("topsides", cap), ("bulwark", wall)]
    shapes = join_shapes([*shapes, (style.deck, _span(deck_rows[:, 1], downwards=False))])
    return [(paint, drop_flat_triangles(surface)) for paint, surface in shapes]


def _list_bands(rings: HullRings, style: Style) -> list[tuple[str, float]]:
    """Paints above the antifouling from the deck down, each with the height of its lower edge."""
    load = find_load_line(rings, style)
    z_boot = [max(rings.z_deck, load - share * rings.z_keel) for share in BOOT_TOP]
    stripe = [rings.z_deck + share * (z_boot[0] - rings.z_deck) for share in STRIPE if style.has_stripe]
    return [*zip(["topsides", "stripe"], stripe, strict=False), ("topsides", z_boot[0]), ("boot-top", z_boot[1])]


def cut_bare_hull(hull: Surface, T: float) -> list[Shape]:
    """A hull as it is, by paint: bands of height, and a deck where the top is level."""
    top, boot, bottom = cut_into_bands(hull, [-0.10 * T, 0.02 * T])
    z = hull.vertices[:, 2].min()
    level = (top.vertices[top.triangles][..., 2] < z + 0.01).all(axis=1)
    deck, sides = Surface(top.vertices, top.triangles[level]), Surface(top.vertices, top.triangles[~level])
    return [("topsides", sides), ("deck", deck), ("boot-top", boot), ("antifouling", bottom)]


def find_load_line(rings: HullRings, style: Style) -> float:
    """z of the line up to which the hull has antifouling [m]: above the water for a ship in ballast."""
    depth, freeboard = rings.z_keel - rings.z_deck, -rings.z_deck
    return -float(np.clip(depth / style.depth_over_draught - rings.z_keel, 0.0, 0.4 * freeboard))


def _place_sections(deck: WeatherDeck, lines: UnderwaterLines) -> tuple[list[float], list[bool]]:
    """Places of the sections along the deck's edge from the stem, and whether each lies before the stern post."""
    rings, L = deck.rings, deck.length
    stations = [
        *(lines.aft + share * RUN * L for share in np.linspace(0.0, 1.0, 15)[1:]),
        *(lines.aft + share * POST * L for share in (0.3, 0.6, 0.85)),
    ]
    if deck.style.forecastle:
        stations += [deck.forecastle + GAP, deck.forecastle - 0.012 * L]
    for share in (deck.style.bulwark_fore, deck.style.bulwark_aft):
        stations += [deck.aft + (share + step) * L for step in (-0.03, 0.0, 0.03)]
    if deck.style.sheer_fore:
        stations += [deck.aft + share * L for share in np.linspace(0.0, 1.0, 21)]
    numbers = np.arange(len(rings.edge), dtype=float)
    post = float(np.interp(-lines.post, -rings.edge[:, 0], numbers))
    places = [post, *numbers.tolist()]  # and of the others those that are at none of these
    for place in np.interp(-np.array(stations), -rings.edge[:, 0], numbers).tolist():
        if min(abs(place - other) for other in places) > SAME:
            places.append(place)
    places = sorted([*(place for place in places if place == post or abs(place - post) > SAME), post + 0.2 * SAME])
    return places, [place <= post for place in places]


def _above_deck(deck: WeatherDeck, place: float) -> tuple[float, float, float]:
    x, y, _ = _on_wall(deck.rings, place, deck.z)
    return x, y, deck.height(x) - deck.bulwark(x)


def _on_wall(rings: HullRings, place: float, z: float) -> tuple[float, float, float]:
    corners, numbers = rings.at(z), np.arange(rings.corners.shape[1])
    return float(np.interp(place, numbers, corners[:, 0])), float(np.interp(place, numbers, corners[:, 1])), z


def _rows_on_deck(deck: WeatherDeck, lines: UnderwaterLines, top: Array) -> Array:
    """The bulwark's inner edge and the deck beside it (2, 3), of the edge's point `top`."""
    thick = 0.18 * deck.unit
    x = float(np.clip(top[0], deck.aft + thick, deck.fore - 2.5 * thick))
    y = max(0.0, float(top[1]) - thick) if top[0] < deck.fore - 2.5 * thick else 0.0
    return np.array([(x, y, top[2]), (x, y, deck.height(float(top[0])))])


def _plate(grid: Array) -> Surface:
    """Both sides and the transom of a grid (sections, rows, 3) of starboard points, rows downwards."""
    n, rows = grid.shape[:2]
    number = np.arange(n * rows).reshape(n, rows)
    a, b, c, d = (number[i, j].ravel() for i, j in (
        (slice(None, -1), slice(None, -1)), (slice(1, None), slice(None, -1)),
        (slice(1, None), slice(1, None)), (slice(None, -1), slice(1, None)),
    ))  # fmt: skip
    starboard = Surface(grid.reshape(-1, 3), np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])]))
    end = grid[-1]
    across = np.vstack([end, end * [1.0, -1.0, 1.0]])
    transom = [
        triangle
        for i, j in pairwise(range(rows))
        for triangle in ((i, i + rows, j + rows), (i, j + rows, j))
    ]  # fmt: skip
    return join_surfaces([starboard, mirror_surface(starboard), Surface(across, np.array(transom))])


def _span(edge: Array, downwards: bool) -> Surface:
    """The level surface between an edge (n, 3) on starboard and its mirror image, with normals down or up."""
    n = len(edge)
    i = np.arange(n - 1)
    triangles = np.vstack([np.column_stack([i, i + 1, i + 1 + n]), np.column_stack([i, i + 1 + n, i + n])])
    return Surface(np.vstack([edge, edge * [1.0, -1.0, 1.0]]), triangles if downwards else triangles[:, ::-1])
