"""TouchLog: where bodies have touched so far, thinned, so that a page that is opened later can draw their scratches."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any

from .snapshot import TouchSnapshot

__all__ = ["MOST_TOUCHES", "LoggedTouch", "TouchLog"]

APART = 0.25
"""[m] Edge of the cells of which each is kept once for a pair. The narrowest stroke on a ship of 80 m is as broad."""
MOST_TOUCHES = 500
"""Touches that are kept, the latest ones; some 150 kB as JSON."""

Vector = tuple[float, float, float]
Cell = tuple[str, str, tuple[int, ...]]


@dataclass(frozen=True)
class LoggedTouch:
    """A contact point, and the time [s] at which its cell was first touched.

    normal_a, normal_b: the normal from ship_a to ship_b in the b that each had then; ships turn afterwards.
    """

    time: float
    touch: TouchSnapshot
    normal_a: Vector
    normal_b: Vector

    def as_message(self) -> dict[str, Any]:
        """Of the WebSocket."""
        return asdict(self.touch) | {"time": self.time, "normal_a": self.normal_a, "normal_b": self.normal_b}


class TouchLog:
    """The touches of a run. `touches` may be read by any thread."""

    def __init__(self) -> None:
        self._cells: dict[Cell, LoggedTouch] = {}
        self.touches: tuple[LoggedTouch, ...] = ()

    def add(self, time: float, touching: Iterable[TouchSnapshot], turn: Callable[[str, Vector], Vector]) -> None:
        """Note the contact points of a time, which is later than those before. turn(body, vector in n): in its b."""
        found = {_find_cell(touch): touch for touch in touching}
        new = {
            cell: LoggedTouch(time, touch, turn(touch.ship_a, touch.normal), turn(touch.ship_b, touch.normal))
            for cell, touch in found.items()
            if cell not in self._cells
        }
        if not new:
            return
        self._cells |= new
        latest = sorted(self._cells.items(), key=lambda item: item[1].time)[-MOST_TOUCHES:]
        self._publish(dict(latest))

    def restore(self, touches: tuple[LoggedTouch, ...]) -> None:
        """Have the touches again that there were at a time; those that the limit has pushed out since, too."""
        self._publish({_find_cell(logged.touch): logged for logged in touches})

    def _publish(self, cells: dict[Cell, LoggedTouch]) -> None:
        self._cells, self.touches = cells, tuple(cells.values())


def _find_cell(touch: TouchSnapshot) -> Cell:
    return touch.ship_a, touch.ship_b, tuple(round(x / APART) for x in (*touch.a, *touch.b))
