"""A closed surface from the triangles of a file: vertices joined, faces given twice dropped, seams and holes closed.

    triangles -> vertices at one place joined -> faces given twice dropped
              -> vertices of open edges within `weld` joined -> seams (loops without area) closed
              -> holes closed where asked for -> closed and oriented, or refused

Every edge of a closed surface is passed as often in one direction as in the other. All in the file's own coordinates
and unit, so that a message can name a place in the file.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ...errors import HostError, ShipError
from ..frames import Array
from .child_process import OutOfTimeError, ProgramError, check_installed, run_program
from .convex import LEAST_VOLUME, Indices, enclosed_volume

__all__ = ["Mended", "close_surface", "count", "describe_place", "join_same_vertices"]

SAME_PLACE = 1e-7
"""Distance over the mesh's length within which vertices are one: numbers of 32 bits are not exact to more."""
WELD = 1e-5
"""Distance over the mesh's length within which vertices of open edges are joined unless the ship file states one."""
LARGEST_WELD = 1e-3
"""Distance over the mesh's length up to which it is tried whether joining closes the surface, for the message."""
MOST_OPEN_EDGES = 20_000
"""Open edges up to which it is looked for seams and for a remedy. A file of loose triangles has more, and no remedy."""
LONGEST_FILLING = 60.0
"""Time [s] after which the closing of holes is ended."""
DIRECTION = np.array([0.4142135, 0.7320508, 0.5403023])
"""Along this direction, which no ship's face lies across, vertices are sorted to find those near each other."""

Loop = npt.NDArray[np.int64]


@dataclass(frozen=True)
class Mended:
    """Vertices (n, 3) and triangles (m, 3) of a surface, and what was done to them, for the user."""

    vertices: Array
    triangles: Indices
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Edges:
    """Edges of a mesh: how many triangles each has, and how often it is passed upwards more than downwards."""

    count: npt.NDArray[np.int64]
    net: npt.NDArray[np.int64]
    directed: Indices  # (k, 2) of the first triangle of each edge


def join_same_vertices(vertices: Array, faces: Indices) -> tuple[Array, Indices]:
    """Vertices, those at one place joined, and the triangles with three different corners.

    STL repeats every corner, OBJ those where groups, materials or normals meet.
    """
    grid = _measure_length(vertices) * SAME_PLACE
    cells = np.round(vertices / grid).astype(np.int64)
    order = np.lexsort(cells.T[::-1])
    new = np.ones(len(order), dtype=bool)
    new[1:] = (cells[order[1:]] != cells[order[:-1]]).any(axis=1)
    joined = np.empty(len(order), dtype=np.int64)
    joined[order] = np.cumsum(new) - 1
    return _keep_used(vertices[order[new]], joined[faces])


def close_surface(name: str, mesh: Mended, metres: float, weld: float | None, fill: bool) -> Mended:
    """The closed surface.

    metres: per unit of the file; weld: distance [m] within which vertices of open edges are joined; fill: whether holes
    are closed. Raises ShipError with a place when the surface cannot be closed, or is none.
    """
    distance = WELD * _measure_length(mesh.vertices) if weld is None else weld / metres
    mesh = _weld(_drop_doubled(mesh), distance)
    is_loose = int((_find_edges(mesh).count == 1).sum()) > MOST_OPEN_EDGES
    if is_loose and not fill:
        raise ShipError(_describe_loose(name, mesh))
    if not is_loose:
        mesh = _close_seams(mesh, distance)
    if loops := _find_loops(mesh):
        if not fill:
            raise ShipError(_describe_holes(name, mesh, loops, distance, metres))
        mesh = _fill_holes(name, mesh, loops)
    _check_oriented(name, mesh)
    return mesh


def describe_place(point: Array) -> str:
    """A point of the file as text."""
    return "({:.6g}, {:.6g}, {:.6g})".format(*point.tolist())


