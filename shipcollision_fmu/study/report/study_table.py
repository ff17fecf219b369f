"""StudyTable: columns of a study's encounters, read part by part, so that memory holds the columns in use alone."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from ...errors import StudyError
from ...ship.frames import Array
from ...ship.loading.toml import parse_toml
from ..engine.part_file import read_mark
from .reasons import CommonReason, find_commonest

__all__ = ["REMEDY", "StudyTable"]

REMEDY = "go on with `shipcollision study STUDY.toml --out DIR --resume`, then show it again"


class StudyTable:
    """The encounters of a study's folder. Cases that are done are those with an energy; others are refused.

    told: study.json
    name, level, sampler, engine: as in the study; rows: its cases; present: those whose part is written
    row: numbers of the cases that are done, rising; energy: what they lost [J]
    contact_at_end: number of cases that end with hulls that touch
    has_pools, has_tables: whether ships are sampled, and whether the study has empirical tables
    """

    def __init__(self, folder: Path) -> None:
        """Raises StudyError for a folder whose files are damaged or have no case that is done."""
        self.folder = folder
        told = _read_json(folder)
        self.told = told
        self.fingerprint, self.rows = str(told["fingerprint"]), int(told["rows"])
        self.level, self.engine = str(told["level"]), str(told["engine"])
        file = _read_file(folder)
        header = _get_table(file, "study")
        self.has_tables = bool(file.get("tables"))
        self.has_pools = any(_get_table(file, role).get("sampled") for role in ("own", "target"))
        self.name, self.sampler = str(header.get("name", "study")), str(header.get("sampler", "latin-hypercube"))
        self._parts = self._find_parts()
        status = np.concatenate([self._read(part, "status").to_numpy(False) == "done" for part in self._parts])
        energy = self._join("energy")
        self.contact_at_end = int(np.nansum(self._join("contact_at_end")))
        self.present, self._is_done = len(status), status & np.isfinite(energy)
        self.energy, self.row = energy[self._is_done], self._join("row")[self._is_done].astype(np.int64)
        if not len(self.row):
            who = "the only case is" if self.present == 1 else f"all {self.present} cases are"
            raise StudyError(f"{folder}: {who} refused, and there is nothing to show{self._describe_reason()}")

    @property
    def refused(self) -> int:
        """Cases that are refused, of those that are present."""
        return self.present - len(self.row)

    def find_reason(self) -> CommonReason | None:
        """The commonest reason of the cases that are refused; None where no reason is stored."""
        counts: Counter[str] = Counter()
        for part in self._parts:
            for found in self._read(part, "reason").value_counts().to_pylist():
                if found["values"]:
                    counts[found["values"]] += found["counts"]
        return find_commonest(counts) if counts else None

    def _describe_reason(self) -> str:
        reason = self.find_reason()
        if reason is None:
            return ": the column `reason` of the encounters says why; change the study file"
        often = "" if reason.cases == self.present == 1 else f", {reason.cases} times"
        return f"; the commonest reason{often}: {reason.text}"

    def read_numbers(self, column: str) -> Array:
        """A column of the cases that are done; NaN where it is null or where the study has no such column."""
        return self._join(column)[self._is_done]

    def read_codes(self, column: str) -> Array:
        """A column of words as whole numbers, one for each word, -1 for null, of the cases that are done."""
        known: dict[Any, int] = {None: -1}
        codes = []
        for part in self._parts:
            coded = self._read(part, column).combine_chunks().dictionary_encode()
            words = [known.setdefault(word, len(known) - 1) for word in [*coded.dictionary.to_pylist(), None]]
            codes.append(np.array(words)[coded.indices.fill_null(len(words) - 1).to_numpy(False)])
        return np.concatenate(codes)[self._is_done].astype(float)

    def list_numbers(self) -> list[tuple[str, str]]:
        """Names and units of the columns of real numbers."""
        with pq.ParquetFile(self._parts[0]) as file:
            fields = [field for field in file.schema_arrow if field.type == pa.float64()]
        return [(field.name, (field.metadata or {}).get(b"unit", b"").decode()) for field in fields]

    def has_row(self, row: int) -> bool:
        """Whether the part of a row is written."""
        return any(first <= row <= last for first, last in map(_parse_range, self._parts))

    def read_cases(self, rows: Sequence[int], columns: Sequence[str]) -> list[dict[str, Any]]:
        """The values of some rows by column, in the order of `rows`."""
        found: dict[int, dict[str, Any]] = {}
        for part in self._parts:
            first, last = _parse_range(part)
            numbers = [row - first for row in rows if first <= row <= last]
            if numbers:
                with pq.ParquetFile(part) as file:
                    there = [name for name in ("row", *columns) if name in file.schema_arrow.names]
                    lines = file.read(columns=there).take(numbers).to_pylist()
                found.update({line["row"]: line for line in lines})
        return [found[row] for row in rows]

    def _find_parts(self) -> list[Path]:
        parts = sorted((self.folder / "encounters").glob("part-*.parquet"))
        if not parts:
            raise StudyError(f"{self.folder} has no part of its rows yet: wait while the study runs, or {REMEDY}")
        for part in parts:
            mark = read_mark(part)
            if mark is None or mark.fingerprint != self.fingerprint:
                raise StudyError(f"{part} is cut short or of another study: {REMEDY}")
        return parts

    def _join(self, column: str) -> Array:
        """A column of numbers of all present cases, NaN where it is null."""
        joined: Array = np.concatenate(
            [self._read(part, column).cast(pa.float64()).to_numpy().astype(float) for part in self._parts]
        )
        return joined

    def _read(self, part: Path, column: str) -> Any:
        """A column of a part; nulls where the part has none of that name."""
        with pq.ParquetFile(part) as file:
            if column not in file.schema_arrow.names:
                return pa.chunked_array([pa.nulls(file.metadata.num_rows, pa.string())])
            return file.read(columns=[column]).column(0)


def _parse_range(part: Path) -> tuple[int, int]:
    _, first, last = part.stem.split("-")
    return int(first), int(last)


def _read_json(folder: Path) -> dict[str, Any]:
    path = folder / "study.json"
    try:
        told = json.loads(path.read_bytes())
        if isinstance(told, dict) and {"fingerprint", "rows", "level", "engine"} <= told.keys():
            return told
    except (OSError, ValueError):
        pass
    raise StudyError(f"{path} is not that of a study: give a folder that `shipcollision study` has written")


def _read_file(folder: Path) -> dict[str, Any]:
    path = folder / "study.toml"
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        raise StudyError(f"{path} cannot be read: put the study file there again") from None
    return parse_toml(text, str(path), StudyError)


def _get_table(file: dict[str, Any], name: str) -> dict[str, Any]:
    table = file.get(name)
    return table if isinstance(table, dict) else {}
