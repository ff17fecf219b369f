"""News: what listeners are told of a live run, in its thread.

An event is a dict with "kind", "time" [s] and what belongs to it:

    collision begins | collision ends     id, ship_a, ship_b, point in n, start, energy
    command        ship, client (None: nobody)
    failure        ship, what, on         armed           armed: all that are now, each ship, what, at, of, within
                                          mark, back      name, note   environment    current, wind
    horn           ship, on               rate            rate        pause          paused
    log            message
    end            folder, message, error (None: all well)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["Event", "News", "Tell"]

Event = dict[str, Any]
Tell = Callable[..., None]
"""See News.tell."""


class News:
    """Tells listeners. `read_time`: the simulated time [s]."""

    def __init__(self, read_time: Callable[[], float]) -> None:
        self._read_time = read_time
        self._listeners: list[Callable[[Event], None]] = []

    def listen(self, listener: Callable[[Event], None]) -> Callable[[], None]:
        """Give every event to `listener` from now on; the function that stops this."""
        self._listeners = [*self._listeners, listener]

        def stop() -> None:
            self._listeners = [other for other in self._listeners if other is not listener]

        return stop

    def tell(self, kind: str, **what: Any) -> None:
        """Tell all listeners. One that raises is told nothing more."""
        event = {"kind": kind, "time": self._read_time(), **what}
        for listener in self._listeners:
            try:
                listener(event)
            except Exception:  # the others are to hear of it, and the run goes on
                self._listeners = [other for other in self._listeners if other is not listener]
