"""Refuses an encounter whose hulls overlap before the impact, by their sections in plan.

Overlap at the start of a scenario that is loaded from a file is refused in scenario/initial_overlap.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot, sin

import numpy as np

from ..errors import ScenarioError
from ..ship.frames import Array
from ..ship.ship_state import ShipState
from .plan_contact import measure_gap, move_polygon
from .request import FASTEST

__all__ = ["check_no_earlier_overlap"]

DEEPEST = 0.03
"""[m] Overlap of the sections that is not yet a contact of its own. It must exceed the overlap that targeting leaves at
the impact; with a much larger value an earlier contact would be missed."""
LAST = 0.01
"""[s] Overlap in the last communication step, and so long before it, belongs to the impact: a default substep."""


def check_no_earlier_overlap(
    own: Sequence[ShipState],
    target: Sequence[ShipState],
    sections: Mapping[str, Array],
    deck: float,
    steps: int,
    h: float,
) -> None:
    """Raise ScenarioError unless the hulls are apart from the start until the impact at `steps`.

    sections in b at the height `deck` (down) [m], communication step h [s]. Heel moves a section sideways by up to
    |deck sin(phi)|, which is allowed on top of DEEPEST. Where the ships are far apart, communication points are skipped
    by a quarter of the time in which a relative speed of FASTEST would close the distance.
    """
    k = 0
    reach = sum(float(np.hypot(*polygon.T).max()) for polygon in sections.values())
    while k < steps:
        a, b = own[k], target[k]
        distance = hypot(a.north - b.north, a.east - b.east) - reach
        if distance <= 0.0:
            polygons = [
                move_polygon(sections[name], np.array([pose.north, pose.east]), pose.heading)
                for name, pose in (("own", a), ("target", b))
            ]
            distance = measure_gap(*polygons)
            deepest = DEEPEST + abs(deck) * (abs(sin(a.roll)) + abs(sin(b.roll)))
            if distance < -deepest and (steps - k) * h > LAST + h:
                raise ScenarioError(
                    f"the ships touch elsewhere {(steps - k) * h:.1f} s before the impact that is wanted: change the "
                    "angle, the place, the speeds or the rudder, or shorten the time before it"
                )
        k += max(1, int(distance / (4.0 * FASTEST * h)))
