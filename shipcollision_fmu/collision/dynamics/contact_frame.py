"""Axes of a contact, in which velocities, W and impulses are solved: the normal n and two tangents t1, t2."""

from __future__ import annotations

from math import hypot

import numpy as np

from ...ship.frames import Array

__all__ = ["contact_axes"]


def contact_axes(normal: Array) -> Array:
    """Rows (normal, t1, t2), right-handed, (3, 3): from n to contact axes. t1 is horizontal unless the normal is
    steep."""
    x, y, z = normal.tolist()
    if abs(z) < 0.9:
        size = hypot(x, y)
        t1 = (y / size, -x / size, 0.0)
    else:
        size = hypot(y, z)
        t1 = (0.0, z / size, -y / size)
    t2 = (y * t1[2] - z * t1[1], z * t1[0] - x * t1[2], x * t1[1] - y * t1[0])
    return np.array([(x, y, z), t1, t2])
