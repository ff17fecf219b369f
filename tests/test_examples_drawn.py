"""The examples of a property test are the same whatever else the project holds or has imported: see conftest.py."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st


def drawn() -> list[str]:
    """What a sample property is given, in the suite's own settings."""
    seen = []

    @settings(max_examples=300, phases=[Phase.generate])
    @given(st.integers(), st.floats(-1e4, 1e4), st.text())
    def sample(whole: int, real: float, text: str) -> None:
        seen.append(repr((whole, real, text)))

    sample()
    return seen


@pytest.mark.slow
def test_a_new_module_with_odd_constants_does_not_change_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = drawn()
    (tmp_path / "odd.py").write_text('numbers = [271828, 314159, 1414.25, 1732.75]\nword = "abracadabra"\n')
    monkeypatch.syspath_prepend(tmp_path)
    importlib.import_module("odd")
    assert drawn() == before
    assert len(set(before)) > 200


@pytest.mark.parametrize("profile", ["shipcollision", "thorough"])
def test_they_are_neither_random_nor_remembered_nor_timed(profile: str) -> None:
    chosen = settings.get_profile(profile)
    assert chosen.derandomize
    assert chosen.database is None
    assert chosen.deadline is None
