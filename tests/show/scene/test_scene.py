"""The scene says what states.csv and events.json say, within the errors that it states."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shipcollision_fmu.ship.frames import Array, rotation, rotation_from_quaternion
from shipcollision_fmu.show.scene.effects import point_outwards
from shipcollision_fmu.show.scene.hull_ends import BOW, STERN
from shipcollision_fmu.show.scene.resample import choose_samples
from shipcollision_fmu.show.scene.run_folder import STATE
from shipcollision_fmu.show.scene.scene import POSE_ERROR, Scene, Ship, load_scene
from shipcollision_fmu.show.scene.scratches import LINE_ERROR
from shipcollision_fmu.show.scene.surface import Surface, compute_corner_normals, cut_into_bands, drop_flat_triangles
from tests.show.conftest import GUAN2014, MakeRun


@pytest.fixture(scope="module", params=[GUAN2014, "kvlcc2_crossing"])
def folder(request: pytest.FixtureRequest) -> Path:
    """The two shipped runs."""
    return Path(request.getfixturevalue(request.param))


@pytest.fixture(scope="module")
def scene(folder: Path) -> Scene:
    return load_scene(folder)


def rows_of(folder: Path, name: str) -> list[dict[str, str]]:
    with (folder / name).open(newline="") as file:
        return list(csv.DictReader(file))


def outline(ship: Ship) -> Array:
    return ship.hull.vertices


def test_hulls_are_where_states_csv_puts_them(folder: Path, scene: Scene) -> None:
    for ship in scene.ships:
        worst = 0.0
        for row in rows_of(folder, "states.csv"):
            position, q = ship.track.at(float(row["time"]))
            eta = [float(row[f"{ship.name}.{state}"]) for state in STATE[:6]]
            shown = position + outline(ship) @ rotation_from_quaternion(q).T
            wanted = np.array(eta[:3]) + outline(ship) @ rotation(eta[3:]).T
            worst = max(worst, float(np.linalg.norm(shown - wanted, axis=1).max()))
        assert worst <= POSE_ERROR
        assert np.all(np.einsum("ij,ij->i", ship.track.quaternion[1:], ship.track.quaternion[:-1]) > 0.0)


def test_tracks_are_much_shorter_than_the_run(kvlcc2_crossing: Path) -> None:
    for ship in load_scene(kvlcc2_crossing).ships:
        assert len(ship.track.times) < 300  # of 3001


def test_scratches_lie_on_the_hull_beside_the_contact_points(folder: Path, scene: Scene) -> None:
    """At the ends the drawn hull lies within the one that touches; test_hull_shell.py has by how much."""
    events = json.loads((folder / "events.json").read_text())["scratches"]
    assert len(scene.scratches) == 2 * len(events) > 0
    for scratch in scene.scratches:
        ship = scene.ship(scratch.ship)
        hull, B = ship.plating, ship.B
        mesh = trimesh.Trimesh(hull.vertices, hull.triangles, process=False)
        _, distance, _ = trimesh.proximity.closest_point_naive(mesh, scratch.points)
        assert distance.max() < 1e-6
        event = next(event for event in events if event["id"] == scratch.id)
        line = event["b_a" if event["ship_a"] == scratch.ship else "b_b"]
        for time, point in zip(event["time"], line, strict=True):
            drawn = [np.interp(time, scratch.times, scratch.points[:, axis]) for axis in range(3)]
            is_on_a_side = STERN < point[0] / ship.L_oa + 0.5 < 1.0 - BOW
            assert np.linalg.norm(np.subtract(drawn, point)) < (0.1 if is_on_a_side else 0.25 * B) + LINE_ERROR
        assert np.allclose(np.linalg.norm(scratch.normals, axis=1), 1.0)
        assert np.all(np.diff(scratch.times) >= 0.0)


def test_every_scratch_has_its_effects_at_its_first_point_on_the_struck_ship(folder: Path, scene: Scene) -> None:
    """Dust and splash of each; the four of the paper where the energy says so, for tankers from Minorsky's 32.7 MJ."""
    contacts = rows_of(folder, "contacts.csv")
    least = 32.7e6 if scene.ships[0].kind.startswith("tanker") else 50e6
    for event in json.loads((folder / "events.json").read_text())["scratches"]:
        effects = [effect for effect in scene.effects if effect.scratch == event["id"]]
        energy = sum(float(row["energy"]) for row in contacts if int(row["scratch"]) == event["id"])
        burning = {"explosion", "debris", "fire", "smoke"} if energy > least else set()
        assert {effect.kind for effect in effects} == {"dust", "splash"} | burning
        for effect in effects:
            assert effect.ship == "target"  # own runs into her with the bow
            assert np.linalg.norm(effect.point - event["first_point"]["b_b"]) < 0.1
            assert event["start"] <= effect.time <= event["start"] + 1.0
            assert 0.0 < effect.intensity <= 1.0


@pytest.mark.parametrize(
    ("normal", "y", "outwards"),
    [
        ([0.0, 0.0, 1.0], 13.48, [0.0, 1.0, 0.0]),
        ([0.0, 0.0, 1.0], -13.48, [0.0, -1.0, 0.0]),
        ([0.6, 0.8, 0.0], 9.0, [0.6, 0.8, 0.0]),
    ],
)
def test_a_hull_struck_at_the_keel_opens_to_the_side(normal: list[float], y: float, outwards: list[float]) -> None:
    """The camera of the impact stands there; below the bottom it would look from the far side."""
    assert point_outwards(np.array(normal), np.array([0.0, y, 9.5])).tolist() == outwards


