"""run_study(): all rows of a study, into a folder of Parquet files."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from ...cosim.interrupt import delay_interrupts
from ...errors import InputError
from .assembly import Assembly
from .batches import BatchPlan
from .csv_tables import write_csv
from .executor import Executor
from .folder import StudyFolder
from .in_process import InProcess
from .interface import ComputeRows, Study
from .loop import Loop, Progress, Tally
from .parts import Part

__all__ = ["StudyResult", "run_study"]


@dataclass(frozen=True)
class StudyResult:
    """What a finished study has come to."""

    folder: Path
    rows: int
    refused: int
    """Rows that are refused cases."""
    collisions: int
    computed: int
    """Rows that this call computed; the others were there."""
    seconds: float
    """Time of this call [s]."""
    waited: float
    """Time [s] of it in which the client waited for workers."""


def run_study(
    study: Study,
    out: str | Path,
    *,
    scheduler: str | None = None,
    scheduler_file: str | Path | None = None,
    workers: int | None = None,
    resume: bool = False,
    csv: bool = False,
    progress: Progress | None = None,
    notify: Callable[[str], None] | None = None,
    compute: ComputeRows,
) -> StudyResult:
    """The rows of a study, written into the folder `out`; what it has come to.

    scheduler        address of the scheduler of an existing Dask cluster, such as "tcp://10.0.0.1:8786"
    scheduler_file   or the file that the scheduler writes
    workers          processes of a local cluster; None: one for each core, 0: this process computes
    resume           whether what an interrupted study left in `out` is kept, and the rest computed
    csv              whether both tables are written as CSV as well
    progress         called with the number of rows that are done and that of all
    notify           called with lines for the user, such as the address of the dashboard
    compute          computes rows

    Files depend on the study alone, not on workers or interruptions. A script that starts a local cluster must guard
    its top level by `if __name__ == "__main__":`, as each worker imports it.

    Raises InputError for what does not go together and for a folder with another study, HostError when the folder, the
    cluster or the disk fails. Parts that are written stay, and `resume` goes on from there. So it does after
    KeyboardInterrupt, whose text says how far the study came.
    """
    begin = perf_counter()
    _check_options(scheduler, scheduler_file, workers)
    say = notify or _ignore
    folder = StudyFolder(Path(out), study)
    folder.check(resume)
    with _open_executor(study, compute, scheduler, scheduler_file, workers, say) as executor:
        folder.open()
        tally = Tally()
        missing = list(_find_missing(folder, tally, say))
        loop = Loop(executor, BatchPlan(missing), Assembly(study.fingerprint), folder, tally, study.rows, progress)
        there = tally.rows
        try:
            with delay_interrupts() as check:
                loop.run(check)
        except KeyboardInterrupt:
            folder.write_status("interrupted", tally.as_counts())
            raise KeyboardInterrupt(
                f"interrupted; {tally.rows} of {study.rows} rows are in {out}: go on with --resume"
            ) from None
    if csv:
        write_csv(folder.path, study)
    folder.write_status("complete", tally.as_counts())
    return StudyResult(
        folder.path,
        tally.rows,
        tally.refused,
        tally.collisions,
        tally.rows - there,
        perf_counter() - begin,
        loop.waited,
    )


def _check_options(scheduler: str | None, scheduler_file: str | Path | None, workers: int | None) -> None:
    if scheduler is not None and scheduler_file is not None:
        raise InputError("a study has one scheduler: give --scheduler or --scheduler-file, not both")
    if workers is not None and (scheduler is not None or scheduler_file is not None):
        raise InputError("a cluster that exists has its own workers: leave out --workers")
    if workers is not None and workers < 0:
        raise InputError(f"--workers {workers} must be 0 or more; 0 computes in the client itself")


@contextmanager
def _open_executor(
    study: Study, compute: ComputeRows, scheduler: str | None, scheduler_file: str | Path | None, workers: int | None,
    notify: Callable[[str], None],
) -> Iterator[Executor]:  # fmt: skip
    """The executor that the options name."""
    if workers == 0:
        yield InProcess(study, compute)
        return
    from .clusters import quiet_dask, start_local_cluster, use_scheduler
    from .dask_executor import DaskExecutor

    is_local = scheduler is None and scheduler_file is None
    file = None if scheduler_file is None else Path(scheduler_file)
    with quiet_dask(), start_local_cluster(workers) if is_local else use_scheduler(scheduler, file) as cluster:
        executor = DaskExecutor(study, compute, cluster, notify)
        try:
            notify(f"dashboard: {executor.dashboard}")
            yield executor
        finally:
            executor.close()


def _find_missing(folder: StudyFolder, tally: Tally, notify: Callable[[str], None]) -> Iterator[Part]:
    """The parts that must be computed; those that are there are added to the tally."""
    for part, mark in folder.find_marks():
        if mark is not None:
            tally.add(mark)
            continue
        for path in folder.find_damaged(part):
            notify(f"{path} is cut short or no file of this study: its rows are computed again")
        yield part


def _ignore(*arguments: object) -> None:
    del arguments
