"""A trial's figures as a table for people, and its track as CSV."""

from __future__ import annotations

from dataclasses import fields

from rich.table import Table

from ..manoeuvring.trials.steady_course import Approach
from ..manoeuvring.trials.trial import Figure, Moment, Trial
from .run_table import table

__all__ = ["figures", "track_csv"]

SHORTEST = 100.0
"""[m] IMO's standards are for ships of this length and more."""


def figures(start: Approach, trial: Trial) -> Table:
    """The figures of a trial with IMO's limits beside them."""
    rows = table(
        "figure", ">value", "unit", ">IMO limit", "",
        title=f"{start.ship.name}, {trial.title}: approach at {start.speed:g} m/s with {start.rev_per_s:.4g} rev/s, "
        f"L = {start.ship.L_pp:g} m",
    )  # fmt: skip
    for figure in trial.figures.values():
        limit = "" if figure.limit is None else f"{figure.limit:.4g}"
        rows.add_row(figure.name, f"{figure.value:.3f}", figure.unit, limit, _verdict(start, figure))
    return rows


def track_csv(trial: Trial) -> str:
    """Header and a row per step, SI units and radians; floats so that reading them back gives the same double."""
    names = [f.name for f in fields(Moment)]
    rows = (",".join(repr(getattr(moment, name)) for name in names) for moment in trial.track)
    return "\n".join([",".join(names), *rows]) + "\n"


def _verdict(start: Approach, figure: Figure) -> str:
    if figure.within is None:
        return ""
    kept = "kept" if figure.within else "NOT KEPT"
    if not figure.within and figure.waived is not None and figure.value <= figure.waived:
        kept = f"NOT KEPT; {figure.waived:g} may be allowed to large displacements"
    return kept if start.ship.L_pp >= SHORTEST else f"{kept} (meant for {SHORTEST:g} m and more)"
