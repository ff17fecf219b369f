"""`trial`: a standard manoeuvre of a ship."""

from __future__ import annotations

from pathlib import Path

import click

from .console import print_table, say
from .options import NUMBER, PATH, SHIP, Choice

__all__ = ["trial"]


@click.command()
@click.argument("ship", type=SHIP)
@click.argument("manoeuvre", metavar="MANOEUVRE", type=Choice(["turning-circle", "zigzag", "crash-stop"]))
@click.option("--rudder-deg", type=NUMBER, metavar="DEG", help="Rudder angle.  [default: 35, in a zigzag 10]")
@click.option("--heading-deg", type=NUMBER, metavar="DEG", help="Of a zigzag.  [default: 10]")
@click.option("--starboard/--port", default=True, help="Side of the first rudder.  [default: --starboard]")
@click.option("--speed", type=NUMBER, metavar="M/S", help="Approach speed.  [default: the service speed]")
@click.option(
    "--rev-per-s", type=NUMBER, metavar="REV/S", help="Propeller on the approach.  [default: those that keep the speed]"
)
@click.option("--degrees-of-freedom", type=Choice(["3", "4", "6"]), default="3", show_default=True, help="Of the ship.")
@click.option("--out", type=PATH, metavar="FILE.csv", help="Store the track.")
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
    """Sail a standard trial of a ship.

    Its figures are printed beside IMO's limits. SHIP is a name that `shipcollision ships` lists, or the path of a
    TOML file. MANOEUVRE is turning-circle, zigzag or crash-stop. Limits: IMO resolution MSC.137(76), for ships of 100
    m and more. Distances are of midship, in lengths L.
    """
    from ..files import check_writable, write_file
    from ..manoeuvring.trials.steady_course import find_steady_course
    from ..manoeuvring.trials.trials import sail_crash_stop, sail_turning_circle, sail_zigzag
    from .trial_table import format_track_csv, make_trial_table

    if manoeuvre != "zigzag" and heading_deg is not None:
        raise click.UsageError("--heading-deg goes with a zigzag only")
    if manoeuvre == "crash-stop" and rudder_deg is not None:
        raise click.UsageError("--rudder-deg goes with a turning-circle or a zigzag: a crash-stop keeps it amidships")
    start = find_steady_course(ship, speed=speed, rev_per_s=rev_per_s, degrees_of_freedom=int(degrees_of_freedom))
    if out is not None:
        check_writable(out.parent)
    if manoeuvre == "turning-circle":
        trial_run = sail_turning_circle(start, 35.0 if rudder_deg is None else rudder_deg, port=not starboard)
    elif manoeuvre == "zigzag":
        by, to = (10.0 if angle is None else angle for angle in (rudder_deg, heading_deg))
        trial_run = sail_zigzag(start, by, to, port=not starboard)
    else:
        trial_run = sail_crash_stop(start)
    if out is not None:
        write_file(out, format_track_csv(trial_run))
    print_table(make_trial_table(start, trial_run))
    if trial_run.doubt:
        say(trial_run.doubt)
    if out is not None:
        say(f"stored in {out}")
