"""scene.osgt and camera.path: a scene for stock osgviewer of OpenSceneGraph.

    root  sky, sun
    ├── sea                     a transparent disc, drawn after the solids
    ├── obstacles
    └── per ship  osg::MatrixTransform with an AnimationPath: z-up body axes in w, see zup.py
        ├── hull and fittings
        ├── per scratch  osg::Sequence: the line as it is at more and more of its times
        └── effects      osg_effects.py

osgviewer has no slider, and it needs a moment to open its window. The run is therefore delayed so that the first
contact comes FIRST_CONTACT after the window opens; ships lie still until the run starts. `delay` is its delay [s].
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from shlex import quote as quote_for_shell

import numpy as np

from ...files import IN_PLACE, write_file
from ...ship.frames import SWAP, Array, quaternion, rotation
from ..scene.camera import place_camera
from ..scene.palette import Paint, convert_to_display, find_paint
from ..scene.parts import Part, list_obstacle_parts, list_ship_parts
from ..scene.resample import choose_samples
from ..scene.scene import Obstacle, Scene, Scratch, Ship
from ..scene.surface import Surface, compute_corner_normals, drop_flat_triangles
from . import zup
from .osg_effects import build_effects, build_sprites
from .osgt import Item, Raw, format_document, format_number, format_numbers, format_vectors, quote

__all__ = ["OsgFiles", "build_osg_files", "format_viewer_command", "write_osg"]

FIRST_CONTACT = 4.0
"""[s] Earliest time of contact after the start of osgviewer, so that the window is open by then."""
LONGEST_LINE = 200
"""Most steps in which a scratch grows; each step is a node."""
LIFT = 0.15
"""[m] Distance of a scratch from the plating, which would otherwise hide it in part."""
DENT = 1.5
"""[m] Length of the cross that marks a shorter scratch."""
LINE_WIDTH = 4.0
CAMERA_ERROR = 0.05
"""[m] Largest error of the camera by thinning."""
FOREVER = 86400.0
"""[s] End of the camera's path, which osgviewer repeats: a day."""

SEA = np.array([0.03, 0.19, 0.30, 0.80])
SKY = (0.74, 0.83, 0.92)
SEA_RADIUS = 12e3
SUN = (0.45, -0.35, 0.82, 0.0)
"""Towards the sun in w; a fourth number of 0 makes it a direction."""


@dataclass(frozen=True)
class OsgFiles:
    """Files by name, and their delay after the times of the run [s]."""

    files: dict[str, str | bytes]
    delay: float


def write_osg(scene: Scene, folder: Path) -> list[Path]:
    """Write scene.osgt, camera.path and the sprite into a folder; returns the paths, scene.osgt last."""
    files = build_osg_files(scene).files
    return [write_file(folder / name, content, IN_PLACE) for name, content in files.items()]


def format_viewer_command(folder: Path) -> str:
    """The shell command that shows the scene in `folder`. OSG searches OSG_FILE_PATH for the sprites."""
    place = quote_for_shell(str(folder))
    return (
        f"OSG_FILE_PATH={place} osgviewer --window 80 80 1280 720 "
        f"-p {quote_for_shell(str(folder / 'camera.path'))} {quote_for_shell(str(folder / 'scene.osgt'))}"
    )


def build_osg_files(scene: Scene) -> OsgFiles:
    """The files of a scene: sprite, camera.path, scene.osgt."""
    first = min((effect.time for effect in scene.effects), default=np.inf)
    delay = max(0.0, FIRST_CONTACT - (first - scene.start)) - scene.start if np.isfinite(first) else -scene.start
    text = format_document(_build_root(scene, delay))
    return OsgFiles({**build_sprites(), "camera.path": _format_camera_path(scene, delay), "scene.osgt": text}, delay)


