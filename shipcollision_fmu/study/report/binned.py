"""Quantiles of a result in bins of an input."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["LEVELS", "Binned", "find_binned_quantiles"]

LEVELS = (0.1, 0.5, 0.9)
LEAST_CASES = 20
"""A bin with fewer cases has no quantiles: with 20, two lie beyond each of the outer ones."""


class Binned(NamedTuple):
    """Edges of k bins, (k + 1,); cases in each, (k,); quantiles at LEVELS, (k, 3), NaN in a bin of few cases."""

    edges: Array
    counts: npt.NDArray[np.int_]
    quantiles: Array


def find_binned_quantiles(x: Array, y: Array, bins: int) -> Binned:
    """Quantiles of y in bins of x of equal width, which reach over the range of x."""
    edges = np.linspace(x.min(), x.max(), bins + 1)
    places = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, bins - 1)
    counts = np.bincount(places, minlength=bins)
    quantiles = np.full((bins, len(LEVELS)), np.nan)
    parts = np.split(y[np.argsort(places, kind="stable")], np.cumsum(counts)[:-1])
    for i, part in enumerate(parts):
        if len(part) >= LEAST_CASES:
            quantiles[i] = np.quantile(part, LEVELS)
    return Binned(edges, counts, quantiles)
