"""Report figures: what they show is the run, with units, and nothing covers anything."""

from __future__ import annotations

import io
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from PIL import Image

from shipcollision_fmu.show.plots import draw_figures, save_figure, write_plots
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.osg.test_osg import in_the_world, states

from .conftest import MakeRun
from .foreign import with_many_collisions, with_names

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@pytest.fixture(scope="module")
def scene(guan2014: Path) -> Scene:
    return load_scene(guan2014)


@pytest.fixture(scope="module")
def plots(scene: Scene) -> dict[str, Figure]:
    return draw_figures(scene)


@pytest.mark.slow
def test_files(scene: Scene, tmp_path: Path) -> None:
    """PNG wide enough for print, SVG that is XML without a date; the same bytes again."""
    paths = write_plots(scene, tmp_path)
    assert sorted(str(path.relative_to(tmp_path)) for path in paths) == [
        f"plots/{name}.{kind}" for name in ("energy", "motion", "track") for kind in ("png", "svg")
    ]
    again = draw_figures(scene)["energy"]
    for path in paths:
        if path.stem == "energy":
            assert path.read_bytes() == save_figure(again, path.suffix[1:])
        if path.suffix == ".svg":
            assert ElementTree.parse(path).getroot().tag.endswith("svg")
            assert b"<dc:date>" not in path.read_bytes()
        else:
            assert Image.open(io.BytesIO(path.read_bytes())).width == 1440


def test_every_axis_has_its_unit(plots: dict[str, Figure]) -> None:
    for figure in plots.values():
        for axes in figure.axes:
            assert axes.get_ylabel().endswith("]")
        assert any("[" in axes.get_xlabel() for axes in figure.axes)


def test_the_axis_of_headings_is_a_compass(plots: dict[str, Figure]) -> None:
    """A ship heads -33.8 deg, as its yaw angle has it."""
    axes = plots["motion"].axes[5]
    assert axes.get_ylabel() == "heading [deg]"
    assert axes.get_ylim()[0] < -30.0
    labels = [float(axes.yaxis.get_major_formatter()(tick)) for tick in (-30.0, 0.0, 370.0)]
    assert labels == [330.0, 0.0, 10.0]


def test_curves_are_those_of_states_csv(guan2014: Path, plots: dict[str, Figure]) -> None:
    rows = states(guan2014)
    panels = {axes.get_ylabel(): axes for axes in plots["motion"].axes}
    for label, column in (("yaw rate [deg/s]", "rate.yaw"), ("roll [deg]", "attitude.roll")):
        curve = panels[label].get_lines()[-1]  # of the target
        drawn_there = np.interp([row["time"] for row in rows], *curve.get_data())
        actual = np.degrees([row[f"target.{column}"] for row in rows])
        assert np.abs(drawn_there - actual).max() < 2e-3 * np.ptp(actual)


def test_outlines_are_the_hulls_at_their_times(guan2014: Path, scene: Scene, plots: dict[str, Figure]) -> None:
    """Each outline's extent against states.csv, at the start and at the end."""
    patches = [patch.get_path().vertices for patch in plots["track"].axes[0].patches]
    for row in (states(guan2014)[0], states(guan2014)[-1]):
        for ship in scene.ships:
            plan = in_the_world(row, ship.name, ship.hull.vertices)[:, :2]
            off = [max(np.abs(p.min(0) - plan.min(0)).max(), np.abs(p.max(0) - plan.max(0)).max()) for p in patches]
            assert min(off) < 0.02


def test_the_legend_covers_no_axes(plots: dict[str, Figure]) -> None:
    for figure in plots.values():
        figure.draw_without_rendering()
        for legend in figure.legends:
            box = legend.get_window_extent()
            assert not any(box.overlaps(axes.get_window_extent()) for axes in figure.axes)


def test_ships_differ_in_line_style_too(plots: dict[str, Figure]) -> None:
    handles = plots["motion"].legends[0].legend_handles
    assert handles[0].get_linestyle() != handles[1].get_linestyle()  # type: ignore[union-attr]  # drawn above


def test_names_are_shown_as_they_are(guan2014: Path, tmp_path: Path) -> None:
    """No formula, nothing hidden, any script, without a warning."""
    names = {"own": "_$x^2$ <script>", "target": "船 50 %"}
    scene = load_scene(with_names(guan2014, tmp_path / "named", names))
    figure = draw_figures(scene)["track"]
    assert [text.get_text() for text in figure.legends[0].get_texts()][:2] == [r" _\$x^2\$ <script>", "船 50 %"]
    assert save_figure(figure, "svg")


def test_no_contact_and_an_obstacle(meeting: MakeRun) -> None:
    scene = load_scene(meeting(("speed = 4.0", "speed = 0.5")))
    track = draw_figures(scene)["track"]
    assert [text.get_text() for text in track.legends[0].get_texts()] == ["own", "target"]
    quay = track.axes[0].patches[0].get_path().vertices
    np.testing.assert_allclose([quay.min(0), quay.max(0)], [[50.0, -100.0], [70.0, 100.0]])  # type: ignore[union-attr]  # drawn above


@pytest.mark.slow
def test_hundred_collisions(guan2014: Path, tmp_path: Path) -> None:
    scene = load_scene(with_many_collisions(guan2014, tmp_path / "many", 100))
    assert draw_figures(scene)["track"].legends[0].get_texts()[-1].get_text() == "first contacts"
