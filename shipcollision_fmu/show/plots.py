"""Figures for a report by Matplotlib: track, motions, energy and impulse, as PNG and SVG.

    track     in plan: the ships' outlines at intervals and at the first contact, paths of CO, points of contact
    motion    speed, surge and sway, yaw rate, roll, heading, clearance over time
    energy    kinetic energy per ship, dissipated energy; cumulative impulses of contact

Vertical lines mark the beginnings of collisions. Ships differ in colour and in line style, so that the figures can be
read in grey and with any colour vision. The same run gives the same bytes. Matplotlib is imported when needed.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..files import IN_PLACE, write_file
from ..ship.frames import Array, rotation_from_quaternion
from .extras import require
from .scene.palette import choose_topsides
from .scene.plan import find_convex_hull, find_plan
from .scene.scene import Scene, Ship
from .scene.signals import Signal

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

__all__ = ["FOLDER", "apply_style", "draw_figures", "save_figure", "write_plots"]

FOLDER = "plots"
WIDTH = 7.2
"""Width of a figure [inch]: two columns of a journal."""
OUTLINES = 7
"""Number of outlines of each ship along its path, with the first and the last."""
STYLES = ("-", (0, (5, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1.2, 1.2)))
"""Line styles of the first, second ... ship."""
GREY = "#5a5a5a"
DEGREE = 180.0 / np.pi
_STYLE: dict[Any, Any] = {
    "font.size": 8.5, "axes.labelsize": 8.5, "axes.titlesize": 9.0, "xtick.labelsize": 8.0, "ytick.labelsize": 8.0,
    "legend.fontsize": 8.5, "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.7,
    "lines.linewidth": 1.4, "axes.grid": True, "grid.linewidth": 0.4, "grid.color": "#d9d9d9", "axes.axisbelow": True,
    "legend.frameon": False, "savefig.dpi": 200, "svg.hashsalt": "shipcollision-fmu", "svg.fonttype": "path",
    "figure.constrained_layout.h_pad": 0.06, "figure.constrained_layout.w_pad": 0.06,
}  # fmt: skip


def write_plots(scene: Scene, folder: Path) -> list[Path]:
    """Write the figures into `folder`/plots; returns the paths. Raises HostError, also without Matplotlib."""
    require("plots", "a figure")
    paths = []
    for name, figure in draw_figures(scene).items():
        paths += [
            write_file(folder / FOLDER / f"{name}.{kind}", save_figure(figure, kind), IN_PLACE)
            for kind in ("png", "svg")
        ]
    return paths


def draw_figures(scene: Scene) -> dict[str, Figure]:
    """The figures by name."""
    from matplotlib.figure import Figure

    made = {}
    with apply_style():
        for name, draw in (("track", _draw_track), ("motion", _draw_motion), ("energy", _draw_energy)):
            made[name] = Figure(layout="constrained")
            draw(made[name], scene)
    return made


@contextmanager
def apply_style() -> Iterator[None]:
    """A context in which Matplotlib draws in the style of all figures."""
    import matplotlib

    with matplotlib.rc_context(_STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing from", UserWarning)  # a name may be in any script
        yield


def save_figure(figure: Figure, kind: str) -> bytes:
    """The figure's file of that kind, "png" or "svg"; the same bytes for the same figure."""
    data = io.BytesIO()
    with apply_style():
        figure.savefig(data, format=kind, metadata={"Date": None} if kind == "svg" else {"Software": None})
    return data.getvalue()


def _escape(name: str) -> str:
    """A name as Matplotlib shows it unchanged: no formula, no leading underscore, which would hide it in a legend."""
    plain = "".join(c if c.isprintable() else " " for c in name).replace("$", r"\$")
    return f" {plain}" if plain.startswith("_") else plain


def _choose_look(scene: Scene, ship: str | None) -> dict[str, Any]:
    """Colour and style of a ship's lines, of black for all ships together."""
    if ship is None:
        return {"color": "black", "linestyle": "-"}
    index = [known.name for known in scene.ships].index(ship)
    return {"color": choose_topsides(index).colour, "linestyle": STYLES[index % len(STYLES)]}


# -- seen from above ----------------------------------------------------------------------------------


def _draw_track(figure: Figure, scene: Scene) -> None:
    from matplotlib.lines import Line2D

    axes = figure.add_subplot()
    for obstacle in scene.obstacles:
        axes.fill(*find_plan(obstacle)[:, ::-1].T, facecolor="#c9c5bc", edgecolor=GREY, linewidth=0.6)
    first = min((event.time for event in scene.events), default=None)
    times = np.linspace(scene.start, scene.end, OUTLINES)
    for ship in scene.ships:
        look = _choose_look(scene, ship.name)
        axes.plot(ship.track.position[:, 1], ship.track.position[:, 0], linewidth=0.9, **look)
        for i, time in enumerate(times):
            share = 0.25 + 0.6 * i / (len(times) - 1)
            axes.fill(
                *_find_outline(ship, time)[:, ::-1].T, fill=False, edgecolor=look["color"], linewidth=0.7, alpha=share
            )
        if first is not None:
            outline = _find_outline(ship, first)[:, ::-1].T
            axes.fill(*outline, facecolor=look["color"], alpha=0.22, linewidth=0.0)
            axes.fill(*outline, fill=False, edgecolor=look["color"], linewidth=1.2)
    points = np.array([event.point for event in scene.events]).reshape(-1, 3)
    axes.plot(points[:, 1], points[:, 0], "*", color="black", markersize=8, markeredgewidth=0.0, zorder=4)
    axes.set(xlabel=f"east [m]\n{_describe_times(scene, first)}", ylabel="north [m]")
    axes.set_aspect("equal", adjustable="datalim")
    handles = [Line2D([], [], **_choose_look(scene, ship.name)) for ship in scene.ships]
    labels = [_escape(ship.name) for ship in scene.ships]
    if len(points):
        handles.append(Line2D([], [], linestyle="", marker="*", color="black", markersize=8, markeredgewidth=0.0))
        labels.append("first contact" if len(points) == 1 else "first contacts")
    figure.legend(handles, labels, loc="outside upper center", ncols=4)
    figure.set_size_inches(WIDTH, _measure_height(axes))


