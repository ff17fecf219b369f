"""Where sweeps that slow down steadily are going.

    step_k = P_k - P_(k-1),   ratio = step_k . step_(k-1) / |step_(k-1)|^2
    P_k + ratio/(1 - ratio) step_k          the limit, if every step is that share of the one before

Reference: Irons and Tuck (1969), Int. J. Numer. Methods Eng. 1:275-277.
"""

from __future__ import annotations

__all__ = ["Aitken"]

SLOWEST = 0.98
"""Ratio of a sweep's step to that of the one before up to which the rest of the sequence is foreseen."""


class Aitken:
    """Where a sequence of sweeps is going, from how its last step compares with the one before.

    What it gives is only a start for the next sweep, which puts every contact back into its law.
    """

    def __init__(self) -> None:
        self._step: list[float] = []

    def __call__(self, P: list[float], last: list[float]) -> list[float]:
        """A better start for the next sweep than P, of which the sweep before was `last`; P where none can be told."""
        before, self._step = self._step, [x - y for x, y in zip(P, last, strict=True)]
        square = sum(d * d for d in before)
        if square == 0.0:
            return P
        ratio = sum(d * e for d, e in zip(self._step, before, strict=True)) / square
        if not 0.0 < ratio < SLOWEST:
            return P
        factor, step = ratio / (1.0 - ratio), self._step
        self._step = []
        return [x + factor * d for x, d in zip(P, step, strict=True)]
