"""Colours and roughness of all parts, as sRGB and as linear RGB.

Topsides distinguish the ships; curves and figures use the same colours.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = [
    "LIVERIES",
    "SHIP_COLOURS",
    "Paint",
    "choose_topsides",
    "convert_to_display",
    "convert_to_linear",
    "find_paint",
]

SHIP_COLOURS = ("#2f6fb7", "#c8102e", "#2e8b57", "#b8860b", "#7a4fa3", "#3a8f9e")
"""Topsides (sRGB) of the first, second ... ship; from the seventh on they repeat."""
LIVERIES = ("topsides", "livery")
"""Parts in the colour of their ship: topsides, and the band of the funnel; of grey ships boot topping and stripe."""


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
        Paint("boot-top", "#d9d6cd", 0.6),
        Paint("deck", "#56655f", 0.9),
        Paint("deck-red", "#653a30", 0.9),
        Paint("deck-grey", "#5c646a", 0.9),
        Paint("bulwark", "#8d8a80", 0.8),
        Paint("stripe", "#e2dfd7", 0.5),
        Paint("letters", "#f4f2ec", 0.6),
        Paint("bronze", "#b08a3c", 0.35, 0.7),
        Paint("house", "#dddad1", 0.55),
        Paint("trim", "#b9b7ae", 0.65),
        Paint("windows", "#18232c", 0.12, 0.4),
        Paint("funnel", "#d5d1c6", 0.6),
        Paint("funnel-top", "#1c1d1f", 0.8),
        Paint("mast", "#d8d4c8", 0.6),
        Paint("rail", "#dcdad2", 0.6),
        Paint("crane", "#d9b23c", 0.6),
        Paint("lifeboat", "#d6431c", 0.5),
        Paint("grey", "#8b949a", 0.6),
        Paint("naval", "#7f898f", 0.55),
        Paint("hatch", "#7c3f31", 0.8),
        Paint("pipe", "#b3aca2", 0.5, 0.3),
        Paint("gap", "#23211f", 0.9),
        Paint("container-a", "#8f3b2a", 0.8),
        Paint("container-b", "#2f5f8a", 0.8),
        Paint("container-c", "#b9b7b0", 0.8),
        Paint("container-d", "#2f6b4a", 0.8),
        Paint("container-e", "#c9a13b", 0.8),
        Paint("container-f", "#c4622d", 0.8),
        Paint("container-g", "#7fa6bd", 0.8),
        Paint("container-h", "#8d2f55", 0.8),
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
