"""BatchPlan: which rows a worker gets next. A batch lies within one part and takes some seconds by measured cost.

    rows of a batch = TARGET / cost of a row

Each task costs the scheduler about a millisecond, so short batches waste workers. Long ones are lost when a worker
dies, and leave workers idle at the end.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from .parts import Part

__all__ = ["FIRST_ROWS", "TARGET", "Batch", "BatchPlan"]

TARGET = 2.0
"""Time [s] of a batch. With a tenth of it, a hundred workers would come near what one scheduler can hand out."""
FIRST_ROWS = 4
"""Rows of a batch while the cost of a row is unknown. Sailed encounters in Python take seconds each."""
NEWEST = 0.5
"""Weight of the newest batch in the cost of a row."""


@dataclass(frozen=True)
class Batch:
    """Rows of one part, from `first` on."""

    part: Part
    first: int
    count: int

    @property
    def is_whole(self) -> bool:
        """Whether it is all of its part."""
        return self.count == self.part.count


class BatchPlan:
    """Batches of some parts in the order of rows; lost ones come first again."""

    def __init__(self, parts: Iterable[Part]) -> None:
        self._parts: Iterator[Part] = iter(parts)
        self._part: Part | None = None
        self._next = 0
        self._returned: deque[Batch] = deque()
        self._cost: float | None = None

    def take(self) -> Batch | None:
        """The next batch, None when all are handed out."""
        if self._returned:
            return self._returned.popleft()
        if self._part is None or self._next > self._part.last:
            self._part = next(self._parts, None)
            if self._part is None:
                return None
            self._next = self._part.first
        count = self._choose_count(self._part.last - self._next + 1)
        batch = Batch(self._part, self._next, count)
        self._next += count
        return batch

    def give_back(self, batch: Batch) -> None:
        """Hands a batch out again that was lost with its worker or scheduler."""
        self._returned.append(batch)

    def give_back_halves(self, batch: Batch) -> None:
        """Hands out both halves of a batch that was too much for its workers. It has two rows or more."""
        half = batch.count // 2
        self._returned.append(Batch(batch.part, batch.first, half))
        self._returned.append(Batch(batch.part, batch.first + half, batch.count - half))

    def learn(self, count: int, seconds: float) -> None:
        """Takes the time of a finished batch for the size of those to come."""
        cost = max(seconds / count, 1e-9)
        self._cost = cost if self._cost is None else (1.0 - NEWEST) * self._cost + NEWEST * cost

    def _choose_count(self, left: int) -> int:
        """Rows of the next batch, of so many left in the part: even shares, so that no crumb stays."""
        size = FIRST_ROWS if self._cost is None else TARGET / self._cost
        return -(-left // max(1, round(left / size)))
