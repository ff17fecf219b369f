"""The checks before a commit are those of the gate."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMMIT = re.findall(r"entry: \.venv/bin/(.+)", (ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))


def test_four_checks_before_a_commit() -> None:
    assert [entry.split()[0] for entry in COMMIT] == ["ruff", "ruff", "mypy", "lint-imports"]


@pytest.mark.parametrize("entry", COMMIT)
def test_a_check_before_a_commit_is_one_of_the_gate(entry: str) -> None:
    """Of `ruff check --force-exclude` the gate runs `ruff check .`: pre-commit names the files itself."""
    program, *arguments = entry.removesuffix(" --force-exclude").split()
    gate = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    assert " ".join([f'"$work/tools/bin/{program}"', *arguments]) in gate
