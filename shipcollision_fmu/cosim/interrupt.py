"""An interrupt (Ctrl-C) or an order to end (SIGTERM) waits for the end of the step.

Python raises KeyboardInterrupt wherever it happens to be, also inside an FMU in this very process. There the exception
would count as a fault of the model. So the signal is noted, and the exception is raised between two steps. SIGTERM
would end the process at once and leave the unpacked FMUs behind.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

__all__ = ["delay_interrupts"]


@contextmanager
def delay_interrupts() -> Iterator[Callable[[], None]]:
    """A context that notes SIGINT and SIGTERM, and the function that acts on what has come.

    It raises KeyboardInterrupt for SIGINT. For SIGTERM it calls the handler from before, or raises SystemExit(143).
    Outside the main thread Python delivers no signals, so nothing is delayed there. Ignored signals stay ignored.
    """
    came: list[int] = []
    before: dict[int, Any] = {}

    def note(number: int, frame: FrameType | None) -> None:
        del frame
        came.append(number)

    def check() -> None:
        if signal.SIGINT in came:
            raise KeyboardInterrupt
        if came:
            if callable(before[signal.SIGTERM]):
                before[signal.SIGTERM](signal.SIGTERM, None)
            raise SystemExit(128 + signal.SIGTERM)

    if threading.current_thread() is threading.main_thread():
        for which in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(which) not in (signal.SIG_IGN, None):  # ignored: a job in the background of a shell
                before[which] = signal.signal(which, note)
    try:
        yield check
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
