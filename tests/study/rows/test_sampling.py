"""Samplers: numbers by row alone, strata, discrepancy, and Sobol's points beside SciPy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats
from scipy.stats import qmc

from shipcollision_fmu.study.definition.study import SOBOL_DIMENSIONS
from shipcollision_fmu.study.definition.study_file import SAMPLERS
from shipcollision_fmu.study.rows.direction_numbers import DIMENSIONS
from shipcollision_fmu.study.rows.permutation import permute
from shipcollision_fmu.study.rows.sampling import Sampler
from shipcollision_fmu.study.rows.sobol import sobol_bits
from shipcollision_fmu.study.rows.uniform_numbers import draw_bits, draw_shares, make_key

NAMES = ["a", "b", "c", "d"]


@pytest.mark.parametrize("kind", SAMPLERS)
def test_a_number_depends_on_its_row_alone(kind: str) -> None:
    sampler = Sampler(kind, 7, 1000, NAMES)
    whole = sampler.draw("c", 0, 1000)
    for first, count in ((0, 1), (1, 2), (3, 5), (996, 4), (500, 257)):
        assert (sampler.draw("c", first, count) == whole[first : first + count]).all()
    assert (Sampler(kind, 8, 1000, NAMES).draw("c", 0, 1000) != whole).any()
    assert (sampler.draw("d", 0, 1000) != whole).any()
    assert 0.0 < whole.min() < whole.max() < 1.0


def test_bits_are_those_of_a_generator_drawn_from_its_start() -> None:
    whole = np.random.Philox(key=make_key(3, "x")).random_raw(50)
    assert (draw_bits(3, "x", 11, 30) == whole[11:41]).all()


def test_shares_are_uniform_and_names_independent() -> None:
    """Kolmogorov and Smirnov, and the correlation of two names: both with the probability of 1e-4 to be refused."""
    a, b = (draw_shares(1, name, 0, 100_000) for name in ("a", "b"))
    assert stats.kstest(a, "uniform").pvalue > 1e-4
    assert abs(np.corrcoef(a, b)[0, 1]) < 4.0 / np.sqrt(100_000)
    assert abs(np.corrcoef(a[1:], a[:-1])[0, 1]) < 4.0 / np.sqrt(100_000)


@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 16, 17, 1000, 4097, 65_536])
def test_a_permutation_hits_every_number_once(n: int) -> None:
    assert sorted(permute(5, "x", np.arange(n), n)) == list(range(n))


def test_a_permutation_is_evaluated_at_any_place() -> None:
    whole = permute(5, "x", np.arange(1000), 1000)
    assert (permute(5, "x", [999, 3, 500], 1000) == whole[[999, 3, 500]]).all()
    n = 10**10
    assert permute(5, "x", np.arange(n - 1000, n), n).max() < n


def test_a_permutation_has_no_order() -> None:
    """Neither rank correlation with the row, nor with the neighbour, nor with another name or seed."""
    n = 40_000
    a, limit = permute(5, "x", np.arange(n), n).astype(float), 4.0 / np.sqrt(n)
    for other in (np.arange(n), np.roll(a, 1), permute(5, "y", np.arange(n), n), permute(6, "x", np.arange(n), n)):
        assert abs(np.corrcoef(a, other.astype(float))[0, 1]) < limit
    cycles = sum(1 for i in range(n) if a[i] == i)
    assert cycles < 10  # 1 is expected


@pytest.mark.parametrize("n", [7, 1000])
def test_latin_hypercube_hits_each_stratum_once(n: int) -> None:
    for name in NAMES:
        shares = Sampler("latin-hypercube", 2, n, NAMES).draw(name, 0, n)
        assert sorted((shares * n).astype(int)) == list(range(n))


def test_sobol_hits_each_stratum_once() -> None:
    """Each interval of length 2^-k holds the same number of the first 2^10 points, whatever the shift."""
    for name in NAMES:
        shares = Sampler("sobol", 2, 1024, NAMES).draw(name, 0, 1024)
        assert sorted((shares * 1024).astype(int)) == list(range(1024))


def test_sobol_has_the_points_of_scipy() -> None:
    """All dimensions; SciPy's points have 30 bits."""
    assert DIMENSIONS == SOBOL_DIMENSIONS
    points = qmc.Sobol(DIMENSIONS, scramble=False).random(4096)
    own = np.column_stack([sobol_bits(d, 0, 4096) * 2.0**-40 for d in range(DIMENSIONS)])
    assert (own == points).all()
    far = qmc.Sobol(5, scramble=False).fast_forward(1_000_003).random(8)
    assert (np.column_stack([sobol_bits(d, 1_000_003, 8) * 2.0**-40 for d in range(5)]) == far).all()


def test_samplers_fill_the_cube_better_one_after_the_other() -> None:
    """Discrepancy of 1024 points in 4 dimensions: random above Latin hypercube above Sobol."""
    found = [
        qmc.discrepancy(np.column_stack([Sampler(kind, 2, 1024, NAMES).draw(name, 0, 1024) for name in NAMES]))
        for kind in ("random", "latin-hypercube", "sobol")
    ]
    assert found[0] > 2.0 * found[1] > 4.0 * found[2]
