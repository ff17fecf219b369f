"""`run` and `show`: co-simulate a scenario, and write pictures of a finished run."""

from __future__ import annotations

from pathlib import Path

import click

from ..errors import ShipCollisionError
from .console import print_table, progress, say
from .mistakes import fail
from .native_code import compile_native
from .options import FMI, NUMBER, PATH, SCENARIO, WHOLE_NUMBER, Choice

__all__ = ["run", "show"]


@click.command()
@click.argument("scenario", default="guan2014", type=SCENARIO)
@click.option("--out", type=PATH, help="Folder of the results.  [default: runs/NAME]")
@click.option("--algorithm", type=Choice(["gauss-seidel", "jacobi"]), help="Instead of the scenario's.")
@click.option("--step", type=NUMBER, metavar="S", help="Communication step in seconds, instead of the scenario's.")
@click.option("--in-process", is_flag=True, help="Drive the models without FMI; gives the same bits.")
@click.option("--native", is_flag=True, help="FMUs without Python, some twenty times faster; not the same bits.")
@click.option("--fmi", type=FMI, default="2", show_default=True, help="Version of the FMUs; gives the same bits.")
@click.option("--overwrite", is_flag=True, help="Replace files of other origin in the folder of the results, too.")
@click.option("--page/--no-page", default=True, help="Write replay.html, which shows the run.  [default: --page]")
def run(
    scenario: str,
    out: Path | None,
    algorithm: str | None,
    step: float | None,
    in_process: bool,
    native: bool,
    fmi: str,
    overwrite: bool,
    page: bool,
) -> None:
    """Co-simulate a scenario, store the results.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file. Without one it is guan2014, the
    published collision. The FMUs are built first when they are missing or older than the sources.

    With --native they are compiled first, once. Native code has the contact response pgs alone; guan2014 has another.
    """
    from ..collision.responses import require_adapter
    from ..cosim.earlier_run import refuse_foreign_files
    from ..cosim.prepared_files import refuse_response
    from ..cosim.run import RUN_FILES
    from ..cosim.simulate import simulate
    from ..files import check_writable
    from ..scenario.scenario import load_scenario
    from ..show.outputs import PICTURES
    from .run_table import make_run_tables, summarise_run

    if in_process and (native or fmi != "2"):
        raise click.UsageError(f"--in-process runs without FMI: leave out {'--native' if native else '--fmi'}")
    loaded = load_scenario(scenario)
    for note in loaded.notes:
        say(f"note: {note}")
    if native:
        refuse_response(loaded, "leave --native out")
    else:
        require_adapter(loaded.collision.response)
    folder = out if out is not None else Path("runs") / loaded.name
    if not overwrite:
        refuse_foreign_files(folder, (*RUN_FILES, *PICTURES))
    if native:
        check_writable(folder)
        _compile()
    with progress(loaded.name) as report:
        finished = simulate(
            loaded, algorithm=algorithm, step=step, in_process=in_process, engine="native" if native else "python",
            fmi=int(fmi), out=folder, overwrite=overwrite, progress=report,
        )  # fmt: skip
    _remove_pictures(folder)
    for table in make_run_tables(finished):
        print_table(table)
    for line in summarise_run(finished):
        say(line)
    say(f"stored in {folder}")
    if page:
        _write_page(folder)


def _compile() -> None:
    """Compile native code for this machine, which takes long at the first time."""
    from ..cosim.native_fmu_files import require_own_platform

    compile_native([require_own_platform().name])


