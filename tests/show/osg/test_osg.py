"""scene.osgt against states.csv and events.json, by a parser of its own."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from shipcollision_fmu.show.osg.osg import FIRST_CONTACT, build_osg_files, format_viewer_command, write_osg
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from shipcollision_fmu.show.scene.surface import find_nearest_points
from tests.show.conftest import GUAN2014, MakeRun
from tests.show.foreign import with_many_collisions, with_names

from . import osgt_reader as osgt

Node = osgt.Node
Path_ = tuple[np.ndarray, np.ndarray, np.ndarray]
CM = 0.01
DEEPEST = 0.5
"""A contact point lies within the crush, and what is drawn on the plating [m]."""


class Written(NamedTuple):
    """A run that is shown: its scene, what the file holds, and where it is."""

    scene: Scene
    root: Node
    folder: Path


def written(run: Path, folder: Path) -> tuple[Scene, Node]:
    scene = load_scene(run)
    write_osg(scene, folder)
    return scene, osgt.read(folder / "scene.osgt")


@pytest.fixture(scope="module")
def shipped(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Written]:
    """Scene, written folder and its nodes of a shipped run by its name: they are read, and read once."""

    @cache
    def find(name: str) -> Written:
        folder = tmp_path_factory.mktemp(name)
        scene, root = written(request.getfixturevalue(name), folder)
        return Written(scene, root, folder)

    return find


def named(root: Node, name: str) -> Node:
    found = [node for node in osgt.walk(root) if osgt.name(node) == name]
    assert len(found) == 1, f"{len(found)} nodes are called {name!r}"
    return found[0]


def states(run: Path) -> list[dict[str, float]]:
    with (run / "states.csv").open() as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def in_the_world(row: dict[str, float], ship: str, points: np.ndarray) -> np.ndarray:
    """Points of a ship's b as (east, north, up), by Euler's angles one after the other."""
    roll, pitch, yaw = (row[f"{ship}.attitude.{angle}"] for angle in ("roll", "pitch", "yaw"))
    x, y, z = points.T
    y, z = y * np.cos(roll) - z * np.sin(roll), y * np.sin(roll) + z * np.cos(roll)
    x, z = x * np.cos(pitch) + z * np.sin(pitch), -x * np.sin(pitch) + z * np.cos(pitch)
    x, y = x * np.cos(yaw) - y * np.sin(yaw), x * np.sin(yaw) + y * np.cos(yaw)
    north, east, down = (row[f"{ship}.position.{axis}"] for axis in ("north", "east", "down"))
    return np.column_stack([east + y, north + x, -down - z])


def moved(path: Path_, time: float, points: np.ndarray) -> np.ndarray:
    """Points of a node's frame where OSG puts them: position linear, attitude slerp, v' = v + 2 q x (q x v + w v)."""
    times, places, turns = path
    i = int(np.clip(np.searchsorted(times, time, side="right") - 1, 0, len(times) - 2))
    share = np.clip((time - times[i]) / (times[i + 1] - times[i]), 0.0, 1.0)
    p, q = turns[i], turns[i + 1]
    angle = np.arccos(np.clip(p @ q, -1.0, 1.0))
    turn = p if angle < 1e-9 else (np.sin((1 - share) * angle) * p + np.sin(share * angle) * q) / np.sin(angle)
    v, w = turn[:3], turn[3]
    turned = points + 2 * np.cross(v, np.cross(v, points) + w * points)
    return places[i] + share * (places[i + 1] - places[i]) + turned


def hull(transform: Node) -> np.ndarray:
    """All corners of the ship's geometry, in its node's frame."""
    geode = next(child for child in transform["Children"] if osgt.name(child) == "hull")
    return np.vstack([osgt.vertices(geometry["VertexArray"]) for geometry in geode["Drawables"]])


@pytest.mark.parametrize("run", [GUAN2014, "kvlcc2_crossing"])
def test_outlines_agree_with_states_csv_to_a_centimetre(
    run: str, request: pytest.FixtureRequest, shipped: Callable[[str], Written]
) -> None:
    folder = request.getfixturevalue(run)
    scene, root, _ = shipped(run)
    delay = build_osg_files(scene).delay
    bodies = json.loads((folder / "bodies.json").read_text())["ships"]
    rows = states(folder)
    for ship, body in bodies.items():
        outline = np.array(body["vertices"])
        transform = named(root, ship)
        corners, path = hull(transform), osgt.path(transform)
        drawn = outline[:, [1, 0, 2]] * [1, 1, -1]  # starboard, forward, up
        for corner in drawn[drawn[:, 2] >= 0.0]:  # under water the ends are finer
            assert np.linalg.norm(corners - corner, axis=1).min() < 1e-3, "a corner of the hull is not drawn"
        for row in rows[:: max(1, len(rows) // 25)]:
            off = moved(path, row["time"] + delay, drawn) - in_the_world(row, ship, outline)
            assert np.linalg.norm(off, axis=1).max() < CM


def test_port_stays_port(meeting: MakeRun, tmp_path: Path) -> None:
    """The barge that heads north is struck on her port side, by one that comes from the west."""
    _, root = written(meeting(), tmp_path)
    start = osgt.path(named(root, "own"))[1][0] - osgt.path(named(root, "target"))[1][0]
    assert start[0] < -50.0  # own is west of the target
    sequence = next(c for c in named(root, "target")["Children"] if c["class"] == "osg::Sequence")
    point = osgt.vertices(sequence["Children"][1]["Drawables"][0]["VertexArray"])[0]
    assert point[0] < -9.0  # starboard is positive


def test_scratches_lie_on_the_hull_and_grow_in_time(kvlcc2_crossing: Path, shipped: Callable[[str], Written]) -> None:
    scene, root, _ = shipped("kvlcc2_crossing")
    delay = build_osg_files(scene).delay
    events = {event["id"]: event for event in json.loads((kvlcc2_crossing / "events.json").read_text())["scratches"]}
    for ship in scene.ships:
        sequences = [c for c in named(root, ship.name)["Children"] if c["class"] == "osg::Sequence"]
        assert len(sequences) == 3
        for sequence in sequences:
            event = events[int(osgt.name(sequence).split()[1])]
            empty, *lines = sequence["Children"]
            assert empty["class"] == "osg::Group"
            assert "Children" not in empty
            shared = [line["Drawables"][0]["VertexArray"] for line in lines]
            assert all(array is shared[0] for array in shared)
            counts = [int(line["Drawables"][0]["PrimitiveSetList"][0]["Count"][0]) for line in lines]
            assert counts == sorted(set(counts))
            assert counts[-1] == len(osgt.vertices(shared[0]))
            durations = osgt.numbers(sequence["TimeList"][1:])
            assert len(durations) == len(sequence["Children"])
            shown = np.cumsum(durations[:-1]) - delay  # when each line replaces the one before
            assert (durations >= 0.0).all()
            assert event["start"] - 1e-6 <= shown[0] <= event["start"] + 1.0
            assert sequence["NumRepeats"] == ["1"]
            points = osgt.vertices(shared[0])[:, [1, 0, 2]] * [1, 1, -1]
            on_hull, _ = find_nearest_points(ship.plating, points)
            away = np.linalg.norm(points - on_hull, axis=1)
            if len(points) > 4:  # what is shorter is a dent, a cross, whose arms may leave a round bow
                assert shown[-1] == pytest.approx(event["end"], abs=1e-6 * len(durations))  # each written to six digits
                assert away.max() < 0.16
                assert away.min() > 0.05


def test_the_four_effects_stand_at_the_first_contact_point_of_each_scratch(
    kvlcc2_crossing: Path, shipped: Callable[[str], Written]
) -> None:
    """In the struck ship's own frame, with a particle system drawn beside them: so they move with her."""
    scene, root, folder = shipped("kvlcc2_crossing")
    delay = build_osg_files(scene).delay
    effects = [node for node in osgt.walk(named(root, "target")) if node["class"].startswith("osgParticle::")]
    kinds = ["ExplosionDebrisEffect", "ExplosionEffect", "FireEffect", "SmokeEffect"]
    burning = {effect.scratch for effect in scene.effects if effect.kind == "fire"}
    scratches = [
        s for s in json.loads((kvlcc2_crossing / "events.json").read_text())["scratches"] if s["id"] in burning
    ]
    assert len(scratches) == 2  # of three: the last is gentle
    assert sorted(node["class"][13:] for node in effects) == sorted(kinds * len(scratches))
    drawn = next(c for c in named(root, "target")["Children"] if osgt.name(c) == "particles")["Drawables"]
    for scratch in scratches:
        x, y, z = scratch["first_point"]["b_b"]
        here = [e for e in effects if np.linalg.norm(osgt.numbers(e["Position"]) - [y, x, -z]) < DEEPEST]
        assert sorted(node["class"][13:] for node in here) == kinds
        for node in here:
            late = float(node["StartTime"][0]) - delay - scratch["start"]
            assert 0.0 <= late < 1.0
            assert any(node["ParticleSystem"] is system for system in drawn)
            assert (folder / node["TextureFileName"][0][1:-1]).is_file()


