"""Convergence: mean and 99 % quantile of the first n cases, for growing n."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...ship.frames import Array

__all__ = ["Convergence", "find_convergence"]

POINTS = 50
FIRST = 10
"""Cases of the first point: the standard deviation of fewer says little."""
QUANTILE = 0.99
NORMAL = 1.959963984540054
"""97.5 % quantile of the standard normal distribution: intervals of 95 %."""


class Convergence(NamedTuple):
    """Cases n; mean and quantile of the first n, each with the limits of its 95 % interval; NaN where n is too small.

    mean: +- 1.96 standard errors. quantile: order statistics by the normal limit of the binomial distribution; David
    and Nagaraja, Order Statistics, 2003, section 7.1.
    """

    n: Array
    mean: Array
    mean_lower: Array
    mean_upper: Array
    quantile: Array
    quantile_lower: Array
    quantile_upper: Array


def find_convergence(values: Array) -> Convergence:
    """Mean and quantile of the first n of the values, in their order. There are at least two values."""
    total = len(values)
    counts = np.unique(np.geomspace(min(FIRST, total), total, POINTS).round().astype(int))
    centre = values.mean()  # sums of squares about it do not cancel
    sums, squares = np.cumsum(values - centre)[counts - 1], np.cumsum((values - centre) ** 2)[counts - 1]
    offset = sums / counts
    variance = np.maximum(squares - counts * offset**2, 0.0) / np.maximum(counts - 1, 1)
    margin = NORMAL * np.sqrt(variance / counts)
    mean = centre + offset
    tails = np.array([_find_quantile(values[:n]) for n in counts])
    return Convergence(counts, mean, mean - margin, mean + margin, *tails.T)


def _find_quantile(values: Array) -> tuple[float, float, float]:
    """The quantile and the limits of its interval."""
    n = len(values)
    margin = NORMAL * np.sqrt(n * QUANTILE * (1.0 - QUANTILE))
    low, high = int(np.floor(n * QUANTILE - margin)) - 1, int(np.ceil(n * QUANTILE + margin))
    if low < 0 or high >= n:
        return np.nan, np.nan, np.nan
    ordered = np.partition(values, [low, high])
    return float(np.quantile(values, QUANTILE)), float(ordered[low]), float(ordered[high])
