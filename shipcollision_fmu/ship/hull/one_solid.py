"""The one solid that the closed surfaces of a mesh bound, simple enough to be cut.

Surfaces that pass through each other are united, a surface inside another is a cavity and is filled, and a mesh of many
faces is simplified within a stated distance (manifold_process.py). A single surface of few faces stays as it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import HostError, ShipError
from ..frames import Array
from .child_process import Arrays, OutOfTimeError, ProgramError, check_installed, run_program
from .convex import CONVEX_WITHIN, LEAST_VOLUME, Indices, enclosed_volume, has_flat_triangles, is_convex
from .file_frame import FileFrame
from .mending import count, describe_place

__all__ = ["Solid", "find_convex_hull", "unite_surfaces"]

MOST_FACES = 2200
"""Faces above which a mesh is simplified. Cutting takes 10 s of CPU with as many, and three times that with 4 000."""
STEPS = (0.0025, 0.005, 0.01)
"""Distances over B by which simplification may move the surface: the next is tried where faces are still too many."""
CLEAN = 1e-6
"""Distance over the length within which triangles without area are dissolved."""
LONGEST = 60.0
"""Time [s] after which the work is ended and the mesh refused. 140 000 faces take 2 s."""


@dataclass(frozen=True)
class Solid:
    """A closed surface in b [m], normals outwards; what was done to make it so, and what the user is warned of."""

    vertices: Array
    triangles: Indices
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def unite_surfaces(name: str, vertices: Array, triangles: Indices, B: float, frame: FileFrame) -> Solid:
    """The solid inside closed, oriented surfaces in b [m]. Raises ShipError when they hold hardly anything."""
    box = float(np.prod(np.ptp(vertices, axis=0)))
    own = enclosed_volume(vertices, triangles)
    outwards = triangles if own >= 0.0 else triangles[:, ::-1].copy()
    if abs(own) > LEAST_VOLUME * box and _is_simple(vertices, outwards):
        return Solid(vertices, outwards)
    made = _run(name, vertices, outwards, B, convex=False)
    own = float(made["own_volume"] - made["cavity_volume"])
    if not own > LEAST_VOLUME * box:
        raise ShipError(
            f"{name}: encloses {own:.6g} m3, less than 1 % of the box around it: give the hull as one closed solid "
            "with a thickness, not as plates or shells inside each other, or set convex_hull = true"
        )
    if made["is_plain"]:
        return Solid(vertices, outwards, (), _list_warnings(made, frame))
    return Solid(made["vertices"], made["triangles"], _list_notes(made, triangles), _list_warnings(made, frame))


def find_convex_hull(name: str, vertices: Array, triangles: Indices, is_closed: bool, B: float) -> Solid:
    """The convex hull of a mesh, closed or not, and the volume that it adds."""
    made = _run(name, vertices, triangles if is_closed else triangles[:0], B, convex=True)
    volume, own = enclosed_volume(made["vertices"], made["triangles"]), float(made["own_volume"])
    if not volume > LEAST_VOLUME * float(np.prod(np.ptp(vertices, axis=0))):
        raise ShipError(f"{name}: its points lie in one plane: give the hull as a solid")
    if is_closed:
        said = f"and adds {volume - own:.4g} m3 to the mesh's {own:.4g} m3 ({volume / own - 1.0:.1%})"
    else:
        said = "and how much that adds is not known, for the mesh is not closed"
    warning = (
        f"its convex hull of {volume:.4g} m3 is taken (convex_hull = true), {said}: there is contact where there is no "
        "ship"
    )
    return Solid(made["vertices"], made["triangles"], _list_notes(made, triangles), (warning,))


def _is_simple(vertices: Array, triangles: Indices) -> bool:
    """Whether a mesh is convex, of few faces that all have an area, and so one surface."""
    return (
        len(triangles) <= MOST_FACES
        and not has_flat_triangles(vertices, triangles).any()
        and is_convex(vertices, triangles, CONVEX_WITHIN)
    )


def _run(name: str, vertices: Array, triangles: Indices, B: float, convex: bool) -> Arrays:
    check_installed("manifold3d", "a hull that is not convex is prepared with it")
    given = {
        "vertices": vertices, "triangles": triangles, "steps": np.array(STEPS) * B, "most_faces": np.array(MOST_FACES),
        "clean": np.array(CLEAN * float(np.ptp(vertices, axis=0).max())), "convex": np.array(convex),
    }  # fmt: skip
    try:
        return run_program("manifold_process", ("unite",), given, LONGEST)
    except OutOfTimeError:
        raise ShipError(f"{name}: its surfaces are not united within {LONGEST:g} s: simplify the mesh") from None
    except ProgramError as error:
        raise HostError(f"{name}: its surfaces cannot be united: manifold3d failed ({error})") from None


def _list_notes(made: Arrays, triangles: Indices) -> tuple[str, ...]:
    """What was done to the surfaces."""
    notes = []
    if made["cavities"]:
        cavities = count(int(made["cavities"]), "closed surface")
        notes.append(f"{cavities} inside others filled ({made['cavity_volume']:.4g} m3)")
    if made["turned"] and made["shells"] > 1:
        notes.append(f"normals of {made['turned']} of {made['shells']} closed surfaces turned outwards")
    if made["deviation"]:
        notes.append(
            f"{len(triangles)} faces are simplified to {len(made['triangles'])}, which moves the surface by at most "
            f"{float(made['deviation']):.3g} m"
        )
    return tuple(notes)


def _list_warnings(made: Arrays, frame: FileFrame) -> tuple[str, ...]:
    """Where surfaces pass through each other or themselves."""
    warnings = []
    if len(made["place"]):
        place = describe_place(frame.to_file(made["place"]))
        warnings.append(
            f"{made['shells']} closed surfaces pass through each other, two of them around {place} in the file: they "
            f"are one solid, and the {float(made['overlap']):.4g} m3 that they share count once"
        )
    if len(made["crossings"]):
        place = describe_place(frame.to_file(made["crossings"][0]))
        times = count(len(made["crossings"]), "place")
        warnings.append(
            f"its surface passes through itself at {times}, one at {place} in the file, and "
            "may be cut wrongly there: mend it in the program that made the file, or set convex_hull = true"
        )
    return tuple(warnings)
