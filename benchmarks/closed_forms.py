"""The energy of the simulation as a share of what closed forms of the literature give, over the same 2 000 cases.

    python benchmarks/closed_forms.py

Prints both tables of docs/validation.md as Markdown, of the shipped study `closed_forms`; the page is
held to them by tests/docs/test_closed_forms.py.
"""

from __future__ import annotations

import click
import numpy as np

from docs.generate.markdown import table
from shipcollision_fmu import load_ship, read_study
from shipcollision_fmu.study.closed_forms.comparison import Spread, compare_by_angle, compare_by_knowledge
from shipcollision_fmu.study.rows.compute import compute_rows

__all__ = ["make_tables"]


def make_tables() -> tuple[str, str]:
    """The table by angle, and that by what is known of the contact."""
    study = read_study("closed_forms")
    encounters = compute_rows(study, 0, study.rows).encounters
    names = sorted({name for role in ("own", "target") for name in encounters.column(f"{role}_ship").to_pylist()})
    by_angle = [
        (f"{of.least:.0f} to {of.most:.0f}", "sticks" if of.sticks else "slides", str(of.pedersen_zhang.cases),
         _cell(of.minorsky), _cell(of.popov), _cell(of.pedersen_zhang))
        for of in compare_by_angle(encounters)
    ]  # fmt: skip
    by_knowledge = [
        (of.words, str(of.all.cases), _cell(of.all), _cell(of.stick), _cell(of.slide))
        for of in compare_by_knowledge(encounters, {name: load_ship(name) for name in names})
    ]
    return (
        table(("angle [deg]", "contact", "cases", "Minorsky", "Popov", "Pedersen and Zhang"), by_angle),
        table(("Pedersen and Zhang with", "cases", "all", "sticks", "slides"), by_knowledge),
    )


def _cell(of: Spread) -> str:
    return "" if np.isnan(of.median) else f"{of.median:.2f} ({of.low:.2f} to {of.high:.2f})"


if __name__ == "__main__":
    click.echo("\n".join(make_tables()))
