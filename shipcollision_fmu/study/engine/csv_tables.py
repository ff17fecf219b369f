"""Both tables of a study as CSV, part by part: memory does not grow with the study."""

from __future__ import annotations

from pathlib import Path

import pyarrow.csv as pc
import pyarrow.parquet as pq

from ...errors import HostError
from .folder import TABLES
from .interface import Study
from .parts import list_parts

__all__ = ["write_csv"]


def write_csv(folder: Path, study: Study) -> None:
    """Writes encounters.csv and collisions.csv beside the folders of a finished study. Raises HostError."""
    for table in TABLES:
        path, aside = folder / f"{table}.csv", folder / f".shipcollision-{table}.csv"
        files = (folder / table / part.file for part in list_parts(study.rows, study.level))
        try:
            first = next(files)
            with pc.CSVWriter(aside, pq.read_schema(first)) as writer:
                writer.write_table(pq.read_table(first))
                for file in files:
                    writer.write_table(pq.read_table(file))
            aside.replace(path)
        except BaseException as error:
            aside.unlink(missing_ok=True)
            if not isinstance(error, OSError):
                raise
            raise HostError(
                f"cannot write {path}: {error.strerror or error}; the Parquet files are complete: make room on the "
                "disk, then go on with --resume --csv"
            ) from None
