"""Exceedance: how probable it is that a case has at least some value."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...ship.frames import Array
from .clopper_pearson import clopper_pearson

__all__ = ["Exceedance", "find_exceedance"]

POINTS = 200
"""Points of a curve, spaced evenly in the logarithm of the probability: more are not seen in a figure."""


class Exceedance(NamedTuple):
    """Values, rising; the share of cases with at least that value; the limits of its confidence interval."""

    value: Array
    share: Array
    lower: Array
    upper: Array


def find_exceedance(values: Array, confidence: float = 0.95) -> Exceedance:
    """The exceedance curve of values, of which there is at least one, with a pointwise Clopper-Pearson band.

    The band is for cases drawn independently of each other.
    """
    ordered, n = np.sort(values), len(values)
    ranks = np.unique(np.geomspace(1, n, POINTS).round().astype(int))
    value = np.unique(ordered[n - ranks])
    counts = n - np.searchsorted(ordered, value)  # with ties: all that have at least the value
    return Exceedance(value, counts / n, *clopper_pearson(counts, n, confidence))
