"""The command `shipcollision`.

Exit status: 0 done, 1 the run or the check failed, 2 bad usage or input. A user's mistake is one line on stderr, without a traceback.
Results go to stdout, progress to stderr; both are plain when not a terminal.

Imports of the library are inside the commands: help is fast, and a missing package is one clear line too.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table

from . import __version__
from .errors import HostError, ShipCollisionError

if TYPE_CHECKING:
    from .cosim.simulate import Run

__all__ = ["main"]

PLAIN_WIDTH = 110
"""Characters in a line when stdout is not a terminal: no column of ours is cut."""


class _Commands(click.Group):
    """A group of commands that ends on the errors of this package with one line, and knows near misses."""

    def resolve_command(self, ctx: click.Context, args: list[str]) -> tuple[str | None, click.Command | None, list[str]]:
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError:
            from .ship.refusal import suggestion

            names = self.list_commands(ctx)
            raise click.UsageError(f"no command {args[0]!r}:{suggestion(args[0], names)} known: {', '.join(names)}") from None

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except ShipCollisionError as error:
            _fail(str(error), error.exit_status)
        except ModuleNotFoundError as error:
            _fail(f"the package {error.name!r} is not installed: run `python -m pip install shipcollision-fmu`", 1)
        except BrokenPipeError:  # `shipcollision run | head`
            sys.stderr.close()
            ctx.exit(1)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="shipcollision")
def main() -> None:
    """Ship collisions, co-simulated through FMI FMUs."""


@main.command()
@click.argument("scenario", default="guan2014")
@click.option("--out", type=click.Path(path_type=Path), help="Folder of the results.  [default: runs/NAME]")
@click.option("--algorithm", type=click.Choice(["gauss-seidel", "jacobi"]), help="Order of the master's steps.  [default: as in the scenario]")
@click.option("--step", type=float, metavar="S", help="Communication step in seconds.  [default: as in the scenario]")
@click.option("--in-process", is_flag=True, help="Drive the models without FMI; the same bits.")
def run(scenario: str, out: Path | None, algorithm: str | None, step: float | None, in_process: bool) -> None:
    """Co-simulate SCENARIO and store what happened.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file; without one it is guan2014, the
    published collision. The FMUs are built first when they are missing or older than the sources.
    """
    from .cosim.fmu_files import require_pybullet

    require_pybullet()
    from .cosim.scenario import load_scenario
    from .cosim.simulate import simulate

    loaded = load_scenario(scenario)
    folder = out if out is not None else Path("runs") / loaded.name
    with _progress(f"{loaded.name}") as advance:
        finished = simulate(
            loaded, algorithm=algorithm, step=step, in_process=in_process, out=folder, progress=advance
        )
    _print_run(finished, folder)


@main.command()
@click.option("--out", type=click.Path(path_type=Path), default=Path("build"), show_default=True, help="Folder of the FMUs.")
def build(out: Path) -> None:
    """Build ShipCollision.fmu and ShipManoeuvring.fmu."""
    from .cosim.fmu_files import require_pybullet

    require_pybullet()
    from .fmi.package import build_fmus

    for path in build_fmus(out).values():
        click.echo(path)


@main.command()
def ships() -> None:
    """List the shipped ships."""
    from .ship.library import load_ship, ship_names

    table = _table("name", "kind", ">L_pp [m]", ">B [m]", ">T [m]", ">mass [t]", "manoeuvring")
    for name in ship_names():
        ship = load_ship(name)
        sails = "yes" if ship.manoeuvring is not None else "coasts"
        table.add_row(name, ship.kind, f"{ship.L_pp:g}", f"{ship.B:g}", f"{ship.T:g}", f"{ship.mass / 1e3:,.0f}", sails)
    _console().print(table)


@main.command()
def scenarios() -> None:
    """List the shipped scenarios."""
    from .cosim.scenario import load_scenario, scenario_names

    table = _table("name", "ships", ">duration [s]", ">step [s]", "description")
    for name in scenario_names():
        loaded = load_scenario(name)
        ships = ", ".join(f"{role}: {ship.ship}" for role, ship in loaded.ships.items())
        header = loaded.scenario
        table.add_row(name, ships, f"{header.duration:g}", f"{header.step:.6g}", header.description)
    _console().print(table)


@main.command()
@click.argument("fmu", type=click.Path(path_type=Path))
def validate(fmu: Path) -> None:
    """Check that FMU complies with FMI; exit status 1 when it does not."""
    from .cosim.compliance import problems

    found = problems(fmu)
    for problem in found:
        click.echo(f"{fmu}: {problem}")
    if found:
        _fail(f"{fmu} has {len(found)} problem{'s' if len(found) > 1 else ''}", 1)
    click.echo(f"{fmu}: no problem found")


def _fail(message: str, status: int) -> NoReturn:
    click.echo(f"error: {' '.join(message.split())}", err=True)
    raise click.exceptions.Exit(status)


# -- results ------------------------------------------------------------------------------------------------------------


def _console() -> Console:
    return Console() if sys.stdout.isatty() else Console(width=PLAIN_WIDTH)


def _table(*columns: str, title: str | None = None) -> Table:
    """A table; a column whose heading begins with '>' is of numbers."""
    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False)
    for column in columns:
        table.add_column(column.removeprefix(">"), justify="right" if column.startswith(">") else "left", no_wrap=True)
    return table
