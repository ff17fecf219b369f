"""Executor: what the loop of a study asks of whoever computes batches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from .batches import Batch
from .work import Answer

__all__ = ["Executor", "Failure", "Outcome"]


class Failure(Enum):
    """Why a batch has no answer, though its rows are not at fault."""

    LOST = "its worker or the scheduler went away"
    DEADLY = "it ended one worker after the other"


@dataclass(frozen=True)
class Outcome:
    """What became of a batch: an answer, or a failure."""

    batch: Batch
    answer: Answer | None = None
    failure: Failure | None = None


class Executor(Protocol):
    """Computes batches side by side."""

    @property
    def most(self) -> int:
        """Batches that may be out at a time. It may change with the number of workers."""

    def submit(self, batch: Batch) -> None:
        """Hands out a batch."""

    def collect(self, check: Callable[[], None]) -> list[Outcome]:
        """Outcomes that have come, after some waiting; [] if none has. check: raises when the study is interrupted.

        Raises the exception of a batch whose computation failed.
        """
