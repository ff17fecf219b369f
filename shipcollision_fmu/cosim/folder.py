"""Writing a run's folder: all files or none.

The files are written into a temporary folder beside the real one and then renamed into it, so that nobody ever reads
half a file.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path

from ..errors import HostError

__all__ = ["check_writable", "write_file", "write_files"]


def check_writable(out: Path) -> None:
    """Raise HostError when `out` could not be written. Tries it, and leaves nothing behind."""
    place = out
    while not (place.exists() or place.is_symlink()):
        place = place.parent
    if not place.is_dir():
        raise HostError(f"cannot write to {out}: {place} is not a folder; give another folder with --out")
    try:
        Path(tempfile.mkdtemp(prefix=".shipcollision-", dir=place)).rmdir()
    except OSError as error:
        raise _refused(out, error) from None


def write_files(out: Path, files: Mapping[str, str | bytes]) -> None:
    """Write files, text or bytes, by name into the folder `out`, making it if need be.

    Files of the same names are replaced; others in the folder are left alone. Raises HostError when it cannot be done.
    """
    made = [place for place in (out, *out.parents) if not place.exists()]
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f".{out.name}-", dir=out.parent) as aside:
            for name, content in files.items():
                data = content if isinstance(content, bytes) else content.encode()
                Path(aside, name).write_bytes(data)
            out.mkdir(exist_ok=True)
            for name in files:
                Path(aside, name).replace(out / name)
    except OSError as error:
        for place in made:
            if place.is_dir() and not any(place.iterdir()):
                place.rmdir()
        raise _refused(out, error) from None


def write_file(out: Path, content: str | bytes) -> None:
    """Write one file, whole or not at all; a file of that name is replaced. Raises HostError."""
    if out.is_dir():
        raise HostError(f"cannot write to {out}: it is a folder; give the name of a file with --out")
    write_files(out.parent, {out.name: content})


def _refused(out: Path, error: OSError) -> HostError:
    return HostError(f"cannot write to {out}: {error.strerror or error}; give another folder with --out")
