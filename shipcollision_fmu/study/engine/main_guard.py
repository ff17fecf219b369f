"""The guard that a script with worker processes needs: `if __name__ == "__main__":`.

Each worker process imports the script first. Without the guard it would call run_study() again, and start workers of
its own. Python forbids that with a traceback in each of them.
"""

from __future__ import annotations

import multiprocessing
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from ...errors import HostError

__all__ = ["end_in_a_starting_worker", "explain_missing_guard"]


def end_in_a_starting_worker() -> None:
    """Ends this process without a word while it imports the script of its client, which says what is missing."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):  # as multiprocessing itself looks
        sys.exit(1)


@contextmanager
def explain_missing_guard() -> Iterator[None]:
    """A context in which the failure of worker processes to start is raised as HostError, with the remedy."""
    try:
        yield
    except RuntimeError as error:
        cause = str(error).partition("\n")[0]
        raise HostError(
            f"no worker process has started ({cause}): put the call of run_study() below `if __name__ == "
            '"__main__":`, as each worker imports the script, or give workers=0'
        ) from None
