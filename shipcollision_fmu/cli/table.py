"""make_table(): the form of every table on the terminal."""

from __future__ import annotations

from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

__all__ = ["make_table"]


def make_table(*columns: str, title: str | None = None) -> Table:
    """An empty table with these headings; a column whose heading begins with '>' is aligned right, for numbers.

    A unit in brackets goes on a second line, since a terminal has 80 characters. Cells are folded where the terminal is
    narrow, because a ship's name that is cut off would be useless.
    """
    heading = None if title is None else Text(title)  # Text: a unit in brackets is not a style
    table = Table(title=heading, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    for column in columns:
        name = Text(column.removeprefix(">").replace(" [", "\n["))
        table.add_column(name, justify="right" if column.startswith(">") else "left", overflow="fold")
    return table
