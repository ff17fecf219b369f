"""Random numbers by row number: the k-th number of a name is the same whoever asks for it, and in whatever order.

Philox 4x64-10 of Salmon et al., Parallel random numbers: as easy as 1, 2, 3 (2011), as NumPy has it. Its key is a hash
of the seed and the name of the variable; its counter is the row number over 4. Nothing is drawn one after the other.
"""

from __future__ import annotations

from hashlib import sha256

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["as_shares", "draw_bits", "draw_shares", "make_key"]

PER_COUNTER = 4
"""Numbers for each value of Philox' counter."""


def make_key(seed: int, name: str) -> int:
    """128 bits from the seed and the name of a variable."""
    return int.from_bytes(sha256(f"{seed}/{name}".encode()).digest()[:16], "little")


def draw_bits(seed: int, name: str, first: int, count: int) -> npt.NDArray[np.uint64]:
    """64 random bits for each of the rows first to first + count - 1."""
    skipped, left_out = divmod(first, PER_COUNTER)
    philox = np.random.Philox(key=make_key(seed, name), counter=skipped)
    return np.asarray(philox.random_raw(left_out + count)[left_out:], np.uint64)


def as_shares(bits: npt.NDArray[np.uint64]) -> Array:
    """(k + 1/2) 2^-52, k the highest 52 bits: in (0, 1), without its ends, and 1 - u is one of them, too."""
    shares: Array = ((bits >> np.uint64(12)).astype(np.float64) + 0.5) * 2.0**-52
    return shares


def draw_shares(seed: int, name: str, first: int, count: int) -> Array:
    """A number in (0, 1) for each of the rows."""
    return as_shares(draw_bits(seed, name, first, count))