def count(number: int, noun: str) -> str:
    """A number of things as text: 1 hole, 2 holes."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _measure_length(vertices: Array) -> float:
    return max(float(np.ptp(vertices, axis=0).max()), 1e-300)


def _keep_used(vertices: Array, triangles: Indices) -> tuple[Array, Indices]:
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    used = np.zeros(len(vertices), dtype=bool)
    used[triangles] = True
    return vertices[used], (np.cumsum(used) - 1)[triangles]


# -- faces and vertices -----------------------------------------------------------------------------


def _drop_doubled(mesh: Mended) -> Mended:
    """Of faces with the same corners, as many as differ in direction: of two alike one, of two opposite ones none.

    Where every face has its opposite (a surface drawn from both sides), one of each stays.
    """
    triangles = mesh.triangles
    if len(triangles) == 0:
        return mesh
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    corners = np.column_stack([low, triangles.sum(axis=1) - low - high, high])
    order = np.lexsort(corners.T)
    new = np.ones(len(order), dtype=bool)
    new[1:] = (corners[order[1:]] != corners[order[:-1]]).any(axis=1)
    if new.all():
        return mesh
    group = np.empty(len(order), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    a, b, c = corners.T
    p, q, _ = triangles.T
    direction = np.where(((p == a) & (q == b)) | ((p == b) & (q == c)) | ((p == c) & (q == a)), 1, -1)
    net = np.zeros(int(new.sum()), dtype=np.int64)
    np.add.at(net, group, direction)
    if (net == 0).all():
        net[group] = direction  # that of the last
    alike = np.flatnonzero(direction == np.sign(net)[group])
    _, first = np.unique(group[alike], return_index=True)
    kept = np.sort(alike[first])
    vertices, left = _keep_used(mesh.vertices, triangles[kept])
    note = f"{count(len(triangles) - len(kept), 'face')} of {len(triangles)}, given twice, dropped"
    return replace(mesh, vertices=vertices, triangles=left, notes=(*mesh.notes, note))


def _weld(mesh: Mended, distance: float) -> Mended:
    """Vertices of open edges nearer to each other than `distance` joined."""
    edges = _find_edges(mesh)
    open_ones = np.unique(edges.directed[edges.count == 1])
    if len(open_ones) == 0:
        return mesh
    joined = np.arange(len(mesh.vertices))
    joined[open_ones] = open_ones[_join_near(mesh.vertices[open_ones], distance)]
    moved = int((joined != np.arange(len(joined))).sum())
    if moved == 0:
        return mesh
    vertices, triangles = _keep_used(mesh.vertices, joined[mesh.triangles])
    note = f"vertices of open edges at most {distance:.3g} (in the file's unit) from others joined with them: {moved}"
    return _drop_doubled(Mended(vertices, triangles, (*mesh.notes, note)))


def _join_near(points: Array, distance: float) -> npt.NDArray[np.int64]:
    """For each point the first of those that it is joined with, over any number of steps up to `distance`."""
    along = points @ (DIRECTION / np.linalg.norm(DIRECTION))
    order = np.argsort(along, kind="stable")
    pairs = []
    for step in range(1, len(order)):
        near = along[order[step:]] - along[order[:-step]] <= distance
        if not near.any():
            break
        a, b = order[:-step][near], order[step:][near]
        close = np.linalg.norm(points[a] - points[b], axis=1) <= distance
        pairs.append(np.column_stack([a[close], b[close]]))
    label = np.arange(len(points))
    if pairs:
        a, b = np.vstack(pairs).T
        while (label[a] != label[b]).any():
            least = np.minimum(label[a], label[b])
            np.minimum.at(label, a, least)
            np.minimum.at(label, b, least)
    return label


def _find_edges(mesh: Mended) -> _Edges:
    directed = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    key = directed.min(axis=1) * len(mesh.vertices) + directed.max(axis=1)
    _, first, edge, count = np.unique(key, return_index=True, return_inverse=True, return_counts=True)
    net = np.zeros(len(count), dtype=np.int64)
    np.add.at(net, edge.reshape(-1), np.where(directed[:, 0] < directed[:, 1], 1, -1))
    return _Edges(count, net, directed[first])


def _check_oriented(name: str, mesh: Mended) -> None:
    """Every edge is passed as often in one direction as in the other."""
    edges = _find_edges(mesh)
    for wrong, said, remedy in (
        ((edges.net != 0) & (edges.count > 2), "edges belong to an odd number of faces, more than two",
         "remove inner walls and doubled faces"),
        (edges.net != 0, "edges lie between faces of which one looks inwards",
         "make the normals consistent (recalculate normals outside)"),
    ):  # fmt: skip
        if wrong.any():
            place = describe_place(mesh.vertices[edges.directed[int(np.argmax(wrong))]].mean(axis=0))
            raise ShipError(
                f"{name}: {int(wrong.sum())} {said}, one at {place} in the file: {remedy}, or set convex_hull = true"
            )


# -- loops of open edges ----------------------------------------------------------------------------


def _find_loops(mesh: Mended) -> list[Loop]:
    """Loops of vertices around holes, in the direction in which a face that fills one passes them."""
    edges = _find_edges(mesh)
    following: dict[int, list[int]] = {}
    for b, a in edges.directed[edges.count == 1].tolist():
        following.setdefault(a, []).append(b)
    loops: list[Loop] = []
    while following:
        start = next(iter(following))
        path, place = [start], {start: 0}
        while ends := following.get(path[-1]):
            end = ends.pop()
            if not ends:
                del following[path[-1]]
            if end not in place:
                place[end] = len(path)
                path.append(end)
                continue
            loop = path[place[end] :]  # a loop within the path is complete
            loops.append(np.array(loop))
            for vertex in loop[1:]:
                del place[vertex]
            del path[place[end] + 1 :]
        if len(path) > 2:  # faces of which one looks inwards: no face fills it
            loops.append(np.array(path))
    return loops


def _close_seams(mesh: Mended, distance: float) -> Mended:
    """Loops no wider than `distance` closed by a fan of triangles with hardly any area: a vertex on another's edge."""
    seams = [loop for loop in _find_loops(mesh) if _is_seam(mesh.vertices[loop], distance)]
    if not seams:
        return mesh
    fans = [np.column_stack([np.full(len(loop) - 2, loop[0]), loop[1:-1], loop[2:]]) for loop in seams if len(loop) > 2]
    note = f"{count(len(seams), 'seam')} closed, where vertices of one face lie on the edge of another"
    return replace(mesh, triangles=np.vstack([mesh.triangles, *fans]), notes=(*mesh.notes, note))


