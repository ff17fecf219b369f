"""What other forces do within a step, seen from poses; the way ahead in plain numbers; no answer adds energy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import Impulse, energy_velocities, make_contact
from shipcollision_fmu.collision.dynamics.other_forces import ReceivedState, estimate_other_forces
from shipcollision_fmu.collision.dynamics.passivity import enforce_passivity
from shipcollision_fmu.ship.coasting import coast
from shipcollision_fmu.ship.frames import rotation

H, REACH = 0.1, 100.0
ANGLE, RATE = st.floats(-0.5, 0.5), st.floats(-0.02, 0.02)
M_INVERSE = np.diag([1e-7, 2e-7, 1e-7, 1e-9, 1e-11, 1e-11])


def received(t: float, eta: list[float], nu: list[float], applied: np.ndarray | None = None) -> ReceivedState:
    return ReceivedState(t, H, eta[:3], eta[3:], nu, [0.0] * 6 if applied is None else applied.tolist())


@given(st.tuples(ANGLE, ANGLE, st.floats(-3, 3)), st.tuples(RATE, RATE, RATE), st.tuples(*[st.floats(-5, 5)] * 3))
def test_a_ship_that_coasts_has_none(
    attitude: tuple[float, ...], rate: tuple[float, ...], r_bg: tuple[float, ...]
) -> None:
    """Also where CO goes round CG, and with an impulse at the start of the step."""
    eta, nu, J = [3.0, -2.0, 1.0, *attitude], [4.0, 0.5, -0.1, *rate], np.array([1e6, -2e6, 0, 1e7, 0, 3e8])
    struck = (np.array(nu) + M_INVERSE @ J).tolist()
    position, angles, velocity = coast(eta[:3], eta[3:], struck[:3], struck[3:], r_bg, H)
    after = received(H, [*position, *angles], [*velocity, *struck[3:]], J)
    assert estimate_other_forces(received(0.0, eta, nu), after, M_INVERSE, np.array(r_bg), REACH) is None


def test_a_steady_force_is_half_in_the_mean_and_whole_at_the_end() -> None:
    a = np.array([0.02, -0.03, 0.0])
    eta, nu = [0.0, 0.0, 0.0, 0.0, 0.0, 0.7], [2.0, 0.1, 0.0, 0.0, 0.0, 0.0]
    R = rotation(eta[3:])
    x = R @ (np.array(nu[:3]) * H + 0.5 * a * H**2)
    later = received(H, [*x.tolist(), 0.0, 0.0, 0.7], [*(np.array(nu[:3]) + a * H).tolist(), 0.0, 0.0, 0.0])
    found = estimate_other_forces(received(0.0, eta, nu), later, M_INVERSE, np.zeros(3), REACH)
    assert found is not None
    np.testing.assert_allclose(found.velocity_bias[:3], 0.5 * a * H, atol=1e-12)
    np.testing.assert_allclose(found.velocity_gain[:3], a * H, atol=1e-12)


@pytest.mark.parametrize(("t", "x"), [(0.3, 0.2), (H, 9.0)])
def test_a_jump_in_time_or_place_is_no_force(t: float, x: float) -> None:
    eta, nu = [0.0] * 6, [2.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    after = received(t, [x + 0.001, *[0.0] * 5], nu)
    assert estimate_other_forces(received(0.0, eta, nu), after, M_INVERSE, np.zeros(3), REACH) is None


@given(st.tuples(ANGLE, ANGLE, st.floats(-9, 9)), st.tuples(RATE, RATE, RATE))
def test_a_far_step_is_that_of_the_body_state(attitude: tuple[float, ...], rate: tuple[float, ...]) -> None:
    position, velocity = np.array([100.0, -50.0, 1.0]), [4.0, 0.5, -0.1]
    r_bg = np.array([-3.0, 0.5, 2.0])
    state = BodyState.at(position, np.array(attitude), np.array([*velocity, *rate]), M_INVERSE, r_bg)
    state.advance(0.2)
    state.advance(0.3)
    place, angles, turned = coast(position.tolist(), attitude, velocity, rate, r_bg.tolist(), 0.5)
    np.testing.assert_allclose(place, state.x, atol=1e-12)
    np.testing.assert_allclose(rotation(angles), state.R, atol=1e-12)
    np.testing.assert_allclose([*turned, *rate], state.twist_at_predicted_pose(), atol=1e-12)
    assert abs(angles[2] - attitude[2]) < 0.1


@given(st.floats(0.1, 10.0), st.floats(-3.0, 3.0))
def test_an_answer_that_would_add_energy_becomes_elastic(size: float, sway: float) -> None:
    """A ship at 1 m/s against a wall; beyond twice the plastic impulse energy is added, and is taken back."""
    wall = BodyState.wall(np.array([50.0, 0.0, 0.0]), 0.0)
    ship = BodyState.at(np.zeros(3), np.zeros(3), np.array([1.0, sway, 0, 0, 0, 0]), M_INVERSE)
    states = [ship, wall]
    contact = make_contact(0, 1, states, np.array([50.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]), 0.0)
    (answer,), taken_off = enforce_passivity([Impulse(contact, np.array([size * 1e7, 0.0, 0.0]))], states)
    assert answer.P[0] == pytest.approx(min(size, 2.0) * 1e7)
    assert (taken_off > 0.0) == (answer.P[0] < size * 1e7 * (1.0 - 1e-9))
    np.testing.assert_allclose(energy_velocities([contact], states)[0], [-1.0, -sway, 0.0])
