"""The command `shipcollision`.

Exit status: 0 done, 1 the run or the check failed, 2 bad usage or input, 130 interrupted, 143 ended by SIGTERM. A live
run that either of both ends is stored, so that its exit status is 0.

    runs.py, live.py, nmea.py, fmus.py, encounters.py, trials.py, studies.py, lists.py  the commands, grouped by subject
    run_table.py      what `run` prints                    trial_table.py   what `trial` prints
    table.py          the form of all tables               console.py       stdout, and progress on stderr
    mistakes.py       one line for every mistake           options.py       options of several commands
    help.py           help on a narrow terminal      row_progress.py   progress of a study on stderr
    study_keys.py     the keys of a study file       study_refusals.py   why most rows of a study are refused

Imports from every room, but inside the commands: help is fast, and a missing package becomes one clear line.
"""

from __future__ import annotations

import click

from .. import __version__
from .encounters import encounter, import_
from .fmus import build, package, prepare, validate
from .lists import scenarios, ships
from .live import live
from .mistakes import Commands
from .nmea import nmea
from .runs import run, show
from .studies import study
from .trials import trial

__all__ = ["main"]


@click.group(cls=Commands, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="shipcollision")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Ship collisions, co-simulated through FMI FMUs."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


for command in (
    build,
    encounter,
    import_,
    live,
    nmea,
    package,
    prepare,
    run,
    scenarios,
    ships,
    show,
    study,
    trial,
    validate,
):
    main.add_command(command)
