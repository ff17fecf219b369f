"""Aiming: the two tracks brought to an impact at the wanted place and time, as the collision model itself finds it.

The place of an impact is the middle of what touches first (impact.north ... of the FMU). Where a corner meets a side
that is the corner. Where two sides meet nearly parallel, within some centimetres of each other over metres, it is the
middle of the line, and a ship aimed with a corner of that line at the place would be found to strike beside it. A ship
that heels meets with her deck edge elsewhere than an upright one. So the aim starts from the sections in plan
(plan_contact.py), and is corrected by what the collision model finds when it is given the last steps before the impact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, hypot, sin
from typing import NamedTuple

import numpy as np

from ..collision.model import ShipCollision
from ..errors import ScenarioError
from ..ship.frames import Array, rotation, rotation_vector
from .approach_track import BEYOND, Mover, Pose, nearer
from .plan_contact import gap, moved
from .request import FASTEST

__all__ = ["HALF_A_SUBSTEP", "OVERLAP", "Found", "Range", "aimed", "check_nothing_before"]

OVERLAP = 0.012
"""[m] of the sections at the wanted time: about what detection lets pass, so that it finds the contact then."""
HALF_A_SUBSTEP = 0.005
"""[s] by which the hulls touch before the wanted time for the same reason; of the collision model's usual substep."""
DEEPEST = 0.03
"""[m] of overlap before the impact that is not yet another contact."""
GOOD = 0.02
"""[m] from the place: near enough not to be corrected any more."""
BEST = 0.35
"""[m] from the place that is accepted, of the half metre that is promised."""
CORRECTIONS = 16
NUDGES = (2e-4, -2e-4, 1e-5, -1e-5)
"""[m] A scenario file rounds positions; the aim must not stand on the edge of that."""
BEFORE = 3
"""Communication steps before the wanted impact that the collision model is given."""


class Found(NamedTuple):
    """The first contact: in the target's b (2,) [m], and how long after the wanted time [s]."""

    point: Array
    late: float


class Range:
    """The two ships in a collision model, to be tried again and again. Close it after use."""

    def __init__(self, own: Mover, target: Mover, steps: int, h: float) -> None:
        self._steps, self._h = steps, h
        self._model = ShipCollision(("own", "target"))
        for parameters, mover in zip(self._model.parameters.ships, (own, target), strict=True):
            parameters.ship, parameters.degrees_of_freedom = mover.file, mover.degrees_of_freedom
        self._fresh: dict[str, object] | None = None

    def found(self, own: Sequence[Pose], target: Sequence[Pose]) -> Found | None:
        """Where the collision model finds the first contact on these tracks; None within two steps after the time."""
        model, h = self._model, self._h
        for k in range(max(0, self._steps - BEFORE), self._steps + BEYOND):
            for state, pose in zip(model.inputs.ships, (own[k], target[k]), strict=True):
                state.position[:], state.attitude[:] = pose[0:3], pose[3:6]
                state.velocity[:], state.rate[:] = pose[6:9], pose[9:12]
            if self._fresh is None:
                model.initialise()
                self._fresh = model.get_state()
            elif k == max(0, self._steps - BEFORE):
                model.set_state(self._fresh)
            model.step(k * h, h)
            if model.outputs.impact_count:
                return self._of_the_impact(target[k], k)
        return None

    def close(self) -> None:
        """Leave the Bullet world."""
        self._model.close()

    def _of_the_impact(self, target: Pose, k: int) -> Found:
        time, point = self._model.outputs.impact[0], np.array(self._model.outputs.impact_point)
        since = time - k * self._h
        R_nb = rotation(target[3:6])
        x = np.array(target[0:3]) + R_nb @ np.array(target[6:9]) * since
        in_b = rotation_vector(np.array(target[9:12]) * -since) @ R_nb.T @ (point - x)
        return Found(in_b[:2], time - self._steps * self._h)


def aimed(
    range_: Range, own: Sequence[Pose], target: Sequence[Pose], place: Array, normal: Array, closing_speed: float,
    steps: int, h: float,
) -> tuple[list[Pose], float]:  # fmt: skip
    """Own's track, shifted until the collision model finds the impact at `place`, and how far from it it still is [m].

    place, normal (2,): in the target's b; closing_speed along the normal [m/s]. Infinity: they do not meet at all.
    """
    psi = target[steps].heading
    R = np.array([[cos(psi), -sin(psi)], [sin(psi), cos(psi)]])
    outwards, along = R @ normal, np.array([-normal[1], normal[0]])
    track = nearer(own, -outwards * (OVERLAP + HALF_A_SUBSTEP * closing_speed))
    best: tuple[float, list[Pose]] = (float("inf"), list(track))
    for attempt in range(CORRECTIONS):
        found = _found_nearby(range_, track, target, outwards)
        if found is None:  # they pass within centimetres, or meet later
            track = nearer(track, -outwards * max(OVERLAP, closing_speed * h))
            continue
        misses = np.array([(place - one.point) @ along for one in found])
        late, middle = float(np.median([one.late for one in found])), 0.5 * float(misses.max() + misses.min())
        step = -closing_speed * late
        if abs(late) <= h + 2.0 * HALF_A_SUBSTEP:
            off = float(np.median([np.hypot(*(place - one.point)) for one in found]))
            if off < best[0]:
                best = (off, list(track))
            if off <= GOOD or (off <= BEST and abs(middle) <= GOOD):
                break
            # On the edge between two substeps, where the line of contact is longer or shorter: off that edge.
            step = -closing_speed * HALF_A_SUBSTEP * (-1.0) ** attempt if abs(middle) <= GOOD or attempt > 3 else 0.0
        track = nearer(track, R @ (along * middle) + outwards * step)
    return best[1], best[0]


def _found_nearby(
    range_: Range, own: Sequence[Pose], target: Sequence[Pose], outwards: Array
) -> list[Found] | None:  # fmt: skip
    """The first contact on the track, and when own is a hair nearer or farther; None when they then do not meet.

    Along a line of contact the closest points are anywhere, and what decides between them is rounding.
    """
    found = [range_.found(nearer(own, by * outwards), target) for by in (0.0, *NUDGES)]
    return [one for one in found if one is not None] if None not in found else None


def check_nothing_before(
    own: Sequence[Pose], target: Sequence[Pose], sections: Mapping[str, Array], deck: float, steps: int, h: float
) -> None:
    """Raises ScenarioError unless the ships are apart at the start, and until the impact at `steps`.

    sections in b, at the height `deck` (down) [m]: what a ship's heel moves them by does not count. Far apart, steps
    are taken as wide as that allows.
    """
    k = 0
    reach = sum(float(np.hypot(*polygon.T).max()) for polygon in sections.values())
    while k < steps:
        a, b = own[k], target[k]
        apart = hypot(a.north - b.north, a.east - b.east) - reach
        if apart <= 0.0:
            polygons = [
                moved(sections[name], np.array([pose.north, pose.east]), pose.heading)
                for name, pose in (("own", a), ("target", b))
            ]
            apart = gap(*polygons)
            deepest = DEEPEST + abs(deck) * (abs(sin(a.roll)) + abs(sin(b.roll)))
            if apart < -deepest and (steps - k) * h > 2.0 * HALF_A_SUBSTEP + h:
                raise ScenarioError(
                    f"the ships touch elsewhere {(steps - k) * h:.1f} s before the impact that is wanted: change the "
                    "angle, the place, the speeds or the rudder, or shorten the time before it"
                )
        k += max(1, int(apart / (4.0 * FASTEST * h)))
