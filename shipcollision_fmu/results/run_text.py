"""Texts of a run's files: tables as CSV, everything else as JSON. The same data gives the same bytes."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["csv_text", "json_text"]


def csv_text(rows: npt.NDArray[Any]) -> str:
    """A structured array as header and rows; floats as repr, so that reading the text gives the same doubles."""
    assert rows.dtype.names is not None
    lines = [",".join(rows.dtype.names), *(",".join(map(_cell, row)) for row in rows.tolist())]
    return "\n".join(lines) + "\n"


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
