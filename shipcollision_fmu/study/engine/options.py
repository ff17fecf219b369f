"""check_options(): refuses options of run_study() that are of another type, or do not go together."""

from __future__ import annotations

import re
from os import PathLike

from ...errors import StudyError

__all__ = ["ENGINES", "check_options"]

ENGINES = ("auto", "native", "python")

ADDRESS = re.compile(r"((tcp|tls|ws|wss|ucx)://)?(\[[\w.:%]+\]|[^\s:/@\[\]]+):\d{1,5}")
"""Protocol, by default tcp, host and port, as Dask has them."""


def check_options(
    out: object, scheduler: object, scheduler_file: object, workers: object, resume: object, engine: object, csv: object
) -> None:
    """Raises StudyError, with the option's value and what it takes."""
    _check_types(out, scheduler, scheduler_file, resume, csv)
    if scheduler is not None and scheduler_file is not None:
        raise StudyError("a study has one scheduler: give --scheduler or --scheduler-file, not both")
    if workers is not None and (scheduler is not None or scheduler_file is not None):
        raise StudyError("a cluster that exists has its own workers: leave out --workers")
    if workers is not None and (not isinstance(workers, int) or isinstance(workers, bool)):
        raise StudyError(f"workers = {workers!r} must be a whole number of processes, or None for one on each core")
    if workers is not None and workers < 0:
        raise StudyError(f"--workers {workers} must be 0 or more; 0 computes in the client itself")
    if engine not in ENGINES:
        raise StudyError(f"engine = {engine!r} is unknown: take one of {', '.join(ENGINES)}")


def _check_types(out: object, scheduler: object, scheduler_file: object, resume: object, csv: object) -> None:
    if not _is_path(out):
        raise StudyError(f"out = {out!r} is no folder: give its path")
    for name, flag in (("resume", resume), ("csv", csv)):
        if not isinstance(flag, bool):
            raise StudyError(f"{name} = {flag!r} must be True or False")
    if scheduler is not None and not (isinstance(scheduler, str) and ADDRESS.fullmatch(scheduler)):
        raise StudyError(
            f"scheduler = {scheduler!r} is no address of a scheduler of Dask: give tcp://HOST:8786, as `dask "
            "scheduler` prints it"
        )
    if scheduler_file is not None and not _is_path(scheduler_file):
        raise StudyError(f"scheduler_file = {scheduler_file!r} is no file: give its path")


def _is_path(given: object) -> bool:
    return isinstance(given, str | PathLike) and given != ""
