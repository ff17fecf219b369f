"""Ships from four numbers beside published figures: GM, roll period, power, stopping. Turning: estimated_ships.py.

    python benchmarks/estimated_stopping.py

Each ship is made from L, B, T, C_b and its type with `[manoeuvring] estimate = true`. Sources are named in the tables;
"secondary" means that the publication itself was not at hand. Rows that miss are printed like the others.
"""

from __future__ import annotations

from math import log, nan, sqrt
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from rich.console import Console
from rich.table import Table
from rich.text import Text

from shipcollision_fmu.manoeuvring.trials.ship_summary import ShipSummary, summarise_ship
from shipcollision_fmu.scenario.toml_writer import format_toml
from shipcollision_fmu.ship.loading.engine_estimate import estimate_engine
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.loading.motora_charts import Dimensions
from shipcollision_fmu.ship.loading.propulsion_estimate import (
    compute_resistance_coefficient,
    compute_service_power,
    estimate_propeller,
    estimate_service_speed,
    solve_self_propulsion,
)
from shipcollision_fmu.ship.ship_type import KNOT, ShipType, find_ship_type


class Ship(NamedTuple):
    """A ship from four numbers: type, L, B, T [m], C_b."""

    kind: str
    L: float
    B: float
    T: float
    C_b: float


VLCC = Ship("tanker", 320.0, 58.0, 20.8, 0.81)
MR_TANKER = Ship("tanker", 174.0, 32.2, 11.0, 0.79)
CAPESIZE = Ship("bulk carrier", 279.0, 45.0, 18.0, 0.84)
PANAMAX = Ship("bulk carrier", 217.0, 32.2, 14.0, 0.86)
CONTAINER = Ship("container ship", 376.0, 56.4, 15.0, 0.63)
FEEDER = Ship("container ship", 230.0, 32.2, 10.8, 0.65)
CRUISE = Ship("cruise ship", 330.0, 47.0, 9.1, 0.72)
CAR_CARRIER = Ship("car carrier", 190.0, 32.2, 9.0, 0.58)
LNG = Ship("lng carrier", 277.0, 43.4, 11.5, 0.76)
FERRY = Ship("ferry", 180.0, 27.5, 6.5, 0.58)
SMALL_FERRY = Ship("ferry", 150.0, 25.0, 6.0, 0.58)
CARGO = Ship("general cargo ship", 120.0, 19.0, 7.3, 0.72)
COASTER = Ship("general cargo ship", 84.0, 13.0, 5.5, 0.75)
SUPPLY = Ship("offshore supply vessel", 80.0, 18.0, 6.5, 0.72)
TUG = Ship("tug", 29.0, 11.0, 4.8, 0.55)
TRAWLER = Ship("trawler", 28.0, 8.0, 3.5, 0.55)
TITANIC = Ship("passenger liner", 259.1, 28.2, 10.5, 0.674)
DESTROYER = Ship("destroyer", 142.0, 19.0, 6.2, 0.505)

GUIDE = "Barrass and Derrett, secondary"
GM: tuple[tuple[Ship, float, float, str], ...] = (
    (VLCC, 2.0, 5.0, GUIDE),
    (PANAMAX, 2.0, 3.0, GUIDE),
    (FEEDER, 1.5, 2.5, GUIDE),
    (CAR_CARRIER, 1.5, 1.5, GUIDE),
    (CARGO, 0.3, 0.5, GUIDE),
)
"""Ship, GM from and to [m], source."""

SHEET = "data sheets, secondary"
POWER: tuple[tuple[Ship, float, float, str], ...] = (
    (VLCC, 25.0, 29.0, SHEET),
    (MR_TANKER, 8.5, 9.5, SHEET),
    (CAPESIZE, 17.0, 18.6, SHEET),
    (PANAMAX, 9.5, 10.0, SHEET),
    (CONTAINER, 75.0, 80.9, SHEET),
    (FEEDER, 29.0, 36.0, SHEET),
    (CRUISE, 60.0, 60.0, SHEET),
    (CAR_CARRIER, 13.0, 15.0, SHEET),
    (LNG, 26.0, 28.0, SHEET),
    (FERRY, 22.0, 25.0, SHEET),
    (COASTER, 1.8, 2.2, SHEET),
    (SUPPLY, 4.0, 5.5, SHEET),
    (TUG, 3.0, 4.5, SHEET),
    (TRAWLER, 0.6, 1.0, SHEET),
    (DESTROYER, 70.0, 75.0, SHEET),
)
"""Ship, installed power from and to [MW], source."""

CIRCULAR = "MSC/Circ.1053, secondary"
B = (0.6, 1.0)
"""Resistance over astern thrust, of diesels with 85 % of their power astern."""

