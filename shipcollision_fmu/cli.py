"""The command `shipcollision`.

Exit status: 0 done, 1 the run or the check failed, 2 bad usage or input. A mistake is one line on stderr, without a
traceback. Results go to stdout, progress to stderr; both are plain when not a terminal.

The library is imported inside the commands: help is fast, and a missing package is one clear line too.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import Any, NoReturn

import click
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from . import __version__
from .errors import ShipCollisionError

__all__ = ["main"]

PLAIN_WIDTH = 110
"""Characters in a line when stdout is not a terminal: wide enough for every table here."""
PLAIN_PAUSE = 2.0
"""Time [s] between lines of progress when stderr is not a terminal: a short run prints none."""


class _Path(click.Path):
    """A path; an empty one (an unset variable of the shell) is a mistake, not the current folder."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("is empty: name a folder or a file", param, ctx)
        return super().convert(value, param, ctx)


_PATH = _Path(path_type=Path)
_FMI = click.Choice(["2", "3"])


class _Commands(click.Group):
    """A group of commands that ends on every mistake with one line, and knows near misses."""

    def main(self, *args: Any, **extra: Any) -> Any:
        """As click's, but with all errors told in one way."""
        try:
            status: Any = super().main(*args, **{**extra, "standalone_mode": False})
        except click.UsageError as error:
            path = error.ctx.command_path if error.ctx is not None else "shipcollision"
            _fail(f"{error.format_message()} (see `{path} --help`)", error.exit_code)
        except ShipCollisionError as error:
            _fail(str(error), error.exit_status)
        except ModuleNotFoundError as error:
            if (error.name or "").startswith(__package__ or "shipcollision_fmu"):
                raise  # a fault of ours, not of the installation
            _fail(f"the package {error.name!r} is not installed: run `python -m pip install {error.name}`", 1)
        except (click.Abort, KeyboardInterrupt):
            _fail("interrupted; nothing is written", 1)
        except BrokenPipeError:  # `shipcollision run | head`
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            sys.exit(1)
        sys.exit(status if isinstance(status, int) else 0)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As click's, with a suggestion for a name that is nearly right."""
        names = self.list_commands(ctx)
        if args[0] not in names and not args[0].startswith("-"):
            from .ship.refusal import suggestion

            ctx.fail(f"unknown command {args[0]!r}:{suggestion(args[0], names)} known: {', '.join(names)}")
        return super().resolve_command(ctx, args)


@click.group(cls=_Commands, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="shipcollision")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Ship collisions, co-simulated through FMI FMUs."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())


@main.command()
@click.argument("scenario", default="guan2014")
@click.option("--out", type=_PATH, help="Folder of the results.  [default: runs/NAME]")
@click.option("--algorithm", type=click.Choice(["gauss-seidel", "jacobi"]), help="Instead of the scenario's.")
@click.option("--step", type=float, metavar="S", help="Communication step in seconds, instead of the scenario's.")
@click.option("--in-process", is_flag=True, help="Drive the models without FMI; gives the same bits.")
@click.option("--fmi", type=_FMI, default="2", show_default=True, help="Version of the FMUs; gives the same bits.")
@click.option("--page/--no-page", default=True, help="Write replay.html, which shows the run.  [default: --page]")
def run(
    scenario: str,
    out: Path | None,
    algorithm: str | None,
    step: float | None,
    in_process: bool,
    fmi: str,
    page: bool,
) -> None:
    """Co-simulate SCENARIO and store what happened.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file. Without one it is guan2014, the
    published collision. The FMUs are built first when they are missing or older than the sources.
    """
    from .cosim.fmu_files import require_pybullet
    from .cosim.report import lines, tables
    from .cosim.scenario import load_scenario
    from .cosim.simulate import simulate

    if in_process and fmi != "2":
        raise click.UsageError("--in-process runs without FMI: leave out --fmi")
    require_pybullet()
    loaded = load_scenario(scenario)
    folder = out if out is not None else Path("runs") / loaded.name
    with _progress(loaded.name) as progress:
        finished = simulate(
            loaded, algorithm=algorithm, step=step, in_process=in_process, fmi=int(fmi), out=folder, progress=progress
        )
    _remove_pictures(folder)
    console = _console()
    for table in tables(finished):
        console.print(table)
    for line in lines(finished):
        click.echo(line)
    click.echo(f"stored in {folder}")
    if page:
        _write_page(folder)


