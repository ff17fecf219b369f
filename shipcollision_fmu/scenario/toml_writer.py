"""A scenario as a TOML file that people like to read: a comment on top, tables in order, a ship's orders one a line."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

__all__ = ["scenario_text"]

WIDTH = 110
"""A list that would be longer is written one item a line."""


def scenario_text(comment: Sequence[str], tables: Mapping[str, Mapping[str, Any]]) -> str:
    """TOML text of tables by their names ("scenario", "ships.own"); keys whose value is None are left out.

    Floats are written so that reading them back gives the same double.
    """
    lines = [f"# {line}".rstrip() for line in comment]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *_entries(table)]
    return "\n".join(lines).lstrip("\n") + "\n"


def _entries(table: Mapping[str, Any]) -> Iterator[str]:
    for key, value in table.items():
        if value is None:
            continue
        line = f"{key} = {_value(value)}"
        if isinstance(value, list) and (len(line) > WIDTH or (value and isinstance(value[0], Mapping))):
            yield f"{key} = ["
            yield from (f"  {_value(item)}," for item in value)
            yield "]"
        else:
            yield line


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{k} = {_value(v)}" for k, v in value.items() if v is not None) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(float(value) if isinstance(value, float) else value)  # NumPy's floats have a repr of their own
