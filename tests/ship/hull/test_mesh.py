"""A hull from a user's mesh file: the same solid as ours, refused with the reason, cut alike every time."""

from __future__ import annotations

import hashlib
import importlib.util
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import HostError, ShipError
from shipcollision_fmu.ship.hull import convex_parts
from shipcollision_fmu.ship.hull.convex import enclosed_volume, half_spaces, is_convex
from shipcollision_fmu.ship.hull.file_frame import UNITS
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.loading.library import find_models, load_ship
from shipcollision_fmu.ship.tables.hull import HullTable
from tests.ship.hull.mesh_files import BOX, DEPTH, L_OA, SHIP, TO_FILE, B, T, obj, ours, stl
from tests.ship_files import ship_toml

FLARED = ours(shape="parametric", bow_length=40.0, stern_length=50.0, flare_deg=8.0)

Read = Callable[..., HullMesh]


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Writes a hull's vertices, changed, and its triangles into a file, and reads it as a ship's hull."""

    def go(
        hull: HullMesh = BOX, change: Callable[[np.ndarray], np.ndarray] = lambda v: v, kind: str = "obj",
        triangles: np.ndarray | None = None, **keys: Any,
    ) -> HullMesh:  # fmt: skip
        path = tmp_path / f"hull.{kind}"
        faces = hull.triangles if triangles is None else triangles
        path.write_text({"obj": obj, "stl": stl}[kind](change(hull.vertices * TO_FILE), faces))
        return build_mesh_hull(L_OA, B, T, HullTable(shape="mesh", depth=DEPTH, file=str(path), **keys))

    return go


def rows(points: np.ndarray) -> list[tuple[float, ...]]:
    return sorted(map(tuple, (np.round(points, 6) + 0.0).tolist()))


# -- the same solid ---------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["obj", "stl"])
@pytest.mark.parametrize("hull", [BOX, SHIP], ids=["box", "ship"])
def test_a_convex_hull_comes_back_as_its_own_part(read: Read, hull: HullMesh, kind: str) -> None:
    got = read(hull, kind=kind)
    assert rows(got.vertices) == rows(hull.vertices)
    assert got.volume == pytest.approx(hull.volume, rel=1e-12)
    assert len(got.parts) == 1
    assert rows(got.parts[0]) == rows(hull.vertices)
    assert (got.volume_error, got.bulge) == (0.0, 0.0)


@pytest.mark.parametrize("unit", UNITS)
def test_units(read: Read, unit: str) -> None:
    assert rows(read(SHIP, lambda v: v / UNITS[unit], unit=unit).vertices) == rows(SHIP.vertices)


def test_scale_is_metres_per_unit(read: Read) -> None:
    assert rows(read(SHIP, lambda v: v / 45.714, scale=45.714).vertices) == rows(SHIP.vertices)


AXES = [("+x", "+z"), ("-x", "+z"), ("+y", "+z"), ("-y", "-z"), ("+z", "+y"), ("+x", "-y")]


@pytest.mark.parametrize(("forward", "up"), AXES)
def test_axes(read: Read, forward: str, up: str) -> None:
    """The file's axes turned, never mirrored: starboard is forward x up."""
    unit = {sign + axis: s * e for axis, e in zip("xyz", np.eye(3), strict=True) for sign, s in (("+", 1), ("-", -1))}
    to_file = np.array([unit[forward], np.cross(unit[up], unit[forward]), unit[up]])  # rows: forward, port, up
    lopsided = HullMesh(SHIP.vertices + [0.0, 0.2, 0.0], SHIP.triangles, ())
    got = read(lopsided, lambda v: v @ to_file, forward=forward, up=up)
    assert rows(got.vertices) == rows(lopsided.vertices)
    assert got.volume == pytest.approx(SHIP.volume)