@main.command()
@click.argument("folder", metavar="DIR", type=_PATH)
@click.option("--open", "in_browser", is_flag=True, help="Open the page in the browser.")
@click.option("--osg", is_flag=True, help="scene.osgt and camera.path, for OpenSceneGraph's osgviewer.")
@click.option("--glb", is_flag=True, help="scene.glb, glTF for Blender, Unity, Unreal and viewers.")
@click.option("--plots", is_flag=True, help="Figures for a report, PNG and SVG. Needs Matplotlib.")
@click.option("--gif", is_flag=True, help="impact.gif, a film of the first contact. Needs Pillow.")
@click.option("--mp4", is_flag=True, help="impact.mp4, the same. Needs Pillow and imageio-ffmpeg.")
@click.option("--still", type=float, metavar="S", help="still.png, the picture at S seconds. Needs Pillow.")
def show(
    folder: Path, in_browser: bool, osg: bool, glb: bool, plots: bool, gif: bool, mp4: bool, still: float | None
) -> None:
    """Show the finished run in the folder DIR.

    Without an option its page, replay.html, is written anew and what there is to see is listed. With options, what they
    name is written into the folder.
    """
    import webbrowser

    from .show import outputs

    scene = outputs.load_scene(folder)
    asked = {"osg": osg, "glb": glb, "plots": plots, "gif": gif, "mp4": mp4, "still": still is not None}
    kinds = [kind for kind, wanted in asked.items() if wanted]
    for kind in kinds or ["page"]:
        with _progress(kind) as progress:
            made = outputs.made(kind, scene, folder, still, progress)
        for line in made:
            click.echo(line)
    if in_browser:
        page = folder / outputs.PAGE if not kinds else outputs.page(scene, folder)
        if not webbrowser.open(page.resolve().as_uri()):
            _fail(f"found no browser to open {page}: open it yourself", 1)
    elif not kinds:
        for line in outputs.listed(scene, folder):
            click.echo(line)


@main.command()
@click.option("--out", type=_PATH, default=Path("build"), show_default=True, help="Folder.")
@click.option("--fmi", type=_FMI, default="2", show_default=True, help="Version of FMI.")
def build(out: Path, fmi: str) -> None:
    """Build ShipCollision.fmu and ShipManoeuvring.fmu.

    With --fmi 3 they are called ShipCollision.fmi3.fmu and ShipManoeuvring.fmi3.fmu, so that both versions may lie in
    one folder. FMI 3.0 needs `pip install 'shipcollision-fmu[fmi3]'`.
    """
    from .cosim.fmu_files import require_pybullet
    from .fmi.package import build_fmus

    require_pybullet()
    for path in build_fmus(out, fmi=int(fmi)).values():
        click.echo(path)


