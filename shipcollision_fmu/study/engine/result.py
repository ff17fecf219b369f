"""StudyResult: what a finished study has come to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

__all__ = ["StudyResult"]


@dataclass(frozen=True)
class StudyResult:
    """Counts of a finished study; its rows are in the folder."""

    folder: Path
    rows: int
    refused: int
    """Rows that are refused cases."""
    collisions: int
    contact_at_end: int
    """Rows that end with hulls that touch: their energy may not be the whole."""
    computed: int
    """Rows that this call computed; the others were there."""
    engine: str
    """What computed the rows: native or python."""
    seconds: float
    """Time of this call [s]."""
    busy: float
    """Time [s] that workers spent on batches, all together."""
    waited: float
    """Time [s] of it in which the client waited for workers."""
