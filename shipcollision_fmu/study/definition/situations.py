"""[situations]: a folder of traffic situations, each a case, in place of encounters by kind."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field

from ...errors import StudyError
from ...ship.tables.table import Table

__all__ = ["SituationsTable", "read_situations"]

SUFFIXES = (".json", ".xml")
MOST_FILES = 100_000
"""Files of the largest folder: their texts are kept in the memory of every worker."""


class SituationsTable(Table):
    """[situations]: a folder of files of trafficgen, maritime-schema or CommonOcean."""

    folder: str = Field(min_length=1, description="the path of the folder, from the study file's folder")
    duration: float | None = Field(
        default=None, gt=0.0, le=86400.0, description="the duration [s]; without it, that of each file"
    )


def read_situations(table: SituationsTable, folder: Path, place: str) -> dict[str, bytes]:
    """Contents by name of file, in the order of names. `place` begins messages. Raises StudyError."""
    home = folder / table.folder
    said = f"{place} folder = {table.folder!r}"
    try:
        paths = sorted(path for path in home.iterdir() if path.suffix.lower() in SUFFIXES)
        files = {path.name: path.read_bytes() for path in paths[:MOST_FILES]}
    except OSError as error:
        raise StudyError(
            f"{said} cannot be read in {folder}: {error.strerror}: give a folder of situations, from the study file's "
            "folder"
        ) from None
    if not 1 <= len(paths) <= MOST_FILES:
        raise StudyError(
            f"{said} holds {len(paths)} files {' and '.join(f'*{end}' for end in SUFFIXES)}, must hold 1 to "
            f"{MOST_FILES}: give a folder of situations"
        )
    return files