@main.command()
@click.argument("scenario")
@click.option("--ssp", is_flag=True, help="One .ssp file: System Structure and Parameterization 1.0.")
@click.option("--osp", is_flag=True, help="A folder for the Open Simulation Platform.")
@click.option("--out", type=_PATH, metavar="FILE|FOLDER", help="[default: NAME.ssp or NAME-osp]")
@click.option("--initial-orders", is_flag=True, help="Hold the orders of time 0, leave out what a helm does later.")
def package(scenario: str, ssp: bool, osp: bool, out: Path | None, initial_orders: bool) -> None:
    """Make a system of FMUs of SCENARIO for other hosts.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file. The package holds an FMU for
    each ship and one for the collision, with the scenario's values as their start values. What a host cannot be told
    in that way, such as a route, is refused, or left out and said so.
    """
    from .cosim.osp import write_osp
    from .cosim.scenario import load_scenario
    from .cosim.ssp import write_ssp

    if ssp == osp:
        raise click.UsageError("say which one to make: --ssp or --osp")
    loaded = load_scenario(scenario)
    if ssp:
        place = out if out is not None else Path(f"{loaded.name}.ssp")
        if place.suffix != ".ssp":
            raise click.UsageError(f"--out {place}: hosts know the file by its suffix; call it {place.name}.ssp")
        left_out = write_ssp(loaded, place, initial_orders=initial_orders)
    else:
        place = out if out is not None else Path(f"{loaded.name}-osp")
        left_out = write_osp(loaded, place, initial_orders=initial_orders)
    for line in left_out:
        click.echo(f"note: {line}", err=True)
    click.echo(place)


@main.command()
def ships() -> None:
    """List the shipped ships."""
    from .cosim.report import table
    from .ship.library import load_ship, ship_names

    listed = table("name", "kind", ">L_pp [m]", ">B [m]", ">T [m]", ">mass [t]", "under way")
    for name in ship_names():
        ship = load_ship(name)
        under_way = "coasts" if ship.manoeuvring is None else "manoeuvres"
        sizes = (f"{ship.L_pp:g}", f"{ship.B:g}", f"{ship.T:g}", f"{ship.mass / 1e3:.0f}")
        listed.add_row(name, escape(ship.kind), *sizes, under_way)
    _console().print(listed)


@main.command()
def scenarios() -> None:
    """List the shipped scenarios."""
    from .cosim.report import table
    from .cosim.scenario import load_scenario, scenario_names

    listed = table("name", "ships", ">duration [s]", ">step [s]", "description")
    for name in scenario_names():
        loaded = load_scenario(name)
        header = loaded.scenario
        who = ", ".join(f"{role}: {ship.ship}" for role, ship in loaded.ships.items())
        listed.add_row(name, who, f"{header.duration:g}", f"{header.step:.6g}", escape(header.description))
    _console().print(listed)


@main.command()
@click.argument("fmu", type=_PATH)
@click.option("--no-calls", is_flag=True, help="Look at the file only; do not run the FMU's code.")
@click.option("--ignore", multiple=True, metavar="CHECK", help="Leave out a check; may be given again.")
def validate(fmu: Path, no_calls: bool, ignore: tuple[str, ...]) -> None:
    """Check that FMU complies with FMI; exit status 1 when it does not.

    FMU is any FMI 2.0 or 3.0 FMU. FMPy's validator is followed by checks of what it leaves out, and by calls that an
    FMU must refuse; these run its code, in a process beside this one. Notes are good practice and do not count.
    """
    from .cosim.compliance import findings

    found = findings(fmu, calls=not no_calls, ignore=ignore)
    for one in found:
        click.echo(f"{fmu}: {'' if one.binding else 'note: '}{one}")
    count = sum(one.binding for one in found)
    if count:
        _fail(f"{fmu} has {count} problem{'s' if count > 1 else ''}", 1)
    click.echo(f"{fmu}: no problem found")


