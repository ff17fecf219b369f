"""StudyFolder: what a study leaves on the disk.

    study.toml                                the study file as given
    study.json                                fingerprint, versions, counts
    encounters/part-FIRST-LAST.parquet        a line per row
    collisions/part-FIRST-LAST.parquet        a line per collision

Every file is written under another name and renamed, so readers find whole files only. The collisions of a part come
first: its file of encounters says that the part is done.
"""

from __future__ import annotations

import json
import platform
import shutil
from collections.abc import Callable, Iterator
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ... import __version__
from ...errors import HostError, StudyError
from ...files import check_writable, describe_failure, write_files
from .changes import describe_changes
from .interface import Study
from .part_file import Mark, PartBytes, read_mark
from .part_files import ROOM, PartFiles
from .parts import Part, count_parts, get_part, list_parts

__all__ = ["TABLES", "StudyFolder"]

TABLES = ("encounters", "collisions")
ASIDE = ".shipcollision-*"
"""Folders and files that are being written; a client that was killed leaves some behind."""


class StudyFolder:
    """The folder of a study."""

    def __init__(self, path: Path, study: Study) -> None:
        self.path = path
        self.engine = ""
        """What computes the rows; after check()."""
        self._study = study

    def check(self, resume: bool, engine: Callable[[str | None], str]) -> None:
        """Raises StudyError or HostError when the study cannot go there; writes nothing.

        engine: chooses what computes the rows, by what computed those that are there.
        """
        found = self._read_json()
        if found is None:
            self._refuse_foreign()
        elif not resume:
            raise StudyError(
                f"{self.path} holds a study already: go on with it with --resume, or give another folder with --out"
            )
        else:
            self._refuse_other(found)
        check_writable(self.path)
        self.engine = engine(None if found is None else str(found.get("engine")))

    def open(self) -> None:
        """Makes the folder, or takes up what is there. Raises HostError."""
        self.close()
        found = self._read_json()
        if found is not None and found["rows"] != self._study.rows:
            self._make_room_for_more(int(found["rows"]))
        write_files(self.path, {"study.toml": self._study.text, "study.json": self._describe("running", {})}, ROOM)

    def _make_room_for_more(self, rows: int) -> None:
        """Removes what would be wrong with more rows than before: a last part that was not full, and CSV files."""
        last = get_part(count_parts(rows, self._study.level) - 1, rows, self._study.level)
        for table in reversed(TABLES):
            (self.path / f"{table}.csv").unlink(missing_ok=True)
            if last != get_part(last.number, self._study.rows, self._study.level):
                (self.path / table / last.file).unlink(missing_ok=True)

    def close(self) -> None:
        """Removes what was being written, by workers that were ended as well."""
        for aside in [*self.path.glob(ASIDE), *self.path.glob(f"*/{ASIDE}")]:
            if aside.is_dir():
                shutil.rmtree(aside, ignore_errors=True)
            else:  # a table as CSV
                aside.unlink(missing_ok=True)

    @property
    def aside(self) -> Path:
        """Folder in which workers of this machine write the files of whole parts."""
        return self.path.resolve() / ".shipcollision-workers"

    def find_marks(self) -> Iterator[tuple[Part, Mark | None]]:
        """All parts in order, each with the mark of its files, None where the part must be computed."""
        for part in list_parts(self._study.rows, self._study.level):
            marks = [self._read_mark(table, part) for table in TABLES]
            yield part, marks[0] if marks[0] == marks[1] else None

    def find_damaged(self, part: Part) -> list[Path]:
        """Files of a part that are there and are no files of this study, such as those that were cut short."""
        paths = [self.path / table / part.file for table in TABLES]
        return [
            path
            for path, table in zip(paths, TABLES, strict=True)
            if path.exists() and not self._read_mark(table, part)
        ]

    def write(self, part: PartBytes | PartFiles) -> None:
        """Puts both files of a part in place. Raises HostError."""
        if isinstance(part, PartFiles):
            self._move(part)
            return
        write_files(self.path / "collisions", {part.part.file: part.collisions}, ROOM)
        write_files(self.path / "encounters", {part.part.file: part.encounters}, ROOM)

    def _move(self, part: PartFiles) -> None:
        try:
            for table in ("collisions", "encounters"):
                (self.path / table).mkdir(exist_ok=True)
                part.move(table, self.path / table / part.part.file)
            part.folder.rmdir()
        except OSError as error:
            raise describe_failure(self.path, error, ROOM) from None

    def write_status(self, status: str, counts: dict[str, int]) -> None:
        """Writes study.json anew."""
        write_files(self.path, {"study.json": self._describe(status, counts)}, ROOM)

    def _read_mark(self, table: str, part: Part) -> Mark | None:
        mark = read_mark(self.path / table / part.file)
        own = (self._study.fingerprint, part.first, part.last)
        return mark if mark is not None and (mark.fingerprint, mark.first, mark.last) == own else None

    def _read_json(self) -> dict[str, Any] | None:
        """study.json of a study of this program, None if there is none."""
        try:
            content = json.loads((self.path / "study.json").read_bytes())
        except (OSError, ValueError):
            return None
        return content if isinstance(content, dict) and {"fingerprint", "rows"} <= content.keys() else None

    def _refuse_foreign(self) -> None:
        if self.path.is_dir() and (names := sorted(entry.name for entry in self.path.iterdir())):
            raise HostError(
                f"{self.path} holds {names[0]}{' and others' if len(names) > 1 else ''}, and no study.json of a study: "
                "give a new or an empty folder with --out"
            )

    def _refuse_other(self, found: dict[str, Any]) -> None:
        """Raises StudyError unless the study of the folder is this one."""
        if found["fingerprint"] != self._study.fingerprint:
            reason = describe_changes(self._study, found, self.path)
            raise StudyError(f"{self.path} holds another study: {reason}; give a new folder with --out")
        if found["rows"] > self._study.rows:
            raise StudyError(
                f"{self.path} holds a study of {found['rows']} rows, more than rows = {self._study.rows}: give rows = "
                f"{found['rows']} or more, or a new folder with --out"
            )

    def _describe(self, status: str, counts: dict[str, int]) -> str:
        study = self._study
        content = {
            "fingerprint": study.fingerprint,
            "inputs": dict(study.inputs),
            "folder": study.folder,
            "level": study.level,
            "engine": self.engine,
            "rows": study.rows,
            "parts": count_parts(study.rows, study.level),
            "status": status,
            "counts": counts,
            "versions": {
                "shipcollision_fmu": __version__, "python": platform.python_version(),
                **{name: version(name) for name in ("numpy", "pyarrow", "dask", "distributed") if find_spec(name)},
            },
        }  # fmt: skip
        return json.dumps(content, indent=1) + "\n"
