"""What the engine asks of a study, and of the function that computes its rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import pyarrow as pa

__all__ = ["ComputeRows", "RowTables", "Study"]


class Study(Protocol):
    """A study: its file's text, and all that its rows depend on. It is pickled to the workers."""

    @property
    def text(self) -> str:
        """The study file as given."""

    @property
    def fingerprint(self) -> str:
        """SHA-256 of all that determines the rows."""

    @property
    def folder(self) -> str:
        """Folder of the study file, in which paths in it begin."""

    @property
    def inputs(self) -> Mapping[str, str]:
        """SHA-256 of each ship, table and folder that the study file names, by a name for messages."""

    @property
    def warnings(self) -> Sequence[str]:
        """What is hardly meant, in a line each, for the user."""

    @property
    def rows(self) -> int:
        """Number of rows."""

    @property
    def level(self) -> str:
        """impact, encounter or sailed."""


class RowTables(Protocol):
    """The lines of both tables that belong to a range of rows."""

    @property
    def encounters(self) -> pa.Table:
        """One line per row of the study, in order; column `row`."""

    @property
    def collisions(self) -> pa.Table:
        """Any number of lines per row; column `row`."""


class ComputeRows(Protocol):
    """A pure function of a study and its rows first to first + count - 1; workers find it by its module and name."""

    def __call__(self, study: Any, first: int, count: int, engine: str, /) -> RowTables:
        """The tables of these rows. engine: "native" or "python"; HostError where a machine lacks it."""
