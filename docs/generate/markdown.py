"""Markdown, as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

__all__ = ["anchored", "cell", "table"]


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table with its cells as given."""
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def cell(text: str) -> str:
    """Text for a cell of a table: a bar would end the cell."""
    return " ".join(text.split()).replace("|", "\\|")


def anchored(code: str, anchor: str) -> str:
    """Code that a link can name: `code` with the identifier `anchor`."""
    return f"`{code}`{{ #{anchor} }}"
