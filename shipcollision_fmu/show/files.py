"""Writing pictures beside a run: a file is there whole or not at all."""

from __future__ import annotations

import tempfile
from pathlib import Path

from ..errors import HostError

__all__ = ["write"]


def write(path: Path, content: str | bytes) -> Path:
    """Write a file, making its folder if need be; one of that name is replaced. Returns the path.

    It is written into a temporary folder beside its place and renamed. Raises HostError when it cannot be done.
    """
    data = content.encode() if isinstance(content, str) else content
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{path.name}-", dir=path.parent) as aside:
            Path(aside, path.name).write_bytes(data)
            Path(aside, path.name).replace(path)
    except OSError as error:
        raise HostError(
            f"cannot write {path}: {error.strerror or error}; make its folder writable, or room on the disk"
        ) from None
    return path