@main.command()
@click.argument("ship")
@click.argument("manoeuvre", type=click.Choice(["turning-circle", "zigzag", "crash-stop"]))
@click.option("--rudder-deg", type=float, metavar="DEG", help="Rudder angle.  [default: 35, in a zigzag 10]")
@click.option("--heading-deg", type=float, metavar="DEG", help="Of a zigzag.  [default: 10]")
@click.option("--starboard/--port", default=True, help="Side of the first rudder.  [default: --starboard]")
@click.option("--speed", type=float, metavar="M/S", help="Approach speed.  [default: the service speed]")
@click.option(
    "--rev-per-s", type=float, metavar="REV/S", help="Propeller on the approach.  [default: as the speed asks]"
)
@click.option("--degrees-of-freedom", type=click.Choice(["3", "4", "6"]), default="3", show_default=True)
@click.option("--out", type=_PATH, metavar="FILE.csv", help="Store the track.")
def trial(
    ship: str,
    manoeuvre: str,
    rudder_deg: float | None,
    heading_deg: float | None,
    starboard: bool,
    speed: float | None,
    rev_per_s: float | None,
    degrees_of_freedom: str,
    out: Path | None,
) -> None:
    """Sail a standard trial with SHIP and print its figures beside IMO's limits.

    SHIP is a name that `shipcollision ships` lists, or the path of a TOML file. Limits: IMO resolution MSC.137(76), for
    ships of 100 m and more. Distances are of midship, in lengths L.
    """
    from .cosim.approach import approach
    from .cosim.folder import check_writable, write_file
    from .cosim.trial_report import figures, track_csv
    from .cosim.trials import crash_stop, turning_circle, zigzag

    if manoeuvre != "zigzag" and heading_deg is not None:
        raise click.UsageError("--heading-deg goes with a zigzag only")
    if manoeuvre == "crash-stop" and rudder_deg is not None:
        raise click.UsageError("--rudder-deg goes with a turning-circle or a zigzag: a crash-stop keeps it amidships")
    start = approach(ship, speed=speed, rev_per_s=rev_per_s, degrees_of_freedom=int(degrees_of_freedom))
    if out is not None:
        check_writable(out.parent)
    if manoeuvre == "turning-circle":
        sailed = turning_circle(start, 35.0 if rudder_deg is None else rudder_deg, port=not starboard)
    elif manoeuvre == "zigzag":
        by, to = (10.0 if angle is None else angle for angle in (rudder_deg, heading_deg))
        sailed = zigzag(start, by, to, port=not starboard)
    else:
        sailed = crash_stop(start)
    if out is not None:
        write_file(out, track_csv(sailed))
    _console().print(figures(start, sailed))
    if out is not None:
        click.echo(f"stored in {out}")


@main.command()
@click.argument("kind", metavar="TYPE")
@click.option("--own", default="kvlcc2", show_default=True, metavar="SHIP", help="The ship that strikes.")
@click.option("--target", default="kvlcc2", show_default=True, metavar="SHIP", help="The ship that is struck.")
@click.option("--angle-deg", type=float, metavar="DEG", help="Between the headings: 0 overtaking, 180 head-on.")
@click.option("--at", type=float, metavar="S", help="Place on the target: -0.5 stern, 0 amidships, 0.5 stem.")
@click.option("--side", type=click.Choice(["starboard", "port"]), default="starboard", show_default=True)
@click.option("--own-speed", type=float, metavar="M/S")
@click.option("--target-speed", type=float, metavar="M/S")
@click.option("--time", type=float, metavar="S", help="From the start to the impact.  [default: 60; imazu 1800]")
@click.option("--after", type=float, metavar="S", help="From the impact to the end.  [default: 60; imazu 120]")
@click.option("--before", type=float, metavar="S", help="Of the rudder order: late-evasive, loss-of-steering.")
@click.option("--rudder-deg", type=float, metavar="DEG", help="That order, positive to starboard.")
@click.option("--drift-speed", type=float, metavar="M/S", help="Of a drifting target.")
@click.option("--drift-deg", type=float, metavar="DEG", help="Where she drifts, from her bow.  [default: 90]")
@click.option("--case", type=int, metavar="N", help="Of imazu: 1 to 22.")
@click.option("--hydrodynamics/--coasting", default=None, help="Sail the ships, or let them coast.  [default: by TYPE]")
@click.option("--degrees-of-freedom", type=click.Choice(["3", "4", "6"]), help="Of all ships.  [default: 3]")
@click.option("--step", type=float, default=0.05, show_default=True, metavar="S", help="Communication step.")
@click.option("--name", help="Of the scenario.")
@click.option("--out", type=_PATH, metavar="FILE.toml", help="Store it; else it is printed.")
def encounter(kind: str, out: Path | None, case: int | None, degrees_of_freedom: str | None, **options: Any) -> None:
    """Make a scenario in which two ships collide as wanted.

    TYPE is head-on, crossing, overtaking, glancing, t-bone, drifting-target, late-evasive, loss-of-steering, or imazu
    with --case: one of the 22 cases of Imazu's problem, with one to three targets.
    """
    from .cosim.encounters import encounter as made
    from .cosim.folder import check_writable, write_file
    from .cosim.imazu import imazu_with

    directory = Path(".") if out is None else out.parent
    options["degrees_of_freedom"] = None if degrees_of_freedom is None else int(degrees_of_freedom)
    if kind == "imazu":
        text = imazu_with(case, options, directory).text
    else:
        if case is not None:
            raise click.UsageError("--case goes with TYPE imazu only")
        text = made(kind, directory, **options).text
    if out is None:
        click.echo(text, nl=False)
        return
    check_writable(directory)
    write_file(out, text)
    click.echo(f"stored in {out}: run it with `shipcollision run {out}`")


