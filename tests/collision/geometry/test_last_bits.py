"""The last bits of a pose choose no contact normal: two hosts, or two languages, see one collision."""

from __future__ import annotations

import random
from math import pi

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.geometry.adapter import open_narrow_phase
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship

POSES = 60
NUDGE = 1e-15
"""Of a pose, as a share: some of its last bits."""
SAME = 1e-8
"""Of a normal, between poses that are rounded to neighbours 0.1 nm apart."""


def state(x: float, y: float, heading: float) -> BodyState:
    return BodyState.at(np.array([x, y, 0.0]), np.array([0.0, 0.0, heading]), np.zeros(6), np.eye(6))


@pytest.mark.parametrize("adapter", [pytest.param("pybullet", marks=pytest.mark.needs("pybullet")), "library"])
def test_last_bits_of_a_pose_choose_no_normal(adapter: str) -> None:
    """A stem meets the side of a ship whose deck is level with its own: edges and corners are equally near."""
    ship, draw = load_ship("kvlcc2"), random.Random(1)
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    narrow_phase = open_narrow_phase([hull, hull], adapter)
    reach = 0.5 * (ship.L_oa + ship.B) + 1.0
    met = other = 0
    for _ in range(POSES):
        x, y, heading = draw.uniform(-80.0, 80.0), reach, -0.5 * pi + draw.uniform(-0.02, 0.02)
        states = [state(0.0, 0.0, 0.0), state(x, y, heading)]
        y -= narrow_phase.gap(0, 1, states, 10.0) + draw.uniform(0.0, 5e-5)
        answers = []
        for nudge in (0.0, NUDGE, -NUDGE):
            states = [state(0.0, 0.0, 0.0), state(x * (1.0 + nudge), y * (1.0 + nudge), heading * (1.0 + nudge))]
            found = narrow_phase.closest(0, 1, states, 0.0)
            answers.append(found[0].normal if found else np.zeros(3))
        met += bool(answers[0].any())
        other += any(np.abs(each - answers[0]).max() > SAME for each in answers)
    narrow_phase.close()
    assert met >= 0.9 * POSES
    assert other <= 0.02 * POSES  # of those whose pose lies where 0.1 nm are rounded the other way
