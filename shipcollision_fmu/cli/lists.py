"""`ships` and `scenarios`: lists of the shipped ships and scenarios."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from rich.markup import escape

from .console import print_table, say
from .options import SHIP
from .table import WordTable, make_table

if TYPE_CHECKING:
    from ..ship.ship import Ship

__all__ = ["scenarios", "ships"]


@click.command()
@click.argument("name", required=False, type=SHIP)
def ships(name: str | None) -> None:
    """List the ships, or show one.

    NAME is a shipped ship or the path of a TOML file; without it the shipped ships are listed. Its figures are inertia,
    added mass, GM, roll period, service speed, power and stopping distance, for which a crash stop is sailed. The
    estimates that stand for missing values follow. A hull from a mesh file is read, checked and kept for later runs.
    """
    if name is None:
        print_table(_list_ships())
        return
    from ..manoeuvring.trials.ship_summary import summarise_ship
    from ..ship.loading.library import load_ship
    from .ship_table import make_ship_table

    ship = load_ship(name)
    hull = _describe_mesh(ship)
    summary = summarise_ship(name, ship)
    print_table(make_ship_table(summary))
    for note in (*summary.notes, *ship.suspicious, *hull):
        say(f"note: {note}")
    if ship.estimated:
        say("Estimated:")
    for line in ship.estimated:
        say(f"  {line}")


def _describe_mesh(ship: Ship) -> list[str]:
    """What a hull from a mesh file has become; nothing for other hulls. Raises ShipError when the mesh is refused."""
    from ..ship.hull.hull import build_hull

    if ship.hull.file is None:
        return []
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    file, faces, parts = Path(ship.hull.file).name, len(hull.triangles), len(hull.parts)
    return [f"{file}: {hull.volume:.4g} m3 in {faces} faces, convex parts: {parts}, which add {hull.volume_error:.2%}"]


def _list_ships() -> WordTable:
    from ..ship.loading.library import list_ship_names, load_ship

    table = make_table(
        "name", "kind", ">L_pp [m]", ">B [m]", ">T [m]", ">mass [t]", "under way", optional=("kind", "T", "B")
    )
    for name in list_ship_names():
        ship = load_ship(name)
        under_way = "coasts" if ship.manoeuvring is None else "manoeuvres"
        sizes = (f"{ship.L_pp:g}", f"{ship.B:g}", f"{ship.T:g}", f"{ship.mass / 1e3:.0f}")
        table.add_row(name, escape(ship.kind), *sizes, under_way)
    return table


@click.command()
def scenarios() -> None:
    """List the shipped scenarios."""
    from ..scenario.scenario import list_scenario_names, load_scenario

    table = make_table("name", "ships", ">duration [s]", ">step [s]", "description")
    for name in list_scenario_names():
        loaded = load_scenario(name)
        header = loaded.scenario
        who = "\n".join(f"{role}: {ship.ship}" for role, ship in loaded.ships.items())
        table.add_row(name, who, f"{header.duration:g}", f"{header.step:.6g}", escape(header.description))
    print_table(table)
