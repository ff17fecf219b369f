"""`study`: many encounters, drawn from distributions, on this machine or on a Dask cluster."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import NoReturn

import click

from .console import say
from .mistakes import fail
from .options import PATH, STUDY, WHOLE_NUMBER, Choice
from .row_progress import row_progress
from .study_keys import print_keys
from .study_refusals import describe_refusals

__all__ = ["study"]


class _EndedError(KeyboardInterrupt):
    """SIGTERM came: the study stays as resumable as after Ctrl-C."""


def _print_keys(ctx: click.Context, param: click.Parameter, is_asked: bool) -> None:
    del param
    if is_asked and not ctx.resilient_parsing:
        print_keys()
        ctx.exit()


@click.command()
@click.argument("study", type=STUDY)
@click.option("--out", type=PATH, help="Folder of the tables.  [default: studies/NAME]")
@click.option("--scheduler", metavar="ADDRESS", help="Scheduler of an existing Dask cluster, tcp://HOST:8786.")
@click.option("--scheduler-file", type=PATH, metavar="FILE", help="The same by the file that it writes.")
@click.option(
    "--workers", type=WHOLE_NUMBER, metavar="N",
    help="Processes on this machine; 0: without Dask, in one.  [default: one for each core]",
)  # fmt: skip
@click.option("--resume", is_flag=True, help="Go on with what an interrupted study left in the folder.")
@click.option(
    "--engine", type=Choice(["auto", "native", "python"]), default="auto", show_default=True,
    help="What computes the cases; auto is native where there is the library.",
)  # fmt: skip
@click.option("--csv", is_flag=True, help="Write both tables as CSV as well.")
@click.option("--row", type=WHOLE_NUMBER, metavar="N", help="Write row N alone, as a scenario file.")
@click.option(
    "--keys", is_flag=True, is_eager=True, expose_value=False, callback=_print_keys,
    help="Print all keys of a study file, and all columns.",
)  # fmt: skip
def study(
    study: str, out: Path | None, scheduler: str | None, scheduler_file: Path | None, workers: int | None, resume: bool,
    engine: str, csv: bool, row: int | None,
) -> None:  # fmt: skip
    """Run the cases of a study, store its tables.

    STUDY is the name of a shipped study, such as quick, or the path of a TOML file. Worker processes on this machine
    compute the cases, or those of a Dask cluster. After Ctrl-C, --resume goes on with the study, to the same bytes.

    With --row no case is computed: one is written as a scenario file into the folder of --out, for `shipcollision run`.
    """
    from ..study.definition.study import read_study
    from ..study.engine.run import run_study

    read = read_study(study)
    if row is not None:
        from ..study.rows.case_scenario import write_case

        path = write_case(read, row, out if out is not None else Path("cases"))
        say(f"{path}: run it with `shipcollision run {path}`")
        return
    folder = out if out is not None else Path("studies") / read.name
    try:
        with _raise_at_sigterm(), row_progress(read.name) as report:
            result = run_study(
                read, folder, scheduler=scheduler, scheduler_file=scheduler_file, workers=workers, resume=resume,
                engine=engine, csv=csv, progress=report, notify=lambda line: say(line, err=True),
            )  # fmt: skip
    except KeyboardInterrupt as interrupt:
        text = str(interrupt) or "interrupted; nothing is written"
        fail(text, 128 + (signal.SIGTERM if isinstance(interrupt, _EndedError) else signal.SIGINT))
    say(
        f"{result.rows} rows: {result.refused} refused, {result.collisions} collisions; {result.computed} computed in "
        f"{result.seconds:.1f} s, engine {result.engine}"
    )
    if result.contact_at_end:
        say(
            f"{result.contact_at_end} rows end with hulls that touch, column contact_at_end: a longer `after` in [run] "
            "gives more of their energy"
        )
    refusals = describe_refusals(folder, result.refused, result.rows)
    if refusals is not None:
        say(f"warning: {refusals}", err=True)
    say(f"stored in {folder}: {folder}/encounters and {folder}/collisions are tables in Parquet files")


@contextmanager
def _raise_at_sigterm() -> Iterator[None]:
    """A context in which SIGTERM is answered as Ctrl-C is, so that the line says how far the study came."""

    def end(number: int, frame: FrameType | None) -> NoReturn:
        raise _EndedError

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
