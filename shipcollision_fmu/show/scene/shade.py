"""Ambient occlusion: how much of the light from all around reaches a place on a ship, past the ship's other parts.

The parts are sampled into cells. From a place, rays in cosine-weighted directions pass through the cells up to REACH:

    share = 1 - DEPTH mean(w),  w = 1 - distance/REACH of the first full cell of a ray, 0 without one

Only what is near darkens, as under an overhang or in the corner of wall and deck. Landis, "Production-Ready Global
Illumination", SIGGRAPH 2002.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from .solids import Shape
from .surface import Surface

__all__ = ["UNLIT", "Shade", "cast_shade"]

REACH = 12
"""Length of a ray, in cells: 6 m on large ships, two tiers of a house."""
CELL = 0.5
"""[m] Size of a cell on ships broader than BROAD. Larger ones blur corners, smaller ones cost time and memory."""
BROAD = 9.0
"""[m] Breadth from which fittings have their full size; a narrower ship has them, and cells, in proportion."""
DEPTH = 0.85
"""Share of the light that a place loses that is closed in. With 1, corners would be black, for light is mirrored."""
ABOVE = 1.2
"""Height above a surface at which its rays begin, in cells: lower, they would meet the surface itself."""
WITHIN = 0.4
"""Depth of a surface within its cells, in cells, on the average."""
RAYS = 32
"""Rays of a place; with fewer, neighbouring places differ visibly."""
UNLIT = ("rail", "mast", "letters", "windows", "antifouling", "bronze", "gap")
"""Parts that take no light from others: they are thinner than a cell, lie on a wall, or are hidden."""
TOGETHER = 4096
"""Places whose rays are cast together, which bounds memory."""


@dataclass(frozen=True, eq=False)
class Shade:
    """Cells (i, j, k) of a ship, full or not, with a margin of a ray's length; `low` (3,) their corner in b [m]."""

    full: npt.NDArray[np.bool_]
    low: Array
    cell: float

    def find_share(self, points: Array, normals: Array) -> Array:
        """Share of the light (k,), from 1 - DEPTH to 1, at points (k, 3) of surfaces with outward normals (k, 3)."""
        parts = [
            self._cast(points[i : i + TOGETHER], normals[i : i + TOGETHER]) for i in range(0, len(points), TOGETHER)
        ]
        return np.concatenate(parts) if parts else np.zeros(0)

    def _cast(self, points: Array, normals: Array) -> Array:
        rays = _list_rays()
        turned = _turn(rays, normals).astype(np.float32)  # (k, rays, 3)
        start = (points + ABOVE * self.cell * normals - self.low) / self.cell
        # What lies beyond the cells meets nothing.
        start = np.clip(start, REACH + 1, np.array(self.full.shape) - REACH - 2).astype(np.float32)
        weight = np.zeros(turned.shape[:2])
        flat, (_, rows, layers) = self.full.ravel(), self.full.shape
        for step in range(REACH, 0, -1):  # the nearest comes last, and stays
            i, j, k = np.moveaxis((start[:, None] + np.float32(step) * turned).astype(np.int32), -1, 0)
            hit = flat[(i * rows + j) * layers + k]
            distance = WITHIN + np.sqrt(step**2 + 2.0 * step * ABOVE * rays[:, 2] + ABOVE**2)
            weight = np.where(hit, np.maximum(0.0, 1.0 - distance / REACH), weight)
        share: Array = 1.0 - DEPTH * weight.mean(axis=1)
        return share


def cast_shade(shapes: Iterable[Shape], breadth: float) -> Shade:
    """The cells of a ship's shapes; `breadth` is the ship's [m]."""
    cell = CELL * min(1.0, breadth / BROAD)
    samples = np.concatenate(
        [_sample(surface, cell) for part, surface in shapes if part not in UNLIT and len(surface.triangles)]
    )
    low = samples.min(axis=0) - (REACH + 3) * cell
    place = ((samples - low) / cell).astype(np.int64)
    full = np.zeros(place.max(axis=0) + REACH + 4, dtype=bool)
    full[tuple(place.T)] = True
    return Shade(full, low, cell)


def _sample(surface: Surface, spacing: float) -> Array:
    """Points (n, 3) all over the triangles of a surface, in rows along the longest edges, at most the spacing apart."""
    triangles = surface.vertices[surface.triangles]
    edges = np.roll(triangles, -1, axis=1) - triangles
    lengths = np.linalg.norm(edges, axis=2)
    first = lengths.argmax(axis=1)
    p, q, r = (triangles[np.arange(len(first)), (first + k) % 3] for k in range(3))
    longest = lengths.max(axis=1)
    height = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) / np.maximum(longest, 1e-9)
    rows, columns = (np.maximum(np.ceil(size / spacing), 1.0).astype(np.int64) + 1 for size in (height, longest))
    count = rows * columns
    owner = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    up = ((number // columns[owner]) / (rows[owner] - 1))[:, None]
    along = ((number % columns[owner]) / (columns[owner] - 1))[:, None]
    points: Array = up * r[owner] + (1.0 - up) * ((1.0 - along) * p[owner] + along * q[owner])
    return points


def _list_rays() -> Array:
    """Unit vectors (RAYS, 3) about (0, 0, 1), as dense as the cosine of their angle from it (Fibonacci spiral)."""
    i = np.arange(RAYS) + 0.5
    sine, turn = np.sqrt(i / RAYS), np.pi * (3.0 - np.sqrt(5.0)) * i
    return np.column_stack([sine * np.cos(turn), sine * np.sin(turn), np.sqrt(1.0 - sine**2)])


def _turn(rays: Array, normals: Array) -> Array:
    """The rays (k, rays, 3) about each of the normals (k, 3)."""
    aside = np.where(np.abs(normals[:, 2:]) < 0.9, np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]))
    first = np.cross(aside, normals)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(normals, first)
    turned: Array = rays @ np.stack([first, second, normals], axis=1)
    return turned
