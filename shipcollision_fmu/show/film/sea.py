"""Sky and sea of a picture: waves, reflection, haze, and visibility under water.

The sea is the plane z = 0 of n. Sinusoidal deep-water waves give it slopes, which tilt reflections and move no point.
Colours are linear shares of red, green and blue.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from .raster import Eye

__all__ = ["colour_sea", "colour_sky", "find_clarity", "find_depth"]

Singles = npt.NDArray[np.float32]

GRAVITY = 9.81
"""[m/s2]"""
DEEP = np.array([0.03, 0.16, 0.25], dtype=np.float32)
ZENITH = np.array([0.33, 0.52, 0.80], dtype=np.float32)
HORIZON = np.array([0.78, 0.86, 0.92], dtype=np.float32)
HAZE = 9000.0
"""Distance [m] at which the sea has taken on most of the horizon's colour."""
VISIBILITY = 5.0
"""[m] Length of the way through water that reduces the light from below to 1/e."""

_LENGTHS = 6.0 * 1.27 ** np.arange(11)  # of the waves [m]
_HEADINGS = np.radians(60.0 + 70.0 * np.sin(4.1 * np.arange(11)))
_STEEPNESS = np.float32(0.016)


def find_depth(eye: Eye, rays: Array) -> Array:
    """Depth along the line of sight at which each ray (..., 3) meets the sea [m]; inf where it does not."""
    down = rays[..., 2]
    meets = down > 1e-6
    return np.where(meets, -eye.position[2] / np.where(meets, down, 1.0), np.inf)


def colour_sky(rays: Array) -> Array:
    """Colour (..., 3) of the sky along rays."""
    height = np.clip(-rays[..., 2] / np.linalg.norm(rays, axis=-1), 0.0, 1.0)
    return _mix(HORIZON, ZENITH, 1.0 - (1.0 - height) ** 4)


def colour_sea(eye: Eye, rays: Array, depth: Array, time: float) -> Array:
    """Colour (k, 3) of the sea where rays (k, 3) meet it at `depth` (k,), finite, at `time` [s]."""
    place = eye.position[:2].astype(np.float32) + rays[:, :2] * depth[:, None].astype(np.float32)
    slope = _find_slopes(place, depth / eye.focal, time)
    size = np.linalg.norm(rays, axis=1)
    facing = np.clip((rays[:, 2] + (rays[:, :2] * slope).sum(axis=1)) / size, 0.0, 1.0)
    mirrored = 0.02 + 0.98 * (1.0 - facing) ** 5  # Schlick's approximation for water
    height = np.clip(np.abs(rays[:, 2]) / size + 0.4 * np.abs(slope).sum(axis=1), 0.0, 1.0)
    deep = DEEP * (1.0 + 2.5 * slope.sum(axis=1, keepdims=True))
    above = 0.85 * _mix(HORIZON, ZENITH, 1.0 - (1.0 - height) ** 4)
    colour = deep + (above - deep) * mirrored[:, None]
    haze = 1.0 - np.exp(-((depth * size / HAZE) ** 2))
    hazy: Array = colour + (HORIZON - colour) * haze[:, None].astype(np.float32)
    return hazy


def find_clarity(way: Array) -> Array:
    """Share of light from below that passes `way` [m] of water."""
    return np.exp(-np.maximum(way, 0.0) / VISIBILITY)


def _mix(start: Singles, end: Singles, share: Array) -> Array:
    mixed: Array = start + (end - start) * share[..., None]
    return mixed


def _find_slopes(place: Array, pixel: Array, time: float) -> Array:
    """Slope north and east (k, 2) of the waves at places (k, 2); none shorter than four pixels [m]."""
    north, east, pixel = place[:, 0].copy(), place[:, 1].copy(), pixel.astype(np.float32)
    slope_north, slope_east = np.zeros_like(north), np.zeros_like(north)
    for i, (length, heading) in enumerate(zip(_LENGTHS, _HEADINGS, strict=True)):
        seen = np.flatnonzero(pixel < 0.25 * length)
        k, c, s = (np.float32(x) for x in (2 * np.pi / length, np.cos(heading), np.sin(heading)))
        passed = np.float32((2.4 * i - np.sqrt(GRAVITY * k) * time) % (2 * np.pi))
        steep = _STEEPNESS * np.minimum(length / (4 * pixel[seen]) - 1, 1).astype(np.float32)
        steep *= np.cos(k * c * north[seen] + k * s * east[seen] + passed)
        slope_north[seen] += c * steep
        slope_east[seen] += s * steep
    return np.column_stack([slope_north, slope_east])
