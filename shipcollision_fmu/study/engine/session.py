"""run_session(): one call of run_study(), from the folder's check to its status."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from ...cosim.folder_lock import hold_folder
from ...cosim.interrupt import delay_interrupts
from ...errors import HostError
from .assembly import Assembly
from .batches import BatchPlan
from .csv_tables import write_csv
from .executor import Executor
from .folder import StudyFolder
from .in_process import InProcess
from .interface import ComputeRows, Study
from .loop import Loop, Progress, Tally
from .parts import Part
from .result import StudyResult

__all__ = ["Means", "run_session"]

Notify = Callable[[str], None]


@dataclass(frozen=True)
class Means:
    """Who computes: a scheduler by address or by file, else a local cluster; no workers: this process."""

    scheduler: str | None
    scheduler_file: Path | None
    workers: int | None


HERE = Means(None, None, workers=0)
"""Where nothing is missing: a cluster would start in vain."""


def run_session(
    study: Study, out: Path, means: Means, compute: ComputeRows, engine: Callable[[str | None], str], resume: bool,
    csv: bool, progress: Progress | None, notify: Notify,
) -> StudyResult:  # fmt: skip
    """What run_study() returns and raises. engine: that of the rows, by the one of the folder if it has one."""
    with hold_folder(out):
        return _run(study, out, means, compute, engine, resume, csv, progress, notify)


def _run(
    study: Study, out: Path, means: Means, compute: ComputeRows, engine: Callable[[str | None], str], resume: bool,
    csv: bool, progress: Progress | None, notify: Notify,
) -> StudyResult:  # fmt: skip
    begin = perf_counter()
    folder = StudyFolder(out, study)
    folder.check(resume, engine)
    tally = Tally()
    missing = list(_find_missing(folder, tally, notify))
    there = tally.rows
    for line in study.warnings:
        notify(f"warning: {line}")
    try:
        loop = _compute(study, compute, folder, means if missing else HERE, notify, missing, tally, progress)
        folder.write_status("complete", tally.as_counts())
        if csv:
            write_csv(folder.path, study)
    except KeyboardInterrupt as reason:
        option = "--resume --csv" if csv else "--resume"
        text = f"interrupted; {tally.rows} of {study.rows} rows are in {out}: go on with {option}"
        raise type(reason)(text) from None
    computed, seconds = tally.rows - there, perf_counter() - begin
    return StudyResult(
        out,
        tally.rows,
        tally.refused,
        tally.collisions,
        tally.contact_at_end,
        computed,
        folder.engine,
        seconds,
        loop.busy,
        loop.waited,
    )


def _compute(
    study: Study, compute: ComputeRows, folder: StudyFolder, means: Means, notify: Notify, missing: list[Part],
    tally: Tally, progress: Progress | None,
) -> Loop:  # fmt: skip
    """The loop, after it has computed the missing parts."""
    with _open_executor(study, compute, folder, means, notify) as executor:
        folder.open()
        loop = Loop(executor, BatchPlan(missing), Assembly(study.fingerprint), folder, tally, study.rows, progress)
        try:
            with delay_interrupts() as check:
                loop.run(check)
        except BaseException:
            with suppress(HostError):  # a full disk may have no room for this either
                folder.write_status("interrupted", tally.as_counts())
            raise
    return loop


@contextmanager
def _open_executor(
    study: Study, compute: ComputeRows, folder: StudyFolder, means: Means, notify: Notify
) -> Iterator[Executor]:
    if means.workers == 0:
        yield InProcess(study, compute, folder.engine)
        return
    from .clusters import quiet_dask, start_local_cluster, use_scheduler
    from .dask_executor import DaskExecutor

    is_local = means.scheduler is None and means.scheduler_file is None
    opened = start_local_cluster(means.workers) if is_local else use_scheduler(means.scheduler, means.scheduler_file)
    aside = folder.aside if is_local else None
    try:
        with quiet_dask(), opened as cluster:
            executor = DaskExecutor(study, compute, folder.engine, cluster, notify, aside)
            try:
                if executor.dashboard is not None:
                    notify(f"dashboard: {executor.dashboard}")
                yield executor
            finally:
                executor.close()
    finally:
        folder.close()  # what workers wrote that ended in the middle of a batch


def _find_missing(folder: StudyFolder, tally: Tally, notify: Callable[[str], None]) -> Iterator[Part]:
    """The parts that must be computed; those that are there are added to the tally."""
    for part, mark in folder.find_marks():
        if mark is not None:
            tally.add(mark)
            continue
        for path in folder.find_damaged(part):
            notify(f"{path} is cut short or no file of this study: its rows are computed again")
        yield part
