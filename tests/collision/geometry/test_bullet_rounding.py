"""Bullet rounds the corners of every hull: by how much, and what it does to an impact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from shipcollision_fmu.collision.geometry.adapter import open_narrow_phase
from shipcollision_fmu.collision.geometry.detection import Detector
from shipcollision_fmu.collision.geometry.narrow_phase import NarrowPhase
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.loading.library import load_ship
from tests.collision.conftest import World

STEPS = 10216
"""Steps into which Bullet's hull computer divides the extent of a hull along each axis."""


def hull_of(name: str) -> HullMesh:
    ship = load_ship(name)
    return build_hull(ship.L_oa, ship.B, ship.T, ship.hull)


def rounded(adapter: NarrowPhase, ship: int, parts: tuple[np.ndarray, ...]) -> tuple[np.ndarray, ...]:
    """The parts with the corners that Bullet has, in the order of ours."""
    found = []
    for i, part in enumerate(parts):
        there = adapter.corners(ship, i)
        found.append(np.array([there[np.argmin(np.linalg.norm(there - corner, axis=1))] for corner in part]))
    return tuple(found)


@pytest.mark.parametrize(
    ("name", "largest"), [("kvlcc2", 29.4e-3), ("kcs", 21.9e-3), ("kvlcc2_l7", 0.7e-3), ("buoy", 0)]
)
def test_corners_are_rounded_to_1_10216_of_the_extent(name: str, largest: float) -> None:
    """Each coordinate by at most one step; the planes that bound the hull stay within 1 mm. A box keeps its corners."""
    hull = hull_of(name)
    adapter = open_narrow_phase([hull])
    moved = []
    for part, there in zip(hull.parts, rounded(adapter, 0, hull.parts), strict=True):
        step = np.ptp(part, axis=0) / STEPS
        assert (np.abs(there - part) <= step * (1.0 + 1e-6) + 1e-9).all()
        np.testing.assert_allclose(there.max(axis=0), part.max(axis=0), atol=1.1e-3)
        np.testing.assert_allclose(there.min(axis=0), part.min(axis=0), atol=1.1e-3)
        moved.append(np.linalg.norm(there - part, axis=1).max())
    adapter.close()
    assert max(moved) == pytest.approx(largest, abs=0.1e-3)


@pytest.mark.parametrize(("heading", "offset"), [(1.58, 3.0), (0.66, -94.0), (2.37, 50.0)])
def test_places_from_rounded_corners_would_change_no_impulse(
    world: Callable[..., World], monkeypatch: pytest.MonkeyPatch, heading: float, offset: float
) -> None:
    """Bullet finds that hulls touch, up to 29 mm early or late; places and features come from the exact corners. With
    the rounded ones the impulse of a tanker's bow is the same to a thousandth, so the exact ones stay."""

    class RoundedDetector(Detector):
        def __init__(self, hulls: list[HullMesh], adapter: str | None = None) -> None:
            super().__init__(hulls, adapter)
            self._hulls = tuple(
                replace(hull, parts=rounded(self.narrow_phase, i, hull.parts)) for i, hull in enumerate(hulls)
            )

    place = [offset - 170.0 * np.cos(heading), -32.0 - 165.0 * np.sin(heading), 0.0]
    start = [
        {"position": [0.0, 0.0, 0.0], "nu": [0.0] * 6},
        {"position": place, "attitude": (0.0, 0.0, heading), "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
    ]
    taken = []
    for detector in (Detector, RoundedDetector):
        monkeypatch.setattr("shipcollision_fmu.collision.model.Detector", detector)
        w = world(["kvlcc2", "kvlcc2"], start, degrees_of_freedom=3, friction=0.0)
        while not w.model.outputs.contact_count and w.t < 12.0:
            w.step(0.1)
        taken.append(np.array(w.model.outputs.ships[0].impulse) / ([1.0] * 3 + [160.0] * 3))
    assert np.linalg.norm(taken[0][:3]) > 1e7
    assert np.linalg.norm(taken[0] - taken[1]) <= 1e-3 * np.linalg.norm(taken[0][:3])
