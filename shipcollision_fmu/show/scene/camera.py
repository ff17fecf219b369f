"""Where to look from: one camera over the time of a scene, for the films and for OpenSceneGraph.

The camera looks at the place of the first collision, half-way between the points of both ships that touch there, and
keeps its bearing and height, so that the ships move and not the sea. The bearing is the middle of the widest gap
between the ships as seen from that place at the time of contact: no hull is in the way. As the ships come from afar and
drift apart it stands back. Without a collision it looks at the middle of all ships. Frame n.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array, rotation_from_quaternion
from .scene import Scene, Scratch, Ship

__all__ = ["ANGLE", "Camera", "camera_of"]

ANGLE = 32.0
"""Vertical angle of view [deg]: about that of osgviewer."""
HEIGHT = 24.0
"""Of the eye over the horizontal through what it looks at [deg]."""
BEARINGS = 72
"""Bearings that are looked at for a gap."""
NEAR = 0.1
"""Hull nearer to the place than this [lengths] does not hide it: the eye is above."""
CLOSE = 1.45
"""Distance from the place of contact, in mean lengths of the two ships."""


@dataclass(frozen=True)
class _Mark:
    """A point of a ship, in its b."""

    ship: Ship
    point: Array

    def at(self, time: float) -> Array:
        position, quaternion = self.ship.track.at(time)
        place: Array = position + rotation_from_quaternion(quaternion) @ self.point
        return place


@dataclass(frozen=True)
class Camera:
    """A camera of a scene; see camera_of."""

    marks: tuple[_Mark, ...]
    direction: Array
    distance: float

    def at(self, time: float) -> tuple[Array, Array]:
        """Place of the eye (3,) and what it looks at (3,) in n [m], at `time` [s]."""
        places = np.array([mark.at(time) for mark in self.marks])
        target = 0.5 * (places.min(axis=0) + places.max(axis=0))
        target[2] *= 0.5
        apart = float(np.linalg.norm(np.ptp(places, axis=0)[:2]))
        return target + self.direction * (self.distance + 1.1 * apart), target


def camera_of(scene: Scene) -> Camera:
    """The camera of a scene."""
    first = min((s.id for s in scene.scratches), default=None)
    touched = [scratch for scratch in scene.scratches if scratch.id == first]
    if not touched:
        marks = tuple(_Mark(ship, np.zeros(3)) for ship in scene.ships)
        length = max(ship.L_oa for ship in scene.ships)
        return Camera(marks, _direction(np.radians(135.0)), 2.0 * length)
    ships = [scene.ship(scratch.ship) for scratch in touched]
    marks = tuple(_Mark(ship, scratch.points[0]) for ship, scratch in zip(ships, touched, strict=True))
    bearing = _open_bearing(scene, touched[0])
    return Camera(marks, _direction(bearing), CLOSE * float(np.mean([ship.L_oa for ship in ships])))


def _direction(bearing: float) -> Array:
    height = np.radians(HEIGHT)
    return np.array([np.cos(bearing) * np.cos(height), np.sin(bearing) * np.cos(height), -np.sin(height)])


def _open_bearing(scene: Scene, scratch: Scratch) -> float:
    """Middle of the widest range of bearings [rad], from the first contact point, in which no ship lies.

    What is nearer than NEAR lengths does not count: a bow that is touched at its side reaches round the place.
    """
    bearer, time = scene.ship(scratch.ship), float(scratch.times[0])
    place = _Mark(bearer, scratch.points[0]).at(time)
    taken = np.zeros(BEARINGS, dtype=bool)
    for ship in scene.ships:
        position, quaternion = ship.track.at(time)
        away = (position + _outline(ship) @ rotation_from_quaternion(quaternion).T - place)[:, :2]
        away = away[np.linalg.norm(away, axis=1) > NEAR * bearer.L_oa]
        taken[np.floor(np.arctan2(away[:, 1], away[:, 0]) / (2 * np.pi) * BEARINGS).astype(int) % BEARINGS] = True
    start, count = _widest_gap(taken.tolist())
    return (start + 0.5 * count) * 2 * np.pi / BEARINGS


def _widest_gap(taken: list[bool]) -> tuple[int, int]:
    """Start and number of the longest run of False round the circle; from 0, none, where all or nothing is taken."""
    if not any(taken):
        return 0, 0
    best, run = (0, 0), 0
    for i, blocked in enumerate([*taken, *taken]):
        run = 0 if blocked else run + 1
        if run > best[1]:
            best = (i - run + 1, run)
    return best


def _outline(ship: Ship) -> Array:
    """Points (k, 3) of the hull in b, close enough together along its edges to leave no false gap."""
    p = ship.hull.vertices[ship.hull.triangles]
    share = np.linspace(0.0, 1.0, 40)[:, None, None, None]
    edges: Array = p + share * (np.roll(p, -1, axis=1) - p)
    return edges.reshape(-1, 3)
