"""RowLog: the rows of a table that grows while a run goes on, in memory or in a temporary file.

A run of known length has room for all rows from the start. A live run has no length: with a folder for a temporary
file, memory holds CHUNK rows, whatever the length. The system removes the file when it is closed, also after a crash.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

import numpy as np
import numpy.typing as npt

__all__ = ["CHUNK", "RowLog"]

CHUNK = 1024
"""Rows in memory of a log with a file. Fewer are written more often, more cost memory."""


class RowLog:
    """Rows of `width` numbers, or of a structured dtype with width 0. `room` rows are allocated at first."""

    def __init__(self, dtype: npt.DTypeLike, width: int = 0, room: int = CHUNK, spool: Path | None = None) -> None:
        rows = CHUNK if spool is not None else max(1, room)
        self._rows: npt.NDArray[Any] = np.zeros((rows, width) if width else rows, dtype=dtype)
        self._file: IO[bytes] | None = None
        if spool is not None:
            self._file = TemporaryFile(prefix=".shipcollision-", dir=spool)  # noqa: SIM115  # open until close()
        self._written = self._held = 0

    def __len__(self) -> int:
        return self._written + self._held

    def append(self, row: Any) -> None:
        """Add a row: a sequence of numbers, or a tuple for a structured dtype."""
        if self._held == len(self._rows):
            self._make_room()
        self._rows[self._held] = row
        self._held += 1

    def truncate(self, length: int) -> None:
        """Forget the rows from number `length` on."""
        if self._file is not None and length < self._written:
            self._file.seek(length * self._rows[0].nbytes)
            self._file.truncate()
            self._written, self._held = length, 0
        self._held = min(self._held, length - self._written)

    def build_array(self) -> npt.NDArray[Any]:
        """All rows: a view of what is in memory, or a memory map of the file."""
        if self._file is None or not self._written:
            return self._rows[: self._held]
        self._flush()
        self._file.flush()
        return np.memmap(self._file, dtype=self._rows.dtype, mode="r", shape=(self._written, *self._rows.shape[1:]))

    def close(self) -> None:
        """Remove the file. Arrays that were built from it stay valid."""
        if self._file is not None:
            self._file.close()

    def _make_room(self) -> None:
        if self._file is not None:
            self._flush()
        else:
            self._rows = np.concatenate([self._rows, np.zeros_like(self._rows)])

    def _flush(self) -> None:
        assert self._file is not None
        self._file.write(self._rows[: self._held].tobytes())
        self._written += self._held
        self._held = 0
