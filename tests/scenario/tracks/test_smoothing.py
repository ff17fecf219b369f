"""The smoothing spline against closed forms, against a dense solution of the same sum, and against noise."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest

from shipcollision_fmu.scenario.tracks.smoothing import smooth

TIMES = [0.0, 2.0, 4.0, 10.0, 13.0, 40.0]


def test_what_moves_uniformly_stays_as_it_is() -> None:
    """It bends nothing and misses nothing: the least sum is zero."""
    spline = smooth(TIMES, [3.0 - 2.0 * t for t in TIMES], [5.0] * 6, [-2.0, None, -2.0, -2.0, None, -2.0], 0.2, 0.1)
    for t in (-5.0, 0.0, 1.0, 7.3, 40.0, 50.0):
        assert spline.evaluate(t) == pytest.approx((3.0 - 2.0 * t, -2.0), abs=1e-8)


def test_it_is_the_least_sum_over_all_cubics() -> None:
    """Dense least squares over values and rates, with the integral of x''^2 by Gauss' rule."""
    rng = np.random.default_rng(5)
    values, rates = rng.normal(0.0, 10.0, 6), rng.normal(0.0, 1.0, 6)
    s_value, s_rate, q = 2.0, 0.3, 0.4
    rows, right = [], []
    for i in range(6):
        for k, value, s in ((2 * i, values[i], s_value), (2 * i + 1, rates[i], s_rate)):
            row = np.zeros(12)
            row[k] = 1.0 / s
            rows.append(row)
            right.append(value / s)
    points, weights = np.polynomial.legendre.leggauss(3)
    for i in range(5):
        h = TIMES[i + 1] - TIMES[i]
        for x, w in zip((points + 1.0) / 2.0, weights / 2.0, strict=True):
            row = np.zeros(12)
            second = [(12 * x - 6) / h**2, (6 * x - 4) / h, (6 - 12 * x) / h**2, (6 * x - 2) / h]  # of Hermite's cubics
            row[2 * i : 2 * i + 4] = np.array(second) * np.sqrt(w * h / q)
            rows.append(row)
            right.append(0.0)
    expected = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
    spline = smooth(TIMES, values.tolist(), [s_value] * 6, rates.tolist(), s_rate, q)
    for i, t in enumerate(TIMES):
        assert spline.evaluate(t) == pytest.approx((expected[2 * i], expected[2 * i + 1]), rel=1e-8)


def test_its_rate_is_continuous_and_its_derivative() -> None:
    rng = np.random.default_rng(6)
    spline = smooth(TIMES, rng.normal(0.0, 10.0, 6).tolist(), [1.0] * 6, [None] * 6, 0.2, 0.1)
    for t in (*TIMES[1:-1], 1.0, 20.0):
        before, after = (spline.evaluate(t + d) for d in (-1e-6, 1e-6))
        assert before == pytest.approx(after, abs=1e-4)
        assert (after[0] - before[0]) / 2e-6 == pytest.approx(spline.evaluate(t)[1], abs=1e-4)


def test_noise_of_positions_does_not_become_speed() -> None:
    """Positions 5 m off at 2 s: between raw points the speed is some 3 m/s off; of the spline it is a tenth of this."""
    rng = np.random.default_rng(7)
    times = np.arange(0.0, 120.0, 2.0)
    noisy = 6.0 * times + rng.normal(0.0, 5.0, times.size)
    raw = np.diff(noisy) / 2.0 - 6.0
    rates = (6.0 + rng.normal(0.0, 0.1, times.size)).tolist()
    spline = smooth(times.tolist(), noisy.tolist(), [5.0] * times.size, rates, 0.2, 0.1)
    off = [spline.evaluate(t)[1] - 6.0 for t in np.arange(0.0, 118.0, 0.1)]
    assert np.abs(raw).max() > 5.0
    assert np.abs(off).max() < 0.3


def test_a_turn_is_not_cut() -> None:
    """Radius 500 m at 7 m/s, a report every 6 s: the circle is met within 0.1 m, the speed within 0.02 m/s."""
    R, w = 500.0, 7.0 / 500.0
    times = [6.0 * k for k in range(40)]
    north = smooth(times, [R * sin(w * t) for t in times], [5.0] * 40, [R * w * cos(w * t) for t in times], 0.2, 0.1)
    east = smooth(times, [-R * cos(w * t) for t in times], [5.0] * 40, [R * w * sin(w * t) for t in times], 0.2, 0.1)
    for t in np.arange(12.0, 220.0, 0.7):
        (x, u), (y, v) = north.evaluate(t), east.evaluate(t)
        assert np.hypot(x - R * sin(w * t), y + R * cos(w * t)) < 0.1
        assert np.hypot(u, v) == pytest.approx(7.0, abs=0.02)
