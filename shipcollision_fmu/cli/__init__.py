"""The command `shipcollision`.

Exit status: 0 done, 1 the run or the check failed, 2 bad usage or input.

The library is imported inside the commands: help is fast, and a missing package is one clear line too.

mistakes    how they are told            console, options    what commands share
runs, fmus, lists, trials, encounters    the commands, by what they are about
"""

from __future__ import annotations

import click

from .. import __version__
from .encounters import encounter, import_
from .fmus import build, package, validate
from .lists import scenarios, ships
from .mistakes import Commands
from .runs import run, show
from .trials import trial

__all__ = ["main"]


@click.group(cls=Commands, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="shipcollision")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Ship collisions, co-simulated through FMI FMUs."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


for command in (build, encounter, import_, package, run, scenarios, ships, show, trial, validate):
    main.add_command(command)
