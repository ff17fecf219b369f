"""row_progress(): how far a study is, how fast it goes and how long it takes, on stderr."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic

import click
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

__all__ = ["Pace", "describe_pace", "row_progress"]

PLAIN_PAUSE = 10.0
"""Time [s] between lines when stderr is not a terminal: a night's log stays readable."""


@contextmanager
def row_progress(name: str) -> Iterator[Callable[[int, int], None]]:
    """A function of (rows done, all rows) that draws a bar on stderr, or prints a line now and then without a terminal.

    Rows that are there at its first call are not counted into the rate.
    """
    measure = Pace().measure
    if not sys.stderr.isatty():
        last = monotonic()

        def print_line(done: int, total: int) -> None:
            nonlocal last
            pace = measure(done, total)
            if monotonic() - last >= PLAIN_PAUSE:
                last = monotonic()
                click.echo(f"{name}: {done} of {total} rows{pace}", err=True)

        yield print_line
        return
    columns = (
        TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(),
        TextColumn("{task.completed} of {task.total} rows{task.fields[pace]}"),
    )  # fmt: skip
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(name, total=None, pace="")

        def move_bar(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total, pace=measure(done, total))

        yield move_bar


class Pace:
    """The pace from the first answer on: the time of that one has the start of the workers in it."""

    def __init__(self, clock: Callable[[], float] = monotonic) -> None:
        self._clock = clock
        self._starts: list[tuple[int, float]] = []

    def measure(self, done: int, total: int) -> str:
        """The pace at so many rows, as describe_pace() says it."""
        now = self._clock()
        if not self._starts or (len(self._starts) == 1 and done > self._starts[0][0]):
            self._starts.append((done, now))
        first, begin = self._starts[-1]
        return describe_pace(done, first, total, now - begin)


def describe_pace(done: int, first: int, total: int, seconds: float) -> str:
    """Rows per second since `first` rows were done, and the time left; "" before any row is done."""
    if done <= first or seconds <= 0.0:
        return ""
    rate = (done - first) / seconds
    left = round((total - done) / rate)
    return f", {rate:.3g} rows/s, {left // 3600}:{left // 60 % 60:02d}:{left % 60:02d} left"
