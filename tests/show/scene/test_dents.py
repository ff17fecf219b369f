"""Dents lie where the run has its contacts, and are as large as the energy says; none is there before the contact."""

from __future__ import annotations

from itertools import pairwise
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.show.scene.dents import WIDEST, find_depth
from shipcollision_fmu.show.scene.run_folder import read_run_folder
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.live.javascript import run_javascript

TWO_SIDES = 1.0
"""[m] A contact point lies within an overlap of two hulls, so near the plating of each."""


@pytest.fixture(params=[pytest.param("guan2014", marks=pytest.mark.needs("pybullet")), "kvlcc2_crossing"])
def folder(request: pytest.FixtureRequest) -> Path:
    return Path(request.getfixturevalue(request.param))


@pytest.fixture
def scene(folder: Path) -> Scene:
    return load_scene(folder)


def test_a_cubic_metre_of_steel_is_a_wedge_of_the_formula() -> None:
    """47.2 MJ destroy 1 m3: 0.06 m of plates, over depth^2 tan 30 deg."""
    assert find_depth(47.2e6) == pytest.approx(sqrt(sqrt(3.0) / 0.06), rel=1e-12)
    assert find_depth(4 * 47.2e6) == pytest.approx(2.0 * find_depth(47.2e6), rel=1e-12)
    assert find_depth(0.0) == 0.0


def test_dents_lie_at_the_contact_points(folder: Path, scene: Scene) -> None:
    events = {event.id: event for event in read_run_folder(folder).events.scratches}
    assert scene.dents
    for dent in scene.dents:
        event = events[dent.scratch]
        point = event.first_point.b_a if dent.ship == event.ship_a else event.first_point.b_b
        assert np.linalg.norm(dent.point - point) < TWO_SIDES
        assert dent.time == event.start


def test_the_side_opens_and_the_bow_is_crushed(scene: Scene) -> None:
    """One bow strikes one side in both scenarios: the ship whose contact is farther forward is the one that strikes."""
    first = [dent for dent in scene.dents if dent.scratch == scene.dents[0].scratch]
    bow, side = sorted(first, key=lambda dent: -dent.point[0] / scene.ship(dent.ship).L_pp)
    assert (bow.kind, side.kind) == ("bow", "side")
    assert bow.ship != side.ship
    assert 0.0 < bow.depth < side.depth


def change_energy(folder: Path, changed: Path, share: float) -> Path:
    """A run whose contacts dissipate a share of the energy of another."""
    changed.mkdir()
    for file in folder.iterdir():
        if file.suffix in (".csv", ".json"):
            (changed / file.name).write_bytes(file.read_bytes())
    lines = (folder / "contacts.csv").read_text(encoding="utf-8").splitlines()
    column = lines[0].split(",").index("energy")
    rows = [line.split(",") for line in lines]
    for row in rows[1:]:
        row[column] = repr(share * float(row[column]))
    (changed / "contacts.csv").write_text("".join(",".join(row) + "\n" for row in rows), encoding="utf-8")
    return changed


def test_more_energy_makes_larger_dents(folder: Path, tmp_path: Path) -> None:
    """A run whose contacts dissipate a quarter of the energy has dents of half the size, and of a thousandth none."""
    whole = load_scene(folder).dents
    for share, ratio in ((0.25, 0.5), (1e-6, None)):
        dents = load_scene(change_energy(folder, tmp_path / f"{share}", share)).dents
        if ratio is None:
            assert dents == ()
        else:
            first = min(dents, key=lambda dent: dent.time)
            same = next(dent for dent in whole if (dent.scratch, dent.ship) == (first.scratch, first.ship))
            assert first.depth == pytest.approx(ratio * same.depth)
            assert first.duration <= same.duration


def test_dents_grow_from_their_contact_on() -> None:
    grown = run_javascript(
        "dent_shapes.js", "grownAt",
        "return data.map((now) => grownAt({ time: 60, duration: 2 }, now));",
        [-1e9, 59.9, 60.0, 60.2, 61.0, 61.9, 62.0, 1e9],
    )  # fmt: skip
    assert grown[:3] == [0, 0, 0]
    assert all(later > earlier for earlier, later in pairwise(grown[2:6]))
    assert grown[-2:] == [1, 1]


def test_a_crushed_bow_is_shorter_and_whole_behind() -> None:
    """Corners behind the crush stay; the stem goes back by less than the depth; paint is worn off there alone."""
    places = [[40.0, 5.0, -3.0], [67.0, 3.0, -3.0], [69.0, 1.0, -2.0], [70.0, 0.0, 0.5], [71.5, 0.0, -8.0]]
    crushed = run_javascript(
        "dent_shapes.js", "crush",
        "return data.map((place) => crush(place, { point: [70, 0, 0.5], depth: 3.4 }));", places,
    )  # fmt: skip
    assert crushed[0] == {"place": places[0], "worn": 0}
    for place, one in zip(places[1:], crushed[1:], strict=True):
        assert 0.0 < place[0] - one["place"][0] < 3.4
        assert 0.0 < one["worn"] <= 1.0
    back = [place[0] - one["place"][0] for place, one in zip(places, crushed, strict=True)]
    assert back[3] > back[1]


@pytest.mark.parametrize("share", [1.0, 1000.0])
def test_the_live_page_has_the_same_dents(folder: Path, tmp_path: Path, share: float) -> None:
    """From a collision's first points and its energy, as a live run tells them; a thousandfold is cut in width."""
    scene = load_scene(change_energy(folder, tmp_path / "changed", share))
    first = scene.dents[0]
    assert (first.half_width == WIDEST * scene.ship(first.ship).L_pp) == (share > 1.0)
    event = next(event for event in read_run_folder(folder).events.scratches if event.id == first.scratch)
    collision = {
        "id": event.collision, "time": event.start, "ship_a": event.ship_a, "ship_b": event.ship_b,
        "a": event.first_point.b_a, "b": event.first_point.b_b,
    }  # fmt: skip
    live = run_javascript(
        "live/effects_live.js", "dentsOf", "return dentsOf(data.collision, data.infos, data.energy);",
        {
            "collision": collision,
            "infos": [{"name": ship.name, "L_pp": ship.L_pp} for ship in scene.ships],
            "energy": first.energy,
        },
    )  # fmt: skip
    same = {dent.ship: dent for dent in scene.dents if dent.scratch == first.scratch}
    assert {dent["ship"]: dent["kind"] for dent in live} == {name: dent.kind for name, dent in same.items()}
    for dent in live:
        assert dent["depth"] == pytest.approx(same[dent["ship"]].depth)
        assert dent["half_width"] == pytest.approx(same[dent["ship"]].half_width)
        assert dent["time"] == event.start
