"""draw_picture(): lit hulls, sea and sky, scratches, and puffs of the effects.

Solids are sampled at `SAMPLES` x `SAMPLES` points per pixel and averaged. Sea, sky and puffs have soft edges and are
computed once per pixel. A hull below the sea's surface shines through, the less the deeper it is. All vectors are in n.

No library is used. Renderers without a GPU, a display or system packages (Panda3D's, 55 MB; PyBullet's, without lines
and particles) would replace the fifty lines of raster.py only: water, puffs and anti-aliasing would still be ours. VTK
has 140 MB and needs Mesa; Matplotlib has no depth buffer.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from . import sea
from .puffs import Puffs
from .raster import NOTHING, Eye, Nearest, find_nearest

__all__ = ["Backdrop", "Faces", "Line", "draw_backdrop", "draw_picture"]

SAMPLES = 2
"""Points per pixel in each direction for solids; with 1, edges show stairs."""
SUN = np.array([-0.42, 0.50, -0.76])
"""Towards the sun, in n; a unit vector to three digits."""
AMBIENT = 0.58
"""Share of the light that reaches every face."""
SURFACE = 0.75
"""Share of light from just below the surface that passes it; the surface mirrors the rest."""
LINE_LIFT = 0.01
"""Fraction of its distance by which a scratch is drawn nearer, so that the plating does not hide it."""


@dataclass(frozen=True, eq=False)
class Faces:
    """Triangles (m, 3, 3) in n [m] of closed surfaces, seen from outside only, and their colours (m, 3)."""

    corners: Array
    colours: Array


@dataclass(frozen=True, eq=False)
class Line:
    """A polyline (k, 3) in n [m] with a width [pixels] and a colour."""

    points: Array
    width: float
    colour: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Backdrop:
    """Sky and sea before an eye: colour (height, width, 3), depth of the sea, inf for the sky, and length of a ray of
    depth 1 (height, width)."""

    eye: Eye
    colour: Array
    depth: Array
    stretch: Array


def draw_backdrop(eye: Eye, time: float) -> Backdrop:
    """Sky and sea with the waves of `time` [s]."""
    rays = eye.rays()
    depth = sea.find_depth(eye, rays)
    wet = np.isfinite(depth)
    colour = sea.colour_sky(rays)
    colour[wet] = sea.colour_sea(eye, rays[wet], depth[wet], time)
    return Backdrop(eye, colour, depth, np.linalg.norm(rays, axis=-1))


def draw_picture(
    behind: Backdrop, faces: Faces, lines: Sequence[Line], clouds: Iterable[tuple[Array, Puffs]]
) -> npt.NDArray[np.uint8]:
    """The picture before a backdrop, (height, width, 3). `clouds`: origin (3,) in n and puffs of effects."""
    eye = behind.eye
    fine = replace(eye, width=SAMPLES * eye.width, height=SAMPLES * eye.height)
    colour, depth = _lay_over(behind, *_draw_solids(fine, faces, lines))
    for origin, puffs in clouds:
        _add_puffs(eye, colour, depth, origin + puffs.offset, puffs)
    return np.asarray(np.round(255.0 * np.clip(colour, 0.0, 1.0)), dtype=np.uint8)


def _draw_solids(eye: Eye, faces: Faces, lines: Sequence[Line]) -> tuple[Array, Nearest]:
    """Colours (m, 3) of the triangles of solids and lines in their light, and what is seen of them."""
    corners = faces.corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    front = np.einsum("ij,ij->i", normals, corners[:, 0] - eye.position) < 0.0
    corners, normals = corners[front], normals[front]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    light = AMBIENT + (1.0 - AMBIENT) * np.clip(normals @ SUN, 0.0, 1.0)
    ribbons = [_widen_line(eye, line) for line in lines]
    seen = find_nearest(eye, np.concatenate([corners, *ribbons]))
    painted = [np.broadcast_to(line.colour, (len(ribbon), 3)) for line, ribbon in zip(lines, ribbons, strict=True)]
    return np.concatenate([faces.colours[front] * light[:, None], *painted]), seen


def _widen_line(eye: Eye, line: Line) -> Array:
    """Triangles (m, 3, 3) of a line as wide as it should look, turned to the eye and lifted towards it."""
    points = eye.position + (line.points - eye.position) * (1.0 - LINE_LIFT)
    start, end = points[:-1], points[1:]
    across = np.cross(end - start, start - eye.position)
    size = np.linalg.norm(across, axis=1)
    start, end, across = start[size > 0], end[size > 0], across[size > 0] / size[size > 0][:, None]
    depth = (start - eye.position) @ eye.axes[2]
    half = across * (0.5 * SAMPLES * line.width * depth / eye.focal)[:, None]
    a, b, c, d = start - half, start + half, end + half, end - half
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def _lay_over(behind: Backdrop, colours: Array, seen: Nearest) -> tuple[Array, Array]:
    """Solids, found at the samples, before sea and sky or shining through the sea: colour and depth per pixel."""
    row, column = np.nonzero(seen.triangle != NOTHING)
    pixel = (row // SAMPLES, column // SAMPLES)
    way = (seen.depth[row, column] - behind.depth[pixel]) * behind.stretch[pixel]
    share = np.where(way > 0.0, SURFACE * sea.find_clarity(way), 1.0) / SAMPLES**2
    change = share[:, None] * (colours[seen.triangle[row, column]] - behind.colour[pixel])
    place = np.ravel_multi_index(pixel, behind.depth.shape)
    summed = [np.bincount(place, change[:, k], behind.depth.size).reshape(behind.depth.shape) for k in range(3)]
    return behind.colour + np.stack(summed, axis=-1), np.minimum(seen.depth[::SAMPLES, ::SAMPLES], behind.depth)


_SPRITE = 96
"""Width of the picture of a puff [texels]."""


def _make_sprite() -> Array:
    """Density of a puff over its square, (_SPRITE, _SPRITE): round, soft, with lumps."""
    rng = np.random.default_rng(7)
    u = np.linspace(-1.0, 1.0, _SPRITE)
    x, y = np.meshgrid(u, u)
    lumps = np.zeros_like(x)
    for _ in range(24):
        cx, cy = rng.uniform(-0.6, 0.6, 2)
        lumps += rng.uniform(0.5, 1.0) * np.exp(-((x - cx) ** 2 + (y - cy) ** 2) / 0.05)
    round_ = np.clip(1.0 - np.hypot(x, y), 0.0, 1.0)
    return np.asarray(np.clip(round_ * (0.45 + 0.75 * lumps / lumps.max()) * 1.6, 0.0, 1.0))


_DENSITY = _make_sprite()


def _add_puffs(eye: Eye, colour: Array, depth: Array, places: Array, puffs: Puffs) -> None:
    """Lay puffs over the picture, from the farthest to the nearest; solids and the sea hide what is behind them."""
    projected = eye.project(places)
    for i in np.argsort(-projected[:, 2], kind="stable"):
        x, y, far = projected[i]
        if not far > 2.0 * puffs.radius[i]:
            continue
        r = eye.focal * puffs.radius[i] / far
        x0, x1 = (int(v) for v in np.clip([np.floor(x - r), np.ceil(x + r) + 1], 0, eye.width))
        y0, y1 = (int(v) for v in np.clip([np.floor(y - r), np.ceil(y + r) + 1], 0, eye.height))
        if x0 >= x1 or y0 >= y1 or r < 0.2:
            continue
        turn = i % 2 == 0
        u = np.clip((np.arange(x0, x1) + 0.5 - x) / r * (1 if turn else -1), -1.0, 1.0)
        v = np.clip((np.arange(y0, y1) + 0.5 - y) / r, -1.0, 1.0)
        texel = [np.rint((w + 1.0) * 0.5 * (_SPRITE - 1)).astype(int) for w in (v, u)]
        density = puffs.opacity[i] * _DENSITY[np.ix_(*texel)]
        density = density * np.clip((depth[y0:y1, x0:x1] - far) / puffs.radius[i] + 1.0, 0.0, 1.0)
        light = puffs.colour[i] * (1.0 - 0.25 * v[:, None, None] * (1.0 - puffs.glow[i]))
        patch = colour[y0:y1, x0:x1]
        patch *= 1.0 - (density * (1.0 - 0.6 * puffs.glow[i]))[..., None]
        patch += density[..., None] * light
