"""Dents: the opening in the side that is struck and the crushed bow of the ship that strikes, for pictures.

Ships do not crush in the model; a dent is an illustration of the energy that a scratch dissipates.

    R_T = E / (47.2 MJ/m3)                   destroyed steel, the slope of Minorsky's (1959) line
    depth = sqrt(R_T / (t_eq tan(phi)))      of a wedge-shaped bow that destroys it in the side
    half_width = depth tan(phi)              of the opening
    crush = CRUSH depth                      by which the bow is shortened
    T = 1.67 crush / V                       duration of the crush from the closing speed V, Pedersen (1993)

Minorsky's line begins at 32.7 MJ; its slope alone also gives small ships a size. Place and start are those of the
scratch's first point, laid onto the hull.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, sqrt, tan
from typing import Literal

import numpy as np

from ...ship.frames import Array
from .effects import point_outwards
from .run_folder import RunFolder
from .scratches import Scratch

__all__ = ["Dent", "find_depth", "make_dents"]

STEEL = 47.2e6
"""[J/m3] Energy per volume of destroyed steel, Minorsky (1959) in SI."""
PLATES = 0.06
"""[m] t_eq: thickness of all decks and bottoms in the way, summed. Thinner plates make larger dents."""
HALF_ANGLE = radians(30.0)
"""phi: half-angle of the bow; a blunter bow makes wider and shallower openings."""
CRUSH = 0.25
"""Share of the depth by which the bow is shortened: 3.4 m at 306 MJ, about as Pedersen (1993) has for 140 m."""
BOW = 0.3
"""Share of L_pp ahead of midship from which the ship that strikes does so with its bow."""
STEM = 0.47
"""The same for the ship that is struck: both bows are crushed when ships meet head on."""
SMALLEST = 0.25
"""[m] Least half-width of a dent that is drawn."""
WIDEST = 0.1
"""Greatest half-width in L_pp; a wider opening would not leave a ship in the picture."""
DURATION = (0.4, 3.0)
"""[s] Bounds of the duration: a dent is seen to grow, and is not left behind by the ships."""
MOST = 8
"""Number of dents in a picture, of the greatest energies; more cost time and are not told apart."""


@dataclass(frozen=True, eq=False)
class Dent:
    """A dent on a ship, in its b: `point` (3,) and `outwards` (3,), depth and half_width [m], its start and end of
    growth [s], the energy [J]. "side": an opening; "bow": a crush by `depth` against what lies ahead."""

    kind: Literal["side", "bow"]
    ship: str
    scratch: int
    point: Array
    outwards: Array
    time: float
    duration: float
    energy: float
    depth: float
    half_width: float


def find_depth(energy: float) -> float:
    """Depth [m] of the wedge that the energy [J] drives into a side."""
    return sqrt(max(energy, 0.0) / STEEL / (PLATES * tan(HALF_ANGLE)))


def make_dents(run: RunFolder, scratches: tuple[Scratch, ...]) -> tuple[Dent, ...]:
    """The dents of a run, of its greatest energies, in order of time; a bow is crushed once."""
    lengths = {name: body.L_pp for name, body in run.bodies.ships.items()}
    speeds = {event.id: event.closing_speed for event in run.events.collisions}
    number, energy = run.contacts["scratch"].astype(int), run.contacts["energy"]
    found = []
    for event in run.events.scratches:
        borne = [scratch for scratch in scratches if scratch.id == event.id]
        ahead = {scratch.ship: float(scratch.points[0, 0]) / lengths[scratch.ship] for scratch in borne}
        dissipated = float(energy[number == event.id].sum())
        depth = find_depth(dissipated)
        crush = CRUSH * depth
        duration = float(np.clip(1.67 * crush / max(speeds.get(event.collision) or 1.0, 0.1), *DURATION))
        for scratch in borne:
            is_bow = ahead[scratch.ship] > (BOW if ahead[scratch.ship] == max(ahead.values()) else STEM)
            half_width = min(depth * tan(HALF_ANGLE), WIDEST * lengths[scratch.ship])
            if half_width < SMALLEST:
                continue
            found.append(
                Dent(
                    "bow" if is_bow else "side",
                    scratch.ship,
                    event.id,
                    scratch.points[0],
                    point_outwards(scratch.normals[0], scratch.points[0]),
                    event.start,
                    duration,
                    dissipated,
                    crush if is_bow else depth,
                    half_width,
                )
            )
    largest: list[Dent] = []
    for dent in sorted(found, key=lambda dent: -dent.energy):
        is_crushed = dent.kind == "bow" and any(other.kind == "bow" and other.ship == dent.ship for other in largest)
        if not is_crushed and len(largest) < MOST:
            largest.append(dent)
    return tuple(sorted(largest, key=lambda dent: (dent.time, dent.scratch)))