def test_origin_is_in_the_files_own_coordinates_and_unit(read: Read) -> None:
    got = read(SHIP, lambda v: (v + [100.0, 0.0, 10.0]) * 1000, unit="mm", origin=[100e3, 0.0, 10e3])
    assert rows(got.vertices) == rows(SHIP.vertices)


def test_a_mesh_inside_out_is_turned(read: Read) -> None:
    assert read(triangles=BOX.triangles[:, ::-1]).volume == pytest.approx(L_OA * B * DEPTH)


def test_corners_that_a_file_repeats_are_joined_and_collapsed_triangles_dropped(read: Read) -> None:
    n = len(BOX.vertices)
    twice = HullMesh(np.vstack([BOX.vertices, BOX.vertices]), BOX.triangles, ())
    triangles = np.vstack([BOX.triangles[:6], BOX.triangles[6:] + n, [[0, n, 1]]])
    got = read(twice, triangles=triangles)
    assert (len(got.vertices), len(got.triangles)) == (n, len(BOX.triangles))


# -- refusals ---------------------------------------------------------------------------------------


def swapped_one(triangles: np.ndarray) -> np.ndarray:
    changed = triangles.copy()
    changed[0] = changed[0][::-1]
    return changed


def split_edge() -> tuple[HullMesh, np.ndarray]:
    """A triangle without area along an edge: closed, but with a face that has no normal."""
    a, b, c = BOX.triangles[0]
    middle = len(BOX.vertices)
    vertices = np.vstack([BOX.vertices, 0.5 * (BOX.vertices[a] + BOX.vertices[b])])
    return HullMesh(vertices, BOX.triangles, ()), np.vstack(
        [BOX.triangles[1:], [[a, middle, c], [middle, b, c], [a, b, middle]]]
    )


REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"triangles": BOX.triangles[1:]}, r"hull.obj: is not closed: 3 open edges around 1 hole, the largest 36.06 "
     r"across around \(.*\) in the file: set fill_holes = true, or convex_hull = true, or close deck"),
    ({"triangles": swapped_one(BOX.triangles)}, r"3 edges lie between faces of which one looks inwards, one at .*: ma"),
    ({"change": lambda v: v * 1000}, r"is 200000 m long with unit = \"m\", and L_oa = 200 m: looks like millimetres: "
     r"set unit = \"mm\"$"),
    ({"change": lambda v: v / 0.3048}, r"is 656.168 m long .*looks like feet: set unit = \"ft\"$"),
    ({"unit": "mm"}, r"is 0.2 m long with unit = \"mm\", and L_oa = 200 m: looks like metres: set unit = \"m\"$"),
    ({"scale": 7.0}, r"is 1400 m long with scale = 7, .*looks like metres"),
    ({"change": lambda v: v * 1.7}, r"is 340 m long .*set unit or scale, or correct"),
    ({"forward": "+y"}, r"file's axes are x 200 m, y 30 m, z 20 m; with forward = \"\+y\" and up = \""
     r"\+z\" it is 30 m long and 200 m broad, not L_oa = 200 and B = 30 m: set forward = \"\+x\" or \"-x\" and up"),
    ({"up": "+y"}, r"200 m long and 20 m broad, .* set forward = .* and up = \"\+z\" or \"-z\"$"),
    ({"change": lambda v: v * [1, 2, 1]}, r"is 200 m long, 60 m broad and 20 m high, and L_oa = 200 m, B = 30 m"),
    ({"change": lambda v: v * [1, 0.5, 1] + [0, 7.5, 0]}, r"is 15 m broad on one side of the centreline, and B = 30 m: "
     r"looks like half a hull; mirror it in the program that made the file$"),
    ({"change": lambda v: v + [100, 0, 0]}, r"its middle lies 100 m forward of CO, at most 20 m: set origin to"),
    ({"change": lambda v: v + [0, 15, 0]}, r"its middle lies -15 m to starboard of CO, at most 1.5 m: set origin"),
    ({"change": lambda v: v + [0, 0, 10]}, r"its lowest point lies 0 m below CO, and the draught is T = 10 m: set or"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "message"), REFUSED, ids=[m[:32] for _, m in REFUSED])
