"""Sensitivity of a result to each input: variance of conditional means, and rank correlation.

Sources: K. Pearson, On the general theory of skew correlation and non-linear regression, 1905 (correlation ratio);
T. L. Kelley, An unbiased correlation ratio measure, PNAS 21 (1935) 554-559; E. Plischke, An effective algorithm for
computing global sensitivity indices, Reliability Engineering and System Safety 95 (2010) 354-360 (the ratio as
first-order index); C. Spearman, The proof and measurement of association between two things, 1904.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["find_first_order", "find_rank_correlation"]

BINS = 40
"""Bins of an input, with equal numbers of cases; an input with fewer values has a bin for each. Fewer bins level out an
input that goes up and down: with 20 an index of Ishigami's function is 3 % too small."""
LEAST_CASES = 25
"""Cases in a bin, where there are not enough for BINS of them."""


def find_first_order(x: Array, y: Array, *, are_words: bool = False) -> float:
    """Share of the variance of y that the means of y, given x alone, have: Var(E[y | x]) / Var(y), from 0 to 1.

    Kelley's correction takes off what bins of few cases have by chance. are_words: x holds codes of words, whose order
    says nothing; each word has a bin of its own.
    """
    if y.max() == y.min():
        return 0.0
    groups = np.unique(x, return_inverse=True)[1].ravel() if are_words else _group(x)
    counts = np.bincount(groups)
    means = np.bincount(groups, weights=y) / counts
    between = float(np.sum(counts * (means - y.mean()) ** 2))
    within = float(np.sum((y - y.mean()) ** 2)) - between
    n, k = len(y), len(counts)
    if n <= k:
        return 0.0
    share = 1.0 - within * (n - 1) / ((n - k) * float(np.sum((y - y.mean()) ** 2)))
    return float(np.clip(share, 0.0, 1.0))


def find_rank_correlation(x: Array, y: Array) -> float:
    """Spearman's rank correlation, -1 to 1; equal values share their mean rank. 0 where one of them is constant."""
    ranks = [_rank(values) for values in (x, y)]
    a, b = (rank - rank.mean() for rank in ranks)
    norm = float(np.sqrt(np.sum(a**2) * np.sum(b**2)))
    return float(np.sum(a * b)) / norm if norm > 0.0 else 0.0


def _rank(values: Array) -> Array:
    _, places, counts = np.unique(values, return_inverse=True, return_counts=True)
    mean = np.cumsum(counts) - (counts - 1) / 2.0
    ranks: Array = mean[places.ravel()]
    return ranks


def _group(x: Array) -> npt.NDArray[np.int64]:
    """The number of each case's bin; every bin has a case."""
    found, places = np.unique(x, return_inverse=True)
    bins = max(2, min(BINS, len(x) // LEAST_CASES))
    if len(found) <= bins:
        return places.ravel().astype(np.int64)
    edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, bins + 1)[1:-1]))
    groups = np.searchsorted(edges, x, side="right")
    used: npt.NDArray[np.int64] = np.unique(groups, return_inverse=True)[1].ravel().astype(np.int64)
    return used
