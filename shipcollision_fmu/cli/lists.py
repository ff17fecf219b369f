"""`ships` and `scenarios`: lists of the shipped ships and scenarios."""

from __future__ import annotations

import click
from rich.markup import escape
from rich.table import Table

from .console import console

__all__ = ["scenarios", "ships"]


@click.command()
@click.argument("name", required=False)
def ships(name: str | None) -> None:
    """List the shipped ships, or show the figures of the ship NAME.

    NAME is a shipped ship or the path of a TOML file. Its figures are GM, roll period, service speed, power and
    stopping distance, for which a crash stop is sailed. The estimates that stand for missing values follow.
    """
    if name is None:
        console().print(_list_ships())
        return
    from ..manoeuvring.trials.ship_summary import summarise_ship
    from ..ship.loading.library import load_ship
    from .ship_table import make_ship_table

    ship = load_ship(name)
    summary = summarise_ship(name, ship)
    console().print(make_ship_table(summary))
    for note in (*summary.notes, *ship.suspicious):
        click.echo(f"note: {note}")
    if ship.estimated:
        click.echo("Estimated:")
    for line in ship.estimated:
        click.echo(f"  {line}")


def _list_ships() -> Table:
    from ..ship.loading.library import list_ship_names, load_ship
    from .table import make_table

    table = make_table("name", "kind", ">L_pp [m]", ">B [m]", ">T [m]", ">mass [t]", "under way")
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
    from .table import make_table

    table = make_table("name", "ships", ">duration [s]", ">step [s]", "description")
    for name in list_scenario_names():
        loaded = load_scenario(name)
        header = loaded.scenario
        who = ", ".join(f"{role}: {ship.ship}" for role, ship in loaded.ships.items())
        table.add_row(name, who, f"{header.duration:g}", f"{header.step:.6g}", escape(header.description))
    console().print(table)
