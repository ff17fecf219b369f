"""A list of fittings under construction, and parts that several types of ship share: walls with windows, masts, boats.

Sizes are metres of a full-size ship times `deck.unit`, so that models and boats have them in proportion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from .hull_shell import WeatherDeck
from .solids import make_box, make_faces, make_loft, make_prism, make_rod
from .surface import Surface

__all__ = ["Fitting", "Outfit"]

Span = tuple[float, float]

PROUD = 0.05
"""[m] Distance of windows from their wall; less flickers in single precision, more is seen from the side."""
TIER = 2.75
"""[m] Height of a tier of a deckhouse, times the deck's unit."""


@dataclass(frozen=True, eq=False)
class Fitting:
    """A fitting in the ship's b: the name of its part ("house", "windows", ...), its surface, whether it is closed."""

    part: str
    surface: Surface
    is_closed: bool = True


class Outfit:
    """Fittings of a deck; every method adds some."""

    def __init__(self, deck: WeatherDeck) -> None:
        self.deck = deck
        self.fittings: list[Fitting] = []

    def add(self, part: str, surface: Surface, is_closed: bool = True) -> None:
        """Any surface."""
        if len(surface.triangles):
            self.fittings.append(Fitting(part, surface, is_closed))

    def box(self, part: str, x: Span, y: Span, z: Span) -> None:
        """A box."""
        self.add(part, make_box(x, y, z))

    def pair(self, part: str, x: Span, y: Span, z: Span) -> None:
        """A box on starboard and its mirror image; 0 < y0 < y1."""
        self.box(part, x, y, z)
        self.box(part, x, (-y[1], -y[0]), z)

    def rod(self, part: str, start: tuple[float, float, float], end: tuple[float, float, float], radius: float) -> None:
        """A rod between two points."""
        self.add(part, make_rod(start, end, radius))

    def tier(self, plan: Array, z: float, height: float, pitch: float = 2.6, part: str = "house") -> float:
        """A tier of a deckhouse on a plan, with windows and a deck that stands out a little; z of its top."""
        unit = self.deck.unit
        top = z - height
        self.add(part, make_prism(plan, (top, z)))
        self.add("trim", make_prism(_widen(plan, 0.18 * unit), (top, top + 0.16 * unit)))
        windows = _list_windows(plan, (z - 0.72 * height, z - 0.44 * height), pitch * unit, 0.36 * pitch * unit)
        self.add("windows", windows, is_closed=False)
        return top

    def band(self, plan: Array, z: float, height: float, part: str = "house", glass: Span = (0.35, 0.80)) -> float:
        """A tier with windows all round, as a wheelhouse has: wall, glass, wall; z of its top."""
        low, high = z - glass[0] * height, z - glass[1] * height
        inner = _widen(plan, -0.02 * self.deck.unit)
        self.add(part, make_prism(plan, (low, z)))
        self.add("windows", make_prism(inner, (high, low)))
        posts = _list_windows(plan, (high, low), 1.7 * self.deck.unit, 0.16 * self.deck.unit, out=0.01)
        self.add(part, posts, is_closed=False)
        self.add(part, make_prism(plan, (z - height, high)))
        self.add(
            "trim", make_prism(_widen(plan, 0.35 * self.deck.unit), (z - height, z - height + 0.2 * self.deck.unit))
        )
        return z - height

    def funnel(self, x: Span, half: float, z: float, height: float, y: float = 0.0) -> None:
        """A funnel with the ship's colour as a band and a black top, rounded in plan."""
        plan = _round_plan(x, half, y)
        upper = _round_plan((x[0] + 0.04 * (x[1] - x[0]), x[1] - 0.10 * (x[1] - x[0])), 0.94 * half, y)
        cut = [plan + share * (upper - plan) for share in (0.0, 0.35, 0.75, 1.0)]
        for part, i in (("funnel", 0), ("livery", 1), ("funnel-top", 2)):
            low, high = z - height * (0.0, 0.35, 0.75)[i], z - height * (0.35, 0.75, 1.0)[i]
            self.add(part, make_loft(cut[i], low, cut[i + 1], high))
        for shift in (-0.4, 0.3):
            self.rod(
                "funnel-top", (0.5 * (x[0] + x[1]), y + shift * half, z - 0.9 * height),
                (0.5 * (x[0] + x[1]), y + shift * half, z - 1.14 * height), 0.16 * half,
            )  # fmt: skip

    def mast(self, x: float, z: float, height: float, is_radar: bool = False) -> None:
        """A mast with a yard; with radar also scanners and a second yard."""
        u = self.deck.unit
        self.add("mast", make_loft(_round_plan((x - 0.45 * u, x + 0.45 * u), 0.4 * u), z,
                                   _round_plan((x - 0.2 * u, x + 0.2 * u), 0.18 * u), z - height))  # fmt: skip
        self.box(
            "mast", (x - 0.08 * u, x + 0.08 * u), (-2.2 * u, 2.2 * u), (z - 0.72 * height, z - 0.72 * height + 0.16 * u)
        )
        if is_radar:
            self.box("mast", (x, x + 1.4 * u), (-0.5 * u, 0.5 * u), (z - 0.5 * height, z - 0.5 * height + 0.14 * u))
            self.box(
                "trim",
                (x + 0.6 * u, x + 0.9 * u),
                (-1.9 * u, 1.9 * u),
                (z - 0.5 * height - 0.6 * u, z - 0.5 * height - 0.2 * u),
            )
            self.box(
                "trim",
                (x + 0.1 * u, x + 0.35 * u),
                (-1.3 * u, 1.3 * u),
                (z - 0.86 * height - 0.3 * u, z - 0.86 * height),
            )
            for y in (-1.6, 1.6):
                self.rod("mast", (x, y * u, z - 0.72 * height), (x, y * u, z - 1.05 * height), 0.05 * u)

    def boat(self, x: float, y: float, z: float, length: float) -> None:
        """An enclosed lifeboat on both sides at y, hanging at z, with davits."""
        high, broad = 0.34 * length, 0.17 * length
        for side in (-1.0, 1.0):
            centre = side * y
            lower = _round_plan((x - 0.46 * length, x + 0.46 * length), 0.55 * broad, centre)
            middle = _round_plan((x - 0.5 * length, x + 0.5 * length), broad, centre)
            upper = _round_plan((x - 0.38 * length, x + 0.42 * length), 0.5 * broad, centre)
            self.add("lifeboat", make_loft(lower, z, middle, z - 0.45 * high))
            self.add("lifeboat", make_loft(middle, z - 0.45 * high, upper, z - high))
            for along in (-0.3, 0.3):
                foot = x + along * length
                self.rod(
                    "trim",
                    (foot, centre - side * broad, z + 0.3 * high),
                    (foot, centre, z - 1.45 * high),
                    0.09 * self.deck.unit,
                )

    def crane(self, x: float, y: float, z: float, height: float, reach: float, aft: bool = True) -> None:
        """A deck crane on a pedestal, its jib lying almost level, aft or forward."""
        u = self.deck.unit
        self.add("crane", make_prism(_round_plan((x - 1.1 * u, x + 1.1 * u), 1.1 * u, y), (z - 0.78 * height, z)))
        self.box("crane", (x - 1.7 * u, x + 1.7 * u), (y - 1.5 * u, y + 1.5 * u), (z - height, z - 0.78 * height))
        to = -1.0 if aft else 1.0
        self.rod("crane", (x + to * 1.5 * u, y, z - 0.86 * height), (x + to * reach, y, z - 0.95 * height), 0.45 * u)
        self.rod("trim", (x, y, z - 1.15 * height), (x + to * reach, y, z - 0.97 * height), 0.06 * u)
        self.rod("crane", (x, y, z - height), (x, y, z - 1.18 * height), 0.3 * u)

    def rails(self, aft: float, fore: float, part: str = "rail") -> None:
        """Two bars of a rail along the deck's edge on both sides, with a post every other frame."""
        u, deck = self.deck.unit, self.deck
        if fore - aft < 4.0 * u:
            return
        x = np.linspace(aft, fore, max(2, round((fore - aft) / (3.0 * u)) + 1))
        y = np.array([deck.half_breadth(at, at) for at in x]) - 0.12 * u
        z = np.array([deck.height(at) for at in x])
        faces = []
        for up in (1.1, 0.6):
            p, q = (np.column_stack([x[k], y[k], z[k] - up * u]) for k in (slice(None, -1), slice(1, None)))
            faces.append(np.stack([p, q, q - [0, 0, 0.07 * u], p - [0, 0, 0.07 * u]], axis=1))
        foot = np.column_stack([x, y, z])
        along = np.array([0.05 * u, 0.0, 0.0])
        faces.append(
            np.stack(
                [foot - along, foot + along, foot + along - [0, 0, 1.1 * u], foot - along - [0, 0, 1.1 * u]], axis=1
            )
        )
        one = np.concatenate(faces)
        both = np.concatenate([one, one * [1.0, -1.0, 1.0]])
        self.add(part, make_faces(np.concatenate([both, both[:, ::-1]])), is_closed=False)


