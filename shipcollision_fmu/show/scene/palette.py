"""Colours and roughness of all parts, as sRGB and as linear RGB.

Topsides distinguish the ships; curves and figures use the same colours.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["SHIP_COLOURS", "Paint", "choose_topsides", "convert_to_display", "convert_to_linear", "find_paint"]

SHIP_COLOURS = ("#2f6fb7", "#c8102e", "#2e8b57", "#b8860b", "#7a4fa3", "#3a8f9e")
"""Topsides (sRGB) of the first, second ... ship; from the seventh on they repeat."""


@dataclass(frozen=True)
class Paint:
    """Name, base colour (sRGB, #rrggbb), roughness, metalness, and how much of its colour it gives off itself."""

    name: str
    colour: str
    roughness: float = 0.7
    metalness: float = 0.0
    glow: float = 0.0


_PAINTS = {
    paint.name: paint
    for paint in (
        Paint("antifouling", "#7d2a22", 0.8),
        Paint("boot-top", "#e9e6df", 0.6),
        Paint("deck", "#5d6b62", 0.9),
        Paint("house", "#eeece6", 0.6),
        Paint("windows", "#1b2730", 0.15, 0.4),
        Paint("funnel", "#d99a2b", 0.6),
        Paint("mast", "#d8d4c8", 0.6),
        Paint("hatch", "#8a4b3a", 0.8),
        Paint("pipe", "#a9a39a", 0.5, 0.3),
        Paint("container-a", "#b5482f", 0.8),
        Paint("container-b", "#3d6f8f", 0.8),
        Paint("container-c", "#c9a13b", 0.8),
        Paint("container-d", "#7c8a7a", 0.8),
        Paint("concrete", "#9b978d", 0.95),
        Paint("scratch", "#ff7a2e", 0.5, 0.0, 0.35),
    )
}


def find_paint(name: str) -> Paint:
    """The paint of a part. Raises KeyError for an unknown part."""
    return _PAINTS[name]


def choose_topsides(index: int) -> Paint:
    """The paint of the topsides of ship `index`, from 0."""
    return Paint(f"topsides {index}", SHIP_COLOURS[index % len(SHIP_COLOURS)], 0.45)


def convert_to_display(colour: str) -> tuple[float, float, float]:
    """Red, green, blue from 0 to 1, as on the screen, of #rrggbb."""
    r, g, b = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return (r, g, b)


def convert_to_linear(colour: str) -> tuple[float, float, float]:
    """Linear RGB of an sRGB colour #rrggbb. IEC 61966-2-1."""
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in convert_to_display(colour))
    return (r, g, b)
