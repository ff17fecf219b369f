"""Clopper-Pearson interval of a probability, without SciPy, which the package does not need at run time.

Source: C. J. Clopper and E. S. Pearson, The use of confidence or fiducial limits illustrated in the case of the
binomial, Biometrika 26 (1934) 404-413. The incomplete beta function is the continued fraction 8.17.22 of the NIST
Digital Library of Mathematical Functions.
"""

from __future__ import annotations

from collections.abc import Callable
from math import lgamma

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["clopper_pearson", "incomplete_beta"]

HALVINGS = 60
"""Bisection leaves 2^-60 of the range, far below any probability that a study can resolve."""
CLOSE = 1e-14
"""Change of the continued fraction at which it ends."""
MOST_TERMS = 100_000
"""Of the continued fraction; it needs about the root of a + b."""
TINY = 1e-300


def clopper_pearson(hits: npt.ArrayLike, n: int, confidence: float = 0.95) -> tuple[Array, Array]:
    """Lower and upper limits of the probability of which some of n independent trials are hits.

    Each interval holds the probability at least as often as `confidence` says, whatever the probability.
    """
    k, half = np.asarray(hits, float), (1.0 - confidence) / 2.0
    low, high = np.maximum(k, 1.0), np.minimum(k, n - 1.0)  # the others have a limit in closed form
    lower = _bisect(lambda p: incomplete_beta(low, n - low + 1.0, p) < half, k)
    upper = _bisect(lambda p: incomplete_beta(high + 1.0, n - high, p) < 1.0 - half, k)
    return np.where(k == 0, 0.0, lower), np.where(k == n, 1.0, upper)


def incomplete_beta(a: Array, b: Array, x: Array) -> Array:
    """The regularised incomplete beta function I_x(a, b), 0 <= x <= 1, of arrays of one shape."""
    is_turned = x > (a + 1.0) / (a + b + 2.0)  # the fraction converges fast on the other side only
    a, b, x = np.where(is_turned, b, a), np.where(is_turned, a, b), np.where(is_turned, 1.0 - x, x)
    with np.errstate(divide="ignore"):
        logarithm = _log_gamma(a + b) - _log_gamma(a) - _log_gamma(b) + a * np.log(x) + b * np.log1p(-x)
    value = np.exp(logarithm) / (a * _evaluate_fraction(a, b, x))
    turned: Array = np.where(is_turned, 1.0 - value, value)
    return turned


def _log_gamma(values: Array) -> Array:
    return np.array([lgamma(value) for value in values.ravel()]).reshape(values.shape)


def _evaluate_fraction(a: Array, b: Array, x: Array) -> Array:
    """1 + d1/(1 + d2/(1 + ...)) by Lentz's method."""
    value, c, d = np.ones_like(x), np.ones_like(x), np.zeros_like(x)
    for i in range(1, MOST_TERMS):
        m = i // 2
        if i % 2:
            term = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        else:
            term = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        d, c = 1.0 + term * d, 1.0 + term / c
        d, c = 1.0 / np.where(d == 0.0, TINY, d), np.where(c == 0.0, TINY, c)
        value = value * c * d
        if np.max(np.abs(c * d - 1.0)) < CLOSE:
            break
    return value


def _bisect(is_below: Callable[[Array], npt.NDArray[np.bool_]], like: Array) -> Array:
    """The numbers in [0, 1] up to which `is_below` holds."""
    low, high = np.zeros_like(like), np.ones_like(like)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        below = is_below(middle)
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)
