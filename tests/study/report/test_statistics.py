"""Statistics of a report against SciPy, closed forms and the coverage of their intervals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from shipcollision_fmu.study.report.binned import LEVELS, Binned, find_binned_quantiles
from shipcollision_fmu.study.report.charts import _make_tornado
from shipcollision_fmu.study.report.clopper_pearson import clopper_pearson, incomplete_beta
from shipcollision_fmu.study.report.convergence import find_convergence
from shipcollision_fmu.study.report.exceedance import find_exceedance
from shipcollision_fmu.study.report.figures import draw_binned, draw_exceedance
from shipcollision_fmu.study.report.sensitivity import find_first_order, find_rank_correlation


def test_incomplete_beta_is_that_of_scipy() -> None:
    a, b, x = (
        grid.ravel()
        for grid in np.meshgrid([1.0, 2.0, 30.0, 5e5], [1.0, 7.0, 400.0, 5e5], [0.0, 1e-7, 0.1, 0.5, 0.999, 1.0])
    )
    assert incomplete_beta(a, b, x) == pytest.approx(special.betainc(a, b, x), rel=2e-9, abs=1e-12)


@pytest.mark.parametrize("n", [1, 20, 1968, 1_000_000])
def test_clopper_pearson_is_that_of_scipy(n: int) -> None:
    k = np.unique([0, 1, n // 100, n // 2, n - 1, n])
    lower, upper = clopper_pearson(k, n)
    with np.errstate(invalid="ignore"):
        expected = stats.beta.ppf(0.025, k, n - k + 1), stats.beta.ppf(0.975, k + 1, n - k)
    assert lower == pytest.approx(np.where(k == 0, 0.0, expected[0]), rel=1e-8)
    assert upper == pytest.approx(np.where(k == n, 1.0, expected[1]), rel=1e-8)


def test_exceedance_of_a_few_values() -> None:
    """With ties, a value counts all cases that have at least it."""
    curve = find_exceedance(np.array([3.0, 1.0, 3.0, 0.0]))
    assert curve.value.tolist() == [0.0, 1.0, 3.0]
    assert curve.share.tolist() == [1.0, 0.75, 0.5]


def test_exceedance_of_an_exponential_distribution() -> None:
    """At the quantiles themselves the curve is exact; the worst of the others is seven times too improbable."""
    n = 5000
    values = stats.expon.ppf((np.arange(n) + 0.5) / n)
    curve = find_exceedance(np.random.default_rng(1).permutation(values))
    assert curve.value[[0, -1]].tolist() == [values[0], values[-1]]
    assert curve.share == pytest.approx(np.exp(-curve.value) + 0.5 / n, abs=1e-12)


@pytest.mark.parametrize("n", [1, 40, 5000, 100_000])
@pytest.mark.parametrize("digits", [1, 12])
def test_exceedance_as_a_step_is_that_of_all_cases(n: int, digits: int) -> None:
    """At each case and between any two: within 0.002 and 1 % of the share, and inside the band; 1 digit makes ties."""
    values = np.random.default_rng(n).lognormal(16.0, 1.2, n).round(digits) + 1e4
    curve, ordered = find_exceedance(values), np.sort(values)
    places = np.concatenate([ordered, 0.5 * (ordered[1:] + ordered[:-1])])
    step = np.searchsorted(curve.value, places)
    expected = 1.0 - np.searchsorted(ordered, places) / n
    error = np.abs(curve.share[step] - expected)
    assert error.max() <= 0.002 + 1e-12
    assert (error / expected).max() <= 0.01 + 1e-12
    assert (curve.lower[step] <= expected).all()
    assert (expected <= curve.upper[step]).all()
    assert len(curve.value) <= 1600


def test_the_figure_of_an_exceedance_is_that_step() -> None:
    """The line and the band that Matplotlib draws, vertex by vertex, not only the file of data beside them."""
    values = np.random.default_rng(9).lognormal(16.0, 1.2, 3000)
    figure = draw_exceedance(find_exceedance(values), 1e-6, "energy [MJ]")
    (line,), (band,) = figure.axes[0].get_lines(), figure.axes[0].collections
    assert line.get_drawstyle() == "steps-pre"
    x, y = (np.asarray(data) for data in line.get_data())
    places = np.sort(values)[1:] * 1e-6 * (1.0 - 1e-12)
    expected = 1.0 - np.searchsorted(np.sort(values), places * 1e6) / len(values)
    assert y[np.searchsorted(x, places)] == pytest.approx(expected, abs=0.002 + 1e-12)
    vertices = band.get_paths()[0].vertices
    for place, share in zip(places[::50], expected[::50], strict=True):
        around = vertices[vertices[:, 0] == x[np.searchsorted(x, place)], 1]
        assert around.min() <= share <= around.max()


def test_the_band_has_the_interval_of_each_count() -> None:
    values = np.random.default_rng(8).exponential(size=40)
    curve, (lower, upper) = find_exceedance(values), clopper_pearson(np.arange(41), 40)
    for value, low, high in zip(curve.value, curve.lower, curve.upper, strict=True):
        count = int((values >= value).sum())
        assert (low, high) == pytest.approx((lower[count], upper[count]), rel=1e-12)


def test_intervals_cover_as_often_as_they_say() -> None:
    """At fixed values of an exponential distribution, in 4000 samples of 40: at least 95 %, and not nearly always."""
    repeats, places = 4000, np.array([0.3, 1.0, 2.0])
    values = np.random.default_rng(17).exponential(size=(repeats, 40))
    lower, upper = clopper_pearson(np.arange(41), 40)
    for place in places:
        counts = (values >= place).sum(axis=1)
        covered = np.mean((lower[counts] <= np.exp(-place)) & (np.exp(-place) <= upper[counts]))
        assert 0.95 - 3.0 * np.sqrt(0.95 * 0.05 / repeats) <= covered <= 0.99


def test_quantiles_of_bins_are_those_of_numpy() -> None:
    random = np.random.default_rng(2)
    x, y = random.uniform(0.0, 10.0, 3000), random.normal(size=3000)
    x[[0, 1]] = 0.0, 10.0
    binned = find_binned_quantiles(x, y, 5)
    assert binned.edges.tolist() == [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]
    for i, (low, high) in enumerate(zip(binned.edges[:-1], binned.edges[1:], strict=True)):
        inside = (x >= low) & ((x < high) | (i == 4))
        assert binned.counts[i] == inside.sum()
        assert binned.quantiles[i] == pytest.approx(np.quantile(y[inside], LEVELS))


def test_a_bin_of_few_cases_is_empty() -> None:
    x = np.concatenate([np.linspace(0.0, 0.4, 100), [1.0]])
    binned = find_binned_quantiles(x, x, 2)
    assert binned.counts.tolist() == [100, 1]
    assert np.isfinite(binned.quantiles).all(axis=1).tolist() == [True, False]


@pytest.mark.parametrize("empty", [1, 3, 4])
def test_each_bin_with_quantiles_is_drawn_with_its_band(empty: int) -> None:
    """Beside an empty bin as well, and at both ends."""
    edges = np.linspace(0.0, 5.0, 6)
    quantiles = np.tile([1.0, 2.0, 3.0], (5, 1))
    quantiles[empty] = np.nan
    axes = draw_binned(Binned(edges, np.full(5, 30), quantiles), 1.0, "energy", "angle").axes[0]
    (band,), (median,) = axes.collections, axes.get_lines()
    x, y = (np.asarray(data) for data in median.get_data())
    for i in range(5):
        inside = np.array([[i + 0.01, 2.5], [i + 0.99, 2.5]])
        covered = [any(path.contains_point(point) for path in band.get_paths()) for point in inside]
        assert covered == [i != empty] * 2
        drawn = [np.isfinite(np.interp(place, x, y)) for place in inside[:, 0]]
        assert drawn == [i != empty] * 2


def test_an_exceedance_of_two_values_is_a_step_from_zero() -> None:
    """Of cases without contact and one energy besides, the curve is a line up to that energy."""
    axes = draw_exceedance(find_exceedance(np.array([0.0, 0.0, 5e6, 5e6])), 1e-6, "energy [MJ]").axes[0]
    x, y = (np.asarray(data).tolist() for data in axes.get_lines()[0].get_data())
    assert (x, y, axes.get_xscale()) == ([0.0, 5.0], [1.0, 0.5], "linear")


def test_convergence_is_the_mean_and_the_quantile_of_the_first_cases() -> None:
    values = 1e9 + np.random.default_rng(3).exponential(size=4000)
    found = find_convergence(values)
    assert (found.n[0], found.n[-1]) == (10, 4000)
    for n, mean, low, high in zip(found.n, found.mean, found.mean_lower, found.mean_upper, strict=True):
        first = values[:n]
        assert mean == pytest.approx(first.mean(), rel=1e-14)
        assert high - low == pytest.approx(2 * 1.96 * first.std(ddof=1) / np.sqrt(n), rel=1e-4)
    known = np.isfinite(found.quantile)
    assert known[-1]
    assert not known[0]  # of ten cases none is beyond the 99 % quantile
    assert found.quantile[known] == pytest.approx([np.quantile(values[:n], 0.99) for n in found.n[known]], rel=1e-14)


def test_intervals_of_convergence_cover_as_often_as_they_say() -> None:
    random, repeats = np.random.default_rng(4), 1000
    mean = quantile = 0
    for _ in range(repeats):
        found = find_convergence(random.uniform(size=1500))
        mean += found.mean_lower[-1] <= 0.5 <= found.mean_upper[-1]
        quantile += found.quantile_lower[-1] <= 0.99 <= found.quantile_upper[-1]
    margin = 3.5 * np.sqrt(0.95 * 0.05 / repeats)
    assert mean / repeats == pytest.approx(0.95, abs=margin)
    assert 0.95 - margin <= quantile / repeats <= 0.985


def test_rank_correlation_is_that_of_scipy() -> None:
    random = np.random.default_rng(5)
    x = random.normal(size=500)
    for y in (x**3, -x, x + random.normal(size=500), np.round(x, 1), random.normal(size=500)):
        assert find_rank_correlation(x, y) == pytest.approx(stats.spearmanr(x, y).statistic, abs=1e-12)
    assert find_rank_correlation(x, np.ones(500)) == 0.0


def test_first_order_indices_of_ishigami() -> None:
    """sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1: 0.3139, 0.4424 and 0; Ishigami and Homma, 1990."""
    x = np.random.default_rng(6).uniform(-np.pi, np.pi, (100_000, 3))
    y = np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])
    found = [find_first_order(x[:, i], y) for i in range(3)]
    assert found == pytest.approx([0.3139, 0.4424, 0.0], abs=0.012)


def test_first_order_of_words_is_exact_and_of_noise_about_zero() -> None:
    random = np.random.default_rng(7)
    word, noise = random.integers(0, 3, 20_000).astype(float), random.normal(size=20_000)
    y = np.array([0.0, 1.0, 5.0])[word.astype(int)] + noise
    variance = np.var([0.0, 1.0, 5.0])
    assert find_first_order(word, y) == pytest.approx(variance / (variance + 1.0), abs=0.01)
    assert np.mean([find_first_order(random.uniform(size=200), noise[:200]) for _ in range(200)]) < 0.03
    assert find_first_order(word, np.ones(20_000)) == 0.0


@pytest.mark.parametrize(("words", "cases"), [(30, 400), (100, 20_000), (400, 1_200)])
def test_first_order_of_many_words_has_a_bin_for_each(words: int, cases: int) -> None:
    """Files of traffic: their order says nothing, so that bins of several would level out what they differ by."""
    random = np.random.default_rng(8)
    word, mean = np.arange(cases) % words, random.normal(size=words)
    y = mean[word] + 0.5 * random.normal(size=cases)
    share = np.var(mean) / (np.var(mean) + 0.25)
    assert find_first_order(word.astype(float), y, are_words=True) == pytest.approx(share, abs=0.04)


@pytest.mark.parametrize(("cases", "inputs"), [(40, ["friction"]), (80, ["friction", "situation"])])
def test_files_of_traffic_that_are_run_once_have_no_share(cases: int, inputs: list[str]) -> None:
    """With one case of each of 40 files, what a file adds and what chance adds are one number."""

    class Table:
        energy = np.random.default_rng(9).normal(size=cases)

        def read_numbers(self, name: str) -> Any:
            return self.energy**3 if name == "friction" else np.full(cases, np.nan)

        def read_codes(self, name: str) -> Any:
            return (np.arange(cases) % 40 if name == "situation" else np.zeros(cases)).astype(float)

    (chart,) = _make_tornado(Table())  # type: ignore[arg-type]
    assert sorted(chart.data["input"]) == inputs