@pytest.mark.usefixtures("guan2014")
def test_the_first_contact_waits_for_the_window_to_open(shipped: Callable[[str], Written]) -> None:
    """In guan2014 the ships touch after 0.45 s."""
    _, root, _ = shipped("guan2014")
    first = min(
        float(node["StartTime"][0]) for node in osgt.walk(root) if node["class"].startswith("osgParticle::Expl")
    )
    assert first == pytest.approx(FIRST_CONTACT)


def test_the_camera_sees_the_contact_and_stays_at_the_end(guan2014: Path, shipped: Callable[[str], Written]) -> None:
    rows = np.loadtxt(shipped("guan2014").folder / "camera.path")
    assert rows.shape[1] == 8
    assert (np.diff(rows[:, 0]) > 0.0).all()
    assert rows[0, 0] == 0.0
    assert rows[-1, 0] > 3600.0  # osgviewer begins the path again at its end
    north, east, down = json.loads((guan2014 / "events.json").read_text())["scratches"][0]["first_point"]["n"]
    touching = rows[np.searchsorted(rows[:, 0], FIRST_CONTACT)]
    v, w = touching[4:7], touching[7]
    ahead = np.array([0.0, 0.0, -1.0])
    ahead = ahead + 2 * np.cross(v, np.cross(v, ahead) + w * ahead)
    sight = np.array([east, north, -down]) - touching[1:4]
    assert ahead @ sight / np.linalg.norm(sight) > np.cos(np.radians(5.0))


