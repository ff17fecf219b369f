"""Output of the commands: results on stdout, progress on stderr, both plain when not a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from textwrap import wrap
from time import monotonic

import click
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from .table import WordTable

__all__ = ["print_table", "progress", "say"]

PLAIN_WIDTH = 110
"""Characters in a line when stdout is not a terminal; wider tables have longer lines."""
PLAIN_PAUSE = 2.0
"""Time [s] between lines of progress when stderr is not a terminal: a short run prints none."""


def print_table(table: WordTable) -> None:
    """A table on stdout, as wide as the terminal allows. A file has no width: there every column is shown."""
    console = Console() if sys.stdout.isatty() else Console(width=max(PLAIN_WIDTH, table.least_width))
    console.print(table, crop=False)


def say(text: str, err: bool = False) -> None:
    """A line on stdout or stderr; on a terminal it is broken between words, so that names and numbers stay whole."""
    stream = sys.stderr if err else sys.stdout
    if stream.isatty():
        room, indent = Console(stderr=err).width, text[: len(text) - len(text.lstrip())]
        text = "\n".join(
            wrap(text, room, subsequent_indent=f"{indent}  ", break_long_words=False, break_on_hyphens=False)
        )
    click.echo(text, err=err)


@contextmanager
def progress(name: str) -> Iterator[Callable[[int, int], None]]:
    """A function of (done, total) that draws a bar on stderr, or prints a line now and then without a terminal."""
    if not sys.stderr.isatty():
        last = monotonic()

        def print_line(done: int, total: int) -> None:
            nonlocal last
            if monotonic() - last >= PLAIN_PAUSE:
                last = monotonic()
                click.echo(f"{name}: {done} of {total} steps", err=True)

        yield print_line
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(name, total=None)

        def move_bar(done: int, total: int) -> None:
            if done == total or done % max(1, total // 200) == 0:  # drawing costs more than stepping
                bar.update(task, completed=done, total=total)

        yield move_bar
