"""Ships from four numbers beside published turning circles and zigzags.

    python benchmarks/estimated_ships.py

Each ship is estimated from L, B, T, C_b and its kind, and sails at the speed of the published test: 35 deg of rudder to
starboard, deep water at rest, 3 degrees of freedom. Sources and their grades are those of
tests/oracles/published_turning.py; tests/manoeuvring/trials/test_four_numbers.py holds the claim. GM, roll period,
power and stopping distances are compared by estimated_stopping.py.
"""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from tests.manoeuvring.trials.four_numbers import COMPARED, FIGURES, sail_from_four_numbers, zigzag_from_four_numbers

UNITS = {"advance": "L", "tactical diameter": "L", "steady radius": "L", "speed kept": "1"}


def main() -> None:
    """Print figure by figure: published, ours, deviation."""
    table = Table("ship", "figure", "published", "ours", "deviation", "grade", "source")
    for ship in COMPARED:
        ours = {**sail_from_four_numbers(ship), **zigzag_from_four_numbers(ship)}
        for source in ship.sources:
            published = source.figures()
            for name in FIGURES:
                if name not in published:
                    continue
                there, here = published[name], ours[name]
                table.add_row(
                    ship.name, f"{name} [{UNITS.get(name, 'deg')}]".replace("[", "\\["), f"{there:.2f}", f"{here:.2f}",
                    f"{100.0 * (here / there - 1.0):+.0f} %", source.grade, source.name,
                )  # fmt: skip
        table.add_section()
    Console(width=200).print(table)


if __name__ == "__main__":
    main()
