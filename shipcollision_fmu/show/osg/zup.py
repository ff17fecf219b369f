"""Conversion from the project's frames to OpenSceneGraph's world with z up, done in this file only.

    n  north, east, down         ->  w  east, north, up
    b  forward, starboard, down  ->     starboard, forward, up, the body axes in w

World and body axes are swapped alike, for the reason given in ship/frames.py: a ship on an easterly heading points
east, and its starboard side stays starboard.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import SWAP, Array

__all__ = ["convert_quaternions", "convert_vectors"]


def convert_vectors(vectors: Array) -> Array:
    """Vectors (..., 3) of n in w, or of b in the z-up body axes."""
    swapped: Array = np.asarray(vectors) @ SWAP
    return swapped


def convert_quaternions(quaternions: Array) -> Array:
    """Quaternions (..., 4), as (x, y, z, w), of R_nb: those that turn the z-up body axes into w."""
    q = np.asarray(quaternions)
    return np.stack([q[..., 1], q[..., 0], -q[..., 2], q[..., 3]], axis=-1)
