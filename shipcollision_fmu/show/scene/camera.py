"""Camera of a scene over time, for films and OpenSceneGraph.

The camera looks at the place of the first collision, half-way between the points of both ships that touch there, and
keeps its bearing and height, so that the ships move and not the sea. The bearing is the middle of the widest gap
between the ships around this place at the time of contact, so that no hull hides it. The camera's distance grows with
the distance of the ships. Without a collision it looks at the middle of all ships. All vectors are in n.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array, rotation_from_quaternion
from .scene import Scene, Scratch, Ship

__all__ = ["ANGLE", "Camera", "place_camera"]

ANGLE = 32.0
"""Vertical angle of view [deg]: about that of osgviewer."""
HEIGHT = 14.0
"""Elevation of the eye over the target [deg]."""
BEARINGS = 72
"""Number of bearings that are searched for a gap: steps of 5 deg."""
NEAR = 0.1
"""Fraction of a length. A hull nearer to the place does not hide it, since the eye is above."""
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
    """A camera of a scene; see place_camera."""

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


def place_camera(scene: Scene) -> Camera:
    """The camera of a scene."""
    first = min((s.id for s in scene.scratches), default=None)
    touched = [scratch for scratch in scene.scratches if scratch.id == first]
    if not touched:
        marks = tuple(_Mark(ship, np.zeros(3)) for ship in scene.ships)
        length = max(ship.L_oa for ship in scene.ships)
        return Camera(marks, _find_direction(np.radians(135.0)), 2.0 * length)
    ships = [scene.ship(scratch.ship) for scratch in touched]
    marks = tuple(_Mark(ship, scratch.points[0]) for ship, scratch in zip(ships, touched, strict=True))
    bearing = _find_open_bearing(scene, touched[0])
    return Camera(marks, _find_direction(bearing), CLOSE * float(np.mean([ship.L_oa for ship in ships])))


def _find_direction(bearing: float) -> Array:
    height = np.radians(HEIGHT)
    return np.array([np.cos(bearing) * np.cos(height), np.sin(bearing) * np.cos(height), -np.sin(height)])


def _find_open_bearing(scene: Scene, scratch: Scratch) -> float:
    """Middle of the widest range of bearings [rad], from the first contact point, in which no ship lies.

    Points nearer than NEAR lengths are ignored: a bow that is touched at its side surrounds the place.
    """
    bearer, time = scene.ship(scratch.ship), float(scratch.times[0])
    place = _Mark(bearer, scratch.points[0]).at(time)
    taken = np.zeros(BEARINGS, dtype=bool)
    for ship in scene.ships:
        position, quaternion = ship.track.at(time)
        away = (position + _list_outline_points(ship) @ rotation_from_quaternion(quaternion).T - place)[:, :2]
        away = away[np.linalg.norm(away, axis=1) > NEAR * bearer.L_oa]
        taken[np.floor(np.arctan2(away[:, 1], away[:, 0]) / (2 * np.pi) * BEARINGS).astype(int) % BEARINGS] = True
    start, count = _find_widest_gap(taken.tolist())
    return (start + 0.5 * count) * 2 * np.pi / BEARINGS


def _find_widest_gap(taken: list[bool]) -> tuple[int, int]:
    """Start and number of the longest run of False round the circle; from 0, none, where all or nothing is taken."""
    if not any(taken):
        return 0, 0
    best, run = (0, 0), 0
    for i, blocked in enumerate([*taken, *taken]):
        run = 0 if blocked else run + 1
        if run > best[1]:
            best = (i - run + 1, run)
    return best


def _list_outline_points(ship: Ship) -> Array:
    """Points (k, 3) of the hull in b, close enough together along its edges to leave no false gap."""
    p = ship.hull.vertices[ship.hull.triangles]
    share = np.linspace(0.0, 1.0, 40)[:, None, None, None]
    edges: Array = p + share * (np.roll(p, -1, axis=1) - p)
    return edges.reshape(-1, 3)