STOPPING: tuple[tuple[Ship, float, float, str], ...] = tuple(
    (ship, low * log(1.0 + B[0]) + reversal, high * log(1.0 + B[1]) + reversal, CIRCULAR)
    for ship, low, high, reversal in (
        (VLCC, 14.0, 16.0, 0.8),
        (MR_TANKER, 12.0, 13.0, 1.3),
        (LNG, 10.0, 11.0, 1.0),
        (SMALL_FERRY, 8.0, 9.0, 0.7),
        (CARGO, 5.0, 8.0, 1.9),
    )
) + ((TITANIC, 777.0 / 259.1, 777.0 / 259.1, "sea trials of 1912 from 20 kn, secondary"),)
"""Ship, track reach from and to [L], source."""

GUIDE_TO_RULES = "Cockcroft and Lameijer"
TIME: tuple[tuple[Ship, float, float, str], ...] = (
    (VLCC, 1500.0, nan, GUIDE_TO_RULES),  # "more than 25 minutes", over 200 000 t from 16 kn
    (COASTER, nan, 180.0, GUIDE_TO_RULES),  # "less than 3 minutes", 3 000 t from 16 kn
)
"""Ship, time of a crash stop from and to [s], source."""


def main() -> None:
    """Print the four comparisons."""
    with TemporaryDirectory() as folder:
        ships = {ship for rows in (GM, POWER, STOPPING, TIME) for ship, *_ in rows}
        found = {ship: _summarise(ship, Path(folder)) for ship in sorted(ships)}
    console = Console(width=120)
    console.print(_compare("GM of the loaded ship [m]", GM, {s: f.GM_T for s, f in found.items()}))
    console.print(_compare_periods(found))
    console.print(_compare("installed power [MW]", POWER, {s: f.power / 1e6 for s, f in found.items()}))
    console.print(_compare("crash stop, track reach [L]", STOPPING, {s: f.track_reach / s.L for s, f in found.items()}))
    console.print(_compare_propellers())
    console.print(_compare("crash stop, time [s]", TIME, {s: f.time_to_stop for s, f in found.items()}))


def _summarise(ship: Ship, folder: Path) -> ShipSummary:
    path = folder / "ship.toml"
    mass = 1025.0 * ship.C_b * ship.L * ship.B * ship.T
    text = format_toml(
        [],
        {
            "ship": {"name": ship.kind, "kind": ship.kind, "source": "four numbers"},
            "particulars": {"L_pp": ship.L, "B": ship.B, "T": ship.T, "mass": mass},
            "hull": {"shape": "box", "depth": 1.5 * ship.T},
            "manoeuvring": {"estimate": True},
        },
    )
    path.write_text(text, encoding="utf-8")
    return summarise_ship(str(path), load_ship(path))


def _compare(title: str, rows: tuple[tuple[Ship, float, float, str], ...], ours: dict[Ship, float]) -> Table:
    table = Table("ship", "published", "ours", "outside by", "source", title=Text(title), title_justify="left")
    for ship, low, high, source in rows:
        published = f"{low:.4g} to {high:.4g}" if low < high else f"{low:.4g}"
        if low != low or high != high:
            published = f"below {high:.4g}" if low != low else f"above {low:.4g}"
        value = ours[ship]
        off = (value / low - 1.0) if value < low else (value / high - 1.0) if value > high else 0.0
        table.add_row(_name(ship), published, f"{value:.4g}", f"{off:+.0%}" if off else "", source)
    return table


def _compare_periods(found: dict[Ship, ShipSummary]) -> Table:
    table = Table("ship", "IS Code 2008 [s]", "ours [s]", "deviation", title="roll period", title_justify="left")
    for ship, figures in found.items():
        off = figures.roll_period / figures.code_period - 1.0
        table.add_row(_name(ship), f"{figures.code_period:.1f}", f"{figures.roll_period:.1f}", f"{off:+.0%}")
    return table


def _compare_propellers() -> Table:
    """Installed power of the two ships that miss: at their own and a faster speed, with the disc of one and of two."""
    table = Table("ship", "speed [kn]", "one propeller [MW]", "two [MW]", title="power and speed", title_justify="left")
    for ship, faster in ((FERRY, 25.0), (DESTROYER, 31.0)):
        d, of = Dimensions(ship.L, ship.B, ship.T, ship.C_b, 0.0, 1025.0), find_ship_type(ship.kind)
        for speed in (estimate_service_speed(d, of), faster * KNOT):
            powers = [_compute_power(d, of, speed, discs) for discs in (1.0, 2.0)]
            table.add_row(_name(ship), f"{speed / KNOT:.1f}", *(f"{power / 1e6:.1f}" for power in powers))
    return table


def _compute_power(d: Dimensions, of: ShipType, speed: float, discs: float) -> float:
    propeller = {**estimate_propeller(d, of), "service_speed": speed}
    propeller["D_p"] *= sqrt(discs)
    R_0 = compute_resistance_coefficient(d, speed)
    propeller["service_rev_per_s"] = n = solve_self_propulsion(d, R_0, propeller)
    return estimate_engine(of, d.L, compute_service_power(d, propeller), n)[0]["power"]


def _name(ship: Ship) -> str:
    return f"{ship.kind}, {ship.L:g} x {ship.B:g} x {ship.T:g} m, C_b {ship.C_b:g}"


if __name__ == "__main__":
    main()
