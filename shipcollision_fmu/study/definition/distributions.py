"""Distributions of a study's variables: the keys of each, and its exact inverse distribution function.

    x = F^-1(u)   for u in (0, 1), one number for each row

The samplers make u (rows/sampling.py). A normal and a lognormal distribution may be cut off at `least` and `most`:
F is then rescaled to the part between them, so that nothing is drawn twice and nothing piles up at the ends.
"""

from __future__ import annotations

from math import erfc, isfinite, log, sqrt
from statistics import NormalDist
from typing import Annotated, Any, Literal

import numpy as np
import numpy.typing as npt
from pydantic import Field, PlainValidator, model_validator

from ...ship.frames import Array
from ...ship.tables.table import Positive, Table

__all__ = [
    "DISTRIBUTIONS", "Constant", "Discrete", "Distribution", "Lognormal", "Normal", "TableColumn", "Triangular",
    "Uniform", "cumulate",
]  # fmt: skip

Values = npt.NDArray[Any]

STANDARD = NormalDist()
LEAST_SHARE = 1e-9
"""Least share of a normal distribution between its cuts. With less, rounding of F would make steps in the numbers."""


def _check_values(given: Any) -> list[float] | list[str]:
    """The values of a discrete distribution: numbers, or words."""
    if isinstance(given, list) and given:
        if all(isinstance(value, str) for value in given):
            return given
        if all(type(value) in (int, float) and isfinite(value) for value in given):
            return [float(value) for value in given]
    raise ValueError(f"the value {given!r} must be a list of finite numbers, or of words, e.g. [2.0, 5.0]")


NumbersOrWords = Annotated[Any, PlainValidator(_check_values)]
Weights = Annotated[list[Annotated[float, Field(ge=0.0)]], Field(min_length=1)]


class Distribution(Table):
    """A distribution of numbers, or of words."""

    def quantile(self, u: Array) -> Values:
        """The values at these shares u in (0, 1), of the same shape."""
        raise NotImplementedError

    def limits(self) -> tuple[float, float]:
        """Least and greatest value; infinite where there is none."""
        raise NotImplementedError

    def words(self) -> list[str]:
        """The words among the values; none of a distribution of numbers."""
        return []


class Constant(Distribution):
    """The same value in every row."""

    distribution: Literal["constant"] = "constant"
    value: float | str = Field(description="the value")

    def quantile(self, u: Array) -> Values:
        """The value, for each u."""
        return np.full(u.shape, self.value)

    def limits(self) -> tuple[float, float]:
        """The value twice."""
        return (-np.inf, np.inf) if isinstance(self.value, str) else (self.value, self.value)

    def words(self) -> list[str]:
        """The value, if it is a word."""
        return [self.value] if isinstance(self.value, str) else []


class Uniform(Distribution):
    """Every value between two limits alike."""

    distribution: Literal["uniform"] = "uniform"
    least: float = Field(description="the least value")
    most: float = Field(description="the greatest value")

    @model_validator(mode="after")
    def _check(self) -> Uniform:
        if self.least >= self.most:
            raise ValueError(f"least = {self.least:g} must be below most = {self.most:g}: exchange them")
        return self

    def quantile(self, u: Array) -> Values:
        """least + u (most - least)."""
        return np.minimum(self.least + u * (self.most - self.least), self.most)

    def limits(self) -> tuple[float, float]:
        """least and most."""
        return self.least, self.most


class Normal(Distribution):
    """A normal distribution, cut off at `least` and `most` where they are given."""

    distribution: Literal["normal"] = "normal"
    mean: float = Field(description="the mean, before anything is cut off")
    sd: Positive = Field(description="the standard deviation, before anything is cut off")
    least: float | None = Field(default=None, description="the value below which it is cut off")
    most: float | None = Field(default=None, description="the value above which it is cut off")

    @model_validator(mode="after")
    def _check(self) -> Normal:
        _check_cuts(self.least, self.most, *self._cut_shares())
        return self

    def quantile(self, u: Array) -> Values:
        """mean + sd Phi^-1(F), F between the shares at the cuts."""
        return self._clip(self.mean + self.sd * _quantile_between(u, *self._cut_shares()))

    def limits(self) -> tuple[float, float]:
        """The cuts."""
        return _limits(self.least, self.most)

    def _cut_shares(self) -> tuple[float, float]:
        """The cuts in standard deviations from the mean."""
        low, high = self.limits()
        return (low - self.mean) / self.sd, (high - self.mean) / self.sd

    def _clip(self, values: Values) -> Values:
        return np.clip(values, *self.limits())


class Lognormal(Distribution):
    """A value whose logarithm is normal: never negative, with a long tail. May be cut off likewise."""

    distribution: Literal["lognormal"] = "lognormal"
    median: Positive = Field(description="the median, before anything is cut off")
    sigma: Positive = Field(description="the standard deviation of the natural logarithm, before anything is cut off")
    least: Positive | None = Field(default=None, description="the value below which it is cut off")
    most: Positive | None = Field(default=None, description="the value above which it is cut off")

    @model_validator(mode="after")
    def _check(self) -> Lognormal:
        _check_cuts(self.least, self.most, *self._cut_shares())
        return self

    def quantile(self, u: Array) -> Values:
        """median exp(sigma Phi^-1(F)), F between the shares at the cuts."""
        z = _quantile_between(u, *self._cut_shares())
        return np.clip(self.median * np.exp(self.sigma * z), *self.limits())

    def limits(self) -> tuple[float, float]:
        """The cuts; 0 without a lower one."""
        low, high = _limits(self.least, self.most)
        return max(low, 0.0), high

    def _cut_shares(self) -> tuple[float, float]:
        low = -np.inf if self.least is None else log(self.least / self.median) / self.sigma
        high = np.inf if self.most is None else log(self.most / self.median) / self.sigma
        return low, high