@click.command()
@click.argument("folder", metavar="DIR", type=PATH)
@click.option("--open", "in_browser", is_flag=True, help="Open the page in the browser.")
@click.option("--osg", is_flag=True, help="scene.osgt and camera.path, for OpenSceneGraph's osgviewer.")
@click.option("--glb", is_flag=True, help="scene.glb, glTF for Blender, Unity, Unreal and viewers.")
@click.option("--plots", is_flag=True, help="Figures for a report, PNG and SVG. Needs Matplotlib.")
@click.option("--gif", is_flag=True, help="impact.gif, a film of the first contact. Needs Pillow.")
@click.option("--mp4", is_flag=True, help="impact.mp4, the same. Needs Pillow and imageio-ffmpeg.")
@click.option("--still", type=NUMBER, metavar="S", help="still.png, the picture at S seconds. Needs Pillow.")
@click.option(
    "--compare", "other", type=PATH, metavar="OTHER", help="compare.html, the runs in DIR and OTHER on one clock."
)
@click.option("--row", type=WHOLE_NUMBER, metavar="N", help="Of a study: run row N again, and write its replay alone.")
@click.option(
    "--replays/--no-replays", default=True, help="Of a study: run its ten worst cases again for their replays."
)
def show(
    folder: Path, in_browser: bool, osg: bool, glb: bool, plots: bool, gif: bool, mp4: bool, still: float | None,
    other: Path | None, row: int | None, replays: bool,
) -> None:  # fmt: skip
    """Show a finished run, or a study.

    DIR is its folder. Without an option the page, replay.html, is written again, and the pictures in the folder are
    listed. With options the pictures that they name are written into the folder.

    Of a study the page is report.html, with its figures as PNG, SVG and CSV beside it. It needs Matplotlib. Replays of
    the ten worst cases are in the folder replays, each a run of its own.
    """
    from ..show import outputs

    chosen = {"osg": osg, "glb": glb, "plots": plots, "gif": gif, "mp4": mp4, "still": still is not None}
    kinds = [kind for kind, is_chosen in chosen.items() if is_chosen]
    if (folder / "study.json").is_file():
        _show_study(folder, [*kinds, *(["compare"] if other is not None else [])], in_browser, row, replays)
        return
    if row is not None:
        raise click.UsageError(f"--row shows a row of a study, and {folder} holds none: leave it out")
    if other is not None:
        _show_comparison(folder, other, kinds, in_browser)
        return
    scene = outputs.load_scene(folder)
    for kind in kinds or ["page"]:
        with progress(kind) as report:
            lines = outputs.write(kind, scene, folder, still, report)
        for line in lines:
            say(line)
    if in_browser:
        _open_page(folder / outputs.PAGE if not kinds else outputs.write_page(scene, folder))
    elif not kinds:
        for line in outputs.describe(scene, folder):
            say(line)


def _show_comparison(folder: Path, other: Path, kinds: list[str], in_browser: bool) -> None:
    """Write the page of two runs."""
    from ..show.outputs import write_comparison

    if kinds:
        raise click.UsageError(f"--{kinds[0]} shows one run, and --compare two: leave one of them out")
    page = write_comparison(folder, other)
    say(f"{page}: open it in a browser")
    if in_browser:
        _open_page(page)


def _show_study(folder: Path, kinds: list[str], in_browser: bool, row: int | None, replays: bool) -> None:
    """Write the report of a study, or the replay of a row."""
    from ..study.report.report import FIGURES, replay_row, write_report

    if kinds:
        raise click.UsageError(f"--{kinds[0]} shows a run, and {folder} holds a study: leave it out")
    if row is not None:
        replay = replay_row(folder, row)
        page = replay.page
        numbers = "the numbers" if replay.is_identical else "other numbers than those"
        say(f"row {row}, computed again, has {numbers} of the table")
        say(f"{page}: open it in a browser")
    else:
        with progress("replays") as report:
            page = write_report(
                folder, replays=replays, progress=report, notify=lambda line: say(line, err=True)
            )  # fmt: skip
        say(f"{page}: open it in a browser")
        say(f"{folder / FIGURES}: its figures as PNG, SVG and CSV")
    if in_browser:
        _open_page(page)


def _open_page(page: Path) -> None:
    import webbrowser

    if not webbrowser.open(page.resolve().as_uri()):
        fail(f"found no browser to open {page}: open it yourself", 1)


def _remove_pictures(folder: Path) -> None:
    """Remove pictures of an earlier run from the folder."""
    from ..show.outputs import remove

    remove(folder)


def _write_page(folder: Path) -> None:
    """Write the page of a stored run and print its path; a page that cannot be written does not fail the run."""
    from ..show.page import write_page

    try:
        say(f"open {write_page(folder)} in a browser to see it")
    except ShipCollisionError as error:
        say(f"no page: {error}", err=True)
