"""A run's result as tables for people."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, hypot
from typing import TYPE_CHECKING, Any

from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from ..fmi.names import named

if TYPE_CHECKING:
    from ..cosim.run import Run

__all__ = ["comparison", "lines", "table", "tables"]


_LINEAR = ("surge", "sway", "heave")


def table(*columns: str, title: str | None = None) -> Table:
    """An empty table; a column whose heading begins with '>' is of numbers. Units go below: 80 characters are few."""
    heading = None if title is None else Text(title)  # Text: a unit in brackets is not a style
    empty = Table(title=heading, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    for column in columns:
        name = Text(column.removeprefix(">").replace(" [", "\n["))
        # Folded where the terminal is narrow: half a ship's name is of no use to anybody.
        empty.add_column(name, justify="right" if column.startswith(">") else "left", overflow="fold")
    return empty


def tables(run: Run) -> Iterator[Table]:
    """What a run has to show: the published numbers if there are any, else its collisions and its books."""
    if "paper" in run.summary:
        yield comparison(run.summary)
        return
    if run.events["collisions"]:
        yield _collisions(run.events["collisions"])
    yield _ships(run)


def lines(run: Run) -> Iterator[str]:
    """What is said below the tables."""
    summary = run.summary
    if "paper" in summary:
        within = sum(row["within"] for row in summary["paper"])
        yield f"{within} of {len(summary['paper'])} numbers within tolerance; * corrected, printed as shown"
    if not run.events["collisions"]:
        where = f", {' - '.join(summary['nearest'])}" if summary["nearest"] else " or more (clearance_range)"
        yield f"no collision; least clearance {summary['least_clearance']:.1f} m{where}"
    energy = summary["energy"]
    before, after, lost = (x / 1e6 for x in (energy["before"]["total"], energy["after"]["total"], energy["dissipated"]))
    yield f"kinetic energy {before:.1f} MJ before, {after:.1f} MJ after:"
    between = "sailing" if any(ship["hydrodynamics"] for ship in summary["ships"].values()) else "coasting"
    rest = after + lost - before
    rest = 0.0 if abs(rest) < 0.05 else rest
    yield f"  {lost:.1f} MJ dissipated in contact, {rest:+.1f} MJ from {between} between contacts"
    yield from _rolled(run)
    if summary["solver"]["unconverged"]:
        yield f"  the contact solver missed its residual {summary['solver']['unconverged']} times: see solver.residual"
    yield (
        f"{summary['steps']} steps of {summary['step']:.6g} s, {summary['algorithm']}, {run.timing['mode']}: "
        f"{run.timing['wall_time']:.2f} s, {run.timing['real_time_factor']:.0f} times real time"
    )


def _rolled(run: Run) -> Iterator[str]:
    """Ships that coast far over: nothing rights them."""
    for name, ship in run.summary["ships"].items():
        heel = degrees(float(abs(run.states[f"{name}.attitude.roll"]).max()))
        if not ship["hydrodynamics"] and heel > 30.0:
            yield (
                f"  {name} heeled by {heel:.0f} deg: a ship that coasts has no buoyancy; give degrees_of_freedom = 3, "
                "or hydrodynamics = true"
            )


def comparison(summary: dict[str, Any]) -> Table:
    """Published and computed numbers; a star where the printed one had to be corrected."""
    reference = summary["reference"]
    rows = table(
        "ship", "", "unit", ">printed", ">paper", ">computed", ">difference", ">tolerance", "within",
        title=f"{summary['scenario']}: {reference['source']}, at {reference['time']:g} s",
    )  # fmt: skip
    last = None
    for row in summary["paper"]:
        if last not in (None, row["ship"]):
            rows.add_section()
        corrected = "*" if row["printed"] != row["paper"] else ""
        rows.add_row(
            "" if last == row["ship"] else row["ship"], row["quantity"], row["unit"],
            f"{row['printed']:.4f}" if corrected else "", f"{corrected}{row['paper']:.4f}", f"{row['computed']:.4f}",
            f"{row['difference']:+.4f}", f"{row['tolerance']:g}", "yes" if row["within"] else "NO",
        )  # fmt: skip
        last = row["ship"]
    return rows


def _collisions(collisions: list[dict[str, Any]]) -> Table:
    rows = table(
        "ships", ">start [s]", ">end [s]", ">closing [m/s]", ">angle [deg]", ">impulse [MN s]", ">energy [MJ]",
        ">delta v [m/s]", title="collisions",
    )  # fmt: skip
    for c in collisions:
        gained = ", ".join(f"{hypot(*c['delta_v'][name]):.3f}" for name in (c["ship_a"], c["ship_b"]))
        rows.add_row(
            f"{c['ship_a']} - {c['ship_b']}", f"{c['start']:.2f}", f"{c['end']:.2f}", _or_dash(c["closing_speed"]),
            "-" if c["angle"] is None else f"{degrees(c['angle']):.1f}", f"{c['impulse']['magnitude'] / 1e6:.2f}",
            f"{c['energy'] / 1e6:.2f}", gained,
        )  # fmt: skip
    return rows


def _ships(run: Run) -> Table:
    """Speed and heading before and after, and the ledger of impulses."""
    rows = table("ship", ">speed [m/s]", ">heading [deg]", ">impulse pending [MN s]", title="ships")
    first, last = run.states[0], run.states[-1]
    for name, books in run.summary["ledger"].items():
        columns = named(f"{name}.velocity", _LINEAR)
        speeds = [hypot(*(float(row[column]) for column in columns)) for row in (first, last)]
        headings = [degrees(float(row[f"{name}.attitude.yaw"])) for row in (first, last)]
        rows.add_row(
            name, f"{speeds[0]:.3f} > {speeds[1]:.3f}", f"{headings[0]:.2f} > {headings[1]:.2f}",
            f"{hypot(*books['pending'][:3]) / 1e6:.2g}",
        )  # fmt: skip
    return rows


def _or_dash(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"