class Triangular(Distribution):
    """A density that rises from `least` to `mode` and falls to `most`, both in straight lines."""

    distribution: Literal["triangular"] = "triangular"
    least: float = Field(description="the least value")
    mode: float = Field(description="the most probable value")
    most: float = Field(description="the greatest value")

    @model_validator(mode="after")
    def _check(self) -> Triangular:
        if not (self.least <= self.mode <= self.most and self.least < self.most):
            raise ValueError(
                f"mode = {self.mode:g} must be between least = {self.least:g} and most = {self.most:g}: put the three "
                "in rising order"
            )
        return self

    def quantile(self, u: Array) -> Values:
        """least + sqrt(u width rise) below the mode, most - sqrt((1 - u) width fall) above it."""
        width, rise, fall = self.most - self.least, self.mode - self.least, self.most - self.mode
        return np.where(
            u * width < rise, self.least + np.sqrt(u * width * rise), self.most - np.sqrt((1.0 - u) * width * fall)
        )

    def limits(self) -> tuple[float, float]:
        """least and most."""
        return self.least, self.most


class Discrete(Distribution):
    """Some values, each with a weight."""

    distribution: Literal["discrete"] = "discrete"
    values: NumbersOrWords = Field(description="the values, all numbers or all words, e.g. [2.0, 5.0]")
    weights: Weights | None = Field(default=None, description="a weight for each value; all alike if left out")

    @model_validator(mode="after")
    def _check(self) -> Discrete:
        if self.weights is None:
            return self
        if len(self.weights) != len(self.values):
            raise ValueError(
                f"weights has {len(self.weights)} entries and values has {len(self.values)}: give one weight for each"
            )
        if not sum(self.weights) > 0.0:
            raise ValueError("weights are all 0: give at least one that is above 0")
        return self

    def quantile(self, u: Array) -> Values:
        """The value in whose share of the weights u lies."""
        cumulated = cumulate(self.weights or [1.0] * len(self.values))
        return np.asarray(self.values)[np.searchsorted(cumulated, u, side="right")]

    def limits(self) -> tuple[float, float]:
        """Least and greatest of the values."""
        numbers = [value for value in self.values if not isinstance(value, str)]
        return (min(numbers), max(numbers)) if numbers else (-np.inf, np.inf)

    def words(self) -> list[str]:
        """The values, if they are words."""
        return [value for value in self.values if isinstance(value, str)]


class TableColumn(Distribution):
    """A column of a table of the study; all columns of one table are taken from the same line in a row of the study."""

    distribution: Literal["table"] = "table"
    table: str = Field(description="the NAME of a table [tables.NAME]")
    column: str = Field(description="the name of a column in it")

    def limits(self) -> tuple[float, float]:
        """None: they are checked when the table has been read."""
        return -np.inf, np.inf


DISTRIBUTIONS: dict[str, type[Distribution]] = {
    "constant": Constant, "uniform": Uniform, "normal": Normal, "lognormal": Lognormal, "triangular": Triangular,
    "discrete": Discrete, "table": TableColumn,
}  # fmt: skip
"""By the word in the key `distribution`."""


def cumulate(weights: Any) -> Array:
    """Cumulated shares of the weights (n,), the last exactly 1 so that every u in (0, 1) lies below it.

    Entries of weight 0 at the end get the share 1, too: searching from the right never returns them.
    """
    shares: Array = np.cumsum(np.asarray(weights, float))
    shares /= shares[-1]
    return shares


def _limits(least: float | None, most: float | None) -> tuple[float, float]:
    return -np.inf if least is None else least, np.inf if most is None else most


def _check_cuts(least: float | None, most: float | None, low: float, high: float) -> None:
    """Raise ValueError for cuts, given and in standard deviations, that leave nothing between them."""
    if least is not None and most is not None and least >= most:
        raise ValueError(f"least = {least:g} must be below most = {most:g}: exchange them")
    low, high = _mirror(low, high)
    share = _share(high) - _share(low)
    if share < LEAST_SHARE:
        raise ValueError(
            f"least and most leave {share:.1g} of the distribution, at least {LEAST_SHARE:g} is needed: move them "
            "towards its middle, or take uniform"
        )


def _mirror(low: float, high: float) -> tuple[float, float]:
    """The same interval below the mean, if most of it lies above: F is exact near 0 and rounded near 1."""
    return (-high, -low) if low > 0.0 else (low, high)


def _share(z: float) -> float:
    """Phi(z) = erfc(-z / sqrt(2)) / 2, exact far below the mean, where 1 + erf would be rounded to 0."""
    return 0.5 * erfc(-z / sqrt(2.0))


_inverse = np.frompyfunc(STANDARD.inv_cdf, 1, 1)
"""Phi^-1 by Wichura's algorithm AS 241, from Python's library."""


def _quantile_between(u: Array, low: float, high: float) -> Array:
    """Phi^-1(Phi(low) + u (Phi(high) - Phi(low)))."""
    a, b = _mirror(low, high)
    is_mirrored = (a, b) != (low, high)
    share = 1.0 - u if is_mirrored else u
    F = _share(a) + share * (_share(b) - _share(a))
    z = np.asarray(_inverse(np.clip(F, 5e-324, 1.0 - 2.0**-53)), float)
    return -z if is_mirrored else z
