"""Collisions in time: one for an incident, another one after a time apart."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.collision.collisions import SCRATCH_PAUSE, Episodes
from shipcollision_fmu.collision.dynamics.body_state import Shadow
from shipcollision_fmu.collision.dynamics.contact import make_contact

SHADOWS = [Shadow.at(np.zeros(3), np.zeros(3), np.array([x, 0, 0, 0, 0, 0]), np.eye(6)) for x in (3.0, 0.0)]
CONTACTS = [make_contact(0, 1, SHADOWS, np.zeros(3), np.array([1.0, 0.0, 0.0]), 0.0)]


def touched(times: list[float], apart: float = 10.0) -> Episodes:
    episodes = Episodes(apart)
    for t in times:
        episodes.close_old(t)
        episodes.touch(t, CONTACTS, SHADOWS)
    return episodes


@pytest.mark.parametrize(("pause", "collisions"), [(9.99, 1), (10.0, 2), (500.0, 2)])
def test_a_pair_that_was_apart_for_long_enough_collides_anew(pause: float, collisions: int) -> None:
    episodes = touched([1.0, 2.0, 2.0 + pause])
    assert episodes.impacts == collisions
    assert episodes.latest.time == (1.0 if collisions == 1 else 2.0 + pause)
    assert episodes.latest.closing_speed == 3.0


def test_contact_that_comes_and_goes_is_one_collision_for_ever() -> None:
    assert touched([0.9 * k for k in range(1000)], apart=1.0).impacts == 1


@pytest.mark.parametrize(("pause", "scratches"), [(0.9 * SCRATCH_PAUSE, 1), (1.1 * SCRATCH_PAUSE, 2)])
def test_a_scratch_ends_sooner_than_its_collision(pause: float, scratches: int) -> None:
    episodes = touched([1.0, 1.0 + pause])
    assert (episodes.impacts, episodes.scratches) == (1, scratches)
    assert episodes.numbers(0, 1) == (1, scratches)
