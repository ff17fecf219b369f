"""Cargo on deck: containers in bays, hatch covers with coamings and cranes, a tanker's pipes and manifold."""

from __future__ import annotations

import numpy as np

from .outfit import Outfit
from .solids import make_faces

__all__ = ["fit_hatches", "fit_tank_deck", "stow_containers"]

LENGTH, WIDTH, HEIGHT = 12.19, 2.50, 2.60
"""[m] A container of 40 feet (ISO 668), with the gap to the next one in breadth."""
LINES = "aaaabbbccddefgh"
"""Paints of containers, as often as they are seen: rust red and blue most of all."""


def stow_containers(
    outfit: Outfit, aft: float, fore: float, tiers: int, random: np.random.Generator, lowest: int = 2
) -> None:
    """Bays of containers on hatch covers between two stations, lower towards the bow; only faces that show are made."""
    deck = outfit.deck
    u = min(1.0, deck.breadth / 20.0)
    pitch, z = (LENGTH + 1.9) * u, deck.z - 1.7 * u
    count = int((fore - aft + 1.9 * u) / pitch)
    faces: dict[str, list[np.ndarray]] = {}
    for i in range(count):
        x = (aft + i * pitch, aft + i * pitch + LENGTH * u)
        rows = int(2.0 * (deck.half_breadth(*x) - 0.15 * u) / (WIDTH * u))
        if rows < 2:
            break
        half = 0.5 * rows * WIDTH * u
        outfit.box("hatch", x, (-0.94 * half, 0.94 * half), (z + 0.12 * u, deck.z))
        most = max(lowest, tiers - max(0, 3 - (count - 1 - i)))
        heights = most - np.repeat(random.integers(0, 3, rows), random.integers(1, 4, rows))[:rows]
        _add_bay(faces, x, rows, np.clip(heights, lowest - 1, None), z, u, random)
        if i < count - 1:
            bridge = (x[1] + 0.55 * u, x[1] + 1.35 * u)
            breadth = min(half, deck.half_breadth(*bridge))
            outfit.box("trim", bridge, (-breadth, breadth), (z - 1.05 * HEIGHT * u, z - 0.95 * HEIGHT * u))
            outfit.pair("trim", bridge, (breadth - 0.5 * u, breadth), (z - 0.95 * HEIGHT * u, deck.z))
    for paint, listed in faces.items():
        outfit.add(paint, make_faces(np.concatenate(listed)), is_closed=False)


def _add_bay(
    faces: dict[str, list[np.ndarray]],
    x: tuple[float, float],
    rows: int,
    heights: np.ndarray,
    z: float,
    u: float,
    random: np.random.Generator,
) -> None:
    """Faces of one bay: each container's, a little apart, and dark ones behind them."""
    gap, behind = 0.06 * u, 0.16 * u
    around = [0, *(int(h) for h in heights), 0]
    for j in range(rows):
        y0 = (-0.5 * rows + j) * WIDTH * u
        y1 = y0 + WIDTH * u
        here = around[j + 1]
        for k in range(here):
            paint = f"container-{LINES[int(random.integers(len(LINES)))]}"
            low, high = z - k * HEIGHT * u, z - (k + 1) * HEIGHT * u
            shows = (k == here - 1, k >= around[j], k >= around[j + 2])
            faces.setdefault(paint, []).append(_list_faces(x, (y0 + gap, y1 - gap), (high + gap, low - gap), shows))
        shows = (True, here > around[j], here > around[j + 2])
        core = _list_faces(
            (x[0] + behind, x[1] - behind), (y0 + behind, y1 - behind), (z - here * HEIGHT * u + behind, z), shows
        )
        if here:
            faces.setdefault("gap", []).append(core)


def _list_faces(
    x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], shows: tuple[bool, bool, bool]
) -> np.ndarray:
    """After and fore face of a box, and its top, port and starboard face where they show; (k, 4, 3)."""
    (a, b), (p, s), (t, d) = x, y, z
    found = [
        [(b, s, d), (b, p, d), (b, p, t), (b, s, t)],
        [(a, p, d), (a, s, d), (a, s, t), (a, p, t)],
    ]
    if shows[0]:
        found.append([(a, s, t), (b, s, t), (b, p, t), (a, p, t)])
    if shows[1]:
        found.append([(b, p, d), (a, p, d), (a, p, t), (b, p, t)])
    if shows[2]:
        found.append([(a, s, d), (b, s, d), (b, s, t), (a, s, t)])
    return np.array(found)


