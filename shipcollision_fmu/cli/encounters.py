"""`encounter` and `import`: make scenarios backwards from an impact, or from other people's traffic."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from .console import say
from .options import NUMBER, PATH, SHIP, TOML_PATH, WHOLE_NUMBER, Choice

__all__ = ["encounter", "import_"]


@click.command()
@click.argument("kind", metavar="TYPE")
@click.option("--own", default="kvlcc2", show_default=True, type=SHIP, metavar="SHIP", help="The ship that strikes.")
@click.option(
    "--target", default="kvlcc2", show_default=True, type=SHIP, metavar="SHIP", help="The ship that is struck."
)
@click.option("--angle-deg", type=NUMBER, metavar="DEG", help="Between the headings: 0 overtaking, 180 head-on.")
@click.option("--at", type=NUMBER, metavar="S", help="Place on the target: -0.5 stern, 0 amidships, 0.5 stem.")
@click.option(
    "--side",
    type=Choice(["starboard", "port"]),
    default="starboard",
    show_default=True,
    help="Side of the target that is struck.",
)
@click.option("--own-speed", type=NUMBER, metavar="M/S", help="Approach of own through the water.  [default: by TYPE]")
@click.option("--target-speed", type=NUMBER, metavar="M/S", help="Likewise of the target.  [default: by TYPE]")
@click.option("--time", type=NUMBER, metavar="S", help="From the start to the impact.  [default: 60; imazu 1800]")
@click.option("--after", type=NUMBER, metavar="S", help="From the impact to the end.  [default: 60; imazu 120]")
@click.option("--before", type=NUMBER, metavar="S", help="Of the rudder order: late-evasive, loss-of-steering.")
@click.option("--rudder-deg", type=NUMBER, metavar="DEG", help="That order, positive to starboard.")
@click.option("--drift-speed", type=NUMBER, metavar="M/S", help="Of a drifting target.")
@click.option(
    "--drift-deg",
    type=NUMBER,
    metavar="DEG",
    help="Its direction, from the bow clockwise.  [default: 90]",
)
@click.option("--current-speed", type=NUMBER, metavar="M/S", help="Of the water, with --hydrodynamics.")
@click.option("--current-towards-deg", type=NUMBER, metavar="DEG", help="Where it flows to, clockwise from north.")
@click.option("--wind-speed", type=NUMBER, metavar="M/S", help="Of the wind, with --hydrodynamics.")
@click.option("--wind-from-deg", type=NUMBER, metavar="DEG", help="Where it comes from, clockwise from north.")
@click.option("--case", type=WHOLE_NUMBER, metavar="N", help="Of imazu: 1 to 22.")
@click.option("--hydrodynamics/--coasting", default=None, help="Sail the ships, or let them coast.  [default: by TYPE]")
@click.option("--degrees-of-freedom", type=Choice(["3", "4", "6"]), help="Of all ships.  [default: 3]")
@click.option("--step", type=NUMBER, default=0.05, show_default=True, metavar="S", help="Communication step.")
@click.option("--name", help="Of the scenario.")
@click.option("--out", type=TOML_PATH, metavar="FILE.toml", help="Store it; else it is printed.")
def encounter(kind: str, out: Path | None, case: int | None, degrees_of_freedom: str | None, **options: Any) -> None:
    """Make a scenario in which ships collide.

    TYPE says what the ship `own` does:

    \b
    head-on           meets the target stem to stem
    crossing          crosses and strikes the target's side
    overtaking        overtakes and strikes the stern
    glancing          strikes the side at a small angle
    t-bone            strikes the side of a stopped target
    drifting-target   strikes a target that drifts across
    late-evasive      puts its rudder over too late
    loss-of-steering  jams its rudder before the impact
    imazu             one of Imazu's 22 cases, by --case
    """
    from ..encounters.encounter import encounter as make_encounter
    from ..encounters.imazu import imazu_from_options
    from ..encounters.request import KINDS
    from ..files import check_writable, write_file
    from ..ship.loading.messages import suggest_or_list

    if kind not in (known := [*KINDS, "imazu"]):
        raise click.UsageError(f"unknown encounter {kind!r}:{suggest_or_list(kind, known)}")
    directory = Path(".") if out is None else out.parent
    options["degrees_of_freedom"] = None if degrees_of_freedom is None else int(degrees_of_freedom)
    if kind == "imazu":
        text = imazu_from_options(case, options, directory).text
    else:
        if case is not None:
            raise click.UsageError("--case goes with TYPE imazu only")
        text = make_encounter(kind, directory, **options).text
    if out is None:
        click.echo(text, nl=False)
        return
    check_writable(directory)
    write_file(out, text)
    say(f"stored in {out}: run it with `shipcollision run {out}`")


@click.command("import")
@click.argument("file", type=PATH)
@click.option(
    "--ship", type=SHIP, metavar="SHIP", help="Plays every ship.  [default: ships made from the file's dimensions]"
)
@click.option("--own", type=SHIP, metavar="SHIP", help="Plays own ship.")
@click.option(
    "--duration", type=NUMBER, metavar="S", help="[default: the time of own ship's route, or of the trajectories]"
)
@click.option("--step", type=NUMBER, default=0.05, show_default=True, metavar="S", help="Communication step.")
@click.option(
    "--hydrodynamics",
    is_flag=True,
    help="Sail the ships along their waypoints, by estimate without --ship; else they coast.",
)
@click.option("--out", type=TOML_PATH, required=True, metavar="FILE.toml", help="Scenario to write.")
@click.option("--overwrite", is_flag=True, help="Replace other ship files of the same names beside it, too.")
def import_(
    file: Path, ship: str | None, own: str | None, duration: float | None, step: float, hydrodynamics: bool, out: Path,
    overwrite: bool,
) -> None:  # fmt: skip
    """Make a scenario of a traffic situation.

    FILE is JSON, or a CommonOcean scenario in XML. JSON comes from DNV's trafficgen (all versions) or maritime-schema.
    A ship without --ship gets a ship file of its dimensions beside the scenario. The own ship of CommonOcean has none:
    name it with --own.
    """
    from ..encounters.traffic.situation import traffic_scenario
    from ..files import check_writable, refuse_other_texts, write_files

    traffic = traffic_scenario(
        file, out=out, ship=ship, own=own, duration=duration, step=step, hydrodynamics=hydrodynamics
    )
    check_writable(out.parent)
    if not overwrite:
        refuse_other_texts(out.parent, traffic.ship_files)
    write_files(out.parent, {**traffic.ship_files, out.name: traffic.text})
    for name in (*traffic.ship_files, out.name):
        say(str(out.parent / name))
    for note in traffic.notes:
        say(f"note: {note}", err=True)
