"""A file of a model that changes between saving a state and restoring it, for FMUs with Python and without."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

OK = 0

__all__ = ["check_changed_file"]


def check_changed_file(
    make: Callable[..., Any], begin: Callable[[Any], None], path: Path, contents: tuple[bytes, bytes], line: str
) -> None:
    """A state goes into another instance while the file at `path` has its content, and is refused with `line` when it
    has the second one; whoever saved it, and the instance that refused it, are as they were.

    begin: sets parameters and initialises.
    """
    path.write_bytes(contents[0])
    a, b, c = make("a"), make("b"), make("c")
    begin(a)
    assert a.step(0) == OK
    data = a.saved()
    assert b.restore(data) == OK
    assert b.everything() == a.everything()
    path.write_bytes(contents[1])
    before = c.everything()
    c.restore(data)
    assert line in c.messages[-1][1]
    assert c.everything() == before
    assert a.restore(data) == OK
    assert a.step(1) == OK
    path.write_bytes(contents[0])
    d = make("d")
    assert d.restore(data) == OK
    assert (d.step(1), d.everything()) == (OK, a.everything())
