"""Step-time code adds floats by reduce(add, ...): sum() rounds otherwise from CPython 3.12 on."""

from __future__ import annotations

import ast
from functools import reduce
from operator import add
from pathlib import Path

import pytest

import shipcollision_fmu

PACKAGE = Path(shipcollision_fmu.__file__).parent
FILES = sorted(path for room in ("collision", "manoeuvring") for path in (PACKAGE / room).rglob("*.py"))
HARMLESS = {
    "collision/checks.py": "is the sum finite?",
    "collision/conservative_advancement.py": "two numbers, which round alike",
    "manoeuvring/model.py": "is the sum finite?",
}


def sums(path: Path) -> list[str]:
    """Calls of sum() without a start value, but for counts; sums of arrays have one."""
    calls = (node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Call))
    return [
        f"{path.name}:{call.lineno}: {ast.unparse(call)}"
        for call in calls
        if isinstance(call.func, ast.Name)
        and call.func.id == "sum"
        and len(call.args) == 1
        and not _counts(call.args[0])
    ]


def _counts(summed: ast.expr) -> bool:
    """Whether a generator yields truth values or lengths."""
    return isinstance(summed, ast.GeneratorExp) and isinstance(summed.elt, ast.UnaryOp | ast.Compare | ast.Constant)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_no_float_is_added_by_sum(path: Path) -> None:
    found = sums(path)
    assert (found == []) or path.relative_to(PACKAGE).as_posix() in HARMLESS


def test_reduce_adds_in_order() -> None:
    assert reduce(add, [1.0, 1e100, 1.0, -1e100]) == 0.0
