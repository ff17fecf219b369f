"""An interrupt (Ctrl-C) waits for the end of the step.

Python raises KeyboardInterrupt wherever it happens to be, also inside an FMU that runs in this very process; there it
would be taken for a fault of the model. So it is noted, and raised between two steps.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

__all__ = ["held_back"]


@contextmanager
def held_back() -> Iterator[Callable[[], None]]:
    """Within, SIGINT is only noted; the function given raises KeyboardInterrupt if one came. Outside the main thread
    Python delivers no signals, and nothing is held back."""
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
