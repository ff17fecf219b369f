"""Pose and twist of a ship in one value."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from shipcollision_fmu.ship.coasting import coast
from shipcollision_fmu.ship.ship_state import ShipState

STATE = ShipState(10.0, -20.0, 0.5, 0.1, -0.05, 0.7, 3.0, 0.5, 0.1, 0.01, -0.02, 0.03)


def test_groups_are_the_numbers_in_their_order() -> None:
    assert (*STATE.position, *STATE.attitude, *STATE.velocity, *STATE.rate) == tuple(STATE)


def test_the_velocity_of_a_point_is_the_change_of_its_place() -> None:
    r_b, h = np.array([50.0, -10.0, 4.0]), 1e-6
    position, attitude, _ = coast(STATE.position, STATE.attitude, STATE.velocity, STATE.rate, [0.0, 0.0, 0.0], h)
    after = STATE._replace(**dict(zip(STATE._fields, (*position, *attitude), strict=False)))
    places = [np.array(state.position) + state.R_nb @ r_b for state in (STATE, after)]
    np.testing.assert_allclose((places[1] - places[0]) / h, STATE.velocity_at(r_b), atol=1e-6)


def test_an_upright_ship_moves_in_the_plane() -> None:
    state = ShipState.upright(1.0, 2.0, pi / 2, 3.0, 4.0, 0.1)
    assert state.plan_velocity == pytest.approx((-4.0, 3.0))
    np.testing.assert_allclose(state.velocity_at(np.zeros(3)), [*state.plan_velocity, 0.0], atol=1e-15)
