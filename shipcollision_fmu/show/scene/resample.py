"""Fewer samples of a curve over time, with a bound on the error.

The first and the last sample are chosen, and as many between them as linear interpolation over time needs to stay
within the tolerance of every omitted sample: Ramer (1972), Douglas and Peucker (1973). The distance is taken at equal
times, so that timing is kept as well as shape.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array

__all__ = ["choose_samples"]

LONGEST = 512
"""Most samples between two chosen ones; it bounds the work on curves that are nearly straight."""


def choose_samples(times: Array, samples: Array, tolerance: float) -> npt.NDArray[np.int64]:
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
