"""make_table(): the form of every table on the terminal. Names and numbers are never broken in two.

A narrow terminal shows fewer columns, and a line below says which are missing. Where even that is too wide, each row
becomes a block of lines.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Table
from rich.text import Text

__all__ = ["WordTable", "make_table"]

_GAP = 2
"""Characters that a column takes beside its text: the space between two, or those at both edges."""
_SENTENCE = 40
"""Longer cells are sentences: such a column is at least _NARROW wide, since one word to a line cannot be read."""
_NARROW = 20
_WHOLE: Any = {"no_wrap": True, "overflow": "ignore"}
"""Of a line that is longer than a terminal of 30 characters; half a number would be another number."""


class WordTable(Table):
    """A table whose columns are at least as wide as their longest word."""

    optional: Sequence[str] = ()
    """Headings of columns that a narrow terminal may leave out, the first one first."""

    @property
    def least_width(self) -> int:
        """Characters that a terminal needs for all columns."""
        cells = self._plain_cells()
        return _least(cells, list(range(len(cells))))

    def _plain_cells(self) -> list[list[str]]:
        """The texts of each column, its heading first."""
        return [[str(column.header), *map(_plain, column._cells)] for column in self.columns]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        room, cells = options.max_width, self._plain_cells()
        kept = list(range(len(cells)))
        missing: list[str] = []
        for heading in self.optional:
            if _least(cells, kept) <= room:
                break
            kept = [k for k in kept if cells[k][0].split("\n")[0] != heading]
            missing.append(heading)
        if _least(cells, kept) > room:
            yield from self._blocks(cells, room)
            return
        yield from self._fitted([cells[k] for k in kept], kept, room).__super_render__(console, options)
        if missing:
            yield Text(f"Not shown in {room} columns: {', '.join(missing)}")

    def __super_render__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """As rich renders it."""
        yield from super().__rich_console__(console, options)

    def _fitted(self, cells: list[list[str]], kept: list[int], room: int) -> WordTable:
        """The same table with these columns, as wide as their words need and the terminal allows."""
        made = WordTable(title=self.title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
        for k, width in zip(kept, _share_out(cells, room), strict=True):
            column = self.columns[k]
            made.add_column(column.header, justify=column.justify, width=width)
        for i, row in enumerate(self.rows):
            made.add_row(*(self.columns[k]._cells[i] for k in kept), end_section=row.end_section)
        return made

    def _blocks(self, cells: list[list[str]], room: int) -> RenderResult:
        """A line with the first cell of each row, and one below for each other."""
        if self.title is not None:
            yield self.title
        headings = [column[0].replace("\n", " ") for column in cells]
        indent = 2 + max(map(len, headings[1:])) + _GAP
        for i in range(1, len(cells[0])):
            yield Text(cells[0][i], **_WHOLE)
            for heading, column in zip(headings[1:], cells[1:], strict=True):
                lines = Text(column[i]).wrap(Console(width=room), max(room - indent, _longest_word(column[i : i + 1])))
                for n, line in enumerate(lines):
                    yield Text(f"{f'  {heading}' if n == 0 else '':{indent}}{line.plain.rstrip()}", **_WHOLE)


def make_table(*columns: str, title: str | None = None, optional: Sequence[str] = ()) -> WordTable:
    """An empty table with these headings; a column whose heading begins with '>' is aligned right, for numbers.

    A unit in brackets goes on a second line, since a terminal has 80 characters. `optional` names the headings, without
    units, that a narrow terminal leaves out.
    """
    heading = None if title is None else Text(title)  # Text: a unit in brackets is not a style
    table = WordTable(title=heading, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.optional = optional
    for column in columns:
        name = Text(column.removeprefix(">").replace(" [", "\n["))
        table.add_column(name, justify="right" if column.startswith(">") else "left")
    return table


def _plain(cell: object) -> str:
    return Text.from_markup(cell).plain if isinstance(cell, str) else str(cell)


def _longest_word(cells: Sequence[str]) -> int:
    return max((len(word) for cell in cells for word in cell.split()), default=0)


def _longest_line(cells: Sequence[str]) -> int:
    return max((len(line) for cell in cells for line in cell.split("\n")), default=0)


def _least_width(cells: Sequence[str]) -> int:
    natural = _longest_line(cells)
    return max(_longest_word(cells), _NARROW if natural > _SENTENCE else 1)


def _least(cells: list[list[str]], kept: list[int]) -> int:
    """The width of a table in which every column is as narrow as its words allow."""
    return sum(_least_width(cells[k]) for k in kept) + _GAP * len(kept)


def _share_out(cells: list[list[str]], room: int) -> list[int]:
    """Width of each column: the least, and what is left goes to those first that want the fewest characters more."""
    widths = [_least_width(column) for column in cells]
    more = [_longest_line(column) - width for column, width in zip(cells, widths, strict=True)]
    left = room - sum(widths) - _GAP * len(cells)
    for k in sorted(range(len(cells)), key=lambda k: more[k]):
        given = max(0, min(more[k], left))
        widths[k] += given
        left -= given
    return widths