def _round_plan(x: Span, half: float, y: float = 0.0) -> Array:
    """An oblong with cut corners (8, 2), from ahead along starboard."""
    corner = min(0.32 * (x[1] - x[0]), 0.6 * half)
    a, b = x
    return np.array([
        (b, half - corner), (b - corner, half), (a + corner, half), (a, half - corner),
        (a, corner - half), (a + corner, -half), (b - corner, -half), (b, corner - half),
    ]) + [0.0, y]  # fmt: skip


def _widen(plan: Array, by: float) -> Array:
    """A convex plan whose corners are moved outwards from its edges by `by` [m], about."""
    ahead, behind = np.roll(plan, -1, axis=0) - plan, plan - np.roll(plan, 1, axis=0)
    normals = []
    for edge in (ahead, behind):
        length = np.maximum(np.linalg.norm(edge, axis=1), 1e-9)[:, None]
        normals.append(np.column_stack([edge[:, 1], -edge[:, 0]]) / length)
    mean = normals[0] + normals[1]
    mean /= np.maximum(np.linalg.norm(mean, axis=1), 1e-9)[:, None]
    share = np.maximum((mean * normals[0]).sum(axis=1), 0.5)[:, None]
    widened: Array = plan + by * mean / share
    return widened


def _list_windows(plan: Array, z: Span, pitch: float, width: float, out: float = PROUD) -> Surface:
    """Windows of a width at a pitch [m] along the walls over a plan, from z0 down to z1."""
    faces = []
    for a, b in zip(plan, np.roll(plan, -1, axis=0), strict=True):
        length = float(np.linalg.norm(b - a))
        count = int(length / pitch)
        if not count:
            continue
        along = (b - a) / length
        normal = np.array([along[1], -along[0]])
        middle = a + along * (length * (np.arange(count) + 0.5) / count)[:, None] + out * normal
        p, q = middle - 0.5 * width * along, middle + 0.5 * width * along
        low, high = np.full((count, 1), z[1]), np.full((count, 1), z[0])
        corners = [np.hstack([p, low]), np.hstack([p, high]), np.hstack([q, high]), np.hstack([q, low])]
        faces.append(np.stack(corners, axis=1))
    return make_faces(np.concatenate(faces)) if faces else Surface(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
