"""Markdown, as text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

__all__ = ["anchored", "cell", "plain", "table"]

_CODE = re.compile(r"(`[^`]*`)")


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table with its cells as given."""
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def cell(text: str) -> str:
    """Text for a cell of a table: a bar would end the cell."""
    return plain(" ".join(text.split())).replace("|", "\\|")


def plain(text: str) -> str:
    """Text with its braces escaped, but for those in code: attr_list takes `{...}` at an end for attributes."""
    parts = _CODE.split(text)
    return "".join(part if part.startswith("`") else re.sub(r"([{}])", r"\\\1", part) for part in parts)


def anchored(code: str, anchor: str) -> str:
    """Code that a link can name: `code` with the identifier `anchor`."""
    return f"`{code}`{{ #{anchor} }}"