def _describe_times(scene: Scene, first: float | None) -> str:
    every = (scene.end - scene.start) / (OUTLINES - 1)
    told = f"outlines every {every:.3g} s from t = {scene.start:g} s to {scene.end:g} s"
    return told if first is None else f"{told}; filled: first contact, t = {first:.4g} s"


def _measure_height(axes: Axes) -> float:
    """Of a figure in which the plan fills the width, within what a page allows [inch]."""
    box = axes.dataLim
    return float(np.clip(1.0 + (WIDTH - 0.8) * box.height / max(box.width, 1e-9), 3.2, 8.0))


def _find_outline(ship: Ship, time: float) -> Array:
    """Outline of a ship in plan, (k, 2) north and east [m]: the convex hull of its vertices."""
    position, quaternion = ship.track.at(time)
    return find_convex_hull((position + ship.hull.vertices @ rotation_from_quaternion(quaternion).T)[:, :2])


# -- over time ----------------------------------------------------------------------------------------


def _draw_motion(figure: Figure, scene: Scene) -> None:
    panels: tuple[tuple[str, str, float], ...] = (
        ("speed", "speed [m/s]", 1.0), ("yaw_rate", "yaw rate [deg/s]", DEGREE),
        ("surge", "surge velocity [m/s]", 1.0), ("roll", "roll [deg]", DEGREE),
        ("sway", "sway velocity [m/s]", 1.0), ("heading", "heading [deg]", DEGREE),
    )  # fmt: skip
    grid = figure.subplots(3, 2, sharex=True)
    for axes, (quantity, label, scale) in zip(grid.flat, panels, strict=True):
        _draw_curves(axes, scene, scene.signals.of(quantity), label, scale)
    grid[2, 1].yaxis.set_major_formatter(_format_heading)
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    figure.align_ylabels()
    _draw_legend(figure, scene)
    figure.set_size_inches(WIDTH, 6.0)


def _format_heading(value: float, position: object = None) -> str:
    """A mark on an axis of headings [deg], whose curve counts whole turns: 0 to 360."""
    return f"{round(value, 6) % 360.0:g}"


def _draw_energy(figure: Figure, scene: Scene) -> None:
    grid = figure.subplots(2, 2, sharex=True)
    signals = scene.signals
    _draw_curves(grid[0, 0], scene, signals.of("kinetic"), "kinetic energy [MJ]", 1e-6)
    _draw_curves(grid[0, 1], scene, signals.of("dissipated"), "energy dissipated\nin contact [MJ]", 1e-6)
    _draw_curves(grid[1, 0], scene, signals.of("clearance"), "clearance [m]", 1.0)
    both = (*signals.of("normal"), *signals.of("tangential"))
    lines = _draw_curves(grid[1, 1], scene, both, "impulse, summed [MN s]", 1e-6, styles=("-", (0, (4, 2))))
    grid[1, 1].legend(
        lines,
        [curve.quantity for curve in both],
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncols=2,
        borderaxespad=0.2,
    )
    for axes in grid[-1]:
        axes.set_xlabel("time [s]")
    figure.align_ylabels()
    _draw_legend(figure, scene)
    figure.set_size_inches(WIDTH, 4.6)


def _draw_curves(
    axes: Axes, scene: Scene, curves: tuple[Signal, ...], label: str, scale: float, styles: tuple[Any, ...] = ()
) -> list[Line2D]:
    """Draw curves of one quantity over time, and the beginnings of collisions; returns the curves' lines."""
    lines = []
    for event in scene.events:
        axes.axvline(event.time, color=GREY, linewidth=0.6, alpha=max(0.15, 1.0 / (1 + 0.2 * len(scene.events))))
    for i, curve in enumerate(curves):
        look = _choose_look(scene, curve.ship)
        if styles:
            look["linestyle"] = styles[i]
        lines += axes.plot(scene.signals.times, scale * curve.values, **look)
    axes.set_ylabel(label)
    axes.set_xlim(scene.start, scene.end)
    _make_room(axes)
    return lines


def _make_room(axes: Axes) -> None:
    """A constant curve is drawn in the middle of its axis, not as noise of the last digit."""
    low, high = axes.get_ylim()
    middle = 0.5 * (low + high)
    least = max(1e-3 * abs(middle), 1e-3)
    if high - low < least:
        axes.set_ylim(middle - least, middle + least)


def _draw_legend(figure: Figure, scene: Scene) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], **_choose_look(scene, ship.name)) for ship in scene.ships]
    labels = [_escape(ship.name) for ship in scene.ships]
    if scene.events:
        handles.append(Line2D([], [], color=GREY, linewidth=0.6))
        labels.append("a collision begins")
    figure.legend(handles, labels, loc="outside upper center", ncols=4)
