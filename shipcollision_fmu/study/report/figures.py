"""The figures of a report by Matplotlib. Each is as wide as a phone shows it without making its text too small."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np

from ...show.plots import apply_style, save_figure
from .binned import Binned
from .convergence import Convergence
from .exceedance import Exceedance

__all__ = ["draw_binned", "draw_convergence", "draw_exceedance", "draw_tornado", "save_figure"]

SIZE = (5.0, 3.3)
"""Width and height of a figure [inch]."""
BLUE, BAND, GREY = "#1f5a96", "#b9cfe6", "#5a5a5a"


def _in_style(draw: Callable[..., Any]) -> Callable[..., Any]:
    """A function that draws in the style of all figures, legends included."""

    @wraps(draw)
    def drawn(*arguments: Any) -> Any:
        with apply_style():
            return draw(*arguments)

    return drawn


@_in_style
def draw_exceedance(curve: Exceedance, scale: float, label: str) -> Any:
    """The curve and its band over the value, which is logarithmic too where it spans more than a factor of 30."""
    figure, axes = _make_axes()
    positive = curve.value[curve.value > 0.0]
    is_wide = positive.size > 0 and positive[-1] > 30.0 * positive[0]
    shown = curve.value > 0.0 if is_wide else np.full(curve.value.shape, True)
    x, low, high, share = (values[shown] for values in (curve.value * scale, curve.lower, curve.upper, curve.share))
    axes.fill_between(x, low, high, color=BAND, linewidth=0.0, label="95 % confidence", step="pre")
    axes.plot(x, share, color=BLUE, label="share of cases", drawstyle="steps-pre")
    axes.set(xlabel=label, ylabel="share of cases with at least this", yscale="log", ylim=(0.5 / _count(curve), 1.2))
    if is_wide:
        axes.set_xscale("log")
        axes.set_xlim(max(x.min(), x.max() * 1e-5), x.max() * 1.15)
    axes.legend(loc="lower left")
    return figure


@_in_style
def draw_binned(binned: Binned, scale: float, label: str, input_label: str) -> Any:
    """Median, and the range from the 10 % to the 90 % quantile, over an input."""
    figure, axes = _make_axes()
    x = np.repeat(binned.edges, 2)[1:-1]  # both edges of each bin: a step would end early before an empty bin
    low, middle, high = (np.repeat(quantile, 2) for quantile in scale * binned.quantiles.T)
    axes.fill_between(x, low, high, color=BAND, linewidth=0.0, label="10 % to 90 % of the cases")
    axes.plot(x, middle, color=BLUE, label="median")
    top = np.nanmax(high) if np.isfinite(high).any() else 1.0
    axes.set(xlabel=input_label, ylabel=label, ylim=(0.0, 1.25 * top if top > 0.0 else 1.0))
    axes.legend(loc="upper right", ncols=2)
    return figure


@_in_style
def draw_convergence(found: Convergence, scale: float, label: str) -> Any:
    """Mean and 99 % quantile over the number of cases, one above the other."""
    panels = [("mean", found.mean, found.mean_lower, found.mean_upper)]
    if np.isfinite(found.quantile).any():  # enough cases for it
        panels.append(("99 % quantile", found.quantile, found.quantile_lower, found.quantile_upper))
    figure, axes = _make_axes(len(panels))
    places = np.atleast_1d(axes)
    for place, (name, value, low, high) in zip(places, panels, strict=True):
        place.fill_between(found.n, scale * low, scale * high, color=BAND, linewidth=0.0, label="95 % confidence")
        place.plot(found.n, scale * value, color=BLUE, label=name)
        place.set(ylabel=f"{name}\n{label}", xscale="log")
        place.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0, ncols=2)
    places[-1].set_xlabel("number of cases")
    figure.set_size_inches(SIZE[0], (0.65 + 0.35 * len(panels)) * SIZE[1])
    figure.align_ylabels()
    return figure


@_in_style
def draw_tornado(names: list[str], first_order: np.ndarray[Any, Any], rank: np.ndarray[Any, Any]) -> Any:
    """Bars of both measures for each input, the strongest at the top."""
    figure, axes = _make_axes(1, 2, sharey=True)
    places = np.arange(len(names))[::-1]
    axes[0].barh(places, 100.0 * first_order, color=BLUE, height=0.66)
    axes[0].set(xlabel="share of the variance\nof energy [%]", yticks=places, yticklabels=names)
    axes[0].set_xlim(0.0, max(5.0, 112.0 * float(first_order.max())))
    axes[1].barh(places, rank, color=[BLUE if value > 0.0 else GREY for value in rank], height=0.66)
    axes[1].axvline(0.0, color="black", linewidth=0.7)
    axes[1].set(xlabel="rank correlation\nwith energy", xlim=(-1.0, 1.0))
    for place in axes:
        place.grid(False, axis="y")
    figure.set_size_inches(SIZE[0], 1.1 + 0.27 * max(len(names), 4))
    return figure


def _make_axes(rows: int = 1, columns: int = 1, sharey: bool = False) -> tuple[Any, Any]:
    """A figure, and its axes or an array of them."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, layout="constrained")
    return figure, figure.subplots(rows, columns, sharex=rows > 1, sharey=sharey)


def _count(curve: Exceedance) -> float:
    """Number of cases, of the least share that the curve has."""
    return 1.0 / float(curve.share.min())
