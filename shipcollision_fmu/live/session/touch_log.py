"""TouchLog: where bodies have touched so far, thinned, so that a page that is opened later can draw their scratches."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from .snapshot import TouchSnapshot

__all__ = ["MOST_TOUCHES", "LoggedTouch", "TouchLog"]

APART = 0.25
"""[m] Edge of the cells of which each is kept once for a pair. The narrowest stroke on a ship of 80 m is as broad."""
MOST_TOUCHES = 500
"""Touches that are kept, the latest ones; some 150 kB as JSON."""

Cell = tuple[str, str, tuple[int, ...]]


@dataclass(frozen=True)
class LoggedTouch:
    """A contact point, and the time [s] at which its cell was first touched."""

    time: float
    touch: TouchSnapshot


class TouchLog:
    """The touches of a run. `touches` may be read by any thread."""

    def __init__(self) -> None:
        self._cells: dict[Cell, LoggedTouch] = {}
        self.touches: tuple[LoggedTouch, ...] = ()

    def add(self, time: float, touching: Iterable[TouchSnapshot]) -> None:
        """Note the contact points of a time, which is later than those before."""
        new = {_find_cell(touch): LoggedTouch(time, touch) for touch in touching}
        if new.keys() <= self._cells.keys():
            return
        self._cells = {**new, **self._cells}  # a cell keeps its first touch
        latest = sorted(self._cells.items(), key=lambda item: item[1].time)[-MOST_TOUCHES:]
        self._publish(dict(latest))

    def forget(self, time: float) -> None:
        """Forget what is later than a time [s]."""
        self._publish({cell: logged for cell, logged in self._cells.items() if logged.time <= time})

    def _publish(self, cells: dict[Cell, LoggedTouch]) -> None:
        self._cells, self.touches = cells, tuple(cells.values())


def _find_cell(touch: TouchSnapshot) -> Cell:
    return touch.ship_a, touch.ship_b, tuple(round(x / APART) for x in (*touch.a, *touch.b))
