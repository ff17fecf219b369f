"""hold_folder(): one process at a time writes into the folder of a run or of a study."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..errors import HostError
from ..files import check_writable

__all__ = ["hold_folder"]


@contextmanager
def hold_folder(path: Path) -> Iterator[None]:
    """Meanwhile the folder is there, and no other process holds it. It is removed again if nothing was written.

    The lock is the system's, on the folder itself: it ends with the process, and leaves no file. Where the file system
    or Windows has none, and where the folder may not be read, nothing is held. Raises HostError when another process,
    or another call, holds the folder.
    """
    check_writable(path)
    made = [place for place in (path, *path.parents) if not place.exists()]
    path.mkdir(parents=True, exist_ok=True)
    handle = _open(path)
    try:
        if handle is not None:
            _lock(handle, path)
        yield
    finally:
        if handle is not None:
            os.close(handle)
        with suppress(OSError):  # something was written
            for place in made:
                place.rmdir()


def _open(path: Path) -> int | None:
    if sys.platform == "win32":
        return None
    try:
        return os.open(path, os.O_RDONLY)
    except OSError:  # a folder may be written and not read
        return None


def _lock(handle: int, path: Path) -> None:
    import fcntl  # no module of Windows

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise HostError(
            f"{path} is being written by another run: wait until it has ended, or give another folder with --out"
        ) from None
    except OSError:  # a file system without locks
        return
