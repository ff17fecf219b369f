"""What tests of studies compare: the bytes of all files of rows in a folder."""

from __future__ import annotations

import hashlib
from pathlib import Path

from tests.study.engine.stand_in import StandIn

__all__ = ["STUDY", "digest", "list_files"]

STUDY = StandIn(rows=1010)
"""Five parts of 200 rows, and one of 10."""


def digest(folder: Path) -> dict[str, str]:
    """The SHA-256 of each Parquet and CSV file by its path in the folder."""
    files = [path for path in sorted(folder.rglob("*")) if path.suffix in (".parquet", ".csv")]
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


def list_files(folder: Path) -> list[str]:
    """All files in a folder, hidden ones included."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
