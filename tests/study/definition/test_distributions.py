"""Distributions beside SciPy's inverse distribution functions, moments, and their own limits."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

from shipcollision_fmu.study.definition.distribution_text import read_distribution
from shipcollision_fmu.study.definition.distributions import Constant

U = np.concatenate([[1e-12, 1e-6], np.linspace(0.001, 0.999, 999), [1.0 - 1e-6, 1.0 - 1e-12]])


def lognormal(median: float, sigma: float) -> Any:
    return stats.lognorm(sigma, scale=median)


ORACLES: dict[str, tuple[dict[str, Any], Any]] = {
    "uniform": ({"distribution": "uniform", "least": -2.0, "most": 5.0}, stats.uniform(-2.0, 7.0)),
    "normal": ({"distribution": "normal", "mean": 6.0, "sd": 1.5}, stats.norm(6.0, 1.5)),
    "normal between": (
        {"distribution": "normal", "mean": 6.0, "sd": 1.5, "least": 4.0, "most": 7.0},
        stats.truncnorm(-2.0 / 1.5, 1.0 / 1.5, 6.0, 1.5),
    ),
    "normal, far above": (
        {"distribution": "normal", "mean": 0.0, "sd": 1.0, "least": 4.0, "most": 9.0}, stats.truncnorm(4.0, 9.0),
    ),
    "normal, far below": (
        {"distribution": "normal", "mean": 0.0, "sd": 1.0, "most": -5.0}, stats.truncnorm(-np.inf, -5.0),
    ),
    "lognormal": ({"distribution": "lognormal", "median": 3.0, "sigma": 0.4}, lognormal(3.0, 0.4)),
    "triangular": (
        {"distribution": "triangular", "least": 1.0, "mode": 2.0, "most": 6.0}, stats.triang(0.2, 1.0, 5.0),
    ),
    "triangular, falling": (
        {"distribution": "triangular", "least": 1.0, "mode": 1.0, "most": 6.0}, stats.triang(0.0, 1.0, 5.0),
    ),
    "triangular, rising": (
        {"distribution": "triangular", "least": 1.0, "mode": 6.0, "most": 6.0}, stats.triang(1.0, 1.0, 5.0),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ORACLES)
def test_the_inverse_distribution_function_is_exact(name: str) -> None:
    given, oracle = ORACLES[name]
    values = read_distribution(given).quantile(U)
    assert values == pytest.approx(oracle.ppf(U), rel=2e-9, abs=1e-12)
    assert (np.diff(values) >= 0.0).all()


@pytest.mark.parametrize("name", ORACLES)
def test_moments(name: str) -> None:
    """Mean and standard deviation by the midpoint rule over u."""
    given, oracle = ORACLES[name]
    values = read_distribution(given).quantile((np.arange(400_000) + 0.5) / 400_000)
    assert values.mean() == pytest.approx(oracle.mean(), rel=1e-4, abs=1e-5)
    assert values.std() == pytest.approx(oracle.std(), rel=1e-3)
    least, most = read_distribution(given).limits()
    assert least <= values.min() <= values.max() <= most


def test_a_cut_lognormal_is_the_rescaled_part() -> None:
    """F(x) = (F_0(x) - F_0(least)) / (F_0(most) - F_0(least))."""
    given = {"distribution": "lognormal", "median": 3.0, "sigma": 0.4, "least": 2.0, "most": 5.0}
    values, whole = read_distribution(given).quantile(U), lognormal(3.0, 0.4)
    low, high = whole.cdf([2.0, 5.0])
    assert (whole.cdf(values) - low) / (high - low) == pytest.approx(U, abs=1e-9)
    assert values.min() >= 2.0
    assert values.max() <= 5.0


def test_discrete_values_have_their_shares_of_the_weights() -> None:
    given = read_distribution({"distribution": "discrete", "values": [2, 7, 9, 11], "weights": [1, 0, 3, 0]})
    assert given.quantile(np.array([1e-9, 0.2499, 0.2501, 1.0 - 1e-9])).tolist() == [2.0, 2.0, 9.0, 9.0]
    words = read_distribution({"distribution": "discrete", "values": ["port", "starboard"]})
    assert words.quantile(np.array([0.4999, 0.5001])).tolist() == ["port", "starboard"]


def test_a_value_is_the_same_in_every_row() -> None:
    assert read_distribution(3) == Constant(value=3)
    assert read_distribution(3).quantile(U).tolist() == [3.0] * len(U)
