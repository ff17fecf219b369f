"""DaskExecutor: batches computed by a Dask cluster.

A worker that goes away gives its batches to others; Dask does that. A scheduler that goes away loses all batches that
are out: they come back to the plan, and the client waits for the scheduler to return. Answers are bytes: the client
fetches them as they come, and at most two batches per thread are out, so no memory grows with the study.
"""

from __future__ import annotations

import asyncio
import pickle
from collections.abc import Callable
from concurrent.futures import CancelledError
from concurrent.futures import TimeoutError as WaitTimeoutError
from pathlib import Path
from queue import Empty, SimpleQueue
from time import monotonic, sleep
from typing import Any
from urllib.request import urlopen

from distributed import Future, KilledWorker

from ... import __version__
from ...errors import HostError, InputError
from .batches import Batch
from .clusters import ANSWER, Cluster, check_versions
from .executor import Failure, Outcome
from .interface import ComputeRows, Study
from .versions import describe_missing_package
from .work import Answer, compute_batch

__all__ = ["DaskExecutor"]

PER_THREAD = 2
"""Batches out per thread of a worker: one is computed while the next is there already."""
PATIENCE = 600.0
"""Longest time [s] without a scheduler or without a worker. A queue of a cluster takes minutes to start a job again."""
WAIT = 0.5
"""Time [s] between two looks at the signals."""
LOOK = 2.0
"""Time [s] between two counts of the workers."""


class _SchedulerLostError(Exception):
    """The client has no connection to the scheduler any more."""


