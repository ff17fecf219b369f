"""What `shipcollision run` prints: tables of a run and lines below them."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, hypot
from typing import TYPE_CHECKING, Any

from ..fmi.names import VELOCITY, named
from .table import WordTable, make_table

if TYPE_CHECKING:
    from ..cosim.run import Run

__all__ = ["make_comparison_table", "make_run_tables", "summarise_run"]

LARGE_HEEL = 30.0
"""[deg] Heel from which a coasting ship is unrealistic: real ships right themselves."""


def make_run_tables(run: Run) -> Iterator[WordTable]:
    """The comparison with published numbers where there are any, else collisions and ships with their ledger."""
    if "paper" in run.summary:
        yield make_comparison_table(run.summary)
        return
    if run.events["collisions"]:
        yield _make_collision_table(run.events["collisions"])
    yield _make_ship_table(run)


def summarise_run(run: Run) -> Iterator[str]:
    """Lines below the tables: tolerance, clearance, energy, heel, solver, time."""
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
    ships = summary["ships"].values()
    between = "sailing" if any(ship["hydrodynamics"] for ship in ships) else "coasting"
    between += " and from recorded tracks" if any("track" in ship for ship in ships) else " between contacts"
    rest = after + lost - before
    rest = 0.0 if abs(rest) < 0.05 else rest
    yield f"  {lost:.1f} MJ dissipated in contact, {rest:+.1f} MJ from {between}"
    yield from _warn_of_heel(run)
    if summary["solver"]["unconverged"]:
        yield f"  the contact solver missed its residual {summary['solver']['unconverged']} times: see solver.residual"
    yield (
        f"{summary['steps']} steps of {summary['step']:.6g} s, {summary['algorithm']}, {run.timing['mode']}: "
        f"{run.timing['wall_time']:.2f} s, {run.timing['real_time_factor']:.0f} times real time"
    )


def _warn_of_heel(run: Run) -> Iterator[str]:
    """Lines on ships without buoyancy that heel by more than LARGE_HEEL."""
    for name, ship in run.summary["ships"].items():
        heel = degrees(float(abs(run.states[f"{name}.attitude.roll"]).max()))
        if ship["coasting"] in ("straight", "free") and heel > LARGE_HEEL:
            yield (
                f"  {name} heeled by {heel:.0f} deg: coasting = {ship['coasting']!r} has no buoyancy; take "
                "coasting = 'kirchhoff', or degrees_of_freedom = 3"
            )


def make_comparison_table(summary: dict[str, Any]) -> WordTable:
    """Table of published and computed numbers; a star marks a printed number that had to be corrected."""
    reference = summary["reference"]
    rows = make_table(
        "ship", "", "unit", ">printed", ">paper", ">computed", ">difference", ">allowed", "within",
        title=f"{summary['scenario']}: {reference['source']}, at {reference['time']:g} s",
        optional=("printed", "allowed", "difference"),
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


def _make_collision_table(collisions: list[dict[str, Any]]) -> WordTable:
    rows = make_table(
        "ships", ">start [s]", ">end [s]", ">closing [m/s]", ">angle [deg]", ">impulse [MN s]", ">energy [MJ]",
        ">delta v [m/s]", title="collisions", optional=("end", "delta v"),
    )  # fmt: skip
    for c in collisions:
        delta_v = ", ".join(f"{hypot(*c['delta_v'][name]):.3f}" for name in (c["ship_a"], c["ship_b"]))
        rows.add_row(
            f"{c['ship_a']} - {c['ship_b']}", f"{c['start']:.2f}", f"{c['end']:.2f}",
            _format_or_dash(c["closing_speed"]), "-" if c["angle"] is None else f"{degrees(c['angle']):.1f}",
            f"{c['impulse']['magnitude'] / 1e6:.2f}", f"{c['energy'] / 1e6:.2f}", delta_v,
        )  # fmt: skip
    return rows


def _make_ship_table(run: Run) -> WordTable:
    """Table of speed, surge (negative astern) and heading before and after, and of pending impulses."""
    rows = make_table(
        "ship", ">speed [m/s]", ">surge [m/s]", ">heading [deg]", ">impulse pending [MN s]", title="ships",
        optional=("speed",),
    )  # fmt: skip
    first, last = run.states[0], run.states[-1]
    for name, ledger in run.summary["ledger"].items():
        columns = named(name, VELOCITY)
        speeds = [hypot(*(float(row[column]) for column in columns)) for row in (first, last)]
        surges = [float(row[columns[0]]) for row in (first, last)]
        headings = [_format_heading(float(row[f"{name}.attitude.yaw"])) for row in (first, last)]
        rows.add_row(
            name, *(f"{a:.3f} > {b:.3f}" for a, b in (speeds, surges)), " > ".join(headings),
            f"{hypot(*ledger['pending'][:3]) / 1e6:.2g}",
        )  # fmt: skip
    return rows


def _format_heading(yaw: float) -> str:
    """A yaw angle [rad], which counts whole turns, as a heading from 0.00 to 359.99 deg."""
    return f"{round(degrees(yaw), 2) % 360.0:.2f}"


def _format_or_dash(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"