def fit_hatches(outfit: Outfit, aft: float, fore: float, has_cranes: bool) -> None:
    """Hatches with coamings and covers that open to the sides; cranes between them on ships that have their own."""
    deck, u = outfit.deck, outfit.deck.unit
    B = deck.breadth
    count = max(2, round((fore - aft) / max(0.85 * B, 14.0 * u)))
    pitch = (fore - aft) / count
    for i in range(count):
        x = (aft + (i + 0.13) * pitch, aft + (i + 0.87) * pitch)
        half = min(0.31 * B, 0.8 * deck.half_breadth(*x))
        low, high = 1.3 * u, 2.3 * u
        outfit.box("trim", x, (-half, half), (deck.z - low, deck.z))
        for y in ((-half - 0.3 * u, -0.08 * u), (0.08 * u, half + 0.3 * u)):
            outfit.box("hatch", (x[0] - 0.3 * u, x[1] + 0.3 * u), y, (deck.z - high, deck.z - low))
        for k in range(1, 6):
            at = x[0] + k / 6.0 * (x[1] - x[0])
            outfit.box(
                "trim",
                (at - 0.12 * u, at + 0.12 * u),
                (-half - 0.35 * u, half + 0.35 * u),
                (deck.z - high - 0.12 * u, deck.z - low),
            )
        if has_cranes and i > 0 and (B > 25.0 or i % 2):
            outfit.crane(aft + i * pitch, 0.0, deck.z, min(15.0 * u, 0.65 * B), 0.7 * pitch)
    for i in range(count + 1):
        at = aft + i * pitch
        if not has_cranes or i in (0, count) or (B <= 25.0 and not i % 2):
            half = min(0.16 * B, 0.6 * deck.half_breadth(at, at))
            outfit.box("trim", (at - 0.7 * u, at + 0.7 * u), (-half, half), (deck.z - 2.2 * u, deck.z))


def fit_tank_deck(outfit: Outfit, aft: float, fore: float) -> None:
    """Pipes along the middle with a catwalk, the manifold across amidships, its cranes, vents and tank hatches."""
    deck, u = outfit.deck, outfit.deck.unit
    B, z = deck.breadth, deck.z
    s = u * min(1.0, max(0.35, B / 40.0))
    middle = 0.5 * (aft + fore)
    for y in (-3.6, -2.4, -1.2, 1.2, 2.4, 3.6):
        end = fore - (abs(y) - 1.2) * 0.05 * (fore - aft)
        outfit.rod("pipe", (aft, y * s, z - 1.4 * s), (end, y * s, z - 1.4 * s), 0.36 * s)
    outfit.box("trim", (aft, fore), (-0.7 * s, 0.7 * s), (z - 2.6 * s, z - 2.4 * s))
    for at in np.arange(aft + 3.0 * s, fore, 9.0 * s):
        outfit.box("trim", (at - 0.2 * s, at + 0.2 * s), (-4.4 * s, 4.4 * s), (z - 1.1 * s, z))
        outfit.box("trim", (at - 0.15 * s, at + 0.15 * s), (-0.6 * s, 0.6 * s), (z - 2.4 * s, z - 1.1 * s))
    reach = 0.5 * B - 3.2 * s
    for k in range(-2, 3):
        at = middle + 2.4 * k * s
        outfit.rod("pipe", (at, -reach, z - 2.3 * s), (at, reach, z - 2.3 * s), 0.4 * s)
    outfit.pair("trim", (middle - 6.5 * s, middle + 6.5 * s), (reach - 2.2 * s, reach + 0.3 * s), (z - 0.9 * s, z))
    for side in (-1.0, 1.0):
        outfit.crane(middle - 9.0 * s, side * (reach - 3.5 * s), z, 13.0 * s, 15.0 * s, aft=False)
    tanks = max(3, round((fore - aft) / (0.65 * B)))
    for i in range(tanks):
        at = aft + (i + 0.5) / tanks * (fore - aft)
        for y in (-0.27, 0.27):
            if abs(y) * B + 1.5 * s < deck.half_breadth(at, at):
                outfit.box("trim", (at - 1.1 * s, at + 1.1 * s), (y * B - 1.1 * s, y * B + 1.1 * s), (z - 1.0 * s, z))
                outfit.rod("pipe", (at + 4.0 * s, y * B, z), (at + 4.0 * s, y * B, z - 3.0 * s), 0.25 * s)
    outfit.rod("mast", (aft + 0.62 * (fore - aft), 0.0, z), (aft + 0.62 * (fore - aft), 0.0, z - 9.0 * s), 0.3 * s)
