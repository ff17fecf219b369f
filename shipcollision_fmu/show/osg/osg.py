"""A scene for OpenSceneGraph: what stock osgviewer plays.

    root  sky, sun
    ├── sea                     a disc on the water, drawn after the solids, through which they are seen
    ├── obstacles
    └── per ship  osg::MatrixTransform with an AnimationPath: z-up body axes in w, see zup.py
        ├── hull and fittings
        ├── per scratch  osg::Sequence: the line as it is at more and more of its times
        └── effects      osg_effects.py

osgviewer has no slider, and it needs a moment to open its window. So the run begins late enough that the first contact
comes FIRST_CONTACT after the window opens, ships lying still until then; `delay` says by how much.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from shlex import quote

import numpy as np

from ...files import IN_PLACE, write_file
from ...ship.frames import SWAP, Array, quaternion, rotation
from ..scene.camera import camera_of
from ..scene.palette import Paint, display, paint_of
from ..scene.parts import Part, obstacle_parts, ship_parts
from ..scene.resample import kept
from ..scene.scene import Obstacle, Scene, Scratch, Ship
from ..scene.surface import Surface, corner_normals, solid_triangles
from . import zup
from .osg_effects import effect_items, sprite_files
from .osgt import Item, Raw, document, number, numbers, quoted, vectors

__all__ = ["OsgFiles", "osg_files", "viewer_line", "write_osg"]

FIRST_CONTACT = 4.0
"""Earliest time after the start of osgviewer at which ships touch [s]."""
LONGEST_LINE = 200
"""Steps in which a scratch grows, at most: each is a node."""
LIFT = 0.15
"""Of a scratch off the plating [m], which would hide it in part."""
DENT = 1.5
"""Arm of the cross that marks a scratch that is shorter than it [m]."""
LINE_WIDTH = 4.0
CAMERA_ERROR = 0.05
"""What thinning may move the camera by [m]."""
FOREVER = 86400.0
"""The camera's path, which osgviewer repeats, ends so long after the run [s]."""

SEA = np.array([0.03, 0.19, 0.30, 0.80])
SKY = (0.74, 0.83, 0.92)
SEA_RADIUS = 12e3
SUN = (0.45, -0.35, 0.82, 0.0)
"""Towards the sun in w; a fourth number of 0 makes it a direction."""


@dataclass(frozen=True)
class OsgFiles:
    """Files by name, and how much later than in the run everything happens in them [s]."""

    files: dict[str, str | bytes]
    delay: float


def write_osg(scene: Scene, folder: Path) -> list[Path]:
    """Write scene.osgt, camera.path and the sprite into a folder; returns the paths, scene.osgt last."""
    files = osg_files(scene).files
    return [write_file(folder / name, content, IN_PLACE) for name, content in files.items()]


def viewer_line(folder: Path) -> str:
    """The line for a shell that shows the scene in `folder`. OSG looks for the sprite along OSG_FILE_PATH."""
    place = quote(str(folder))
    return (
        f"OSG_FILE_PATH={place} osgviewer --window 80 80 1280 720 "
        f"-p {quote(str(folder / 'camera.path'))} {quote(str(folder / 'scene.osgt'))}"
    )


def osg_files(scene: Scene) -> OsgFiles:
    """The files of a scene: sprite, camera.path, scene.osgt."""
    first = min((effect.time for effect in scene.effects), default=np.inf)
    delay = max(0.0, FIRST_CONTACT - (first - scene.start)) - scene.start if np.isfinite(first) else -scene.start
    text = document(_root(scene, delay))
    return OsgFiles({**sprite_files(), "camera.path": _camera_path(scene, delay), "scene.osgt": text}, delay)


def _root(scene: Scene, delay: float) -> Item:
    return Item(
        "osg::Group",
        Name=quoted(f"{scene.name}; run time = time here - {number(round(delay, 3))} s"),
        StateSet=Item("osg::StateSet", ModeList=_modes(GL_LIGHTING="ON", GL_LIGHT0="ON"), AttributeList=_matt()),
        Children=[
            Item("osg::ClearNode", ClearColor=numbers((*SKY, 1.0))),
            Item(
                "osg::LightSource",
                CullingActive=Raw("FALSE"),
                Light=Item(
                    "osg::Light", LightNum=Raw(0), Ambient=numbers((0.42, 0.44, 0.47, 1.0)),
                    Diffuse=numbers((0.72, 0.70, 0.66, 1.0)), Specular=numbers((0.0, 0.0, 0.0, 1.0)),
                    Position=numbers(SUN),
                ),
            ),
            _sea(scene),
            *(_obstacle(obstacle) for obstacle in scene.obstacles),
            *(_ship(scene, i, delay) for i in range(len(scene.ships))),
        ],
    )  # fmt: skip