class DaskExecutor:
    """An executor that hands batches to a cluster. notify takes lines for the user.

    aside: folder in which workers write whole parts; None where they need not have the disk of the study.
    """

    def __init__(
        self,
        study: Study,
        compute: ComputeRows,
        engine: str,
        cluster: Cluster,
        notify: Callable[[str], None],
        aside: Path | None,
    ) -> None:
        self._aside = aside
        self._data, self._compute, self._engine = pickle.dumps(study), compute, engine
        self._cluster, self._notify = cluster, notify
        self._out: dict[Future, Batch] = {}
        self._unsent: list[Batch] = []
        self._done: SimpleQueue[Future] = SimpleQueue()
        self._threads, self._looked, self._last_worker = 0, -LOOK, monotonic()
        self._client = cluster.connect(ANSWER)
        try:
            self._prepare()
        except BaseException:
            self.close()
            raise

    @property
    def dashboard(self) -> str | None:
        """Address of the page that shows the cluster at work; None where none answers there. A scheduler that was
        started without one has an address all the same."""
        link = str(self._client.dashboard_link)
        try:
            with urlopen(f"{link}/metadata", timeout=LOOK):  # the page itself costs the scheduler as much as a batch
                return link
        except (OSError, ValueError):
            return None

    @property
    def most(self) -> int:
        """Batches that may be out at a time: PER_THREAD for each thread of a worker, and one when there is none."""
        return max(1, PER_THREAD * self._threads)

    def submit(self, batch: Batch) -> None:
        """Hands out a batch."""
        if self._client.status != "running":
            self._unsent.append(batch)
            return
        future = self._client.submit(
            compute_batch, self._study, self._compute, self._engine, batch, __version__, self._aside, pure=False
        )
        self._out[future] = batch
        future.add_done_callback(self._done.put)

    def collect(self, check: Callable[[], None]) -> list[Outcome]:
        """Outcomes that have come within WAIT; all batches that are out are lost when the scheduler went away."""
        try:
            self._count_workers()
            done = self._wait()
            check()
            return self._take(done, check) if done else []
        except _SchedulerLostError:
            lost = [Outcome(batch, failure=Failure.LOST) for batch in (*self._out.values(), *self._unsent)]
            self._out.clear()
            self._unsent.clear()
            self._reconnect(check)
            return lost

    def close(self) -> None:
        """Leaves the cluster; what is still out is given up."""
        self._out.clear()
        self._client.close(timeout=5.0)

    def _prepare(self) -> None:
        """Checks the cluster and hands it the study, once: whichever worker needs it takes it from another."""
        check_versions(self._client)
        self._study: Future = self._client.submit(pickle.loads, self._data, pure=False)
        self._done = SimpleQueue()
        self._looked, self._is_told = -LOOK, False

    def _wait(self) -> list[Future]:
        """Futures that are done, after waiting for the first of them."""
        try:
            done = [self._done.get(timeout=WAIT)]
        except Empty:
            return []
        while not self._done.empty():
            done.append(self._done.get())
        return done

    def _take(self, done: list[Future], check: Callable[[], None]) -> list[Outcome]:
        """The outcomes of futures that are done. Batches stay out until all of them are known: none is lost when the
        scheduler goes away meanwhile."""
        states = [future.status for future in done]
        if not {"finished", "error"}.issuperset(states):
            raise _SchedulerLostError
        finished = [future for future, state in zip(done, states, strict=True) if state == "finished"]
        failed = [future for future, state in zip(done, states, strict=True) if state == "error"]
        try:
            answers = self._gather(finished, check)
        except KilledWorker:  # computed again, as the worker of the answer had gone: its future says so now
            return self._take(done, check)
        outcomes = [self._explain(self._out[future], future) for future in failed]
        outcomes += [Outcome(self._out[future], answer) for future, answer in zip(finished, answers, strict=True)]
        for future in done:
            del self._out[future]
        return outcomes

    def _gather(self, finished: list[Future], check: Callable[[], None]) -> list[Answer]:
        """Answers of finished futures. An answer whose worker went away is computed again by Dask on the way."""
        if not finished:
            return []
        fetching = asyncio.run_coroutine_threadsafe(
            self._client.gather(finished, asynchronous=True), self._client.loop.asyncio_loop
        )
        while True:
            try:
                answers: list[Answer] = fetching.result(timeout=WAIT)
                return answers
            except (CancelledError, OSError, WaitTimeoutError):
                if fetching.done():
                    raise _SchedulerLostError from None
            try:
                check()
                self._count_workers()
            except BaseException:
                fetching.cancel()
                raise

    def _explain(self, batch: Batch, future: Future) -> Outcome:
        """The failure of a batch that ended its workers. Raises the exception of one whose computation failed."""
        error: Any = future.exception(timeout=10.0)
        if isinstance(error, (KilledWorker, MemoryError)):
            return Outcome(batch, failure=Failure.DEADLY)
        if isinstance(error, ModuleNotFoundError):
            raise HostError(describe_missing_package(str(error.name)))
        raise error

    def _count_workers(self) -> None:
        """Counts the threads of the workers now and then. Raises _SchedulerLostError, or HostError after PATIENCE."""
        if self._client.status != "running":
            raise _SchedulerLostError
        if monotonic() - self._looked < LOOK:
            return
        try:
            self._threads = sum(self._client.nthreads().values())
        except (OSError, CancelledError):
            raise _SchedulerLostError from None
        self._looked = monotonic()
        if self._threads:
            self._last_worker = self._looked
            return
        if not self._is_told:
            self._is_told = True
            self._notify(
                f"{self._cluster.name} has no worker; waiting for one, {PATIENCE:g} s at most: start one with `dask "
                f"worker {self._client.scheduler.address}`"
            )
        if self._looked - self._last_worker > PATIENCE:
            raise HostError(
                f"{self._cluster.name} has had no worker for {PATIENCE:g} s: start one with `dask worker`, then go on "
                "with --resume"
            )

    def _reconnect(self, check: Callable[[], None]) -> None:
        """Waits until the scheduler answers again. Raises HostError after PATIENCE."""
        self._client.close(timeout=2.0)
        if not self._cluster.can_return:
            raise HostError(f"{self._cluster.name} has ended: go on with --resume")
        self._notify(f"{self._cluster.name} went away; waiting for it to return")
        begin = monotonic()
        while not self._try_again():
            if monotonic() - begin > PATIENCE:
                raise HostError(f"{self._cluster.name} did not return within {PATIENCE:g} s: go on with --resume")
            check()
            sleep(WAIT)
        self._last_worker = monotonic()
        self._notify(f"{self._cluster.name} is back; the study goes on")

    def _try_again(self) -> bool:
        """Whether a new client has the scheduler. Raises HostError for a cluster with another version."""
        try:
            self._client = self._cluster.connect(LOOK)
        except (HostError, InputError):  # nobody listens, or the file of the scheduler is not written yet
            return False
        try:
            self._prepare()
        except (OSError, CancelledError):
            self._client.close(timeout=LOOK)
            return False
        return True