def _is_seam(points: Array, distance: float) -> bool:
    p = points - points.mean(axis=0)
    area = 0.5 * float(np.linalg.norm(np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0)))
    perimeter = float(np.linalg.norm(p - np.roll(p, -1, axis=0), axis=1).sum())
    if area > distance * perimeter:
        return False
    return len(p) == 3 or bool(np.linalg.svd(p, compute_uv=False)[1] <= distance * len(p))


def _fill_holes(name: str, mesh: Mended, loops: list[Loop]) -> Mended:
    """The mesh with every hole closed by triangles between its own vertices. Raises ShipError with a place."""
    check_installed("manifold3d", "holes are closed with it")
    given = {
        "points": mesh.vertices[np.concatenate(loops)], "sizes": np.array([len(loop) for loop in loops])
    }  # fmt: skip
    try:
        made = run_program("manifold_process", ("fill",), given, LONGEST_FILLING)
    except (ProgramError, OutOfTimeError) as error:
        raise HostError(f"{name}: its holes cannot be closed: manifold3d failed ({error or 'out of time'})") from None
    for loop, filled in zip(loops, made["filled"], strict=True):
        if not filled:
            raise ShipError(
                f"{name}: the hole {_describe_loop(mesh, loop)} is not a simple polygon, and fill_holes = true cannot "
                "close it: close it in the program that made the file, or set convex_hull = true"
            )
    note = f"{count(len(loops), 'hole')} closed, the largest {_describe_loop(mesh, _find_largest(mesh, loops))}"
    triangles = np.vstack([mesh.triangles, np.concatenate(loops)[made["triangles"]]])
    return replace(mesh, triangles=triangles, notes=(*mesh.notes, note))


def _find_largest(mesh: Mended, loops: list[Loop]) -> Loop:
    return max(loops, key=lambda loop: float(np.linalg.norm(np.ptp(mesh.vertices[loop], axis=0))))


def _describe_loop(mesh: Mended, loop: Loop) -> str:
    points = mesh.vertices[loop]
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    return f"{size:.4g} across around {describe_place(0.5 * (points.min(axis=0) + points.max(axis=0)))} in the file"


# -- what does not close ----------------------------------------------------------------------------


def _describe_holes(name: str, mesh: Mended, loops: list[Loop], distance: float, metres: float) -> str:
    """What is open, where, and those remedies that were tried and close it."""
    remedies = []
    if (weld := _find_closing_weld(mesh, distance, metres)) is not None:
        remedies.append(f"weld = {weld:.1g}")
    try:
        filled = _fill_holes(name, mesh, loops)
        _check_oriented(name, filled)
        box = float(np.prod(np.ptp(filled.vertices, axis=0)))
        if abs(enclosed_volume(filled.vertices, filled.triangles)) > LEAST_VOLUME * box:
            remedies.append("fill_holes = true")
    except (ShipError, HostError):
        pass
    remedies += ["convex_hull = true", "close deck, transom and holes in the program that made the file"]
    return (
        f"{name}: is not closed: {sum(map(len, loops))} open edges around {count(len(loops), 'hole')}, the largest "
        f"{_describe_loop(mesh, _find_largest(mesh, loops))}: set {', or '.join(remedies)}"
    )


def _describe_loose(name: str, mesh: Mended) -> str:
    """A surface with so many open edges that no remedy is looked for."""
    edges = _find_edges(mesh)
    is_open = edges.count == 1
    place = describe_place(mesh.vertices[edges.directed[int(np.argmax(is_open))]].mean(axis=0))
    return (
        f"{name}: is not closed: {int(is_open.sum())} open edges, one at {place} in the file, as of loose triangles: "
        "join them in the program that made the file (merge by distance), or set weld to the distance between them, or "
        "convex_hull = true"
    )


def _find_closing_weld(mesh: Mended, distance: float, metres: float) -> float | None:
    """The least weld [m] of 1, 2 or 5 times a power of ten that closes the surface; None where none does."""
    least, most = distance * metres, LARGEST_WELD * _measure_length(mesh.vertices) * metres
    for exponent in range(int(np.floor(np.log10(least))), int(np.floor(np.log10(most))) + 1):
        for digit in (1, 2, 5):
            weld = digit * 10.0**exponent
            if least < weld <= most:
                closed = _close_seams(_weld(mesh, weld / metres), weld / metres)
                if not (_find_edges(closed).net != 0).any():
                    return weld
    return None
