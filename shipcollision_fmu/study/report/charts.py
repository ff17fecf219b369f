"""Charts of a report: the numbers, the figure and the text of each, from the columns of a study."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...ship.frames import Array
from ..definition.variables import NUMBERS
from .binned import LEAST_CASES, find_binned_quantiles
from .convergence import find_convergence
from .counts import count_cases
from .exceedance import find_exceedance
from .figures import draw_binned, draw_convergence, draw_exceedance, draw_tornado
from .sensitivity import find_first_order, find_rank_correlation
from .study_table import StudyTable

__all__ = ["Chart", "make_charts"]

LEAST_CONVERGENCE = 20
"""Cases below which there is no chart of convergence and none of sensitivities."""
LEAST_BINS, MOST_BINS = 3, 18
"""Bins of a figure of energy over an input: two bins show no course, and more than 18 are not told apart on a phone."""
MOST_INPUTS = 12
"""Bars of the tornado; weaker inputs are in its file of data."""
DAMAGE = ("damage", "penetration", "breach")
"""Beginnings of the names of columns that get an exceedance curve beside those of energy and impulse."""
LEAST_OF_A_WORD = 2
"""Cases of a word on average. With one, a file of traffic that is run once, it explains all or nothing."""
INPUTS = (*NUMBERS, "own_mass", "target_mass")
WORDS = ("kind", "side", "situation")
TITLES = {"at": "place (at)"}


@dataclass(frozen=True, eq=False)
class Chart:
    """A figure: the name of its files, its heading and caption, its data by column, the Matplotlib figure.

    Without data and figure the caption says why there is none.
    """

    name: str
    title: str
    caption: str
    data: dict[str, Any] | None = None
    figure: Any = None


def make_charts(table: StudyTable) -> Iterator[Chart]:
    """All charts that the columns allow, one by one."""
    scale, unit = _choose_unit(table.energy)
    label = f"energy lost to contact [{unit}]"
    given = _describe_given(table)
    yield _make_exceedance("energy", table.energy, scale, label, given)
    impulse = table.read_numbers("impulse")
    if np.isfinite(impulse).any():
        yield _make_exceedance("impulse", impulse[np.isfinite(impulse)], 1e-6, "impulse on the target [MN s]", given)
    for name, column_unit in table.list_numbers():
        if name.startswith(DAMAGE):
            values = table.read_numbers(name)
            if np.isfinite(values).any():
                known, damage = values[np.isfinite(values)], f"{name} [{column_unit or '-'}]"
                yield _make_exceedance(name, known, 1.0, damage, given)
    inputs = (
        ("angle_deg", "angle", "angle between the headings [deg]"),
        ("at", "place", "place on the target, share of its length [-]\nfrom its stern, -0.5, to its stem, 0.5"),
    )
    for column, name, input_label in inputs:
        yield from _make_binned(table, column, name, input_label, scale, label)
    if len(table.energy) >= LEAST_CONVERGENCE and np.ptp(table.energy) > 0.0:
        yield _make_convergence(table.energy, scale, f"energy [{unit}]", given)
        yield from _make_tornado(table)


def _choose_unit(energy: Array) -> tuple[float, str]:
    return (1e-3, "kJ") if 0.0 < energy.max() < 1e6 else (1e-6, "MJ")


def _describe_given(table: StudyTable) -> str:
    """What the intervals take as given; empty where all that varies is drawn anew for each case."""
    given = ["the sampled ships as drawn"] * table.has_pools + ["the lines of the tables"] * table.has_tables
    return f" The interval holds for {' and '.join(given)}, not for the distribution behind them." if given else ""


def _make_exceedance(name: str, values: Array, scale: float, label: str, given: str) -> Chart:
    title = f"Exceedance of {name.replace('_', ' ')}"
    if np.ptp(values) == 0.0:
        value, unit = f"{values[0] * scale:.4g}", label.partition("[")[2].rstrip("]")
        return Chart(f"exceedance_{name}", title, f"{_begin_alike(len(values))} {value} {unit}: there is no curve.")
    curve = find_exceedance(values)
    caption = (
        f"Of {count_cases(len(values))}, the share that has at least the value on the axis. The band is a pointwise "
        "Clopper-Pearson interval of 95 %. It supposes that the cases are drawn independently of each other." + given
    )
    data = {name: curve.value, "share": curve.share, "lower": curve.lower, "upper": curve.upper}
    return Chart(
        f"exceedance_{name}", title, caption, data, draw_exceedance(curve, scale, label),
    )  # fmt: skip


def _begin_alike(count: int) -> str:
    return "The only case has" if count == 1 else f"All {count_cases(count)} have"


def _make_binned(
    table: StudyTable, column: str, name: str, input_label: str, scale: float, label: str
) -> Iterator[Chart]:
    x = table.read_numbers(column)
    known = np.isfinite(x)
    bins = min(MOST_BINS, int(known.sum()) // (2 * LEAST_CASES))  # half of them would do in a bin
    if bins < LEAST_BINS or np.ptp(x[known]) == 0.0:
        return
    binned = find_binned_quantiles(x[known], table.energy[known], bins)
    data = {
        f"{column}_from": binned.edges[:-1], f"{column}_to": binned.edges[1:], "cases": binned.counts,
        **dict(zip(("energy_q10", "energy_q50", "energy_q90"), binned.quantiles.T, strict=True)),
    }  # fmt: skip
    caption = (
        f"Quantiles of the energy in {len(binned.counts)} bins of equal width. Bins of fewer than {LEAST_CASES} cases "
        "are left empty."
    )
    yield Chart(f"energy_by_{name}", f"Energy by {name}", caption, data, draw_binned(binned, scale, label, input_label))


def _make_convergence(energy: Array, scale: float, label: str, given: str) -> Chart:
    found = find_convergence(energy)
    caption = (
        "Mean and 99 % quantile of the first cases, in the order of their row numbers, each with its interval of 95 %: "
        "1.96 standard errors, and order statistics. A grid is run through in order: only its end counts." + given
    )
    return Chart("convergence", "Convergence", caption, found._asdict(), draw_convergence(found, scale, label))


def _make_tornado(table: StudyTable) -> Iterator[Chart]:
    names, first_order, rank = [], [], []
    for name in (*INPUTS, *WORDS):
        x = table.read_codes(name) if name in WORDS else table.read_numbers(name)
        if not np.isfinite(x).all() or np.ptp(x) == 0.0:
            continue  # the same in every case, or without effect in some
        if name in WORDS and len(x) < LEAST_OF_A_WORD * len(np.unique(x)):
            continue  # what a word adds and what chance adds are not told apart
        names.append(TITLES.get(name, name.removesuffix("_deg").replace("_", " ")))
        first_order.append(find_first_order(x, table.energy, are_words=name in WORDS))
        rank.append(np.nan if name in WORDS else find_rank_correlation(x, table.energy))
    if not names:
        return
    order = np.argsort(-np.array(first_order), kind="stable")
    titles, share, correlation = [names[i] for i in order], np.array(first_order)[order], np.array(rank)[order]
    data = {"input": titles, "variance_share": share, "rank_correlation": correlation}
    caption = (
        "Left: variance of the conditional means, Var(E[energy | input]) / Var(energy), from at most 40 bins of equal "
        "numbers of cases, or from the cases of each word. It is Pearson's correlation ratio with Kelley's correction, "
        "the first-order index of Sobol. "
        "Right: Spearman's rank correlation, which has a sign and misses what rises and falls again; words have none."
    )
    shown = slice(0, MOST_INPUTS)
    figure = draw_tornado(titles[shown], share[shown], np.nan_to_num(correlation[shown]))
    yield Chart("sensitivity", "What the energy depends on", caption, data, figure)
