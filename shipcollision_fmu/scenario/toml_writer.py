"""TOML text for people: a comment on top, tables in the given order, a ship's orders on a line each."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime
from typing import Any

__all__ = ["format_toml"]

WIDTH = 110
"""Characters of a line; a longer list is written with an item a line."""


def format_toml(comment: Sequence[str], tables: Mapping[str, Mapping[str, Any]]) -> str:
    """TOML text of tables by name ("scenario", "ships.own"); keys whose value is None are left out.

    Floats are written so that reading them back gives the same double.
    """
    lines = [f"# {line}".rstrip() for line in comment]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *_format_entries(table)]
    return "\n".join(lines).lstrip("\n") + "\n"


def _format_entries(table: Mapping[str, Any]) -> Iterator[str]:
    for key, value in table.items():
        if value is None:
            continue
        line = f"{key} = {_format_value(value)}"
        if isinstance(value, list) and (len(line) > WIDTH or (value and isinstance(value[0], Mapping))):
            yield f"{key} = ["
            yield from (f"  {_format_value(item)}," for item in value)
            yield "]"
        else:
            yield line


def _format_value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{k} = {_format_value(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, datetime):
        return value.isoformat()
    if isinstance(value, list):
        return "[" + ", ".join(map(_format_value, value)) + "]"
    return repr(float(value) if isinstance(value, float) else value)  # NumPy's floats have a repr of their own