def test_an_obstacle_stands_where_the_scenario_puts_it(meeting: MakeRun, tmp_path: Path) -> None:
    """The quay is 200 m along east and 20 m broad, its middle 90 m north and 160 m east."""
    run = meeting(("position = [0.0, 60.0]", "position = [90.0, 160.0]\nheading_deg = 90.0"))
    _, root = written(run, tmp_path)
    quay = named(root, "quay")
    matrix = osgt.numbers(quay["Matrix"]).reshape(4, 4)  # OSG's vectors are rows
    corners = osgt.vertices(quay["Children"][0]["Drawables"][0]["VertexArray"])
    placed = np.hstack([corners, np.ones((len(corners), 1))]) @ matrix
    np.testing.assert_allclose(placed[:, :2].min(axis=0), [60.0, 80.0], atol=CM)
    np.testing.assert_allclose(placed[:, :2].max(axis=0), [260.0, 100.0], atol=CM)
    assert placed[:, 2].max() == pytest.approx(5.0, abs=CM)


def test_no_contact(meeting: MakeRun, tmp_path: Path) -> None:
    """Ships that only pass: no scratch, no effect, and the run begins at once."""
    _, root = written(meeting(("speed = 4.0", "speed = 0.5")), tmp_path)
    kinds = {node["class"] for node in osgt.walk(root)}
    assert "osg::Sequence" not in kinds
    assert not any(kind.startswith("osgParticle") for kind in kinds)
    assert osgt.path(named(root, "own"))[0][0] == 0.0


@pytest.mark.slow
def test_hundred_collisions(guan2014: Path, tmp_path: Path) -> None:
    run = with_many_collisions(guan2014, tmp_path / "many", 100)
    _, root = written(run, tmp_path)
    effects = [node for node in osgt.walk(root) if node["class"].startswith("osgParticle::")]
    assert len(effects) == 400
    assert len([node for node in osgt.walk(root) if node["class"] == "osg::Sequence"]) == 200


def test_a_ship_named_like_a_script(guan2014: Path, tmp_path: Path) -> None:
    name = '<script>alert("1")</script>'
    run = with_names(guan2014, tmp_path / "named", {"own": name, "target": "} Children 1 {"})
    _, root = written(run, tmp_path)
    assert osgt.path(named(root, name))[0].size
    assert osgt.path(named(root, "} Children 1 {"))[0].size


def test_the_same_run_gives_the_same_bytes(guan2014: Path) -> None:
    assert build_osg_files(load_scene(guan2014)).files == build_osg_files(load_scene(guan2014)).files


def test_the_line_for_the_shell_is_quoted() -> None:
    line = format_viewer_command(Path("my runs/a$b"))
    assert line == (
        "OSG_FILE_PATH='my runs/a$b' osgviewer --window 80 80 1280 720 "
        "-p 'my runs/a$b/camera.path' 'my runs/a$b/scene.osgt'"
    )
