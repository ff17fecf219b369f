"""Loop: hands out batches and writes the parts that come of the answers; Tally counts what is written."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from time import perf_counter

from ...errors import HostError
from .assembly import Assembly
from .batches import Batch, BatchPlan
from .executor import Executor, Failure, Outcome
from .folder import StudyFolder
from .part_file import Mark

__all__ = ["Loop", "Progress", "Tally"]

Progress = Callable[[int, int], None]
"""A function of the number of rows that are done, and of all rows."""


class Tally:
    """Counts of the parts that are written."""

    def __init__(self) -> None:
        self.rows = self.refused = self.collisions = self.contact_at_end = 0

    def add(self, mark: Mark) -> None:
        """Adds those of a part."""
        self.rows += mark.last - mark.first + 1
        self.refused += mark.refused
        self.collisions += mark.collisions
        self.contact_at_end += mark.contact_at_end

    def as_counts(self) -> dict[str, int]:
        """Those of study.json."""
        return {
            "rows": self.rows, "refused": self.refused, "collisions": self.collisions,
            "contact_at_end": self.contact_at_end,
        }  # fmt: skip


class Loop:
    """Hands out batches, puts answers together and writes parts, until all are written."""

    def __init__(
        self, executor: Executor, plan: BatchPlan, assembly: Assembly, folder: StudyFolder, tally: Tally, rows: int,
        progress: Progress | None,
    ) -> None:  # fmt: skip
        self._executor, self._plan, self._assembly, self._folder = executor, plan, assembly, folder
        self._tally, self._rows, self._progress = tally, rows, progress or (lambda done, total: None)
        self._computed = tally.rows
        self._out, self._suspects, self._is_alone = 0, deque[Batch](), False
        self.busy = self.waited = 0.0

    def run(self, check: Callable[[], None]) -> None:
        """Returns when all is written. check: raises when the study is interrupted."""
        self._progress(self._computed, self._rows)
        while True:
            check()
            self._hand_out()
            if not self._out:
                return
            begin = perf_counter()
            outcomes = self._executor.collect(check)
            self.waited += perf_counter() - begin
            for outcome in outcomes:
                self._out -= 1
                self._take(outcome)

    def _hand_out(self) -> None:
        """Hands out as many batches as may be out; a suspect one alone, and none beside it until it has come back."""
        if self._is_alone and self._out:
            return
        self._is_alone = bool(self._suspects) and not self._out
        if self._is_alone:
            self._submit(self._suspects.popleft())
        while not self._is_alone and not self._suspects and self._out < self._executor.most:
            batch = self._plan.take()
            if batch is None:
                return
            self._submit(batch)

    def _submit(self, batch: Batch) -> None:
        self._executor.submit(batch)
        self._out += 1

    def _take(self, outcome: Outcome) -> None:
        """Keeps an answer and writes the part that it completes, or hands out the batch again."""
        answer, batch = outcome.answer, outcome.batch
        if answer is not None:
            self._plan.learn(batch.count, answer.seconds)
            self.busy += answer.seconds
            part = self._assembly.add(answer)
            if part is not None:
                self._folder.write(part)
                self._tally.add(part.mark)
            self._computed += batch.count
            self._progress(self._computed, self._rows)
        elif outcome.failure is Failure.LOST:
            self._plan.give_back(batch)
        elif batch.count > 1:
            self._plan.give_back_halves(batch)
        elif not self._is_alone:  # Dask blames all rows that wait at a worker that dies
            self._suspects.append(batch)
        else:
            raise HostError(
                f"row {batch.first} ended one worker after the other, killed or out of memory: give each worker more "
                "memory, such as by fewer --workers, and go on with --resume"
            )