def _build_root(scene: Scene, delay: float) -> Item:
    return Item(
        "osg::Group",
        Name=quote(f"{scene.name}; run time = time here - {format_number(round(delay, 3))} s"),
        StateSet=Item("osg::StateSet", ModeList=_format_modes(GL_LIGHTING="ON", GL_LIGHT0="ON"),
                      AttributeList=_build_matt_material()),
        Children=[
            Item("osg::ClearNode", ClearColor=format_numbers((*SKY, 1.0))),
            Item(
                "osg::LightSource",
                CullingActive=Raw("FALSE"),
                Light=Item(
                    "osg::Light", LightNum=Raw(0), Ambient=format_numbers((0.42, 0.44, 0.47, 1.0)),
                    Diffuse=format_numbers((0.72, 0.70, 0.66, 1.0)), Specular=format_numbers((0.0, 0.0, 0.0, 1.0)),
                    Position=format_numbers(SUN),
                ),
            ),
            _build_sea(scene),
            *(_build_obstacle(obstacle) for obstacle in scene.obstacles),
            *(_build_ship(scene, i, delay) for i in range(len(scene.ships))),
        ],
    )  # fmt: skip


def _format_modes(**modes: str) -> Raw:
    return Raw("\n".join([f"{len(modes)} {{", *(f"{name} {value}" for name, value in modes.items()), "}"]))


def _format_attribute(item: Item) -> Raw:
    return Raw("1 {\n{}\nValue OFF\n}", item)


def _build_matt_material() -> Raw:
    """A material without gloss that takes its colour from the vertices."""
    black = Raw("TRUE Front 0 0 0 1 Back 0 0 0 1")
    return _format_attribute(Item("osg::Material", ColorMode=Raw("AMBIENT_AND_DIFFUSE"), Specular=black))


def _build_ship(scene: Scene, index: int, delay: float) -> Item:
    ship = scene.ships[index]
    return Item(
        "osg::MatrixTransform",
        Name=quote(ship.name),
        DataVariance=Raw("DYNAMIC"),
        UpdateCallback=_build_animation(ship, delay),
        Children=[
            _build_geode(list_ship_parts(ship, index), "hull"),
            *(_build_scratch(scratch, delay) for scratch in scene.scratches if scratch.ship == ship.name),
            *build_effects([effect for effect in scene.effects if effect.ship == ship.name], delay),
        ],
    )


def _build_animation(ship: Ship, delay: float) -> Item:
    """The ship's track. Positions are linear between its points and attitudes slerp, in OSG as in Track."""
    places, attitudes = zup.convert_vectors(ship.track.position), zup.convert_quaternions(ship.track.quaternion)
    lines = [f"{len(places)} {{"]
    for time, place, attitude in zip(ship.track.times, places, attitudes, strict=True):
        lines += [
            f"Time {format_number(time + delay)} {{",
            f"Position {format_numbers(place)}",
            f"Rotation {format_numbers(attitude)}",
            "Scale 1 1 1",
            "}",
        ]
    path = Item("osg::AnimationPath", TimeControlPointMap=Raw("\n".join([*lines, "}"])), LoopMode=Raw("NO_LOOPING"))
    return Item("osg::AnimationPathCallback", AnimationPath=path)


def _build_obstacle(obstacle: Obstacle) -> Item:
    turned = SWAP @ rotation((0.0, 0.0, obstacle.heading)) @ SWAP
    matrix = np.eye(4)
    matrix[:3, :3], matrix[3, :3] = turned.T, zup.convert_vectors(obstacle.position)  # OSG's vectors are rows
    rows = "\n".join(str(format_numbers(row)) for row in matrix)
    return Item(
        "osg::MatrixTransform",
        Name=quote(obstacle.name),
        Children=[_build_geode(list_obstacle_parts(obstacle), "obstacle")],
        Matrix=Raw(f"{{\n{rows}\n}}"),
    )


def _build_geode(parts: list[Part], name: str) -> Item:
    """One geometry per paint."""
    return Item("osg::Geode", Name=quote(name), Drawables=[_build_geometry(*part) for part in parts])


