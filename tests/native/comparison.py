"""assert_close(): results of the native code beside those of the Python model."""

from __future__ import annotations

import numpy as np

from shipcollision_fmu.ship.frames import Array

__all__ = ["assert_close"]

ROUNDING = 2e-14
"""Over the largest number of the column. The elementary functions of both differ by two units in the last place."""


def assert_close(found: object, expected: object, tolerance: float = ROUNDING) -> None:
    """Each column, of many results, within `tolerance` of its largest number; what is not finite is alike."""
    a: Array = np.atleast_2d(np.asarray(found, dtype=float))
    b: Array = np.atleast_2d(np.asarray(expected, dtype=float))
    assert a.shape == b.shape
    assert np.array_equal(np.isfinite(a), np.isfinite(b))
    a, b = np.where(np.isfinite(a), a, 0.0), np.where(np.isfinite(b), b, 0.0)
    scale = np.abs(b).max(axis=0)
    worst = np.abs(a - b).max(axis=0) / np.where(scale > 0.0, scale, 1.0)
    assert worst.max() <= tolerance, f"column {worst.argmax()}: {worst.max():.3g} of {scale[worst.argmax()]:.3g}"
