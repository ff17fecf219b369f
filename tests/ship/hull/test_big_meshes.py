"""A mesh of many faces is simplified within the distance that is said, and its parts hold it up to that distance."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import trimesh

from shipcollision_fmu.ship.hull.file_frame import FileFrame
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.hull.one_solid import MOST_FACES, STEPS, unite_surfaces
from shipcollision_fmu.ship.tables.hull import HullTable

B = 22.0


@pytest.fixture(scope="module")
def made() -> ModuleType:
    """The benchmark of mesh hulls, which makes ships of any number of faces."""
    path = Path(__file__).parents[3] / "benchmarks" / "mesh_hulls.py"
    spec = importlib.util.spec_from_file_location("mesh_hulls", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def distances(points: np.ndarray, vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Distance of each point from the surface."""
    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    return np.asarray(trimesh.proximity.closest_point_naive(mesh, points)[1])


@pytest.mark.slow
def test_simplification_keeps_to_its_distance(made: ModuleType) -> None:
    """What is left are vertices of the file, and the shell between the bulb and the stern is where it was."""
    vertices, triangles = made.make_ship(6000)
    frame = FileFrame(1.0, "+x", "+z", (0.0, 0.0, 8.0))
    solid = unite_surfaces("ship.stl", frame.to_ship(vertices), triangles, B, frame)
    assert len(triangles) > MOST_FACES >= len(solid.triangles)
    (note,) = solid.notes
    said = re.match(rf"{len(triangles)} faces are simplified to {len(solid.triangles)}, .* at most (\S+) m$", note)
    assert said is not None
    assert float(said[1]) == pytest.approx(STEPS[0] * B)
    rng = np.random.default_rng(1)
    picked = solid.vertices[rng.integers(0, len(solid.vertices), 100)]
    assert distances(picked, frame.to_ship(vertices), triangles).max() < 1e-6  # a subset of the vertices, or crossings
    x, _, z = vertices.T
    shell = frame.to_ship(vertices)[(x > -35.0) & (x < 55.0) & (z > 2.5)]
    assert distances(rng.permutation(shell)[:200], solid.vertices, solid.triangles).max() <= STEPS[0] * B
    (warning,) = solid.warnings
    assert re.match(r"6 closed surfaces pass through each other, two of them around ", warning)


@pytest.mark.slow
def test_a_ship_of_20_000_faces(made: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its parts hold all vertices of the file up to the simplification, and at most 5 % more."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    vertices, triangles = made.make_ship(20_000)
    path = tmp_path / "ship.stl"
    made.write_stl(path, (vertices, triangles))
    origin = [0.5 * (made.LENGTH - made.L), 0.0, made.T]
    hull = build_mesh_hull(
        made.LENGTH, B, made.T, HullTable(shape="mesh", depth=made.DEPTH, file=str(path), origin=origin)
    )
    assert 2 <= len(hull.parts) <= 16
    assert len(hull.triangles) <= MOST_FACES
    assert 0.0 <= hull.volume_error < 0.05
    placed = (vertices - origin) * [1.0, -1.0, -1.0]
    outside = np.min([(placed @ planes[:, :3].T - planes[:, 3]).max(axis=1) for planes in hull.planes], axis=0)
    assert outside.max() < STEPS[-1] * B
