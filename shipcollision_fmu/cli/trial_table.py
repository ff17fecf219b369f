"""What `shipcollision trial` prints: the figures of a trial as a table, and its track as CSV."""

from __future__ import annotations

from dataclasses import fields

from ..manoeuvring.trials.steady_course import SteadyCourse
from ..manoeuvring.trials.trial import Figure, Moment, Trial
from .table import WordTable, make_table

__all__ = ["format_track_csv", "make_trial_table"]

SHORTEST = 100.0
"""[m] IMO's standards apply to ships of this length and more."""


def make_trial_table(start: SteadyCourse, trial: Trial) -> WordTable:
    """Table of a trial's figures with IMO's limits."""
    rows = make_table(
        "figure", ">value", "unit", ">IMO limit", "",
        title=f"{start.ship.name}, {trial.title}: approach at {start.speed:g} m/s with {start.rev_per_s:.4g} rev/s, "
        f"L = {start.ship.L_pp:g} m",
    )  # fmt: skip
    for figure in trial.figures.values():
        limit = "" if figure.limit is None else f"{figure.limit:.4g}"
        rows.add_row(figure.name, f"{figure.value:.3f}", figure.unit, limit, _judge(start, figure))
    return rows


def format_track_csv(trial: Trial) -> str:
    """CSV with a row per step in SI units and radians; floats read back as the same double."""
    names = [f.name for f in fields(Moment)]
    rows = (",".join(repr(getattr(moment, name)) for name in names) for moment in trial.track)
    return "\n".join([",".join(names), *rows]) + "\n"


def _judge(start: SteadyCourse, figure: Figure) -> str:
    if figure.within is None:
        return "no verdict" if figure.doubtful and figure.limit is not None else ""
    verdict = "kept" if figure.within else "NOT KEPT"
    if not figure.within and figure.waived is not None and figure.value <= figure.waived:
        verdict = f"NOT KEPT; {figure.waived:g} may be allowed to large displacements"
    return verdict if start.ship.L_pp >= SHORTEST else f"{verdict} (meant for {SHORTEST:g} m and more)"
