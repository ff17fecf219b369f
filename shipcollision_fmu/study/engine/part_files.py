"""A part whose files a worker has written beside the study's tables, for the client to move into place.

The tables of a million impacts are 380 MB. Through the client they would cost it as much time as all else together.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from ...files import describe_failure
from .part_file import Mark, PartBytes
from .parts import Part

__all__ = ["ROOM", "PartFiles", "write_part"]

ROOM = "make room on the disk, or its folder writable, then go on with --resume"
"""Remedy of whoever writes into the folder of a study."""


@dataclass(frozen=True)
class PartFiles:
    """Both files of a part, named after its tables, in a folder of their own."""

    part: Part
    folder: Path
    mark: Mark

    def move(self, table: str, target: Path) -> None:
        """Renames the file of a table. Raises OSError."""
        (self.folder / table).replace(target)


def write_part(part: PartBytes, aside: Path) -> PartFiles:
    """Writes both files of a part into a new folder in `aside`: a part may be computed twice. Raises HostError."""
    try:
        aside.mkdir(exist_ok=True)
        folder = Path(tempfile.mkdtemp(prefix=f"{part.part.number}-", dir=aside))
        (folder / "collisions").write_bytes(part.collisions)
        (folder / "encounters").write_bytes(part.encounters)
    except OSError as error:
        raise describe_failure(aside.parent, error, ROOM) from None
    return PartFiles(part.part, folder, part.mark)
