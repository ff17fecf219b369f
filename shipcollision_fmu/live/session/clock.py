"""The wall clock of a session, which waits for commands until the next step is due."""

from __future__ import annotations

import queue
from concurrent.futures import Future
from time import monotonic
from typing import Any, Protocol, TypeAlias

from .commands import Command

__all__ = ["Clock", "Waiting", "WallClock"]

Waiting: TypeAlias = "tuple[Command, Future[Any]]"
"""A command that waits, and its answer."""


class Clock(Protocol):
    """The wall clock of a session."""

    def now(self) -> float:
        """The time [s] from any start."""

    def wait(self, waiting: queue.Queue[Waiting], timeout: float) -> Waiting | None:
        """The next command, or None when none came within `timeout` [s]; 0: at once."""


class WallClock:
    """The clock of this machine."""

    def now(self) -> float:
        """See Clock."""
        return monotonic()

    def wait(self, waiting: queue.Queue[Waiting], timeout: float) -> Waiting | None:
        """See Clock."""
        try:
            return waiting.get(timeout=timeout) if timeout > 0.0 else waiting.get_nowait()
        except queue.Empty:
            return None
