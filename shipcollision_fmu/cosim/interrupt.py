"""An interrupt (Ctrl-C) waits for the end of the step.

Python raises KeyboardInterrupt wherever it happens to be, also inside an FMU in this very process. There the exception
would count as a fault of the model. So the signal is noted, and KeyboardInterrupt is raised between two steps.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["delay_interrupts"]


@contextmanager
def delay_interrupts() -> Iterator[Callable[[], None]]:
    """A context that notes SIGINT, and the function that raises KeyboardInterrupt if one has come.

    Outside the main thread Python delivers no signals, so nothing is delayed there.
    """
    came = False

    def note(number: int, frame: FrameType | None) -> None:
        del number, frame
        nonlocal came
        came = True

    def check() -> None:
        if came:
            raise KeyboardInterrupt

    ignored = signal.getsignal(signal.SIGINT) == signal.SIG_IGN  # a job in the background of a shell
    if ignored or threading.current_thread() is not threading.main_thread():
        yield check
        return
    before = signal.signal(signal.SIGINT, note)
    try:
        yield check
    finally:
        signal.signal(signal.SIGINT, before)
