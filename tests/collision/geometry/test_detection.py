"""Detection: Bullet's answers after cleaning, on the cases in which Bullet alone is wrong."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.geometry.detection import SHALLOW, Detector
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.tables.hull import HullTable

BOX = HullTable(shape="box", depth=20.0)
PLUMB = HullTable(shape="parametric", depth=20.0, bow_length=40.0, stern_length=50.0)
RAKED = HullTable(shape="parametric", depth=20.0, bow_length=40.0, stern_length=50.0, stem_rake_deg=15.0)
DEEP_BOX = HullTable(shape="box", depth=26.0)


def state(x: float, y: float, z: float = 0.0, heading: float = 0.0, roll: float = 0.0) -> BodyState:
    return BodyState.at(np.array([x, y, z]), np.array([roll, 0.0, heading]), np.zeros(6), np.eye(6))


@pytest.fixture
def detector() -> Iterator[Detector]:
    made = Detector([build_hull(200.0, 30.0, 10.0, table) for table in (BOX, PLUMB, RAKED, DEEP_BOX)])
    yield made
    made.narrow_phase.close()


def place(**where: BodyState) -> list[BodyState]:
    states = [state(0.0, 1e4 * (i + 1)) for i in range(4)]
    for name, one in where.items():
        i = ("box", "plumb", "raked", "deep").index(name)
        states[i] = one
    return states


EAST = np.pi / 2


def test_clearance_is_the_distance_and_is_capped(detector: Detector) -> None:
    states = place(box=state(0, 0), plumb=state(0, 37.5))
    assert detector.clearance(0, 1, states, 100.0) == pytest.approx(7.5, abs=1e-6)
    assert detector.clearance(0, 1, states, 5.0) == 5.0


def test_apart_is_no_contact_however_near(detector: Detector) -> None:
    states = place(box=state(0, 0), plumb=state(0, 30.01))
    assert detector.contacts(0, 1, states, {}) == []


def test_plumb_stem_on_a_side_touches_over_the_common_height(detector: Detector) -> None:
    """Ship 1 heads west into the starboard side of the box; both reach from -10 to 10 m, the stem is 4 m deeper."""
    states = place(box=state(0, 0), plumb=state(20.0, 115.0 - 0.02, z=4.0, heading=-EAST))
    contacts = detector.contacts(0, 1, states, {})
    assert sorted(round(c.point[2], 3) for c in contacts) == [-6.0, 10.0]
    for c in contacts:
        assert c.gap == pytest.approx(-0.02, abs=1e-6)
        np.testing.assert_allclose(c.normal, [0, 1, 0], atol=1e-6)  # from a to b
        np.testing.assert_allclose(c.point[:2], [20.0, 14.99], atol=0.01)
        np.testing.assert_allclose(c.r_a, [20.0, 14.99, c.point[2]], atol=0.01)
        np.testing.assert_allclose(c.r_b[0], 100.0, atol=0.02)


def test_order_of_the_ships_turns_the_normal(detector: Detector) -> None:
    states = place(plumb=state(20.0, 114.98, heading=-EAST), deep=state(0, 0))
    (first, *_) = detector.contacts(1, 3, states, {})
    np.testing.assert_allclose(first.normal, [0, -1, 0], atol=1e-6)


def test_raked_stem_touches_at_one_point_at_the_height_of_the_lower_deck(detector: Detector) -> None:
    """The stem top is the foremost point; the struck side is higher, so the stem's own deck corner touches."""
    states = place(raked=state(0.0, 114.97, heading=-EAST), deep=state(0, 0))
    contacts = detector.contacts(2, 3, states, {})
    assert len(contacts) == 1
    np.testing.assert_allclose(contacts[0].point, [0.0, 14.985, -10.0], atol=0.02)


def test_side_on_side_gives_the_corners_of_the_common_area(detector: Detector) -> None:
    states = place(box=state(0, 0), deep=state(30.0, 29.96))
    contacts = detector.contacts(0, 3, states, {})
    corners = sorted((round(float(c.point[0]), 2), round(float(c.point[2]), 2)) for c in contacts)
    assert corners == [(-70.0, -10.0), (-70.0, 10.0), (100.0, -10.0), (100.0, 10.0)]


def test_tilted_side_leaves_only_the_edge_that_touches(detector: Detector) -> None:
    """Half a degree of roll opens the side by 17 cm over its height: a line, not an area."""
    states = place(box=state(0, 0, roll=np.radians(0.5)), deep=state(0.0, 30.0 + 0.05))
    contacts = detector.contacts(0, 3, states, {})
    assert len(contacts) == 2
    assert all(c.gap < 0.0 for c in contacts)
    assert len({round(float(c.point[2])) for c in contacts}) == 1


def test_deep_overlap_keeps_the_last_shallow_normal(detector: Detector) -> None:
    """Least overlap of two flat hulls is soon up or down; the side that was struck stays the side."""
    last_normals: dict = {}
    for depth in (0.1, 0.3, 1.0, 5.0, 12.0):
        states = place(box=state(0, 0), deep=state(0.0, 30.0 - depth))
        contacts = detector.contacts(0, 3, states, last_normals)
        assert contacts
        for c in contacts:
            np.testing.assert_allclose(c.normal, [0, 1, 0], atol=1e-5)
            assert c.gap == pytest.approx(-depth, abs=1e-6)
    assert depth > SHALLOW
    states = place(box=state(0, 0), deep=state(0.0, 60.0))
    assert detector.contacts(0, 3, states, last_normals) == []
    assert last_normals == {}


def test_a_kept_normal_turns_with_the_hull_that_carries_it(detector: Detector) -> None:
    last_normals: dict = {}
    states = place(box=state(0, 0), plumb=state(0.0, 114.9, heading=-EAST))
    detector.contacts(0, 1, states, last_normals)
    turned = np.radians(10.0)
    position = np.array([[np.cos(turned), -np.sin(turned)], [np.sin(turned), np.cos(turned)]]) @ [0.0, 112.0]
    states = place(box=state(0, 0, heading=turned), plumb=state(*position, heading=turned - EAST))
    for c in detector.contacts(0, 1, states, last_normals):
        np.testing.assert_allclose(c.normal, [-np.sin(turned), np.cos(turned), 0], atol=1e-5)
        assert c.gap == pytest.approx(-3.0, abs=1e-3)


def test_contact_is_booked_at_one_point_between_the_places_of_application(detector: Detector) -> None:
    states = place(box=state(0, 0), plumb=state(0.0, 114.99, heading=-EAST))
    for one in states[:2]:
        one.x_applied = one.x - [0.0, 0.1, 0.0]  # both moved 0.1 m east since the start of the step
    for c in detector.contacts(0, 1, states, {}):
        np.testing.assert_allclose(c.at, c.point - [0.0, 0.1, 0.0], atol=1e-9)
