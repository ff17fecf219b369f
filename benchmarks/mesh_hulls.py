"""Time to load a hull from a mesh file of 20 000 to 130 000 faces, the first time and afterwards.

    python benchmarks/mesh_hulls.py [FACES ...]          default: 20000 60000 130000

The hull is a made-up cargo ship of 140 by 22 m: a flared bow and a narrowing stern on a fine grid, with a bulb, a house
and a funnel that pass through it, and bilge keels. Each load is a process of its own, with a cache that is empty the
first time. The limits are 30 s and 1 s.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table

L, B, T, DEPTH = 140.0, 22.0, 8.0, 13.0
BULB = 6.0
"""Half the bulb's length [m]: its middle lies 1.5 m before the stem's foot."""
LENGTH = L + BULB - 1.5

LOAD = """
import sys
from time import perf_counter
start = perf_counter()
from shipcollision_fmu.ship.hull.mesh import build_mesh_hull
from shipcollision_fmu.ship.tables.hull import HullTable
table = HullTable(shape="mesh", depth={depth}, file=sys.argv[1], origin=[{x}, 0.0, {T}])
hull = build_mesh_hull({L}, {B}, {T}, table)
print(perf_counter() - start, len(hull.triangles), len(hull.parts), hull.volume_error)
"""

Mesh = tuple[np.ndarray, np.ndarray]


def make_ship(faces: int) -> Mesh:
    """Vertices (n, 3) and triangles (m, 3) of about so many faces; x forward, y to port, z above the keel."""
    rings = round((faces / 8.2) ** 0.5)
    sector = max(12, rings // 3)
    keels = [_make_sphere((-5.0, side * 7.7, 1.0), (25.0, 0.8, 0.4), sector // 2) for side in (1.0, -1.0)]
    bulb = _make_sphere((L / 2 - 1.5, 0.0, 3.2), (BULB, 2.2, 2.6), sector)
    house, funnel = _make_box((-59, -9, 11), (-41, 9, 24)), _make_sphere((-50.0, 0.0, 22.0), (3.0, 2.0, 8.0), sector)
    return join([_make_hull(2 * rings, rings), bulb, house, funnel, *keels])


def join(meshes: list[Mesh]) -> Mesh:
    """Several surfaces as one mesh, each closed in itself."""
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return np.vstack([v for v, _ in meshes]), np.vstack([t + s for (_, t), s in zip(meshes, starts, strict=False)])


def _make_hull(n: int, m: int) -> Mesh:
    """The hull from n sections of 2 m points each: from keel to deck to port, and back down to starboard."""
    u, z = np.linspace(0.0, 1.0, n)[:, None], np.linspace(0.0, DEPTH, m)
    s = np.minimum(z / T, 1.0)
    fullness = 0.15 + 0.85 * np.sqrt(1.0 - (1.0 - s) ** 4)
    shoulder = 0.72 + 0.10 * s + 0.14 * (np.maximum(z - T, 0.0) / (DEPTH - T)) ** 2  # farther forward above: a flare
    aft = 1.0 - (0.75 - 0.3 * s) * (np.maximum(0.25 - u, 0.0) / 0.25) ** 2
    fore = 1.0 - (np.maximum(u - shoulder, 0.0) / (1.0001 - shoulder)) ** 2
    half = np.maximum(0.5 * B * np.minimum(aft, fore) * fullness, 0.02)
    port = np.stack(np.broadcast_arrays((u - 0.5) * L, half, z), axis=2)
    ring = np.concatenate([port, port[:, ::-1] * [1.0, -1.0, 1.0]], axis=1)
    i, k = (index.ravel() for index in np.meshgrid(np.arange(n - 1), np.arange(2 * m), indexing="ij"))
    a, b = i * 2 * m + k, i * 2 * m + (k + 1) % (2 * m)
    shell = np.concatenate([np.column_stack([a, b + 2 * m, b]), np.column_stack([a, a + 2 * m, b + 2 * m])])
    j, last = np.arange(m - 1), (n - 1) * 2 * m
    p, q, r, w = j, j + 1, 2 * m - 1 - j, 2 * m - 2 - j
    end = np.concatenate([np.column_stack([p, q, w]), np.column_stack([p, w, r])])
    return _turn_outwards(ring.reshape(-1, 3), np.concatenate([shell, end, end[:, ::-1] + last]))


def _make_sphere(middle: tuple[float, ...], size: tuple[float, ...], sectors: int) -> Mesh:
    """An ellipsoid from circles of latitude and its poles."""
    latitude, longitude = np.linspace(-np.pi / 2, np.pi / 2, sectors // 2 + 1)[1:-1], np.arange(sectors)
    around = 2.0 * np.pi * longitude / sectors
    x, y = (np.outer(np.cos(latitude), f(around)) for f in (np.cos, np.sin))
    circles = np.stack([x, y, np.broadcast_to(np.sin(latitude)[:, None], x.shape)], axis=2).reshape(-1, 3)
    vertices = np.vstack([circles, [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]]) * size + middle
    i, k = (index.ravel() for index in np.meshgrid(np.arange(len(latitude) - 1), longitude, indexing="ij"))
    a, b = i * sectors + k, i * sectors + (k + 1) % sectors
    last, n = (len(latitude) - 1) * sectors, len(circles)
    following = (longitude + 1) % sectors
    faces = [
        np.column_stack([a, b, b + sectors]), np.column_stack([a, b + sectors, a + sectors]),
        np.column_stack([following, longitude, np.full(sectors, n)]),
        np.column_stack([last + longitude, last + following, np.full(sectors, n + 1)]),
    ]  # fmt: skip
    return _turn_outwards(vertices, np.concatenate(faces))


def _make_box(low: tuple[float, ...], high: tuple[float, ...]) -> Mesh:
    corners = np.array([[(low, high)[(c >> k) & 1][k] for k in range(3)] for c in range(8)], dtype=float)
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, np.array([t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])


def _turn_outwards(vertices: np.ndarray, triangles: np.ndarray) -> Mesh:
    p, q, r = (vertices[triangles[:, k]] for k in range(3))
    return vertices, triangles if float(np.einsum("ij,ij->", p, np.cross(q, r))) > 0.0 else triangles[:, ::-1]


def write_stl(path: Path, mesh: Mesh) -> None:
    """Write a binary STL file."""
    facets = np.zeros(len(mesh[1]), dtype=[("corners", "<f4", (4, 3)), ("attribute", "<u2")])
    facets["corners"][:, 1:] = mesh[0][mesh[1]]
    path.write_bytes(bytes(80) + len(mesh[1]).to_bytes(4, "little") + facets.tobytes())


def main(sizes: list[int]) -> None:
    table = make_table(">faces", ">first load [s]", ">second load [s]", ">simplified to", ">parts", ">volume added [%]")
    for size in sizes:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "ship.stl")
            mesh = make_ship(size)
            write_stl(path, mesh)
            code = LOAD.format(depth=DEPTH, x=0.5 * (LENGTH - L), T=T, L=LENGTH, B=B)
            command, environment = [sys.executable, "-c", code, str(path)], {**os.environ, "XDG_CACHE_HOME": folder}
            first, second = (
                subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.split()
                for _ in range(2)
            )
        seconds = f"{float(first[0]):.1f}", f"{float(second[0]):.2f}"
        table.add_row(str(len(mesh[1])), *seconds, first[1], first[2], f"{100 * float(first[3]):.2f}")
    print_table(table)


if __name__ == "__main__":
    main([int(size) for size in sys.argv[1:]] or [20_000, 60_000, 130_000])
