"""Collisions in time: one for an incident, another one after a time apart."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.collision.collisions import SCRATCH_PAUSE, Collisions
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import make_contact

STATES = [BodyState.at(np.zeros(3), np.zeros(3), np.array([x, 0, 0, 0, 0, 0]), np.eye(6)) for x in (3.0, 0.0)]
CONTACTS = [make_contact(0, 1, STATES, np.zeros(3), np.array([1.0, 0.0, 0.0]), 0.0)]


def touched(times: list[float], apart: float = 10.0) -> Collisions:
    tracker = Collisions(apart)
    for t in times:
        tracker.close_old(t)
        tracker.register(t, CONTACTS, STATES)
    return tracker


@pytest.mark.parametrize(("pause", "collisions"), [(9.99, 1), (10.0, 2), (500.0, 2)])
def test_a_pair_that_was_apart_for_long_enough_collides_anew(pause: float, collisions: int) -> None:
    tracker = touched([1.0, 2.0, 2.0 + pause])
    assert tracker.count == collisions
    assert tracker.latest.time == (1.0 if collisions == 1 else 2.0 + pause)
    assert tracker.latest.closing_speed == 3.0


def test_contact_that_comes_and_goes_is_one_collision_for_ever() -> None:
    assert touched([0.9 * k for k in range(1000)], apart=1.0).count == 1


@pytest.mark.parametrize(("pause", "scratches"), [(0.9 * SCRATCH_PAUSE, 1), (1.1 * SCRATCH_PAUSE, 2)])
def test_a_scratch_ends_sooner_than_its_collision(pause: float, scratches: int) -> None:
    tracker = touched([1.0, 1.0 + pause])
    assert (tracker.count, tracker.scratches) == (1, scratches)
    assert tracker.register(1.0 + pause, CONTACTS, STATES)[0, 1][:2] == (1, scratches)
