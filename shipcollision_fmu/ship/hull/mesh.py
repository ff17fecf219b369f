"""A hull from a user's own OBJ or STL file.

    [hull]
    shape = "mesh"
    depth = 18.0               # keel to deck [m]
    file = "my_ship.obj"       # relative to the ship file
    unit = "mm"                # m (default), cm, mm, ft, in; or scale = metres per unit of the file
    forward = "+y"             # the file's axis that points to the bow; default "+x"
    up = "+z"                  # the file's axis that points up; default "+z"
    origin = [0.0, 90e3, 10e3] # CO (midship, centreline, waterline) in the file's own coordinates; default [0, 0, 0]
    max_parts = 16             # most convex parts that the solid is cut into

    p_b = metres [forward, starboard, down]' (p_file - origin),    starboard = forward x up

The surface must be closed, for only then is there an inside. Contact needs convex parts: a convex mesh is its own part;
any other is cut once and kept (convex_parts.py).

Not checked: a surface that passes through itself, which end is the bow, and where T is about half the depth, which way
is up.
"""

from __future__ import annotations

from importlib import import_module
from itertools import permutations
from pathlib import Path
from types import ModuleType

import numpy as np

from ...errors import HostError, ShipError, describe_installation
from ..frames import Array
from ..tables.hull import HullTable
from .convex import Indices, enclosed_volume, half_spaces
from .convex_parts import cut_into_convex_parts
from .solid import HullMesh

__all__ = ["UNITS", "build_mesh_hull"]

UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254}
"""Metres per unit of a file."""
_NAMES = {"m": "metres", "cm": "centimetres", "mm": "millimetres", "ft": "feet", "in": "inches"}

SIZE_TOLERANCE = 0.25
"""Relative difference allowed between the mesh's length and breadth and those of [particulars]: bulb, rudder."""
MIDSHIP_TOLERANCE, CENTRELINE_TOLERANCE, KEEL_TOLERANCE = 0.1, 0.05, 0.25
"""Distance allowed between the mesh's middle and CO, over L_oa (bulb) and B, and between its keel and T, over the depth
(rudder, sonar dome)."""
LARGEST_FILE = 200 * 2**20
"""Bytes of a file that are read at all."""


def build_mesh_hull(L_oa: float, B: float, T: float, table: HullTable) -> HullMesh:
    """Hull of `table.file` (a path from the current folder, or absolute), in b about CO [m].

    L_oa, B, T [m] are what the mesh is compared with. Raises ShipError when the file or the mesh is refused, HostError
    when a package is missing.
    """
    assert table.file is not None
    path = Path(table.file)
    vertices, triangles = _read_mesh(path)
    metres = table.scale or UNITS[table.unit]
    placed = (vertices - table.origin) @ _find_axes(table).T * metres
    _check_closed(path.name, vertices, triangles)
    _check_size(path.name, placed, L_oa, table)
    _check_axes(path.name, placed, L_oa, B, table)
    _check_place(path.name, placed, L_oa, B, T, table)
    _check_triangles(path.name, placed, triangles)
    volume = enclosed_volume(placed, triangles)
    if not abs(volume) > 0.01 * float(np.prod(np.ptp(placed, axis=0))):
        raise ShipError(
            f"{path.name}: encloses {volume:.6g} m3, less than 1 % of the box around it: give the hull as one closed "
            "solid with a thickness, not as plates or shells inside each other"
        )
    if volume < 0.0:  # all of it inside out: turned
        triangles = triangles[:, ::-1].copy()
    cut = cut_into_convex_parts(path.name, placed, triangles, table.max_parts)
    return HullMesh(
        placed, triangles, tuple(p for p, _ in cut.parts), tuple(half_spaces(*part) for part in cut.parts),
        cut.volume_error, cut.bulge,
    )  # fmt: skip


# -- reading ----------------------------------------------------------------------------------------


def _import_optional(name: str, purpose: str) -> ModuleType:
    try:
        return import_module(name)
    except ImportError as error:
        raise HostError(
            f"{name} cannot be imported ({error}), and {purpose}: {describe_installation('mesh')}"
        ) from None


