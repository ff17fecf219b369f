"""Convex parts of a solid that is not convex.

CoACD (Wei et al. 2022, ACM Trans. Graph. 41(4)) cuts the solid along planes into parts whose convex hulls hold the
whole solid and little more (coacd_process.py). The cutting is seeded: the same solid gives the same parts, to the bit.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from time import monotonic

import numpy as np

from ...errors import HostError, ShipError
from ..frames import Array
from .child_process import OutOfTimeError, ProgramError, check_installed, run_program
from .convex import CONVEX_WITHIN, Indices, enclosed_volume, half_spaces, is_convex

__all__ = ["VOLUME_TOLERANCE", "Cut", "Part", "cut_into_convex_parts"]

VOLUME_TOLERANCE = 0.05
"""Largest volume that the convex parts may add to the solid, relative. More is a contact where there is no ship."""
BULGE_GOAL = 0.01
"""Bulge over B (how far a part stands out where the solid is hollow) at which the cutting is fine enough."""
CONCAVITIES = (0.03, 0.015)
"""CoACD's thresholds (a concavity over half the solid's length), from coarse to fine. From 0.01 on a ship falls into
dozens of parts, which takes half a minute and makes contact slow."""
FINE_FACES = 4000
"""Faces up to which a solid is cut more finely where its parts bulge. One of more faces is where they hold too much."""
ITERATIONS = ((1000, 150), (FINE_FACES, 60))
"""CoACD's search for each cut, up to so many faces. With 150, 2 100 faces take 10 s of CPU instead of 5; the parts hold
the same volume to 0.1 %."""
FEWEST_ITERATIONS = 20
"""The search for a solid of more faces: 12 000 (700 boxes on a deck) take 3 s of CPU, and minutes with 60."""
SEED = 1
LONGEST_CUTTING = 180.0
"""Time [s] after which the cutting is ended and the mesh refused. A simplified hull takes 10 s of CPU."""

_log = logging.getLogger("shipcollision_fmu")

Part = tuple[Array, Indices]


@dataclass(frozen=True)
class Cut:
    """Convex meshes that together hold a solid; what they add to its volume, relative; how far they bulge [m]."""

    parts: tuple[Part, ...]
    volume_error: float = 0.0
    bulge: float = 0.0


def cut_into_convex_parts(name: str, vertices: Array, triangles: Indices, max_parts: int) -> Cut:
    """At most max_parts convex parts of a closed solid; the solid itself when it is convex.

    Pieces that do not touch each other and are convex are parts; what is left is cut.
    name: of the mesh file, for messages. Raises ShipError when the parts add too much or the cutting takes too long,
    HostError when CoACD is missing or fails.
    """
    if is_convex(vertices, triangles, CONVEX_WITHIN):
        return Cut(((vertices, triangles),))
    check_installed("coacd", "a hull that is not convex is cut into parts with it")
    cut = _cut_pieces(name, (vertices, triangles), max_parts)
    if cut.volume_error > VOLUME_TOLERANCE:
        more = f"raise max_parts = {max_parts}, or " if len(cut.parts) >= max_parts else ""
        raise ShipError(
            f"{name}: its {len(cut.parts)} convex parts hold {cut.volume_error:.1%} more than the solid, at most "
            f"{VOLUME_TOLERANCE:.0%}: {more}leave out what does not touch other ships (masts, railings, tanks), or set "
            "convex_hull = true"
        )
    return cut


def _cut_pieces(name: str, solid: Part, max_parts: int) -> Cut:
    """The convex pieces of a solid as they are, and parts of the others."""
    convex: list[Part] = []
    others: list[Part] = []
    for piece in _split_into_pieces(*solid):
        (convex if is_convex(*piece, CONVEX_WITHIN) else others).append(piece)
    if not others and len(convex) <= max_parts:
        return Cut(tuple(convex))
    if not convex or len(convex) >= max_parts:
        return _cut_solid(name, solid, max_parts)
    rest = _join_pieces(others)
    cut = _cut_solid(name, rest, max_parts - len(convex))
    share = enclosed_volume(*rest) / enclosed_volume(*solid)
    return Cut((*convex, *cut.parts), cut.volume_error * share, cut.bulge)


def _split_into_pieces(vertices: Array, triangles: Indices) -> list[Part]:
    """The connected pieces of a mesh."""
    label = np.arange(len(vertices))
    while True:
        least = label.copy()
        np.minimum.at(least, triangles, label[triangles].min(axis=1)[:, None])
        least = least[least]
        if (least == label).all():
            break
        label = least
    pieces = []
    for first in np.unique(label[triangles[:, 0]]).tolist():
        own = triangles[label[triangles[:, 0]] == first]
        used, corners = np.unique(own, return_inverse=True)
        pieces.append((vertices[used], corners.reshape(-1, 3).astype(np.int64)))
    return pieces


def _join_pieces(pieces: Sequence[Part]) -> Part:
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in pieces)])
    triangles = [faces + start for (_, faces), start in zip(pieces, starts, strict=False)]
    return np.vstack([vertices for vertices, _ in pieces]), np.vstack(triangles)


def _cut_solid(name: str, solid: Part, max_parts: int) -> Cut:
    """The solid cut at the first of CONCAVITIES that is fine enough, or at the one that bulges least."""
    volume, best = enclosed_volume(*solid), None
    _log.warning(
        "%s is cut into convex parts, once for this file: %d faces, at most %g s", name, len(solid[1]), LONGEST_CUTTING
    )
    end = monotonic() + LONGEST_CUTTING
    goal = BULGE_GOAL * float(np.ptp(solid[0][:, 1]))
    for threshold in CONCAVITIES:
        if best is not None:
            _log.warning(
                "%s: its %d parts bulge by %.2g m, more than %.2g m: it is cut more finely, for at most %.0f s more",
                name, len(best.parts), best.bulge, goal, end - monotonic(),
            )  # fmt: skip
        parts = _run_coacd(name, solid, threshold, max_parts, end - monotonic())
        cut = Cut(parts, sum(enclosed_volume(*part) for part in parts) / volume - 1.0, _measure_bulge(solid[0], parts))
        if best is None or cut.bulge < best.bulge:
            best = cut
        if best.bulge <= goal or (len(solid[1]) > FINE_FACES and best.volume_error <= VOLUME_TOLERANCE):
            break
    assert best is not None
    return best


def _run_coacd(name: str, solid: Part, threshold: float, max_parts: int, longest: float) -> tuple[Part, ...]:
    iterations = next((n for most, n in ITERATIONS if len(solid[1]) <= most), FEWEST_ITERATIONS)
    given = {"vertices": solid[0], "triangles": solid[1]}
    try:
        made = run_program("coacd_process", (threshold, max_parts, iterations, SEED), given, max(longest, 0.001))
    except OutOfTimeError:
        raise ShipError(
            f"{name}: is not cut into convex parts within {LONGEST_CUTTING:g} s: simplify the mesh, leave out what "
            "does not touch other ships, or set convex_hull = true"
        ) from None
    except ProgramError as error:
        raise HostError(f"{name}: cannot be cut into convex parts: coacd failed ({error})") from None
    return tuple((made[f"v{i}"], made[f"t{i}"]) for i in range(int(made["count"])))


def _measure_bulge(surface: Array, parts: Sequence[Part]) -> float:
    """How deep [m] the deepest vertex of the solid's surface lies inside a part; it should lie on one."""
    deepest = 0.0
    for part in parts:
        planes = half_spaces(*part)
        inside = (planes[:, 3] - surface @ planes[:, :3].T).min(axis=1)
        deepest = max(deepest, float(inside.max()))
    return deepest
