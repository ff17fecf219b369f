"""Sobol's sequence by row number, shifted at random.

    x_n = v_1 g_1 ^ v_2 g_2 ^ ...      g: bits of Gray's code n ^ (n >> 1), v: direction numbers

The order of points is that of Antonov and Saleev (1979), as in scipy.stats.qmc.Sobol. Each dimension is shifted by xor
with random bits, which keeps every interval of length 2^-k filled alike.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from .direction_numbers import BITS, direction_numbers
from .uniform_numbers import draw_bits

__all__ = ["draw_sobol", "sobol_bits"]


def sobol_bits(dimension: int, first: int, count: int) -> npt.NDArray[np.uint64]:
    """The points first to first + count - 1 of a dimension from 0, without shift, in units of 2^-BITS."""
    n = np.arange(first, first + count, dtype=np.uint64)
    gray = n ^ (n >> np.uint64(1))
    points = np.zeros(count, np.uint64)
    for k, v in enumerate(direction_numbers(dimension)):
        points ^= v * ((gray >> np.uint64(k)) & np.uint64(1))
    return points


def draw_sobol(seed: int, name: str, dimension: int, first: int, count: int) -> Array:
    """A number in (0, 1) for each of the rows, of the dimension that belongs to the variable `name`."""
    shift = draw_bits(seed, f"{name}/shift", 0, 1) >> np.uint64(64 - BITS)
    shares: Array = ((sobol_bits(dimension, first, count) ^ shift).astype(np.float64) + 0.5) * 2.0**-BITS
    return shares
