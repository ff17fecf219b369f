"""A hull from a user's own OBJ, STL, DAE or glTF file.

    [hull]
    shape = "mesh"
    depth = 18.0               # keel to deck [m]
    file = "my_ship.obj"       # relative to the ship file
    unit = "mm"                # m, cm, mm, ft, in; or scale = metres per unit of the file
    forward = "+y"             # the file's axis that points to the bow; default "+x"
    up = "+z"                  # the file's axis that points up; default what the file or its format states
    origin = [0.0, 90e3, 10e3] # CO (midship, centreline, waterline) in the file's own coordinates; default [0, 0, 0]
    weld = 0.001               # vertices of open edges nearer to each other than this [m] are joined
    fill_holes = true          # holes, such as an open deck, are closed; default false
    convex_hull = true         # the mesh's convex hull is taken; default false
    max_parts = 16             # most convex parts that the solid is cut into

    p_b = metres [forward, starboard, down]' (p_file - origin),    starboard = forward x up

    file -> closed surface (mending.py) -> size, axes, place (mesh_checks.py) -> one solid (one_solid.py)
         -> convex parts (convex_parts.py) -> user's cache (hull_cache.py)

The surface must be closed, for only then is there an inside. Contact needs convex parts: a convex mesh is its own part;
any other is cut once and kept. What was mended is said when it is done; what is suspicious, at every load.
"""

from __future__ import annotations

import logging
from pathlib import Path

from ...errors import ShipError
from ..file_stamp import digest_content
from ..tables.hull import HullTable
from .convex import half_spaces
from .convex_parts import cut_into_convex_parts
from .file_frame import FileFrame, read_frame
from .hull_cache import Kept, compute_key, find_hull, keep_hull
from .mending import Mended, close_surface, join_same_vertices
from .mesh_checks import check_axes, check_place, check_size, list_suspicions
from .mesh_file import find_mesh_file, read_mesh_file
from .one_solid import Solid, find_convex_hull, unite_surfaces
from .solid import HullMesh

__all__ = ["build_mesh_hull"]

_log = logging.getLogger("shipcollision_fmu")


def build_mesh_hull(L_oa: float, B: float, T: float, table: HullTable) -> HullMesh:
    """Hull of `table.file` (a path from the current folder, or absolute), in b about CO [m].

    L_oa, B, T [m] are what the mesh is compared with. Raises ShipError when the file or the mesh is refused, HostError
    when a package is missing.
    """
    assert table.file is not None
    path = find_mesh_file(Path(table.file))
    content = table.model_dump_json(exclude={"file"})
    try:
        digest = digest_content(path)
    except OSError as error:
        raise ShipError(f"{path.name}: cannot be read ({error.strerror}): make the file readable") from None
    key = compute_key(L_oa, B, T, content, path.suffix.lower(), digest)
    kept = find_hull(key)
    if kept is None:
        kept = _prepare(path, L_oa, B, T, table)
        keep_hull(path.name, key, kept)
    for warning in kept.warnings:
        _log.warning("%s: %s", path.name, warning)
    return kept.hull


def _prepare(path: Path, L_oa: float, B: float, T: float, table: HullTable) -> Kept:
    """The hull of a file that is not in the cache."""
    file = read_mesh_file(path)
    frame = read_frame(path.name, table, file.metres, file.up)
    mesh, is_closed = _mend(path.name, Mended(*join_same_vertices(file.vertices, file.faces)), frame, table)
    placed = frame.to_ship(mesh.vertices)
    check_size(path.name, placed, L_oa, frame)
    check_axes(path.name, placed, L_oa, B, frame)
    check_place(path.name, placed, L_oa, B, T, table.depth)
    if table.convex_hull:
        solid = find_convex_hull(path.name, placed, mesh.triangles, is_closed, B)
    else:
        solid = unite_surfaces(path.name, placed, mesh.triangles, B, frame)
    for note in (*mesh.notes, *solid.notes):
        _log.warning("%s: %s", path.name, note)
    suspicions = list_suspicions(solid.vertices, solid.triangles, T, table.depth, frame)
    return Kept(_cut(path.name, solid, table.max_parts), (*solid.warnings, *suspicions))


def _mend(name: str, mesh: Mended, frame: FileFrame, table: HullTable) -> tuple[Mended, bool]:
    """The mesh and whether it is closed: a convex hull is also that of a mesh which is not.

    Its holes are closed where they can be, for only then is it known what the convex hull adds.
    """
    try:
        return close_surface(name, mesh, frame.metres, table.weld, table.fill_holes or table.convex_hull), True
    except ShipError:
        if not table.convex_hull:
            raise
        return mesh, False


def _cut(name: str, solid: Solid, max_parts: int) -> HullMesh:
    """The solid with its convex parts. A refusal also says what may be its cause."""
    try:
        cut = cut_into_convex_parts(name, solid.vertices, solid.triangles, max_parts)
    except ShipError as error:
        raise ShipError("; ".join([str(error), *solid.warnings])) from None
    parts = tuple(vertices for vertices, _ in cut.parts)
    planes = tuple(half_spaces(*part) for part in cut.parts)
    return HullMesh(solid.vertices, solid.triangles, parts, planes, cut.volume_error, cut.bulge)