def _read_mesh(path: Path) -> tuple[Array, Indices]:
    """Vertices (n, 3), those at one place joined, and triangles (m, 3) with three different corners."""
    kind = path.suffix.lower().removeprefix(".")
    if kind not in ("obj", "stl"):
        raise ShipError(
            f"{path.name}: is neither .obj nor .stl: save the hull as one of these, and give its name as file"
        )
    if not path.is_file():
        raise ShipError(
            f"{path.name}: does not exist in {path.parent.resolve()}: [hull] file is relative to the ship file"
        )
    if (size := path.stat().st_size) > LARGEST_FILE:
        raise ShipError(f"{path.name}: has {size} bytes, more than {LARGEST_FILE}: simplify the mesh")
    if kind == "stl":
        _check_whole(path, size)
    trimesh = _import_optional("trimesh", "a hull from a mesh file is read with it")
    try:
        with path.open("rb") as file:
            mesh = trimesh.load_mesh(
                file, file_type=kind, process=False, **({"skip_materials": True} if kind == "obj" else {})
            )
        vertices, faces = np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces, dtype=np.int64)
    except Exception as error:  # whatever a broken file makes the reader stumble on
        said = " ".join(str(error).split())
        raise ShipError(f"{path.name}: cannot be read as {kind.upper()} ({said}): export it again") from None
    if len(faces) == 0:
        raise ShipError(
            f"{path.name}: has no faces: export the hull's surface as {kind.upper()}, not its lines or points"
        )
    if not np.isfinite(vertices).all():
        raise ShipError(f"{path.name}: has vertices that are not finite numbers: export it again")
    # STL repeats every corner, OBJ those where groups, materials or normals meet. Joined within 1e-7 of the size.
    grid = max(float(np.ptp(vertices, axis=0).max()), 1e-300) * 1e-7
    _, first, joined = np.unique(
        np.round(vertices / grid).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    triangles = joined.reshape(-1)[faces]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    used, corners = np.unique(triangles, return_inverse=True)
    return vertices[first[used]], corners.reshape(-1, 3).astype(np.int64)


def _check_whole(path: Path, size: int) -> None:
    """Check that a binary STL (80 bytes of header, a count, 50 bytes per triangle) has the length of its count."""
    with path.open("rb") as file:
        head = file.read(1024)
    if b"\0" not in head or len(head) < 84:  # text
        return
    count = int.from_bytes(head[80:84], "little")
    if size < (whole := 84 + 50 * count):
        raise ShipError(
            f"{path.name}: is cut short: its {count} triangles take {whole} bytes, and it has {size}: export it again"
        )


def _find_axes(table: HullTable) -> Array:
    """(3, 3), rows: forward, starboard and down in the file's axes."""
    forward, up = _parse_axis(table.forward), _parse_axis(table.up)
    return np.array([forward, np.cross(forward, up), -up])


def _parse_axis(axis: str) -> Array:
    direction = np.zeros(3)
    direction["xyz".index(axis[1])] = -1.0 if axis[0] == "-" else 1.0
    return direction


# -- checks -----------------------------------------------------------------------------------------


def _check_closed(name: str, vertices: Array, triangles: Indices) -> None:
    """Every edge belongs to two triangles, which pass it in opposite directions."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, first, edge, count = np.unique(
        np.sort(edges, axis=1), axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    if (count == 1).any():
        x, y, z = vertices[edges[first[int(np.argmax(count == 1))]]].mean(axis=0)
        raise ShipError(
            f"{name}: is not closed: {int((count == 1).sum())} open edges, one at ({x:.6g}, {y:.6g}, {z:.6g}) in the "
            "file: close deck, transom and holes"
        )
    if (count > 2).any():
        x, y, z = vertices[edges[first[int(np.argmax(count > 2))]]].mean(axis=0)
        raise ShipError(
            f"{name}: {int((count > 2).sum())} edges belong to more than two faces, one at ({x:.6g}, {y:.6g}, {z:.6g}) "
            "in the file: remove inner walls and doubled faces"
        )
    up = np.zeros(len(count), dtype=np.int64)
    np.add.at(up, edge.reshape(-1), np.where(edges[:, 0] < edges[:, 1], 1, -1))
    if (up != 0).any():
        raise ShipError(
            f"{name}: {int((up != 0).sum())} edges lie between faces of which one looks inwards: make the normals "
            "consistent (recalculate normals outside)"
        )


def _check_size(name: str, placed: Array, L_oa: float, table: HullTable) -> None:
    longest = float(np.ptp(placed, axis=0).max())
    if _is_alike(longest, L_oa):
        return
    said = f"scale = {table.scale:g}" if table.scale else f'unit = "{table.unit}"'
    in_file = longest / (table.scale or UNITS[table.unit])
    unit = next((u for u, metres in UNITS.items() if _is_alike(in_file * metres, L_oa)), None)
    remedy = f'looks like {_NAMES[unit]}: set unit = "{unit}"' if unit else "set unit or scale, or correct L_oa"
    raise ShipError(f"{name}: is {longest:.6g} m long with {said}, and L_oa = {L_oa:.6g} m: {remedy}")


def _check_axes(name: str, placed: Array, L_oa: float, B: float, table: HullTable) -> None:
    """Length lies forward and breadth across; else the axes are named that would do."""
    x, y, z = np.ptp(placed, axis=0).tolist()
    if _is_alike(x, L_oa) and _is_alike(y, B):
        return
    extent = dict(zip("xyz", np.ptp(placed @ _find_axes(table), axis=0).tolist(), strict=True))
    sizes = ", ".join(f"{axis} {size:.6g} m" for axis, size in extent.items())
    for forward, across, up in permutations("xyz"):
        if (
            _is_alike(extent[forward], L_oa)
            and _is_alike(extent[across], B)
            and (forward, up) != (table.forward[1], table.up[1])
        ):
            raise ShipError(
                f'{name}: extents along the file\'s axes are {sizes}; with forward = "{table.forward}" and up = '
                f'"{table.up}" it is {x:.6g} m long and {y:.6g} m broad, not L_oa = {L_oa:.6g} and B = {B:.6g} m: set '
                f'forward = "+{forward}" or "-{forward}" and up = "+{up}" or "-{up}"'
            )
    raise ShipError(
        f"{name}: is {x:.6g} m long, {y:.6g} m broad and {z:.6g} m high, and L_oa = {L_oa:.6g} m, B = {B:.6g} m: at "
        f"most {SIZE_TOLERANCE:.0%} apart; correct the mesh or [particulars]"
    )


def _is_alike(size: float, expected: float) -> bool:
    return bool(1.0 / (1.0 + SIZE_TOLERANCE) <= size / expected <= 1.0 + SIZE_TOLERANCE)


def _check_place(name: str, placed: Array, L_oa: float, B: float, T: float, table: HullTable) -> None:
    """CO lies amidships on the centreline, and the keel at the draught T below it."""
    low, high = placed.min(axis=0), placed.max(axis=0)
    middle = 0.5 * (low + high)
    remedy = "set origin to midship, centreline and waterline in the file's coordinates"
    for what, value, most in (
        ("forward of", middle[0], MIDSHIP_TOLERANCE * L_oa), ("to starboard of", middle[1], CENTRELINE_TOLERANCE * B),
    ):  # fmt: skip
        if abs(value) > most:
            raise ShipError(f"{name}: its middle lies {value:.6g} m {what} CO, at most {most:.6g} m: {remedy}")
    if abs(high[2] - T) > KEEL_TOLERANCE * table.depth:
        raise ShipError(
            f"{name}: its lowest point lies {high[2]:.6g} m below CO, and the draught is T = {T:.6g} m: {remedy} (or "
            "up is wrong)"
        )


def _check_triangles(name: str, placed: Array, triangles: Indices) -> None:
    p, q, r = (placed[triangles[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(q - p, r - p), axis=1)
    longest = np.sqrt(np.maximum.reduce([((b - a) ** 2).sum(axis=1) for a, b in ((p, q), (q, r), (r, p))]))
    flat = area <= 1e-7 * longest**2
    if flat.any():
        raise ShipError(
            f"{name}: {int(flat.sum())} of {len(flat)} triangles have no area (their corners lie on one line): clean "
            "the mesh (dissolve degenerate faces, merge by distance)"
        )
