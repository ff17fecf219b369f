"""Refuses a scenario whose bodies overlap at the start, where no impulse would be right.

Plans are compared first, which is cheap; the solids are compared only where the plans overlap.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import closing
from math import hypot

import numpy as np

from ..collision.dynamics.body_state import BodyState
from ..collision.geometry.detection import SHALLOW, Detector
from ..collision.geometry.plan_overlap import least_overlap
from ..collision.obstacles import ObstacleTable, build_obstacle
from ..errors import ScenarioError
from ..ship.hull.hull import build_hull
from ..ship.hull.solid import HullMesh
from ..ship.ship import Ship
from .tables.ship_start import ShipStart

__all__ = ["refuse_overlap"]


def refuse_overlap(
    source: str, starts: Mapping[str, ShipStart], ships: Mapping[str, Ship], obstacles: Mapping[str, ObstacleTable]
) -> None:
    """Raises ScenarioError when two ships, or a ship and an obstacle, overlap by more than SHALLOW at the start.

    Less is taken for contact: ships that start alongside. `source` names the scenario in the message.
    """
    hulls: list[HullMesh] = []
    states: list[BodyState] = []
    for name, ship in ships.items():
        start = starts[name].start
        hulls.append(build_hull(ship.L_oa, ship.B, ship.T, ship.hull))
        states.append(BodyState.at(np.array(start.position), np.array(start.attitude), np.zeros(6), np.zeros((6, 6))))
    for name, table in obstacles.items():
        solid = build_obstacle(name, table)
        hulls.append(solid.solid)
        states.append(BodyState.wall(solid.position, solid.heading))
    labels = [f"[ships.{name}]" for name in ships] + [f"[obstacles.{name}]" for name in obstacles]
    for a in range(len(ships)):
        for b in range(a + 1, len(hulls)):
            depth = _overlap((hulls[a], hulls[b]), (states[a], states[b]))
            if depth > SHALLOW:
                raise ScenarioError(
                    f"{source}: {labels[a]} and {labels[b]} overlap by {depth:.3g} m at the start, more than "
                    f"{SHALLOW:g} m: move one of them"
                )


def _overlap(hulls: tuple[HullMesh, HullMesh], states: tuple[BodyState, BodyState]) -> float:
    """Least way [m] that parts two solids; 0 where they are apart."""
    reach = sum(float(np.linalg.norm(hull.vertices, axis=1).max()) for hull in hulls)
    (n_a, e_a, _), (n_b, e_b, _) = states[0].x.tolist(), states[1].x.tolist()
    if hypot(n_b - n_a, e_b - e_a) > reach:
        return 0.0
    placed = [state.x + hull.vertices @ state.R.T for hull, state in zip(hulls, states, strict=True)]
    if least_overlap(*placed)[0] <= SHALLOW:
        return 0.0
    detector = Detector(hulls)
    with closing(detector.narrow_phase):
        return max(0.0, -detector.clearance(0, 1, states, 0.0))
