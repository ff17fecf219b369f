"""The stamp of a file, by which a file that has not changed is read once only."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path
from time import time_ns

__all__ = ["Stamp", "digest_content", "take_stamp"]

SETTLED_NS = 2_000_000_000
"""Age [ns] from which a later version of a file has other times. File systems count in steps of up to 2 s (FAT). With a
smaller age, a file that is written twice within a step would be taken for unchanged."""

Stamp = tuple[str, int, int, int, int]


def take_stamp(path: Path) -> Stamp | None:
    """(path, inode, size, time of the last write, of the last change [ns]); None: read the file again.

    None for a file that cannot be reached or has been written within the last two seconds (SETTLED_NS).
    """
    try:
        status = path.stat()
    except OSError:
        return None
    if time_ns() - max(status.st_mtime_ns, status.st_ctime_ns) < SETTLED_NS:
        return None
    return str(path.absolute()), status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def digest_content(path: Path) -> str:
    """SHA-256 of the file's content in hexadecimal digits. Raises OSError when it cannot be read."""
    stamp = take_stamp(path)
    return _digest(path) if stamp is None else _digest_unchanged(stamp)


@lru_cache(maxsize=64)
def _digest_unchanged(stamp: Stamp) -> str:
    return _digest(Path(stamp[0]))


def _digest(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()
