"""Shifts own's track until the collision model finds the impact at the required place and time.

The place of an impact is the middle of the first contact (impact.north ... of the FMU). Where a corner meets a side, it
is the corner. Two sides within some centimetres of parallel touch along a line of several metres, and the place is the
middle of the line: a track that brings a corner to the place would then be recorded beside it. A heeled ship touches
with its deck edge elsewhere than an upright ship. The search therefore starts from the sections in plan
(plan_contact.py), runs the collision model over the last steps before the impact, and corrects what it finds.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin
from typing import NamedTuple

import numpy as np

from ..collision.model import ShipCollision
from ..ship.frames import Array, rotation, rotation_vector
from ..ship.ship_state import ShipState
from .approach_track import POINTS_AFTER, shift_track
from .approaching_ship import ApproachingShip

__all__ = ["ACCEPTED", "Hit", "ImpactFinder", "aim_track"]

OVERLAP = 0.012
"""[m] Overlap of the sections at the impact. Detection ignores about as much, so with less the collision model finds
the contact one substep later."""
HALF_A_SUBSTEP = 0.005
"""[s] Half of the collision model's default substep, by which the hulls touch early so that the contact is found in the
right step."""
GOOD = 0.02
"""[m] Distance from the place below which no correction follows; smaller costs runs of the model."""
ACCEPTED = 0.35
"""[m] Largest distance from the place that targeting accepts. The encounter promises 0.5 m; the rest is left for the
rounding of the scenario file."""
CORRECTIONS = 16
"""Corrections of a track before the way of touching is given up."""
NUDGES = (2e-4, -2e-4, 1e-5, -1e-5)
"""[m] Shifts that must lead to the same impact. A scenario file rounds positions to 1e-5 m; without the nudges an
impact that depends on this rounding would be accepted."""
POINTS_BEFORE = 3
"""Communication points before the impact at which the search starts the collision model."""


class Hit(NamedTuple):
    """The first contact: its point in the target's b (2,) [m] and its time less the required time [s]."""

    point: Array
    time_error: float


class ImpactFinder:
    """A collision model of both ships that finds the first contact of two tracks. Close it after use."""

    def __init__(self, own: ApproachingShip, target: ApproachingShip, steps: int, h: float) -> None:
        self._steps, self._h = steps, h
        self._model = ShipCollision(("own", "target"))
        for parameters, ship in zip(self._model.parameters.ships, (own, target), strict=True):
            parameters.ship, parameters.degrees_of_freedom = ship.file, ship.degrees_of_freedom
            parameters.coasting = ship.predicted_law
        self._initial_state: dict[str, object] | None = None

    def find_impact(self, own: Sequence[ShipState], target: Sequence[ShipState]) -> Hit | None:
        """The first contact of these tracks; None when there is none until POINTS_AFTER the impact."""
        model, h = self._model, self._h
        first = max(0, self._steps - POINTS_BEFORE)
        for k in range(first, self._steps + POINTS_AFTER):
            for state, pose in zip(model.inputs.ships, (own[k], target[k]), strict=True):
                state.position[:], state.attitude[:] = pose[0:3], pose[3:6]
                state.velocity[:], state.rate[:] = pose[6:9], pose[9:12]
            if self._initial_state is None:
                model.initialise()
                self._initial_state = model.get_state()
            elif k == first:
                model.set_state(self._initial_state)
            model.step(k * h, h)
            if model.outputs.collision_count:
                return self._convert_impact(target[k], k)
        return None

    def close(self) -> None:
        """Disconnect from Bullet."""
        self._model.close()

    def _convert_impact(self, target: ShipState, k: int) -> Hit:
        """The model's latest impact, found in the step from k, in the target's b."""
        time, point = self._model.outputs.impact.time, np.array(self._model.outputs.impact.point)
        since = time - k * self._h
        R_nb = rotation(target[3:6])
        x = np.array(target[0:3]) + R_nb @ np.array(target[6:9]) * since
        in_b = rotation_vector(np.array(target[9:12]) * -since) @ R_nb.T @ (point - x)
        return Hit(in_b[:2], time - self._steps * self._h)


def aim_track(
    finder: ImpactFinder, own: Sequence[ShipState], target: Sequence[ShipState], place: Array, normal: Array,
    closing_speed: float, steps: int, h: float,
) -> tuple[list[ShipState], float]:  # fmt: skip
    """Own's track shifted so that the impact is found at `place`, and the distance from it that remains [m].

    place, normal (2,) in the target's b; closing_speed along the normal [m/s]. The distance is infinite when no contact
    was found at the required time.
    """
    psi = target[steps].heading
    R = np.array([[cos(psi), -sin(psi)], [sin(psi), cos(psi)]])
    outwards, along = R @ normal, np.array([-normal[1], normal[0]])
    track = shift_track(own, -outwards * (OVERLAP + HALF_A_SUBSTEP * closing_speed))
    best: tuple[float, list[ShipState]] = (float("inf"), list(track))
    for attempt in range(CORRECTIONS):
        hits = _find_impacts_nearby(finder, track, target, outwards)
        if hits is None:  # they pass within centimetres, or meet later
            track = shift_track(track, -outwards * max(OVERLAP, closing_speed * h))
            continue
        misses = np.array([(place - hit.point) @ along for hit in hits])
        time_error = float(np.median([hit.time_error for hit in hits]))
        middle = 0.5 * float(misses.max() + misses.min())
        step = -closing_speed * time_error
        if abs(time_error) <= h + 2.0 * HALF_A_SUBSTEP:
            off = float(np.median([np.hypot(*(place - hit.point)) for hit in hits]))
            if off < best[0]:
                best = (off, list(track))
            if off <= GOOD or (off <= ACCEPTED and abs(middle) <= GOOD):
                break
            # Between two substeps the line of contact is longer in one than in the other: move away from there.
            step = -closing_speed * HALF_A_SUBSTEP * (-1.0) ** attempt if abs(middle) <= GOOD or attempt > 3 else 0.0
        track = shift_track(track, R @ (along * middle) + outwards * step)
    return best[1], best[0]


def _find_impacts_nearby(
    finder: ImpactFinder, own: Sequence[ShipState], target: Sequence[ShipState], outwards: Array
) -> list[Hit] | None:  # fmt: skip
    """The impacts of the track and of the track shifted by each of NUDGES; None when one of them has no impact.

    Along a line of contact all points are equally near, and rounding decides which of them is reported.
    """
    hits = [finder.find_impact(shift_track(own, shift * outwards), target) for shift in (0.0, *NUDGES)]
    return [hit for hit in hits if hit is not None] if None not in hits else None
