"""Texts of a run's files: tables as CSV, everything else as JSON. The same data gives the same bytes."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["csv_parts", "csv_text", "json_text"]

PART = 4096
"""Rows of a part of a table. Fewer cost calls, more cost memory, some 2 kB a row."""


def csv_text(rows: npt.NDArray[Any]) -> str:
    """A structured array as header and rows; floats as repr, so that reading the text gives the same doubles."""
    return "".join(csv_parts(rows))


def csv_parts(rows: npt.NDArray[Any]) -> Iterator[str]:
    """The same in parts of PART rows: a long run would fill the memory several times over."""
    assert rows.dtype.names is not None
    yield ",".join(rows.dtype.names) + "\n"
    for first in range(0, len(rows), PART):
        yield "".join(",".join(map(_cell, row)) + "\n" for row in rows[first : first + PART].tolist())


def json_text(data: Any) -> str:
    """JSON, indented, with a list of plain values on one line; floats as repr."""
    text = json.dumps(data, indent=1, allow_nan=False, default=_plain) + "\n"
    return re.sub(r"\[\n[^][{}]*\]", _on_one_line, text)


def _on_one_line(plain_list: re.Match[str]) -> str:
    return re.sub(r"\n *", " ", plain_list[0]).replace("[ ", "[")[:-2] + "]"


def _cell(value: Any) -> str:
    return value if isinstance(value, str) else repr(value)


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} cannot be written as JSON")