@main.command("import")
@click.argument("file", type=_PATH)
@click.option("--ship", metavar="SHIP", help="Plays every ship.  [default: ships made from the file's dimensions]")
@click.option("--own", metavar="SHIP", help="Plays own ship.")
@click.option("--duration", type=float, metavar="S", help="[default: what own ship's route takes]")
@click.option("--step", type=float, default=0.05, show_default=True, metavar="S", help="Communication step.")
@click.option("--hydrodynamics", is_flag=True, help="Sail the ships along their waypoints; else they coast.")
@click.option("--out", type=_PATH, required=True, metavar="FILE.toml", help="Scenario to write.")
def import_(
    file: Path, ship: str | None, own: str | None, duration: float | None, step: float, hydrodynamics: bool, out: Path
) -> None:
    """Make a scenario of a traffic situation in JSON.

    FILE is one of DNV's trafficgen or maritime-schema, version 0.1 or 0.2. Ships of which it gives the size only get a
    ship file beside the scenario.
    """
    from .cosim.folder import check_writable, write_files
    from .cosim.traffic import traffic_scenario

    made = traffic_scenario(
        file, out=out, ship=ship, own=own, duration=duration, step=step, hydrodynamics=hydrodynamics
    )
    check_writable(out.parent)
    write_files(out.parent, {**made.ship_files, out.name: made.text})
    for name in (*made.ship_files, out.name):
        click.echo(out.parent / name)
    for note in made.notes:
        click.echo(f"note: {note}", err=True)


def _remove_pictures(folder: Path) -> None:
    """What shows an earlier run in the same folder is of another run now."""
    from .show.outputs import remove

    remove(folder)


def _write_page(folder: Path) -> None:
    """Write the page of a run and say where it is. The run is stored by now: if there is no page, that is said."""
    from .show.page import write_page

    try:
        click.echo(f"open {write_page(folder)} in a browser to see it")
    except ShipCollisionError as error:
        click.echo(f"no page: {error}", err=True)


def _fail(message: str, status: int) -> NoReturn:
    click.echo(f"error: {' '.join(message.split())}", err=True)
    sys.exit(status)


def _console() -> Console:
    return Console() if sys.stdout.isatty() else Console(width=PLAIN_WIDTH)


@contextmanager
def _progress(name: str) -> Iterator[Callable[[int, int], None]]:
    """A bar on stderr; a line now and then when stderr is not a terminal."""
    if not sys.stderr.isatty():
        last = monotonic()

        def tell(done: int, total: int) -> None:
            nonlocal last
            if monotonic() - last >= PLAIN_PAUSE:
                last = monotonic()
                click.echo(f"{name}: {done} of {total} steps", err=True)

        yield tell
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(name, total=None)

        def show(done: int, total: int) -> None:
            if done == total or done % max(1, total // 200) == 0:  # drawing costs more than stepping
                bar.update(task, completed=done, total=total)

        yield show
