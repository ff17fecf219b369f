"""What comes in a moment on a quiet machine is waited for a minute at least: others may keep the machine busy."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

TESTS = Path(__file__).parent
LEAST = 60.0
"""[s]"""
WAITS = frozenset({"wait", "join", "result", "settimeout", "communicate"})
"""Functions whose number, where it is none of those that count, is the time for which they wait."""


def find_short_waits(source: str) -> Iterator[int]:
    """Lines of calls that give up after less than LEAST; 0 is a look, and no wait. A shorter time that is meant has a
    name, which says why."""
    for call in ast.walk(ast.parse(source)):
        if not isinstance(call, ast.Call):
            continue
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        times = [word.value for word in call.keywords if word.arg in ("timeout", "open_timeout")]
        times += [one for one in call.args if name in WAITS and isinstance(getattr(one, "value", None), float)]
        for time in times:
            if isinstance(time, ast.Constant) and isinstance(time.value, int | float) and 0.0 < time.value < LEAST:
                yield call.lineno


def test_no_test_waits_for_less_than_a_minute() -> None:
    paths = sorted(TESTS.rglob("*.py"))
    found = [f"{path.relative_to(TESTS)}:{n}" for path in paths for n in find_short_waits(path.read_text("utf-8"))]
    assert found == []


def test_a_short_wait_is_found() -> None:
    text = "run(timeout=5)\nthread.join(0.5)\nconnect(open_timeout=20.0)\nanswer.result(0.0)\nevent.wait(LONG)\nwait(2)"
    assert list(find_short_waits(text)) == [1, 2, 3]
