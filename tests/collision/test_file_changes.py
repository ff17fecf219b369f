"""A step in contact can be followed: it changes file half as often as before its parts were gathered."""

from __future__ import annotations

import importlib.util
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "benchmarks" / "file_changes.py"

MOST = 230
"""File changes of the step by the script's definition; 477 before."""


def test_a_step_in_contact_changes_file_seldom_enough_to_be_followed() -> None:
    spec = importlib.util.spec_from_file_location("file_changes", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    changes = script.file_changes_of_a_contact_step()
    assert 0 < sum(changes.values()) <= MOST, changes.most_common(10)