def test_refused_with_the_reason(read: Read, given: dict[str, Any], message: str) -> None:
    with pytest.raises(ShipError, match=message) as raised:
        read(**given)
    assert "\n" not in str(raised.value)


FILES: list[tuple[str, bytes | None, str]] = [
    ("absent.obj", None, r"absent\.obj: does not exist in .*relative to the ship file"),
    ("hull.ply", b"ply", r"hull\.ply: is none of \.obj, \.stl, \.dae, \.glb, \.gltf"),
    ("hull.obj", b"", r"hull\.obj: has no faces: export the hull's surface as OBJ"),
    ("hull.stl", b"hello", r"hull\.stl: has no faces"),
    ("hull.obj", b"v 0 0 x\nf 1 2 3\n", r"hull\.obj: cannot be read as OBJ \("),
    ("hull.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", r"hull\.obj: cannot be read as OBJ \("),
    ("hull.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", r"hull\.obj: .*(not finite|cannot be read)"),
    (
        "hull.obj",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        r"hull\.obj: is not closed: 3 open edges .* set convex_hull",
    ),
]


@pytest.mark.parametrize(("name", "content", "message"), FILES, ids=[f"{n} {m[:20]}" for n, _, m in FILES])
def test_broken_files_are_refused(tmp_path: Path, name: str, content: bytes | None, message: str) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(ShipError, match=message) as raised:
        build_mesh_hull(L_OA, B, T, HullTable(shape="mesh", depth=DEPTH, file=str(tmp_path / name)))
    assert "\n" not in str(raised.value)


@pytest.mark.slow
def test_a_triangle_without_area_is_dissolved(read: Read) -> None:
    hull, triangles = split_edge()
    got = read(hull, triangles=triangles)
    assert got.volume == pytest.approx(L_OA * B * DEPTH)
    assert (len(got.triangles), len(got.parts)) == (12, 1)


def test_shells_inside_each_other_hold_nothing(read: Read) -> None:
    """A plate hull, outside and inside: closed, and almost without volume."""
    n = len(BOX.vertices)
    plates = HullMesh(np.vstack([BOX.vertices, BOX.vertices * 0.999]), BOX.triangles, ())
    with pytest.raises(ShipError, match=r"encloses \d+.* m3, less than 1 % of the box around it"):
        read(plates, triangles=np.vstack([BOX.triangles, BOX.triangles[:, ::-1] + n]))


@pytest.mark.parametrize("package", ["trimesh", "manifold3d"])
def test_a_missing_package_is_named(read: Read, monkeypatch: pytest.MonkeyPatch, package: str) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(HostError, match=rf"{package} cannot be imported .*pip install 'shipcollision-fmu\[mesh\]'"):
        read(FLARED)


# -- convex parts -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_flared_hull_is_cut_into_convex_parts_that_hold_it(read: Read) -> None:
    got = read(FLARED)
    assert 2 <= len(got.parts) <= 16
    assert abs(got.volume_error) < 0.01
    assert got.bulge < 0.01 * B
    for part, planes in zip(got.parts, got.planes, strict=True):
        assert (part @ planes[:, :3].T - planes[:, 3]).max() < 1e-9
    rng = np.random.default_rng(0)
    inside = FLARED.parts[0].mean(axis=0) + 0.98 * (rng.permutation(FLARED.vertices) - FLARED.parts[0].mean(axis=0))
    for p in inside[(inside[:, 2] > 0.5)]:  # below the knuckle the solid is convex: these points are in it
        assert any((planes[:, :3] @ p <= planes[:, 3] + 0.01).all() for planes in got.planes)


@pytest.mark.slow
def test_parts_that_hold_too_much_are_refused(read: Read, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_parts, "VOLUME_TOLERANCE", 1e-6)
    with pytest.raises(
        ShipError, match=r"its 1 convex parts hold \d\.\d% more than the solid.*raise max_parts = 1, or"
    ):
        read(FLARED, max_parts=1)


