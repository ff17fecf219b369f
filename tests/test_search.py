"""Random search for what the examples of the property tests miss, by hand, when there is time to look into a find:

    python -m pytest -m soak tests/test_search.py

Every run takes other examples. A find prints the line that finds it again; put it into the suite as an @example or as a
test of its own, so that the gate, which draws the same examples every time, knows it from then on.
"""

from __future__ import annotations

import re
import secrets
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
FILES = sorted(
    path.relative_to(TESTS.parent).as_posix()
    for path in TESTS.rglob("test_*.py")
    if re.search("^@given", path.read_text(encoding="utf-8"), re.MULTILINE)
)


def search(file: str, seed: int) -> list[str]:
    """The command that tries random examples on the properties in a file."""
    profile = ["--hypothesis-profile=search", f"--hypothesis-seed={seed}"]
    return ["-m", "pytest", "-q", "-m", "hypothesis and not slow and not soak", *profile, file]


@pytest.mark.soak
@pytest.mark.parametrize("file", FILES)
def test_random_examples_find_nothing_new(file: str) -> None:
    command = search(file, secrets.randbits(32))
    done = subprocess.run(
        [sys.executable, *command], cwd=TESTS.parent, capture_output=True, text=True, timeout=3600, check=False
    )
    assert done.returncode == 0, f"{done.stdout}{done.stderr}\nto find it again: python {shlex.join(command)}"


def test_there_are_properties_to_search() -> None:
    assert "tests/collision/solvers/test_gauss_seidel.py" in FILES
