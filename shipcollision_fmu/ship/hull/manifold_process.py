"""The program that works on closed surfaces by the library Manifold, in a process of its own.

Used by one_solid.py and mending.py.

    python -m shipcollision_fmu.ship.hull.manifold_process GIVEN.npz MADE.npz LONGEST ACTION

    unite   vertices, triangles, clean, steps (k,), most_faces, convex  ->  the one solid they bound, and what it took
    fill    points (n, 3), sizes (k,) of the loops  ->  triangles (m, 3), and which loops are filled

Manifold's simplification keeps a subset of the vertices and moves no surface by more than the given distance.
"""

from __future__ import annotations

import faulthandler
import sys
from importlib import import_module
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from ..frames import Array
from .child_process import Arrays, read_arrays, write_arrays
from .convex import Indices, has_flat_triangles
from .self_crossing import find_crossings

MOST_CHECKED = 50_000
"""Triangles up to which it is looked whether a surface passes through itself, which takes 3 s then."""
MOST_PAIRS = 5000
"""Pairs of surfaces of which it is looked where they pass through each other, for the message alone."""
NOTHING_UNITED = {
    "shells": 1, "cavities": 0, "cavity_volume": 0.0, "overlap": 0.0, "place": np.empty(0), "turned": 0
}  # fmt: skip
"""What is said of points alone."""


def main(given: str, made: str, longest: str, action: str) -> None:
    """Write the arrays that the action makes of those in `given`. Ends the process after `longest` seconds."""
    faulthandler.dump_traceback_later(float(longest), exit=True)
    manifold = import_module("manifold3d")
    arrays = read_arrays(Path(given).read_bytes())
    result = _unite(manifold, arrays) if action == "unite" else _fill(manifold, arrays)
    Path(made).write_bytes(write_arrays(result))


# -- one solid of several surfaces ------------------------------------------------------------------


def _unite(manifold: Any, given: Arrays) -> dict[str, Any]:
    if len(given["triangles"]) == 0:  # not closed: its points alone
        solid, said = manifold.Manifold.hull_points(np.ascontiguousarray(given["vertices"])), dict(NOTHING_UNITED)
    else:
        solid, said = _unite_closed(manifold, given["vertices"], given["triangles"])
    own_volume, deviation = solid.volume(), 0.0
    crossings = np.empty((0, 3))
    if not given["convex"] and solid.num_tri() <= MOST_CHECKED:  # simplified surfaces may cross where they were folded
        crossings = find_crossings(*_unpack(solid))
    solid = solid.simplify(float(given["clean"]))
    for step in given["steps"].tolist():
        if solid.num_tri() > int(given["most_faces"]):
            smaller = solid.simplify(step)
            solid, deviation = (smaller, step) if smaller.num_tri() > 0 else (solid, deviation)
    if given["convex"]:
        solid = solid.hull()
    vertices, triangles = _unpack(solid)
    is_plain = said["shells"] == 1 and not said["cavities"] and deviation == 0.0 and _has_plain_faces(given)
    return {
        "vertices": vertices, "triangles": triangles, "deviation": deviation, "own_volume": own_volume,
        "is_plain": is_plain, "crossings": crossings, **said,
    }  # fmt: skip


def _has_plain_faces(given: Arrays) -> bool:
    """Whether every triangle has an area, and every edge two triangles."""
    vertices, triangles = given["vertices"], given["triangles"]
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    return 2 * len(edges) == 3 * len(triangles) and not has_flat_triangles(vertices, triangles).any()


