"""The command `shipcollision`, and `python -m shipcollision_fmu`: Ctrl-C ends both with one line and exit status 130,
during the imports of the commands as well."""

from __future__ import annotations

import os
import signal
from types import FrameType

__all__ = ["main"]

INTERRUPTED = 128 + signal.SIGINT


def main() -> None:
    """Run the command. A process that ignores interrupts, as below nohup, goes on ignoring them."""
    guarded = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if guarded:  # an exception within an import could be swallowed there, or leave half a module behind
        signal.signal(signal.SIGINT, _end_at_once)
    from .cli import main as run_command

    try:
        if guarded:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        run_command()
    except KeyboardInterrupt:  # after the command: during it, cli/mistakes.py has caught it
        _end_at_once(signal.SIGINT, None)
    finally:
        if guarded:  # what was to be done is done: let the process clean up
            signal.signal(signal.SIGINT, signal.SIG_IGN)


def _end_at_once(number: int, frame: FrameType | None) -> None:
    """End the process with a line, without cleaning up."""
    del number, frame
    os.write(2, b"error: interrupted\n")
    os._exit(INTERRUPTED)


if __name__ == "__main__":
    main()
