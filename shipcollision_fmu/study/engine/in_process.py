"""InProcess: batches computed one after the other by this process, without Dask."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from .batches import Batch
from .executor import Failure, Outcome
from .interface import ComputeRows, Study
from .work import compute_batch

__all__ = ["InProcess"]


class InProcess:
    """An executor without workers."""

    most = 1

    def __init__(self, study: Study, compute: ComputeRows, engine: str) -> None:
        self._study, self._compute, self._engine = study, compute, engine
        self._batches: deque[Batch] = deque()

    def submit(self, batch: Batch) -> None:
        """Keeps a batch for collect."""
        self._batches.append(batch)

    def collect(self, check: Callable[[], None]) -> list[Outcome]:
        """The outcome of the batch handed out first, computed here."""
        check()
        batch = self._batches.popleft()
        try:
            return [Outcome(batch, compute_batch(self._study, self._compute, self._engine, batch))]
        except MemoryError:
            return [Outcome(batch, failure=Failure.DEADLY)]
