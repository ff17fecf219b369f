"""Ships from four numbers beside published turning circles and zigzags.

    python benchmarks/estimated_ships.py

Each ship is estimated from L, B, T, C_b and its kind, and sails at the speed of the published test: 35 deg of rudder to
starboard, deep water at rest, 3 degrees of freedom. Sources and their grades are those of
tests/oracles/published_turning.py; tests/manoeuvring/trials/test_four_numbers.py holds the claim. GM, roll period,
power and stopping distances are compared by estimated_stopping.py.
"""

from __future__ import annotations

from statistics import mean, stdev

from rich.console import Console
from rich.table import Table

from tests.manoeuvring.trials.four_numbers import (
    COMPARED,
    FIGURES,
    keep_speed_without_limit,
    sail_from_four_numbers,
    zigzag_from_four_numbers,
)

UNITS = {"advance": "L", "tactical diameter": "L", "steady radius": "L", "speed kept": "1"}


WARSHIPS = ("Fletcher class", "Yamato")


def main() -> None:
    """Print figure by figure: published, ours, deviation; and the scatter over the merchant ships."""
    deviations: dict[str, list[float]] = {name: [] for name in FIGURES}
    table = Table("ship", "figure", "published", "ours", "deviation", "grade", "source")
    for ship in COMPARED:
        ours = {**sail_from_four_numbers(ship), **zigzag_from_four_numbers(ship)}
        for source in ship.sources:
            published = source.figures()
            for name in FIGURES:
                if name not in published:
                    continue
                there, here = published[name], ours[name]
                if source is ship.sources[0] and ship.name not in WARSHIPS:
                    deviations[name].append(100.0 * (here / there - 1.0))
                table.add_row(
                    ship.name, f"{name} [{UNITS.get(name, 'deg')}]".replace("[", "\\["), f"{there:.2f}", f"{here:.2f}",
                    f"{100.0 * (here / there - 1.0):+.0f} %", source.grade, source.name,
                )  # fmt: skip
        if "speed kept" in ship.sources[0].figures():
            table.add_row(ship.name, "speed kept, no limit of torque", "", f"{keep_speed_without_limit(ship):.2f}")
        table.add_section()
    console = Console(width=200)
    console.print(table)
    for name, values in deviations.items():
        console.print(
            f"{name}: mean {mean(values):+.0f} %, standard deviation {stdev(values):.0f} %, {len(values)} ships"
        )


if __name__ == "__main__":
    main()