def _unite_closed(manifold: Any, vertices: Array, triangles: Indices) -> tuple[Any, dict[str, Any]]:
    """The solid inside any of the closed surfaces, and how many there are, how they overlap, and what was changed."""
    shells = _pack(manifold, vertices, triangles).decompose()
    if not shells:
        raise ValueError("no volume")
    turned = [_turn(manifold, shell) for shell in shells]
    cavities = [i for i, shell in enumerate(shells) if shell.volume() < 0.0 and _lies_in_another(i, turned)]
    solids = [solid for i, solid in enumerate(turned) if i not in cavities]
    united = manifold.Manifold.batch_boolean(solids, manifold.OpType.Add) if len(solids) > 1 else solids[0]
    added = sum(solid.volume() for solid in solids)
    said = {
        "shells": len(solids), "cavities": len(cavities),
        "cavity_volume": sum(turned[i].volume() for i in cavities), "overlap": added - united.volume(),
        "place": np.empty(0), "turned": sum(shell.volume() < 0.0 for shell in shells) - len(cavities),
    }  # fmt: skip
    if said["overlap"] > 1e-9 * added:
        said["place"] = _find_overlap(solids)
    return united, said


def _pack(manifold: Any, vertices: Array, triangles: Indices) -> Any:
    mesh = manifold.Mesh64(np.ascontiguousarray(vertices), np.ascontiguousarray(triangles, dtype=np.uint64))
    solid = manifold.Manifold(mesh)
    if solid.status() != manifold.Error.NoError:
        raise ValueError(solid.status().name)
    return solid


def _unpack(solid: Any) -> tuple[Array, Indices]:
    mesh = solid.to_mesh64()
    return np.array(mesh.vert_properties, dtype=float)[:, :3], np.array(mesh.tri_verts).astype(np.int64)


def _turn(manifold: Any, shell: Any) -> Any:
    """The solid inside a closed surface whose normals may point inwards."""
    if shell.volume() >= 0.0:
        return shell
    vertices, triangles = _unpack(shell)
    return _pack(manifold, vertices, triangles[:, ::-1])


def _lies_in_another(own: int, solids: list[Any]) -> bool:
    """Whether no volume of a solid lies outside one of the others."""
    solid = solids[own]
    box = np.array(solid.bounding_box())
    for i, other in enumerate(solids):
        around = np.array(other.bounding_box())
        holds = i != own and (around[:3] <= box[:3]).all() and (box[3:] <= around[3:]).all()
        if holds and (solid - other).volume() < 1e-9 * solid.volume():
            return True
    return False


def _find_overlap(solids: list[Any]) -> Array:
    """A point in the middle of the first common volume of two solids; (0,) where none is found."""
    for one, other in list(combinations(solids, 2))[:MOST_PAIRS]:
        a, b = np.array(one.bounding_box()), np.array(other.bounding_box())
        if (a[:3] < b[3:]).all() and (b[:3] < a[3:]).all():
            common = one ^ other
            if common.volume() > 0.0:
                box = np.array(common.bounding_box())
                middle: Array = 0.5 * (box[:3] + box[3:])
                return middle
    return np.empty(0)


# -- holes ------------------------------------------------------------------------------------------


def _fill(manifold: Any, given: Arrays) -> dict[str, Any]:
    """Triangles over each loop that is a simple polygon seen along its mean normal, and whether it is one."""
    triangles, filled, start = [np.empty((0, 3), dtype=np.int64)], [], 0
    for size in given["sizes"].tolist():
        points = given["points"][start : start + size]
        flat, area = _project(points - points.mean(axis=0))
        found = np.asarray(manifold.triangulate([flat])).astype(np.int64).reshape(-1, 3)
        a, b, c = (flat[found[:, k]] for k in range(3))
        (x, y), (v, w) = (b - a).T, (c - a).T
        covered = 0.5 * float(np.abs(x * w - y * v).sum())
        filled.append(len(found) == size - 2 and abs(covered - area) <= 1e-3 * area)
        triangles.append(found + start)
        start += size
    return {"triangles": np.vstack(triangles), "filled": np.array(filled)}


def _project(points: Array) -> tuple[Array, float]:
    """A loop (n, 3) seen against its mean normal (Newell), where it runs counter-clockwise, (n, 2), and its area."""
    normal = 0.5 * np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
    area = float(np.linalg.norm(normal))
    normal = normal / area
    across = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    across /= np.linalg.norm(across)
    return points @ np.column_stack([across, np.cross(normal, across)]), area


if __name__ == "__main__":
    main(*sys.argv[1:])
