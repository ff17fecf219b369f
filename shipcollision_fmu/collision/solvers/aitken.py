"""Aitken's extrapolation of a vector sequence that converges linearly.

    step_k = P_k - P_(k-1),   ratio = step_k . step_(k-1) / |step_(k-1)|^2
    P_k + ratio/(1 - ratio) step_k          the limit, if every step is the same share of the step before

References: Irons and Tuck (1969), Int. J. Numer. Methods Eng. 1:275-277.
"""

from __future__ import annotations

__all__ = ["Aitken"]

MAX_RATIO = 0.98
"""Largest ratio of two steps for which the limit is extrapolated. At 1 the factor ratio/(1 - ratio) has no limit.
A smaller ratio costs sweeps (a quarter more at 0.5, on 1 080 patches of two ships)."""


class Aitken:
    """The steps of one sequence of Gauss-Seidel sweeps.

    An extrapolation is only a start of the next sweep. That sweep makes every contact obey the law of contact again, so
    an extrapolation that is off costs sweeps and no accuracy.
    """

    def __init__(self) -> None:
        self._step: list[float] = []

    def extrapolate(self, P: list[float], last: list[float]) -> list[float]:
        """Impulses from which the next sweep starts: the limit, or P where the steps have no steady ratio.

        P: impulses after this sweep; last: impulses before it. Both as flat lists.
        """
        before, self._step = self._step, [x - y for x, y in zip(P, last, strict=True)]
        square, product = 0.0, 0.0
        for d, e in zip(self._step, before, strict=False):  # before is empty after an extrapolation
            square += e * e
            product += d * e
        if not 0.0 < product < MAX_RATIO * square:
            return P
        ratio, step = product / square, self._step
        factor = ratio / (1.0 - ratio)
        self._step = []
        return [x + factor * d for x, d in zip(P, step, strict=True)]
