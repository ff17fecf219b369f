"""Names and draught marks as flat strokes on the plating, so that every format draws them without a font or texture.

Letters are drawn with straight strokes on a field 4 wide and 6 high, as shipyards weld them. Accents are left out, and
so are characters that have no such letter; a name of which nothing remains is not painted.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from ...ship.frames import Array
from .hull_rings import HullRings
from .solids import join_surfaces, make_faces, mirror_surface
from .surface import Surface

__all__ = ["LIFT", "find_letters", "letter_hull", "write_text"]

LIFT = 0.04
"""[m] Distance of letters from the plating, less than that of scratches, which are drawn over them."""
LONGEST = 20
"""Most letters of a name on a hull."""
WEIGHT = 0.42
"""Half breadth of a stroke, in fields."""
ADVANCE = 5.6
"""Distance of letters, in fields."""

_STROKES = {
    "A": "00 04 26 44 40|03 43", "B": "00 06 36 45 44 33 03|33 42 41 30 00", "C": "45 36 16 05 01 10 30 41",
    "D": "00 06 26 44 42 20 00", "E": "40 00 06 46|03 33", "F": "00 06 46|03 33", "G": "45 36 16 05 01 10 30 41 43 23",
    "H": "00 06|40 46|03 43", "I": "20 26", "J": "46 41 30 10 01", "K": "00 06|46 03 40", "L": "06 00 40",
    "M": "00 06 23 46 40", "N": "00 06 40 46", "O": "10 01 05 16 36 45 41 30 10", "P": "00 06 36 45 44 33 03",
    "Q": "10 01 05 16 36 45 41 30 10|22 40", "R": "00 06 36 45 44 33 03|23 40",
    "S": "45 36 16 05 04 13 33 42 41 30 10 01",
    "T": "06 46|26 20", "U": "06 01 10 30 41 46", "V": "06 20 46", "W": "06 10 24 30 46", "X": "00 46|06 40",
    "Y": "06 23 46|23 20", "Z": "06 46 00 40", "0": "10 01 05 16 36 45 41 30 10", "1": "15 26 20",
    "2": "05 16 36 45 44 00 40", "3": "06 46 23 33 42 41 30 10 01", "4": "30 36 02 42", "5": "46 06 04 34 43 41 30 00",
    "6": "45 36 16 05 01 10 30 41 42 33 03", "7": "06 46 10", "8": "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",
    "9": "01 10 30 41 45 36 16 05 04 13 43", "-": "13 33", ".": "20 21", "/": "00 46",
    "&": "40 04 05 16 25 24 02 01 10 20 42",
    "+": "23 43|33 32|33 34", "'": "26 24",
}  # fmt: skip


def find_letters(name: str) -> str:
    """The name as it is painted: capitals without accents, single spaces, at most LONGEST characters."""
    plain = unicodedata.normalize("NFKD", name.upper().replace("Ø", "O").replace("Æ", "AE").replace("Ł", "L"))
    kept = "".join(c if c in _STROKES else " " if c.isspace() or c == "_" else "" for c in plain)
    return " ".join(kept.split())[:LONGEST].rstrip()


def write_text(text: str, height: float) -> Array:
    """Strokes (k, 4, 2) [m] of a text, along and up from its lower left corner, counter-clockwise."""
    unit, strokes = height / 6.0, []
    for i, letter in enumerate(text):
        for line in _STROKES.get(letter, "").split("|"):
            points = [np.array([float(p[0]), float(p[1])]) for p in line.split()]
            for a, b in pairwise(points):
                along = WEIGHT * (b - a) / np.linalg.norm(b - a)
                side = np.array([-along[1], along[0]])
                a, b = a - 0.7 * along, b + 0.7 * along
                strokes.append(np.array([a - side, b - side, b + side, a + side]) + [i * ADVANCE, 0.0])
    return unit * np.array(strokes).reshape(-1, 4, 2)


def find_width(text: str, height: float) -> float:
    """Length of a text [m]."""
    return (len(text) * ADVANCE - ADVANCE + 4.0) * height / 6.0


def letter_hull(rings: HullRings, name: str, z_top: float, z_boot: float) -> Surface:
    """The name at both bows and on the transom, and draught marks at bow, middle and stern [m]; both sides."""
    L, B = float(np.ptp(rings.edge[:, 0])), 2.0 * float(rings.edge[:, 1].max())
    room, text = z_boot - z_top, find_letters(name)
    surfaces, height = [], min(max(0.016 * L, 0.06 * B), 0.25 * room, 2.4)
    if text and height > 0.08:
        z = z_top + 0.22 * room + height
        width = find_width(text, height)
        ahead = float(rings.at(z)[0, 0]) - 0.045 * L
        surfaces += [
            _lay(rings, write_text(text, height), lambda s, h: (ahead - width + s, z - h), +1),
            _lay(rings, write_text(text, height), lambda s, h: (ahead - s, z - h), -1),
        ]
        transom = float(rings.at(z)[-1, 1])
        small = min(0.8 * height, 1.5 * transom / max(width / height, 1e-9), 0.3 * room)
        if small > 0.08:
            surfaces.append(_lay_on_transom(rings, write_text(text, small), find_width(text, small), z))
    spacing = max(1.0, round(rings.z_keel / 8.0)) if B > 9.0 else 0.5
    for station in (0.49, 0.0, -0.47):
        surfaces += _mark_draughts(
            rings, station * L + 0.5 * float(rings.edge[0, 0] + rings.edge[-1, 0]), spacing, z_top
        )
    return join_surfaces([surface for surface in surfaces if len(surface.triangles)])


def _mark_draughts(rings: HullRings, station: float, spacing: float, z_top: float) -> list[Surface]:
    """Numbers above the keel at multiples of the spacing [m], from the waterline down to 2 spacings and up to 3."""
    found = []
    for metres in np.arange(spacing, rings.z_keel - z_top, spacing):
        z = rings.z_keel - float(metres)
        if not -3.0 * spacing < z < 0.0:
            continue
        text, height = f"{metres:g}", min(0.5 * spacing, 0.5, 0.06 * float(rings.edge[:, 1].max()))
        x = min(station, float(rings.at(z)[0, 0]) - 1.6 * find_width(text, height))
        strokes = write_text(text, height)
        for side in (+1, -1):
            found.append(_lay(rings, strokes, lambda s, h, x=x, z=z, side=side: (x + side * s, z - h), side))  # type: ignore[misc]
    return found


def _lay(rings: HullRings, strokes: Array, place: Callable[[Array, Array], tuple[Array, Array]], side: int) -> Surface:
    """Strokes on the plating of starboard (+1) or port (-1); `place` gives x and z of points along and up a text."""
    x, z = place(strokes[..., 0], strokes[..., 1])
    corners = np.empty((*x.shape, 3))
    for i in np.ndindex(x.shape):
        y = rings.half_breadth(np.array([x[i] - 0.05, x[i], x[i] + 0.05]), float(z[i]))
        normal = np.array([-(y[2] - y[0]) / 0.1, 1.0, 0.0])
        corners[i] = np.array([x[i], y[1], z[i]]) + LIFT * normal / np.linalg.norm(normal)
    if side > 0:
        return make_faces(corners[:, ::-1] if _faces_inwards(corners) else corners)
    port = make_faces(corners[:, ::-1] if _faces_inwards(corners) else corners)
    return mirror_surface(port)


def _faces_inwards(corners: Array) -> bool:
    """Whether faces on starboard have normals to port."""
    if not len(corners):
        return False
    return float(np.cross(corners[0, 1] - corners[0, 0], corners[0, 3] - corners[0, 0])[1]) < 0.0


def _lay_on_transom(rings: HullRings, strokes: Array, width: float, z: float) -> Surface:
    """Strokes in the middle of the transom, read from astern, where port is on the left."""
    heights = z - strokes[..., 1]
    x = np.vectorize(lambda at: float(rings.at(at)[-1, 0]) - LIFT)(heights)
    corners = np.stack([x, strokes[..., 0] - 0.5 * width, heights], axis=-1)
    return make_faces(corners)
