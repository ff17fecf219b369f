"""Sampler: the share u in (0, 1) of each variable in each row, by the sampler of the study.

    random            u of its own for each row
    latin-hypercube   u = (p + v) / n: p a permutation of the n rows, v in (0, 1); each of n strata is hit once
    sobol             a dimension of Sobol's sequence for each variable

Every u depends on the seed, the name of the variable and the row number alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from .permutation import permute
from .sobol import draw_sobol
from .uniform_numbers import draw_shares

__all__ = ["Sampler"]


@dataclass(frozen=True)
class Sampler:
    """The shares of the variables `names` in n rows, by the sampler `kind`."""

    kind: str
    seed: int
    n: int
    names: Sequence[str]

    def draw(self, name: str, first: int, count: int) -> Array:
        """The shares (count,) of a variable in the rows first to first + count - 1."""
        if self.kind == "sobol":
            return draw_sobol(self.seed, name, self.names.index(name), first, count)
        shares = draw_shares(self.seed, name, first, count)
        if self.kind == "random":
            return shares
        strata = permute(self.seed, name, np.arange(first, first + count), self.n)
        return np.minimum((strata.astype(np.float64) + shares) / self.n, 1.0 - 2.0**-53)
