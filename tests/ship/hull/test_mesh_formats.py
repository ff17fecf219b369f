"""Formats of mesh files: the same solid from each, with what it states of itself; cut short or torn apart, refused."""

from __future__ import annotations

import json
import sys
from base64 import b64encode
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from shipcollision_fmu.errors import HostError, ShipError
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.tables.hull import HullTable
from tests.ship.hull.mesh_files import BOX, DEPTH, L_OA, SHIP, TO_FILE, B, T, obj, stl

Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""From forward, port, up to a file whose +y points up, as modelling programs export it: +x forward, +z to starboard."""


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def read(path: Path, **keys: Any) -> HullMesh:
    return build_mesh_hull(L_OA, B, T, HullTable(shape="mesh", depth=DEPTH, file=str(path), **keys))


def is_same(got: HullMesh, expected: HullMesh) -> bool:
    """Whether both have the same vertices, up to the rounding of 32 bits, in any order."""
    apart = np.linalg.norm(got.vertices[:, None] - expected.vertices, axis=2)
    return len(got.vertices) == len(expected.vertices) and max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-4


def scene(vertices: np.ndarray, triangles: np.ndarray) -> trimesh.Scene:
    """The mesh in two halves, each moved to its place by the transformation of its node."""
    built = trimesh.Scene()
    half = len(triangles) // 2
    for name, faces, shift in (("fore", triangles[:half], 7.0), ("aft", triangles[half:], -3.0)):
        mesh = trimesh.Trimesh(vertices - [shift, 0.0, 0.0], faces, process=False)
        place = trimesh.transformations.translation_matrix([shift, 0.0, 0.0])
        built.add_geometry(mesh, node_name=name, geom_name=name, transform=place)
    return built


def dae(unit: float, up: str) -> bytes:
    """COLLADA 1.4.1 (sections 5 and 8): a mesh of BOX whose axis `up` (Y or Z) points up, in units of `unit` metres."""
    v = BOX.vertices * TO_FILE @ (Y_UP.T if up == "Y" else np.eye(3)) / unit
    numbers = " ".join(f"{x:.9g}" for x in v.ravel())
    corners = " ".join(map(str, BOX.triangles.ravel()))
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>
    <unit name="u" meter="{unit}"/><up_axis>{up}_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="{v.size}">{numbers}</float_array><technique_common>
      <accessor source="#a" count="{len(v)}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="{len(BOX.triangles)}"><input semantic="VERTEX" source="#v" offset="0"/>
      <p>{corners}</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
  </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
""".encode()


def embed_buffer(glb: bytes) -> bytes:
    """A .gltf with its buffer inside, from a .glb (glTF 2.0, section 4.4)."""
    size = int.from_bytes(glb[12:16], "little")
    tree, data = json.loads(glb[20 : 20 + size]), glb[28 + size :]
    uri = f"data:application/octet-stream;base64,{b64encode(data).decode()}"
    return json.dumps({**tree, "buffers": [{"byteLength": len(data), "uri": uri}]}).encode()


@pytest.mark.parametrize("kind", ["glb", "gltf", "dae"])
def test_a_scene_is_read_with_its_transformations(tmp_path: Path, kind: str) -> None:
    """glTF has +y upwards; what trimesh writes as DAE states +y, too."""
    path = tmp_path / f"hull.{kind}"
    built = scene(SHIP.vertices * TO_FILE @ Y_UP.T, SHIP.triangles)
    content = {
        "glb": lambda: built.export(file_type="glb"),
        "gltf": lambda: embed_buffer(built.export(file_type="glb")),
        "dae": lambda: trimesh.exchange.dae.export_collada(built.to_mesh()),
    }
    path.write_bytes(content[kind]())
    got = read(path)
    assert is_same(got, SHIP)
    assert got.volume == pytest.approx(SHIP.volume, rel=1e-6)
    assert len(got.parts) == 1