def _modes(**modes: str) -> Raw:
    return Raw("\n".join([f"{len(modes)} {{", *(f"{name} {value}" for name, value in modes.items()), "}"]))


def _attribute(item: Item) -> Raw:
    return Raw("1 {\n{}\nValue OFF\n}", item)


def _matt() -> Raw:
    """Vertex colours are the surface's own, and nothing shines."""
    black = Raw("TRUE Front 0 0 0 1 Back 0 0 0 1")
    return _attribute(Item("osg::Material", ColorMode=Raw("AMBIENT_AND_DIFFUSE"), Specular=black))


def _ship(scene: Scene, index: int, delay: float) -> Item:
    ship = scene.ships[index]
    return Item(
        "osg::MatrixTransform",
        Name=quoted(ship.name),
        DataVariance=Raw("DYNAMIC"),
        UpdateCallback=_animation(ship, delay),
        Children=[
            _geode(ship_parts(ship, index), "hull"),
            *(_scratch(scratch, delay) for scratch in scene.scratches if scratch.ship == ship.name),
            *effect_items([effect for effect in scene.effects if effect.ship == ship.name], delay),
        ],
    )


def _animation(ship: Ship, delay: float) -> Item:
    """The ship's track. Positions are linear between its points and attitudes slerp, in OSG as in Track."""
    places, attitudes = zup.places(ship.track.position), zup.attitudes(ship.track.quaternion)
    lines = [f"{len(places)} {{"]
    for time, place, attitude in zip(ship.track.times, places, attitudes, strict=True):
        lines += [
            f"Time {number(time + delay)} {{",
            f"Position {numbers(place)}",
            f"Rotation {numbers(attitude)}",
            "Scale 1 1 1",
            "}",
        ]
    path = Item("osg::AnimationPath", TimeControlPointMap=Raw("\n".join([*lines, "}"])), LoopMode=Raw("NO_LOOPING"))
    return Item("osg::AnimationPathCallback", AnimationPath=path)


def _obstacle(obstacle: Obstacle) -> Item:
    turned = SWAP @ rotation((0.0, 0.0, obstacle.heading)) @ SWAP
    matrix = np.eye(4)
    matrix[:3, :3], matrix[3, :3] = turned.T, zup.places(obstacle.position)  # OSG's vectors are rows
    rows = "\n".join(str(numbers(row)) for row in matrix)
    return Item(
        "osg::MatrixTransform",
        Name=quoted(obstacle.name),
        Children=[_geode(obstacle_parts(obstacle), "obstacle")],
        Matrix=Raw(f"{{\n{rows}\n}}"),
    )


def _geode(parts: list[Part], name: str) -> Item:
    """One geometry per paint."""
    return Item("osg::Geode", Name=quoted(name), Drawables=[_geometry(*part) for part in parts])


def _geometry(paint: Paint, surface: Surface) -> Item:
    solid = solid_triangles(surface)
    corners, normals = solid.vertices[solid.triangles].reshape(-1, 3), corner_normals(solid).reshape(-1, 3)
    both = np.round(np.hstack([zup.places(corners), zup.places(normals)]), 4) + 0.0
    rows, index = np.unique(both, axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    listed = "\n".join(" ".join(map(str, row)) for row in triangles.tolist())
    indices = Item("osg::DrawElementsUInt", Mode=Raw("TRIANGLES"), vector=Raw(f"{index.size} {{\n{listed}\n}}"))
    return Item(
        "osg::Geometry",
        PrimitiveSetList=[indices],
        VertexArray=_array("osg::Vec3Array", "BIND_PER_VERTEX", rows[:, :3]),
        NormalArray=_array("osg::Vec3Array", "BIND_PER_VERTEX", rows[:, 3:]),
        ColorArray=_array("osg::Vec4Array", "BIND_OVERALL", np.array([[*display(paint.colour), 1.0]])),
    )


def _array(kind: str, binding: str, rows: Array) -> Item:
    return Item(kind, Binding=Raw(binding), vector=vectors(rows))


def _scratch(scratch: Scratch, delay: float) -> Item:
    """A line that grows: child i of the sequence is drawn from the i-th time on, child 0, nothing, before the first."""
    points = scratch.points + LIFT * scratch.normals
    if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() < DENT:
        points, mode, counts, times = _cross(points[0], scratch.normals[0]), "LINES", [4], scratch.times[:1]
    else:
        mode = "LINE_STRIP"
        chosen = np.unique(np.round(np.linspace(1, len(points) - 1, LONGEST_LINE)).astype(int))
        counts, times = (chosen + 1).tolist(), scratch.times[chosen]
    vertices = _array("osg::Vec3Array", "BIND_PER_VERTEX", np.round(zup.places(points), 4) + 0.0)
    colour = _array("osg::Vec4Array", "BIND_OVERALL", np.array([[*display(paint_of("scratch").colour), 1.0]]))
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
        Name=quoted(f"scratch {scratch.id}"),
        StateSet=Item(
            "osg::StateSet",
            ModeList=_modes(GL_LIGHTING="OFF"),
            AttributeList=_attribute(Item("osg::LineWidth", Width=Raw(number(LINE_WIDTH)))),
        ),
        Children=[Item("osg::Group"), *lines],
        TimeList=Raw(f"{len(shown)} {{\n{numbers(np.round(shown, 6))}\n}}"),
        Speed=Raw(1),
        NumRepeats=Raw(1),
        Mode=Raw("START"),
        Sync=Raw("TRUE"),
    )


