"""run_study(): all rows of a study, into a folder of Parquet files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from ...errors import StudyError
from ..extra import import_pyarrow, require_dask
from .main_guard import end_in_a_starting_worker
from .options import check_options
from .result import StudyResult

if TYPE_CHECKING:
    from .interface import ComputeRows, Study

__all__ = ["run_study"]


def run_study(
    study: Study | str | Path,
    out: str | Path,
    *,
    scheduler: str | None = None,
    scheduler_file: str | Path | None = None,
    workers: int | None = None,
    resume: bool = False,
    engine: str = "auto",
    csv: bool = False,
    progress: Callable[[int, int], None] | None = None,
    notify: Callable[[str], None] | None = None,
    compute: ComputeRows | None = None,
) -> StudyResult:
    """The counts of a study, whose rows are written into the folder `out`.

    study            what read_study() returns, the name of a shipped study, or the path of a study file
    scheduler        address of the scheduler of an existing Dask cluster, such as "tcp://10.0.0.1:8786"
    scheduler_file   or the file that the scheduler writes
    workers          processes of a local cluster; None: one for each core, 0: this process computes
    resume           whether what an interrupted study left in `out` is kept, and the rest computed
    engine           "native", "python", or "auto": native where this machine has the library, python elsewhere
    csv              whether both tables are written as CSV as well
    progress         called with the number of rows that are done and that of all
    notify           called with lines for the user, such as the address of the dashboard and warnings
    compute          what computes rows, compute_rows() by default

    The files depend on the study and the engine alone, not on workers or interruptions. A script that starts a local
    cluster must guard its top level by `if __name__ == "__main__":`, as each worker imports it.

    Raises StudyError for what does not go together and for a folder with another study, HostError when the folder, the
    cluster or the disk fails. Parts that are written stay, and `resume` goes on from there. So it does after
    KeyboardInterrupt, whose text says how far the study came.
    """
    end_in_a_starting_worker()
    check_options(out, scheduler, scheduler_file, workers, resume, engine, csv)
    import_pyarrow()
    if workers != 0:
        require_dask()
    from ..definition.study import read_study
    from ..rows.compute import choose_engine, compute_rows
    from .session import Means, run_session

    def decide_engine(before: str | None) -> str:
        if before is None:
            return choose_engine(engine)
        if engine not in ("auto", before):
            raise StudyError(
                f"{out} holds rows of engine {before!r}: go on with --engine {before}, or give a new folder with --out"
            )
        return choose_engine(before)

    read = cast("Study", study) if hasattr(study, "fingerprint") else read_study(cast(Any, study))
    means = Means(scheduler, None if scheduler_file is None else Path(scheduler_file), workers)
    return run_session(
        read, Path(out), means, compute or compute_rows, decide_engine, resume, csv, progress, notify or _ignore
    )


def _ignore(line: str) -> None:
    del line
