"""Fewer samples of a curve over time, with a bound on what is lost.

Kept are the first and the last sample and as many between as linear interpolation over time needs to stay within the
tolerance of every sample left out (Ramer 1972, Douglas & Peucker 1973, with the distance taken at equal times, so that
timing is kept as well as shape).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["kept"]

LONGEST = 512
"""Samples between two that are kept, at most: bounds the work on a curve that is nearly straight everywhere."""


def kept(times: Array, samples: Array, tolerance: float) -> npt.NDArray[np.int64]:
    """Indices of the samples to keep, increasing.

    times (n,) increasing; samples (n, m): the error of an omitted sample is the Euclidean norm of its row's difference
    from the interpolated one, in the samples' own unit, as is `tolerance`.
    """
    n = len(times)
    if n <= 2:
        return np.arange(n)
    chosen = {0, n - 1}
    stack = [(a, min(a + LONGEST, n - 1)) for a in range(0, n - 1, LONGEST)]
    while stack:
        a, b = stack.pop()
        chosen.update((a, b))
        if b - a < 2:
            continue
        share = ((times[a + 1 : b] - times[a]) / (times[b] - times[a]))[:, None]
        off = samples[a + 1 : b] - samples[a] - share * (samples[b] - samples[a])
        error = np.einsum("ij,ij->i", off, off)
        worst = int(error.argmax())
        if error[worst] > tolerance**2:
            middle = a + 1 + worst
            stack += [(a, middle), (middle, b)]
    return np.array(sorted(chosen))
