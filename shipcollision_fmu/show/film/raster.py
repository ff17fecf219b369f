"""Central projection of triangles to pixels with a depth buffer, by NumPy.

All points are in n (north, east, down). A pixel holds the number of its nearest triangle and the inverse of its depth
along the line of sight, which is linear over the picture of a plane triangle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import radians, tan

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["Eye", "Nearest", "find_nearest"]

Ints = npt.NDArray[np.int64]

NEAR = 1.0
"""[m] Triangles nearer to the eye are left out, since the projection divides by depth; the camera stays away."""
NOTHING = -1
"""Number of the triangle at a pixel without one."""


@dataclass(frozen=True)
class Eye:
    """A camera: its position and target in n [m], vertical angle of view [deg], and size of the picture [pixels]."""

    position: Array
    target: Array
    angle: float
    width: int
    height: int

    @cached_property
    def axes(self) -> Array:
        """Rows right, up, forward, in n; (3, 3)."""
        forward = (self.target - self.position) / np.linalg.norm(self.target - self.position)
        right = np.array([-forward[1], forward[0], 0.0]) / np.hypot(forward[0], forward[1])
        return np.array([right, np.cross(right, forward), forward])

    @property
    def focal(self) -> float:
        """Pixels per unit of (sideways / ahead)."""
        return 0.5 * self.height / tan(radians(0.5 * self.angle))

    def project(self, points: Array) -> Array:
        """Points (..., 3) in n to (..., 3): x right and y down from the upper left corner [pixels], depth [m]."""
        right, up, depth = np.moveaxis((points - self.position) @ self.axes.T, -1, 0)
        ahead = np.where(depth > 0.0, depth, np.nan)
        x = 0.5 * self.width + self.focal * right / ahead
        return np.stack([x, 0.5 * self.height - self.focal * up / ahead, depth], axis=-1)

    def rays(self) -> Array:
        """Direction in n through the middle of each pixel, of depth 1; (height, width, 3), in single precision."""
        right, up, forward = self.axes
        x = (np.arange(self.width) + 0.5 - 0.5 * self.width) / self.focal
        y = (0.5 * self.height - np.arange(self.height) - 0.5) / self.focal
        rays: Array = forward + x[None, :, None] * right + y[:, None, None] * up
        return rays.astype(np.float32)


@dataclass(frozen=True)
class Nearest:
    """Nearest triangle of each pixel: number and depth [m], (height, width) each; NOTHING and inf without one."""

    triangle: Ints
    depth: Array


def find_nearest(eye: Eye, triangles: Array) -> Nearest:
    """The nearest of the triangles (m, 3, 3) in n at each pixel. Triangles are seen from both sides."""
    corners = eye.project(triangles)
    kept = np.flatnonzero((corners[..., 2] > NEAR).all(axis=1))
    corners = corners[kept]
    owner, x, y = _find_covered_pixels(corners[..., :2], eye.width, eye.height)
    plane = _fit_inverse_depth(corners)
    a, b, c = plane.T
    inverse = a[owner] * (x + 0.5) + b[owner] * (y + 0.5) + c[owner]
    pixel = y * eye.width + x
    order = np.argsort(inverse)  # the nearest comes last, and the last one stays
    triangle = np.full(eye.width * eye.height, NOTHING, dtype=np.int64)
    depth = np.full(eye.width * eye.height, np.inf)
    triangle[pixel[order]] = kept[owner[order]]
    depth[pixel[order]] = 1.0 / inverse[order]
    shape = (eye.height, eye.width)
    return Nearest(triangle.reshape(shape), depth.reshape(shape))


def _fit_inverse_depth(corners: Array) -> Array:
    """Coefficients (m, 3) of 1/depth = a x + b y + c over the picture, from corners (m, 3, 3) of x, y, depth.

    A triangle seen edge-on has none; it covers no pixel's middle either, or next to none, and takes its first corner's.
    """
    (x0, y0), (x1, y1), (x2, y2) = (corners[:, k, :2].T for k in range(3))
    i0, i1, i2 = (1.0 / corners[:, k, 2] for k in range(3))
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    flat = np.abs(area) < 1e-9
    area = np.where(flat, 1.0, area)
    a = np.where(flat, 0.0, ((i1 - i0) * (y2 - y0) - (i2 - i0) * (y1 - y0)) / area)
    b = np.where(flat, 0.0, ((i2 - i0) * (x1 - x0) - (i1 - i0) * (x2 - x0)) / area)
    return np.column_stack([a, b, i0 - a * x0 - b * y0])


def _find_covered_pixels(corners: Array, width: int, height: int) -> tuple[Ints, Ints, Ints]:
    """Pixels whose middles lie in the triangles (m, 3, 2): triangle, x, y of each.

    Row by row: where a row's middle cuts the three edges lies the span of the triangle.
    """
    top = np.clip(np.ceil(corners[..., 1].min(axis=1) - 0.5), 0, height).astype(np.int64)
    bottom = np.clip(np.ceil(corners[..., 1].max(axis=1) - 0.5), 0, height).astype(np.int64)
    owner, y = _expand_ranges(top, bottom)
    middle = y + 0.5
    first, last = np.full(len(y), np.inf), np.full(len(y), -np.inf)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        (x0, y0), (x1, y1) = corners[owner, start].T, corners[owner, end].T
        cut = (y0 <= middle) != (y1 <= middle)
        x = x0 + (middle - y0) / np.where(cut, y1 - y0, 1.0) * (x1 - x0)
        first, last = np.where(cut, np.minimum(first, x), first), np.where(cut, np.maximum(last, x), last)
    left = np.clip(np.ceil(first - 0.5), 0, width).astype(np.int64)
    right = np.clip(np.ceil(last - 0.5), 0, width).astype(np.int64)
    row, column = _expand_ranges(left, right)
    return owner[row], column, y[row]


def _expand_ranges(start: Ints, end: Ints) -> tuple[Ints, Ints]:
    """For all ranges start..end - 1 in turn: the range's number and the value."""
    count = np.maximum(end - start, 0)
    owner = np.repeat(np.arange(len(count)), count)
    first = np.cumsum(count) - count
    return owner, np.arange(len(owner)) - first[owner] + start[owner]
