"""All that is drawn of a ship, in its b: hull by paint, marks, appendages, fittings, lights."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .appendages import make_anchors, make_propellers, make_rudders
from .fittings import SHORTEST, Fitting, make_fittings
from .hull_ends import shape_ends
from .hull_lines import UnderwaterLines
from .hull_rings import read_rings
from .hull_shell import BOOT_TOP, WeatherDeck, cut_bare_hull, find_load_line, make_shell
from .lamp_posts import bear_lights
from .lettering import letter_hull
from .lights import Light, Mast, place_lights
from .run_folder import ShipBody
from .ship_style import GREY, choose_style, choose_type
from .solids import Shape, join_shapes, join_surfaces
from .surface import Surface

__all__ = ["PLATED", "Looks", "make_looks"]

PLATED = ("topsides", "stripe", "boot-top", "antifouling", "naval", "livery")
"""Paints of the outside of a hull."""


@dataclass(frozen=True, eq=False)
class Looks:
    """Plating, on which scratches are laid; shell (paint, surface), of which it is the outside; fittings; lights."""

    plating: Surface
    shell: tuple[Shape, ...]
    fittings: tuple[Fitting, ...]
    lights: tuple[Light, ...]


def make_looks(name: str, body: ShipBody, hull: Surface) -> Looks:
    """What is drawn of a ship; the same for the same name and body."""
    low, high = hull.vertices.min(axis=0), hull.vertices.max(axis=0)
    touching = read_rings(hull.vertices) if body.shape == "parametric" else None
    if touching is None or touching.z_deck >= 0.0 or touching.z_keel <= 0.0:
        top = float(low[2])
        mast = Mast(float(low[0] + 0.3 * (high[0] - low[0])), top)
        lights = [] if body.shape == "box" else place_lights(
            body.L_oa, float(high[0]), float(low[0]), body.B, top, mast
        )  # fmt: skip
        posts = bear_lights(lights, [hull], min(1.0, body.B / 9.0))
        return Looks(hull, (*cut_bare_hull(hull, body.T), *posts), (), tuple(lights))
    kind = choose_type(body.kind, body.L_oa, body.B, touching.z_keel - touching.z_deck)
    style = choose_style(kind)
    rings = shape_ends(touching, style.ends)
    deck, lines = WeatherDeck(rings, style), UnderwaterLines(rings, touching, style.has_bulb)
    shell = make_shell(lines, style)
    if style.is_grey:
        shell = join_shapes((GREY.get(paint, paint), surface) for paint, surface in shell)
    plating = join_surfaces([surface for paint, surface in shell if paint in PLATED])
    load = find_load_line(rings, style)
    z_boot = load - BOOT_TOP[0] * rings.z_keel
    shell += [
        ("letters", letter_hull(rings, name, rings.z_deck, z_boot)),
        ("antifouling", make_rudders(lines, deck.breadth, style.propellers)),
        ("bronze", make_propellers(lines, deck.breadth, style.propellers)),
    ]
    mast, fittings = Mast(deck.aft + 0.4 * deck.length, rings.z_deck - 0.5 * deck.breadth), tuple[Fitting, ...]()
    if body.L_oa >= SHORTEST:
        size = float(np.clip(0.012 * deck.length, 0.5, 3.0))
        z_anchor = rings.z_deck + 0.25 * (z_boot - rings.z_deck)
        shell.append(("funnel-top", make_anchors(lines, z_anchor, min(size, 0.2 * (z_boot - rings.z_deck)))))
        outfitted = make_fittings(deck, kind, name)
        mast, fittings = outfitted.mast, outfitted.fittings
    lights = place_lights(body.L_oa, deck.fore, deck.aft, deck.breadth, rings.z_deck, mast)
    parts = [*(surface for _, surface in shell), *(fitting.surface for fitting in fittings)]
    shell += bear_lights(lights, [part for part in parts if len(part.triangles)], deck.unit)
    return Looks(plating, tuple((paint, s) for paint, s in shell if len(s.triangles)), fittings, tuple(lights))