@pytest.mark.parametrize(("unit", "up"), [(1.0, "Z"), (0.01, "Z"), (0.0254, "Y")])
def test_a_dae_file_states_its_unit_and_its_upward_axis(tmp_path: Path, unit: float, up: str) -> None:
    path = tmp_path / "hull.dae"
    path.write_bytes(dae(unit, up))
    assert is_same(read(path), BOX)


def test_keys_go_before_what_a_file_states(tmp_path: Path) -> None:
    """A file that states metres and z, and holds millimetres and y."""
    path = tmp_path / "hull.dae"
    path.write_bytes(dae(0.001, "Y").replace(b'meter="0.001"', b'meter="1"').replace(b"Y_UP", b"Z_UP"))
    with pytest.raises(ShipError, match=r'looks like millimetres: set unit = "mm"'):
        read(path)
    with pytest.raises(ShipError, match=r'set forward = "\+x" or "-x" and up = "\+y" or "-y"'):
        read(path, unit="mm")
    assert is_same(read(path, unit="mm", up="+y"), BOX)


def test_forward_along_the_upward_axis_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "hull.dae"
    path.write_bytes(dae(1.0, "Y"))
    with pytest.raises(ShipError, match=r'hull.dae: up is "\+y" in this file, and forward = "-y" lies along the same'):
        read(path, forward="-y")


def test_a_gltf_with_its_vertices_in_another_file_is_refused(tmp_path: Path) -> None:
    tree = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "hull.bin"}]}
    (tmp_path / "hull.gltf").write_text(json.dumps(tree))
    with pytest.raises(
        ShipError, match=r"hull.gltf: has its vertices in another file, hull.bin: save the hull as one file"
    ):
        read(tmp_path / "hull.gltf")


def test_a_missing_reader_of_dae_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "hull.dae").write_bytes(dae(1.0, "Z"))
    monkeypatch.setitem(sys.modules, "collada", None)
    with pytest.raises(HostError, match=r"collada cannot be imported .* pip install 'shipcollision-fmu\[mesh\]'"):
        read(tmp_path / "hull.dae")


# -- cut short --------------------------------------------------------------------------------------


def binary_stl() -> bytes:
    """Header, count, and per triangle a normal, three corners and two bytes."""
    triangles = (BOX.vertices * TO_FILE)[BOX.triangles]
    facets = np.zeros(len(triangles), dtype=[("corners", "<f4", (4, 3)), ("attribute", "<u2")])
    facets["corners"][:, 1:] = triangles
    return b"solid, as many programs begin".ljust(80, b"\0") + len(triangles).to_bytes(4, "little") + facets.tobytes()


def glb() -> bytes:
    mesh = trimesh.Trimesh(BOX.vertices * TO_FILE @ Y_UP.T, BOX.triangles, process=False)
    return bytes(mesh.export(file_type="glb"))


WHOLE: dict[str, Callable[[], bytes]] = {
    "text.stl": lambda: stl(BOX.vertices * TO_FILE, BOX.triangles).encode(),
    "binary.stl": binary_stl,
    "hull.glb": glb,
    "hull.dae": lambda: dae(1.0, "Z"),
    "hull.obj": lambda: obj(BOX.vertices * TO_FILE, BOX.triangles).encode(),
}
LOST = {
    "text.stl": (100, r"it does not end with endsolid"),
    "binary.stl": (30, r"its 12 triangles take 684 bytes, and it has 654"),
    "hull.glb": (50, r"its header states \d+ bytes, and it has \d+"),
    "hull.dae": (40, r"it does not end with </COLLADA>"),
    "hull.obj": (3, r"its last line is 'f 5 8'"),
}


@pytest.mark.parametrize("name", WHOLE)
def test_a_file_that_is_cut_short_is_refused_as_such(tmp_path: Path, name: str) -> None:
    """And not as a hull with holes."""
    path, whole = tmp_path / name, WHOLE[name]()
    path.write_bytes(whole)
    assert is_same(read(path), BOX)
    lost, said = LOST[name]
    path.write_bytes(whole[:-lost])
    with pytest.raises(ShipError, match=rf"{name}: is cut short: {said}: export it again$"):
        read(path)
