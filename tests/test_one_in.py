"""`@pytest.mark.one_in(n)`: most cases of a grid are slow, and each value of each parameter is in a default test."""

from __future__ import annotations

from itertools import product

import pytest

from tests.conftest import is_quick


@pytest.mark.parametrize("n", [2, 3, 4])
def test_one_case_in_n_is_quick_and_each_value_is_in_one(n: int) -> None:
    lengths = (2, 3, 5)
    cases = list(product(*map(range, lengths)))
    quick = [places for k, places in enumerate(cases) if is_quick(k, lengths, n)]
    assert len(quick) == pytest.approx(len(cases) / n, abs=1.0)
    assert [len({places[k] for places in quick}) for k in range(3)] == list(lengths)


@pytest.fixture(params=["one", "another"])
def way(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.mark.one_in(2)
@pytest.mark.parametrize("number", [0, 1, 2])
@pytest.mark.parametrize(("letter", "capital"), [("a", "A"), ("b", "B")])
def test_the_others_are_slow(request: pytest.FixtureRequest, letter: str, capital: str, number: int, way: str) -> None:
    """Those with a and 0 or 2, and with b and 1, are quick, whatever fixtures add."""
    quick = (letter == "b") == (number == 1)
    assert (letter.upper(), len(way) > 0) == (capital, True)
    assert (request.node.get_closest_marker("slow") is None) == quick