def _cross(point: Array, normal: Array) -> Array:
    """Ends of two lines (4, 3) across each other on the plating."""
    level = np.cross(normal, (0.0, 0.0, 1.0))
    first = level / np.linalg.norm(level) if np.linalg.norm(level) > 1e-6 else np.array([1.0, 0.0, 0.0])
    second = np.cross(normal, first)
    arms = DENT * np.sqrt(0.5) * np.array([first + second, -first - second, first - second, second - first])
    crossed: Array = point + arms
    return crossed


def _sea(scene: Scene) -> Item:
    """A disc of rings, lighter and darker by chance so that motion shows, that fades into the sky at its edge."""
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
        VertexArray=_array("osg::Vec3Array", "BIND_PER_VERTEX", np.round(points, 2) + 0.0),
        ColorArray=_array("osg::Vec4Array", "BIND_PER_VERTEX", np.round(colours, 3)),
    )
    state = Item(
        "osg::StateSet",
        ModeList=_modes(GL_LIGHTING="OFF", GL_BLEND="ON"),
        # after the solids (bin 0), before the particles (bin 10), whatever the distance
        RenderBinMode=Raw("USE_RENDERBIN_DETAILS"),
        BinNumber=Raw(5),
        BinName=quoted("RenderBin"),
    )
    matrix = np.eye(4)
    matrix[3, :3] = zup.places(scene.origin)
    rows = "\n".join(str(numbers(row)) for row in matrix)
    return Item(
        "osg::MatrixTransform",
        Name=quoted("sea"),
        StateSet=state,
        Children=[Item("osg::Geode", Drawables=[disc])],
        Matrix=Raw(f"{{\n{rows}\n}}"),
    )


def _camera_path(scene: Scene, delay: float) -> str:
    """Lines of time, place of the eye and quaternion, for `osgviewer -p`: OSG's eye looks along -z, y up."""
    camera = camera_of(scene)
    times = np.unique(np.concatenate([ship.track.times for ship in scene.ships]))
    times = np.unique(np.concatenate([times, np.linspace(times[0], times[-1], 50)]))
    views = [camera.at(float(time)) for time in times]
    eyes = np.array([zup.places(eye) for eye, _ in views])
    turns = np.array([_looking(*view) for view in views])
    rows = kept(times, np.hstack([eyes, 500.0 * turns]), CAMERA_ERROR)
    lines = [f"{number(times[i] + delay)} {numbers(np.round(eyes[i], 3))} {numbers(turns[i])}" for i in rows]
    held = [f"{number(time)} {line.split(' ', 1)[1]}" for time, line in ((0.0, lines[0]), (FOREVER, lines[-1]))]
    return "\n".join([*held[: int(delay + times[0] > 0.0)], *lines, held[1], ""])


def _looking(eye: Array, target: Array) -> Array:
    """Quaternion (4,) in w of an eye in n that looks at a target in n."""
    ahead = zup.places(target - eye)
    back = -ahead / np.linalg.norm(ahead)
    right = np.cross((0.0, 0.0, 1.0), back)
    right /= np.linalg.norm(right)
    return quaternion(np.column_stack([right, np.cross(back, right), back]))
