"""Atomic writing: a file is written completely or not at all.

A file is first written into a temporary folder on the same file system and then renamed into place, so that no reader
finds half a file. What can be made again is kept in the user's cache.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from .errors import HostError

__all__ = [
    "IN_PLACE",
    "check_writable",
    "describe_failure",
    "is_file",
    "is_folder",
    "refuse_other_origin",
    "refuse_other_texts",
    "user_cache",
    "write_file",
    "write_files",
]

Content: TypeAlias = str | bytes | Iterable[str]
"""Of a file. The parts of a large text are made one after the other."""

ANOTHER_FOLDER = "give another folder with --out"
"""Remedy in messages about a folder that the user chose."""
IN_PLACE = "make its folder writable, or room on the disk"
"""Remedy in messages about a folder that the user did not choose, such as that of a run."""

MOST_NAMED = 3
"""Files named in a refusal; more would break its one line."""


def is_file(path: Path) -> bool:
    """Whether there is such a file; a path that the system refuses, such as one too long, is none."""
    try:
        return path.is_file()
    except OSError:
        return False


def is_folder(path: Path) -> bool:
    """Whether there is such a folder, likewise."""
    try:
        return path.is_dir()
    except OSError:
        return False


def user_cache() -> Path:
    """This package's folder in the user's cache (XDG base directories; LOCALAPPDATA on Windows). It need not exist."""
    home = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (Path(home) if home else Path.home() / ".cache") / "shipcollision-fmu"


def check_writable(out: Path, remedy: str = ANOTHER_FOLDER) -> None:
    """Raise HostError, whose message ends with `remedy`, when the folder `out` cannot be written; nothing is left
    behind."""
    place = out
    while not (place.exists() or place.is_symlink()):
        place = place.parent
    if not place.is_dir():
        raise HostError(f"cannot write to {out}: {place} is not a folder; {remedy}")
    try:
        Path(tempfile.mkdtemp(prefix=".shipcollision-", dir=place)).rmdir()
    except OSError as error:
        raise describe_failure(out, error, remedy) from None


def refuse_other_origin(out: Path, names: Iterable[str], sign: str, place: str = "folder") -> None:
    """Raise HostError when the folder `out` has files of these names.

    sign: which sign of this program is missing there; place: what the user gives with --out.
    """
    there = [name for name in names if (out / name).exists()]
    if not there:
        return
    listed = ", ".join(there[:MOST_NAMED]) + (" and others" if len(there) > MOST_NAMED else "")
    raise HostError(
        f"{out} holds {listed} of other origin ({sign}): give another {place} with --out, or replace what is there "
        "with --overwrite (overwrite=True in Python)"
    )


def refuse_other_texts(out: Path, texts: Mapping[str, str]) -> None:
    """Raise HostError when the folder `out` has a file of one of these names with another text than the one given."""
    for name, text in texts.items():
        path = out / name
        if path.exists() and path.read_bytes() != text.encode():
            raise HostError(
                f"{path} exists and would be replaced by another text: name the scenario differently with --out, or "
                "replace it with --overwrite"
            )


def write_files(out: Path, files: Mapping[str, Content], remedy: str = ANOTHER_FOLDER) -> None:
    """Write files, text, its parts, or bytes, by name into the folder `out`, which is made when it does not exist.

    Files of the same names are replaced; other files stay. Raises HostError, whose message ends with `remedy`.
    """
    _write(out, files, out, remedy)


def write_file(path: Path, content: str | bytes, remedy: str = ANOTHER_FOLDER) -> Path:
    """Write a file as write_files does; returns its path. Raises HostError."""
    if path.is_dir():
        raise HostError(f"cannot write to {path}: it is a folder; give the name of a file with --out")
    _write(path.parent, {path.name: content}, path, remedy)
    return path


def _write(out: Path, files: Mapping[str, Content], named: Path, remedy: str) -> None:
    made = [place for place in (out, *out.parents) if not place.exists()]
    home = out if out.is_dir() else out.parent
    try:
        home.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".shipcollision-", dir=home) as aside:
            for name, content in files.items():
                _write_content(Path(aside, name), content)
            out.mkdir(exist_ok=True)
            for name in files:
                Path(aside, name).replace(out / name)
    except OSError as error:
        for place in made:
            if place.is_dir() and not any(place.iterdir()):
                place.rmdir()
        raise describe_failure(named, error, remedy) from None


def _write_content(path: Path, content: Content) -> None:
    if isinstance(content, str | bytes):
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return
    with path.open("wb") as file:
        file.writelines(part.encode() for part in content)


def describe_failure(out: Path, error: OSError, remedy: str = ANOTHER_FOLDER) -> HostError:
    """The error to raise when the folder `out` cannot be written; its message ends with `remedy`."""
    return HostError(f"cannot write to {out}: {error.strerror or error}; {remedy}")
