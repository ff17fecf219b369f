"""permute(): a random permutation of 0 to n - 1, evaluated at any number by itself.

    a Feistel network of ROUNDS rounds permutes 0 to 4^h - 1, the least such power that is at least n;
    a number that leads to n or beyond is permuted again until it does not (cycle walking).

Black and Rogaway, Ciphers with arbitrary finite domains (2002). A round is a hash of one half of the bits and a key of
the round; it need not be invertible. At most three of four numbers lie beyond n, so few are permuted often.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .uniform_numbers import draw_bits

__all__ = ["permute"]

ROUNDS = 6
"""With 3 or fewer, neighbours stay correlated."""
MIX_1, MIX_2 = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
"""Multipliers of splitmix64, by Stafford."""

Numbers = npt.NDArray[np.uint64]


def permute(seed: int, name: str, numbers: npt.ArrayLike, n: int) -> Numbers:
    """The places of the numbers, each in 0 to n - 1, in the permutation of this seed and name."""
    keys, half = draw_bits(seed, f"{name}/permutation", 0, ROUNDS), _half_width(n)
    places = _scramble(np.asarray(numbers, np.uint64), keys, half)
    while (beyond := places >= n).any():
        places[beyond] = _scramble(places[beyond], keys, half)
    return places


def _half_width(n: int) -> int:
    """Bits h of a half, 4^h >= n."""
    return max(1, ((n - 1).bit_length() + 1) // 2)


def _scramble(numbers: Numbers, keys: Numbers, half: int) -> Numbers:
    mask, shift = np.uint64((1 << half) - 1), np.uint64(half)
    left, right = numbers >> shift, numbers & mask
    for key in keys:
        left, right = right, left ^ (_mix(right ^ key) & mask)
    scrambled: Numbers = (left << shift) | right
    return scrambled


def _mix(x: Numbers) -> Numbers:
    """splitmix64's finaliser; products wrap."""
    x = (x ^ (x >> np.uint64(30))) * MIX_1
    x = (x ^ (x >> np.uint64(27))) * MIX_2
    mixed: Numbers = x ^ (x >> np.uint64(31))
    return mixed
