"""The smoothing spline of values and rates measured at given times.

Among all functions x(t), the spline makes this sum least:

    sum (x(t_i) - value_i)^2 / s_value^2  +  sum (x'(t_i) - rate_i)^2 / s_rate^2  +  1/q  integral x''(t)^2 dt

It is a cubic between two times (Wahba 1990, Spline Models for Observational Data, chapter 1). Its values and rates at
the times determine it: cubic Hermite interpolation, with a continuous rate. The integral over an interval of length h
is that of a bent beam, with the stiffness matrix of its ends. q is the mean square of the change of the rate in a
second; the same x is the mean of a Kalman smoother with that much white noise of acceleration.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence

__all__ = ["Spline", "smooth"]

Matrix = list[list[float]]
BAND = 3
"""Non-zero places beside the diagonal: two unknowns at a time, coupled with those of the next."""


class Spline:
    """A cubic Hermite spline through values with given rates, at rising times."""

    def __init__(self, times: Sequence[float], values: Sequence[float], rates: Sequence[float]) -> None:
        self._times, self._values, self._rates = list(times), list(values), list(rates)

    def evaluate(self, t: float) -> tuple[float, float]:
        """Value and rate at a time; beyond the ends the rate stays."""
        times = self._times
        i = min(max(bisect_right(times, t) - 1, 0), len(times) - 2)
        if t < times[0] or t > times[-1]:
            k = 0 if t < times[0] else -1
            return self._values[k] + (t - times[k]) * self._rates[k], self._rates[k]
        h = times[i + 1] - times[i]
        s = (t - times[i]) / h
        x_0, x_1, v_0, v_1 = self._values[i], self._values[i + 1], h * self._rates[i], h * self._rates[i + 1]
        change = x_1 - x_0
        c_2, c_3 = 3.0 * change - 2.0 * v_0 - v_1, v_0 + v_1 - 2.0 * change
        return x_0 + s * (v_0 + s * (c_2 + s * c_3)), (v_0 + s * (2.0 * c_2 + 3.0 * s * c_3)) / h


def smooth(
    times: Sequence[float],
    values: Sequence[float],
    value_errors: Sequence[float],
    rates: Sequence[float | None],
    rate_error: float,
    q: float,
) -> Spline:
    """The smoothing spline at two or more rising times; a rate may be missing.

    value_errors, rate_error: standard deviations s of the measured values and rates; q as above.
    """
    size = 2 * len(times)
    band: Matrix = [[0.0] * (BAND + 1) for _ in range(size)]  # band[i][d]: row i, column i - d
    right = [0.0] * size
    for i, (value, error, rate) in enumerate(zip(values, value_errors, rates, strict=True)):
        weight = 1.0 / error**2
        band[2 * i][0] += weight
        right[2 * i] += weight * value
        if rate is not None:
            weight = 1.0 / rate_error**2
            band[2 * i + 1][0] += weight
            right[2 * i + 1] += weight * rate
    for i in range(len(times) - 1):
        for (row, column), stiffness in _bend(times[i + 1] - times[i], q).items():
            band[2 * i + row][row - column] += stiffness
    solution = _solve(band, right)
    return Spline(times, solution[0::2], solution[1::2])


def _bend(h: float, q: float) -> dict[tuple[int, int], float]:
    """The lower half of the stiffness matrix of (x_0, x'_0, x_1, x'_1) over an interval of h [s]."""
    c = 1.0 / (q * h**3)
    return {
        (0, 0): 12.0 * c, (1, 0): 6.0 * h * c, (1, 1): 4.0 * h * h * c,
        (2, 0): -12.0 * c, (2, 1): -6.0 * h * c, (2, 2): 12.0 * c,
        (3, 0): 6.0 * h * c, (3, 1): 2.0 * h * h * c, (3, 2): -6.0 * h * c, (3, 3): 4.0 * h * h * c,
    }  # fmt: skip


def _solve(band: Matrix, right: list[float]) -> list[float]:
    """Solve A x = right for a symmetric, positive definite band matrix, by A = L D L^T. Both arguments are changed."""
    n = len(right)
    for i in range(n):
        row = band[i]
        for d in range(min(BAND, i), 0, -1):  # L D of the row, from the left
            j = i - d
            row[d] -= sum(row[e] * band[j][e - d] for e in range(d + 1, min(BAND, i) + 1))
        for d in range(min(BAND, i), 0, -1):
            lower = row[d] / band[i - d][0]
            row[0] -= row[d] * lower
            row[d] = lower
        right[i] -= sum(row[d] * right[i - d] for d in range(1, min(BAND, i) + 1))
    for i in range(n):
        right[i] /= band[i][0]
    for i in range(n - 1, -1, -1):
        right[i] -= sum(band[i + d][d] * right[i + d] for d in range(1, min(BAND, n - 1 - i) + 1))
    return right