def _build_geometry(paint: Paint, surface: Surface) -> Item:
    solid = drop_flat_triangles(surface)
    corners, normals = solid.vertices[solid.triangles].reshape(-1, 3), compute_corner_normals(solid).reshape(-1, 3)
    both = np.round(np.hstack([zup.convert_vectors(corners), zup.convert_vectors(normals)]), 4) + 0.0
    rows, index = np.unique(both, axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    listed = "\n".join(" ".join(map(str, row)) for row in triangles.tolist())
    indices = Item("osg::DrawElementsUInt", Mode=Raw("TRIANGLES"), vector=Raw(f"{index.size} {{\n{listed}\n}}"))
    return Item(
        "osg::Geometry",
        PrimitiveSetList=[indices],
        VertexArray=_build_array("osg::Vec3Array", "BIND_PER_VERTEX", rows[:, :3]),
        NormalArray=_build_array("osg::Vec3Array", "BIND_PER_VERTEX", rows[:, 3:]),
        ColorArray=_build_array("osg::Vec4Array", "BIND_OVERALL", np.array([[*convert_to_display(paint.colour), 1.0]])),
    )


def _build_array(kind: str, binding: str, rows: Array) -> Item:
    return Item(kind, Binding=Raw(binding), vector=format_vectors(rows))


def _build_scratch(scratch: Scratch, delay: float) -> Item:
    """A line that grows: child i of the sequence is drawn from the i-th time on, child 0, nothing, before the first."""
    points = scratch.points + LIFT * scratch.normals
    if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() < DENT:
        points, mode, counts, times = _find_cross(points[0], scratch.normals[0]), "LINES", [4], scratch.times[:1]
    else:
        mode = "LINE_STRIP"
        chosen = np.unique(np.round(np.linspace(1, len(points) - 1, LONGEST_LINE)).astype(int))
        counts, times = (chosen + 1).tolist(), scratch.times[chosen]
    vertices = _build_array("osg::Vec3Array", "BIND_PER_VERTEX", np.round(zup.convert_vectors(points), 4) + 0.0)
    colour = _build_array(
        "osg::Vec4Array", "BIND_OVERALL", np.array([[*convert_to_display(find_paint("scratch").colour), 1.0]])
    )
    lines = [
        Item(
            "osg::Geode",
            Drawables=[
                Item(
                    "osg::Geometry",
                    PrimitiveSetList=[Item("osg::DrawArrays", Mode=Raw(mode), Count=Raw(count))],
                    VertexArray=vertices,
                    ColorArray=colour,
                )
            ],
        )
        for count in counts
    ]
    shown = np.diff(np.concatenate([[-delay], times]), append=times[-1] + 1.0)
    return Item(
        "osg::Sequence",
        Name=quote(f"scratch {scratch.id}"),
        StateSet=Item(
            "osg::StateSet",
            ModeList=_format_modes(GL_LIGHTING="OFF"),
            AttributeList=_format_attribute(Item("osg::LineWidth", Width=Raw(format_number(LINE_WIDTH)))),
        ),
        Children=[Item("osg::Group"), *lines],
        TimeList=Raw(f"{len(shown)} {{\n{format_numbers(np.round(shown, 6))}\n}}"),
        Speed=Raw(1),
        NumRepeats=Raw(1),
        Mode=Raw("START"),
        Sync=Raw("TRUE"),
    )


def _find_cross(point: Array, normal: Array) -> Array:
    """Ends of two lines (4, 3) across each other on the plating."""
    level = np.cross(normal, (0.0, 0.0, 1.0))
    first = level / np.linalg.norm(level) if np.linalg.norm(level) > 1e-6 else np.array([1.0, 0.0, 0.0])
    second = np.cross(normal, first)
    arms = DENT * np.sqrt(0.5) * np.array([first + second, -first - second, first - second, second - first])
    crossed: Array = point + arms
    return crossed


def _build_sea(scene: Scene) -> Item:
    """A disc of rings with random shades, which make motion visible; it fades into the sky at its edge."""
    sectors, radii = 64, np.concatenate([[0.0], np.geomspace(15.0, SEA_RADIUS, 30)])
    angle = np.arange(sectors) * 2 * np.pi / sectors
    ring = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    points = (radii[:, None, None] * ring).reshape(-1, 3)
    rng = np.random.default_rng(1)
    shade = 1.0 + 0.16 * rng.standard_normal(len(points))[:, None]
    far = np.repeat(np.clip(radii / SEA_RADIUS, 0.0, 1.0) ** 0.7, sectors)[:, None]
    colours = np.clip(SEA * np.hstack([shade, shade, shade, np.ones_like(shade)]), 0.0, 1.0)
    colours += far * (np.array([*SKY, 1.0]) - colours)
    i, j = np.meshgrid(np.arange(len(radii) - 1), np.arange(sectors), indexing="ij")
    a, b = (i * sectors + j).ravel(), (i * sectors + (j + 1) % sectors).ravel()
    quads = np.stack([a, a + sectors, b + sectors, a, b + sectors, b], axis=1).reshape(-1, 3)
    listed = "\n".join(" ".join(map(str, row)) for row in quads.tolist())
    disc = Item(
        "osg::Geometry",
        PrimitiveSetList=[
            Item("osg::DrawElementsUInt", Mode=Raw("TRIANGLES"), vector=Raw(f"{quads.size} {{\n{listed}\n}}"))
        ],
        VertexArray=_build_array("osg::Vec3Array", "BIND_PER_VERTEX", np.round(points, 2) + 0.0),
        ColorArray=_build_array("osg::Vec4Array", "BIND_PER_VERTEX", np.round(colours, 3)),
    )
    state = Item(
        "osg::StateSet",
        ModeList=_format_modes(GL_LIGHTING="OFF", GL_BLEND="ON"),
        # after the solids (bin 0), before the particles (bin 10), whatever the distance
        RenderBinMode=Raw("USE_RENDERBIN_DETAILS"),
        BinNumber=Raw(5),
        BinName=quote("RenderBin"),
    )
    matrix = np.eye(4)
    matrix[3, :3] = zup.convert_vectors(scene.origin)
    rows = "\n".join(str(format_numbers(row)) for row in matrix)
    return Item(
        "osg::MatrixTransform",
        Name=quote("sea"),
        StateSet=state,
        Children=[Item("osg::Geode", Drawables=[disc])],
        Matrix=Raw(f"{{\n{rows}\n}}"),
    )


def _format_camera_path(scene: Scene, delay: float) -> str:
    """Lines of time, place of the eye and quaternion, for `osgviewer -p`: OSG's eye looks along -z, y up."""
    camera = place_camera(scene)
    times = np.unique(np.concatenate([ship.track.times for ship in scene.ships]))
    times = np.unique(np.concatenate([times, np.linspace(times[0], times[-1], 50)]))
    views = [camera.at(float(time)) for time in times]
    eyes = np.array([zup.convert_vectors(eye) for eye, _ in views])
    turns = np.array([_find_view_rotation(*view) for view in views])
    rows = choose_samples(times, np.hstack([eyes, 500.0 * turns]), CAMERA_ERROR)
    lines = [
        f"{format_number(times[i] + delay)} {format_numbers(np.round(eyes[i], 3))} {format_numbers(turns[i])}"
        for i in rows
    ]
    held = [f"{format_number(time)} {line.split(' ', 1)[1]}" for time, line in ((0.0, lines[0]), (FOREVER, lines[-1]))]
    return "\n".join([*held[: int(delay + times[0] > 0.0)], *lines, held[1], ""])


def _find_view_rotation(eye: Array, target: Array) -> Array:
    """Quaternion (4,) in w of an eye in n that looks at a target in n."""
    ahead = zup.convert_vectors(target - eye)
    back = -ahead / np.linalg.norm(ahead)
    right = np.cross((0.0, 0.0, 1.0), back)
    right /= np.linalg.norm(right)
    return quaternion(np.column_stack([right, np.cross(back, right), back]))
