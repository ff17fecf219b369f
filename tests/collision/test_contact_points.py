"""What is shown of contact points loses nothing: sums per pair, and friction that stays in its cone."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.collision.contact_points import (
    ContactPoint,
    fill_contacts,
    fit_contact_points,
    merge_contact_point,
)
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import make_contact
from shipcollision_fmu.collision.interface import ContactOutput, contact_point_count

STATES = [BodyState.at(np.zeros(3), np.zeros(3), np.zeros(6), np.eye(6)) for _ in range(6)]


def point(
    a: int, b: int, place: float, P: list[float], normal: tuple[float, float] = (0.0, 1.0), collision: int = 1
) -> ContactPoint:
    contact = make_contact(a, b, STATES, np.array([place, 0.0, 0.0]), np.array([*normal, 0.0]), -0.01)
    return ContactPoint.of(contact, np.array(P), 10.0, collision, collision)


def shown(of: ContactPoint) -> ContactOutput:
    out = ContactOutput()
    fill_contacts([of], [out])
    return out


@pytest.mark.parametrize(("ships", "points"), [(2, 8), (3, 12), (20, 64), (500, 64)])
def test_contact_points_grow_with_the_ships_of_the_build(ships: int, points: int) -> None:
    assert contact_point_count(ships) == points


def test_a_normal_that_turns_between_substeps_makes_no_friction() -> None:
    """Frictionless impulses of 3 and 4 N s along two normals: none of either is tangential."""
    (joined,) = merge_contact_point(
        [point(0, 1, 0.0, [0.0, 3.0, 0.0])], point(0, 1, 0.1, [4.0, 0.0, 0.0], normal=(1.0, 0.0))
    )
    assert shown(joined).impulse_normal == 7.0
    assert shown(joined).impulse_tangential == 0.0
    assert shown(joined).impulse == [4.0, 3.0, 0.0]
    assert shown(joined).energy == 20.0


def test_too_many_points_are_joined_by_pair_and_kind() -> None:
    points = [point(0, 1, 10.0 * k, [0.1, 1.0 + k, 0.0]) for k in range(4)]
    points += [point(2, 3, 10.0 * k, [0.0, 20.0, 0.0]) for k in range(3)]
    points += [point(0, 1, 50.0, [0.0, 5.0, 0.0], collision=0)]  # of a fender
    assert fit_contact_points(points, 8) == points
    joined = fit_contact_points(points, 7)
    assert [(s.contact.a, s.contact.b, s.collision > 0) for s in joined] == [
        (2, 3, True), (0, 1, True), (0, 1, False),
    ]  # fmt: skip
    assert [s.P.tolist() for s in joined] == [[0.0, 60.0, 0.0], [pytest.approx(0.4), 10.0, 0.0], [0.0, 5.0, 0.0]]
    assert [s.energy for s in joined] == [30.0, 40.0, 10.0]
    assert joined[1].contact.point[0] == 30.0  # of the largest impulse
    assert len(fit_contact_points(points, 2)) == 2