PARTS_DIGEST = """
import hashlib
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import load_ship
ship = load_ship("mesh_example")
hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
print(hashlib.sha256(b"".join(part.tobytes() for part in hull.parts)).hexdigest())
"""


@pytest.mark.slow
def test_the_example_ship_is_cut_to_the_same_bits_in_every_process() -> None:
    ship = load_ship("mesh_example")
    hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    assert len(hull.parts) >= 2
    assert abs(hull.volume_error) < 0.01
    x, y, z = np.ptp(hull.vertices, axis=0)
    assert (x, y, z) == (pytest.approx(120.0), pytest.approx(20.0), pytest.approx(12.0))
    root = find_models().parent
    other = subprocess.run(
        [sys.executable, "-c", PARTS_DIGEST], cwd=root, capture_output=True, text=True, check=True, timeout=1200
    )
    assert other.stdout.strip() == hashlib.sha256(b"".join(part.tobytes() for part in hull.parts)).hexdigest()


def test_the_example_file_is_what_its_program_writes() -> None:
    spec = importlib.util.spec_from_file_location("make_example_hull", find_models() / "make_example_hull.py")
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    assert (find_models() / "hulls" / "example.obj").read_text() == made.obj()


def test_file_is_relative_to_the_ship_file_that_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "base").mkdir()
    (tmp_path / "base" / "hull.stl").write_text(stl(BOX.vertices * TO_FILE, BOX.triangles))
    text = ship_toml(
        particulars={"L_pp": 200.0, "B": 30.0, "T": 10.0, "mass": 40e6},
        hull={"shape": "mesh", "depth": 20.0, "file": "hull.stl"},
    )
    (tmp_path / "base" / "ship.toml").write_text(text)
    (tmp_path / "variant.toml").write_text('extends = "base/ship.toml"\n[particulars]\nmass = 45e6\n')
    monkeypatch.chdir("/")
    ship = load_ship(tmp_path / "variant.toml")
    assert rows(build_hull(ship.L_oa, ship.B, ship.T, ship.hull).vertices) == rows(BOX.vertices)


# -- [hull] -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({}, r'file is missing: shape = "mesh" needs the name'),
        ({"file": "a.obj", "bow_length": 3.0}, r'shape = "mesh" has no bow_length: the file has the whole shape'),
        ({"file": "a.obj", "unit": "mm", "scale": 0.001}, r'unit = "mm" and scale = 0.001 are two units: remove one'),
        ({"file": "a.obj", "forward": "+x", "up": "-x"}, r'forward = "\+x" and up = "-x" lie along one axis'),
        ({"shape": "box", "file": "a.obj"}, r'shape = "box" has no file: only "mesh" has'),
    ],
)
def test_keys_that_exclude_each_other(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        HullTable(**{"shape": "mesh", "depth": 20.0, **keys})


# -- convex.py --------------------------------------------------------------------------------------


def test_half_spaces_of_a_box() -> None:
    planes = half_spaces(BOX.vertices, BOX.triangles)
    expected = [(1, 0, 0, 100), (-1, 0, 0, 100), (0, 1, 0, 15), (0, -1, 0, 15), (0, 0, 1, 10), (0, 0, -1, 10)]
    assert rows(planes) == sorted(tuple(map(float, row)) for row in expected)


def test_convexity_and_volume() -> None:
    assert is_convex(SHIP.vertices, SHIP.triangles, 1e-6)
    assert not is_convex(FLARED.vertices, FLARED.triangles, 1e-3)
    far = BOX.vertices + [1e5, -1e5, 1e4]
    assert enclosed_volume(far, BOX.triangles) == pytest.approx(L_OA * B * DEPTH, rel=1e-9)
    assert enclosed_volume(BOX.vertices, BOX.triangles[:, ::-1]) == pytest.approx(-L_OA * B * DEPTH)
