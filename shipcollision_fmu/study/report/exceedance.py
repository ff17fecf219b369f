"""Exceedance: how probable it is that a case has at least some value."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...ship.frames import Array
from .clopper_pearson import clopper_pearson

__all__ = ["Exceedance", "find_exceedance"]

COARSE, RELATIVE = 0.002, 0.01
"""Most by which the share may fall between two points of a curve, and most of it as part of the share: one pixel."""
MOST_RESOLVED = 1_000_000
"""Cases whose standard error bounds the fall, too; with that of 10^8 cases a curve would have 30 000 points."""


class Exceedance(NamedTuple):
    """Values, rising; the share of cases with at least that value; the limits of its confidence interval."""

    value: Array
    share: Array
    lower: Array
    upper: Array


def find_exceedance(values: Array, confidence: float = 0.95) -> Exceedance:
    """The exceedance curve of values, of which there is at least one, with a pointwise Clopper-Pearson band.

    It is a step: from a point up to the next, that one included, the share is that of the next. Few cases all have
    their point. Of many, points are left out as far as the step then differs from that of all cases by at most 0.002,
    1 % of the share, and its standard error, so that the band of the step holds the share of all cases (up to 10^6).
    The band is for cases drawn independently of each other.
    """
    ordered, n = np.sort(values), len(values)
    points = np.array(list(_choose_points(ordered))[::-1])
    counts = n - np.searchsorted(ordered, points)  # with ties: all that have at least the value
    return Exceedance(points, counts / n, *clopper_pearson(counts, n, confidence))


def _choose_points(ordered: Array) -> Iterator[float]:
    """Values that are kept, from the greatest to the least."""
    n = len(ordered)
    place = n - 1
    while place >= 0:
        yield ordered[place]
        first = int(np.searchsorted(ordered, ordered[place]))
        count = n - first
        share = count / n
        fall = min(COARSE, RELATIVE * share, np.sqrt(share * (1.0 - share) / min(n, MOST_RESOLVED)))
        place = n - int(count + n * fall) - 1
    if first > 0:
        yield ordered[0]
