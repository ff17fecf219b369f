"""Mesh files of known solids, for the tests of this folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.hull.solid import HullMesh
from shipcollision_fmu.ship.tables.hull import HullTable

L_OA, B, T, DEPTH = 200.0, 30.0, 10.0, 20.0
TO_FILE = np.array([1.0, -1.0, -1.0])
"""From b to the file's default axes: forward, to port, up."""


def ours(**form: Any) -> HullMesh:
    return build_hull(L_OA, B, T, HullTable(depth=DEPTH, **form))


BOX = ours(shape="box")
SHIP = ours(shape="parametric", bow_length=40.0, stern_length=50.0, stem_rake_deg=10.0, bilge=1.0)


def obj(vertices: np.ndarray, triangles: np.ndarray) -> str:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    return "\n".join(lines + [f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist()]) + "\n"


def stl(vertices: np.ndarray, triangles: np.ndarray) -> str:
    facets = [
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in vertices[t].tolist())
        + "endloop\nendfacet\n"
        for t in triangles
    ]
    return "solid hull\n" + "".join(facets) + "endsolid hull\n"


def read(folder: Path, vertices: np.ndarray, triangles: np.ndarray, **keys: Any) -> HullMesh:
    """The hull of a mesh in b, written into an OBJ file."""
    path = folder / "hull.obj"
    path.write_text(obj(vertices * TO_FILE, triangles))
    return build_mesh_hull(L_OA, B, T, HullTable(shape="mesh", depth=DEPTH, file=str(path), **keys))


def box(low: tuple[float, ...], high: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
    """A box in b, as wide as from low to high."""
    middle, size = 0.5 * (np.array(low) + high), np.array(high) - low
    unit = (BOX.vertices - [0.0, 0.0, T - DEPTH / 2]) / [L_OA, B, DEPTH]
    return unit * size + middle, BOX.triangles


def together(*meshes: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Several meshes as one."""
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return np.vstack([v for v, _ in meshes]), np.vstack([t + s for (_, t), s in zip(meshes, starts, strict=False)])


L_SHAPE = np.array([(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)], dtype=float)
"""An angle bar in section: two convex parts hold it exactly."""


def bar() -> tuple[np.ndarray, np.ndarray]:
    """The angle bar, one unit long, as a closed mesh."""
    vertices = np.vstack([np.column_stack([L_SHAPE, np.full(6, z)]) for z in (0.0, 1.0)])
    cap = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    sides = [f for i in range(6) for f in ((i, (i + 1) % 6, 6 + (i + 1) % 6), (i, 6 + (i + 1) % 6, 6 + i))]
    top = [(a + 6, b + 6, c + 6) for a, b, c in cap]
    return vertices, np.array([(c, b, a) for a, b, c in cap] + sides + top, dtype=np.int64)


BAR = bar()