def test_barges_that_meet_gently_raise_dust_and_spray_but_do_not_burn(meeting: MakeRun) -> None:
    scene = load_scene(meeting())
    assert scene.events
    assert {effect.kind for effect in scene.effects} == {"dust", "splash"}


def test_curves_end_where_the_books_end(folder: Path, scene: Scene) -> None:
    summary = json.loads((folder / "summary.json").read_text())
    last = {(curve.quantity, curve.ship): float(curve.values[-1]) for curve in scene.signals.curves}
    for name, kinetic in summary["energy"]["after"].items():
        if name != "total":
            assert last["kinetic", name] == pytest.approx(kinetic, rel=1e-12)
    assert last["dissipated", None] == pytest.approx(summary["energy"]["dissipated"], rel=1e-12)
    contacts = rows_of(folder, "contacts.csv")
    assert last["normal", None] == pytest.approx(sum(float(row["impulse_normal"]) for row in contacts))
    final = rows_of(folder, "states.csv")[-1]
    assert last["heading", "own"] == float(final["own.attitude.yaw"])


def test_speed_is_that_of_the_track(folder: Path, scene: Scene) -> None:
    rows = rows_of(folder, "states.csv")
    times = np.array([float(row["time"]) for row in rows])
    for curve in scene.signals.of("speed"):
        track = np.array([[float(row[f"{curve.ship}.position.{axis}"]) for axis in ("north", "east")] for row in rows])
        travelled = float(np.linalg.norm(np.diff(track, axis=0), axis=1).sum())
        speed = np.interp(times, scene.signals.times, curve.values)
        shown = float(np.sum(0.5 * (speed[1:] + speed[:-1]) * np.diff(times)))
        assert shown == pytest.approx(travelled, rel=0.01)


def test_no_contact_is_a_scene_with_two_ships_and_nothing_else(meeting: MakeRun) -> None:
    scene = load_scene(meeting(("speed = 4.0", "speed = 0.5")))
    assert len(scene.ships) == 2
    assert scene.scratches == scene.effects == scene.events == ()


def test_an_obstacle_bears_no_scratch_and_no_effect(meeting: MakeRun) -> None:
    scene = load_scene(meeting(("position = [0.0, 60.0]", "position = [0.0, 22.0]")))
    quay = scene.obstacles[0]
    assert (quay.name, quay.kind, quay.position.tolist()) == ("quay", "quay", [0.0, 22.0, 0.0])
    hit = [event for event in scene.events if event.ship_b == "quay"]
    assert hit
    assert {scratch.ship for scratch in scene.scratches} == {"own", "target"}
    assert {effect.ship for effect in scene.effects} <= {"own", "target"}


def test_thinning_keeps_a_curve_within_its_tolerance_and_no_more_than_it_needs() -> None:
    t = np.linspace(0.0, 10.0, 2001)
    circle = np.column_stack([100 * np.cos(0.3 * t), 100 * np.sin(0.3 * t)])
    rows = choose_samples(t, circle, 0.05)
    again = np.column_stack([np.interp(t, t[rows], circle[rows, axis]) for axis in range(2)])
    assert np.linalg.norm(again - circle, axis=1).max() <= 0.05
    sagitta = 0.05  # of a chord that spans the angle 2 acos(1 - s/R)
    fewest = 3.0 / (2 * np.arccos(1 - sagitta / 100))
    assert fewest <= len(rows) - 1 <= 2.2 * fewest + 4


def test_thinning_keeps_the_moment_of_a_step() -> None:
    t = np.arange(1000) * 0.05
    step = np.where(t < 17.0, 0.0, 1.0)[:, None]
    assert choose_samples(t, step, 0.01).tolist() == [0, 339, 340, 512, 999]


def test_bands_keep_the_surface_and_split_it_at_the_waterline(scene: Scene) -> None:
    hull = scene.ships[0].hull
    parts = cut_into_bands(hull, [-0.5, 0.0])
    area = sum(trimesh.Trimesh(p.vertices, p.triangles, process=False).area for p in parts)
    assert area == pytest.approx(trimesh.Trimesh(hull.vertices, hull.triangles, process=False).area, rel=1e-9)
    for part, (low, high) in zip(parts, [(-99.0, -0.5), (-0.5, 0.0), (0.0, 99.0)], strict=True):
        z = part.vertices[part.triangles][..., 2]
        assert z.min() >= low - 1e-9
        assert z.max() <= high + 1e-9


def test_normals_are_round_along_the_side_and_sharp_at_the_deck(scene: Scene) -> None:
    hull = scene.ships[0].hull
    normals = compute_corner_normals(hull)
    deck = np.isclose(hull.vertices[hull.triangles][..., 2], hull.vertices[:, 2].min()).all(axis=1)
    assert np.allclose(normals[deck], [0.0, 0.0, -1.0])
    assert np.allclose(np.linalg.norm(normals, axis=2), 1.0)


def test_triangles_without_area_are_left_out() -> None:
    vertices = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1e-12, 0.0]])
    triangles = np.array([[0, 1, 2], [0, 1, 3], [0, 1, 1], [0, 2, 4]])
    assert drop_flat_triangles(Surface(vertices, triangles)).triangles.tolist() == [[0, 1, 3]]
