"""scene.glb: the scene as glTF 2.0, for Blender, Unity, Unreal, any viewer, and our own page.

    n                     turns north, east, down into glTF's world: x north, y up, z east
    ├── SHIP              translation and rotation animated; children are in the ship's own b
    │   ├── hull          topsides, boot-top, antifouling, deck, bulwark, rudder, propeller, marks
    │   ├── fittings      deckhouse, cargo and masts, for the eye
    │   ├── light stern   a navigation light: a place without a mesh
    │   └── scratch 1.3   a stretch of a scratch: scale 0 until its time has come, then 1 (STEP)
    └── OBSTACLE

Translations are in n from `origin` (see the scene's extras), in metres, so that single precision is enough; times count
from the scene's start. A viewer that plays no animation shows the end of every scratch. Vertices of scratches carry the
time at which they are drawn as attribute _TIME, for viewers that want to draw them point by point. COLOR_0 is ambient
occlusion (scene/shade.py), by which a material's colour is multiplied.

extras of the scene      start [s], origin [m], events, effects (glTF has no particles), frames in words
extras of a node         {"ship": name, ...}, {"obstacle": name}, {"scratch": id, "time": s},
                         {"light": kind, "colour": sRGB, "start", "end", "arc": deg clockwise from ahead,
                         "direction": the middle of the arc in b, "range": nautical miles}
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ... import __version__
from ...ship.frames import Array
from ...ship.hull.convex import Indices
from ..scene.lights import Light
from ..scene.palette import LIVERIES, Paint, choose_topsides, convert_to_linear, find_paint
from ..scene.parts import Shape, join_fittings, join_shapes
from ..scene.scene import Obstacle, Scene, Scratch, Ship
from ..scene.shaded import Corners, shade_ship
from ..scene.surface import Surface, compute_corner_normals, drop_flat_triangles
from .glb import Document
from .ribbons import Ribbon, lay_ribbon

__all__ = ["build_glb", "collect_extras"]

HALF_ROOT = 0.7071067811865476
STRETCHES = 600
"""Approximate number of nodes of all scratches together; it bounds the file's size in long contacts."""
MOST_STRETCHES = 48
"""Most nodes of a scratch; with fewer it appears in visible jumps."""


def build_glb(scene: Scene) -> bytes:
    """The scene as a .glb file; the same bytes for the same scene."""
    return _Writer(scene).write()


class _Writer:
    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._document = Document(f"shipcollision-fmu {__version__}")
        self._materials: dict[str, int] = {}
        self._samplers: list[dict[str, Any]] = []
        self._channels: list[dict[str, Any]] = []
        self._times: dict[bytes, int] = {}

    def write(self) -> bytes:
        scene, document = self._scene, self._document
        children = [self._add_ship(i, ship) for i, ship in enumerate(scene.ships)]
        children += [self._add_obstacle(obstacle) for obstacle in scene.obstacles]
        root = document.add("nodes", {"name": "n", "rotation": [HALF_ROOT, 0.0, 0.0, HALF_ROOT], "children": children})
        document["scene"] = 0
        document.add("scenes", {"name": scene.name, "nodes": [root], "extras": collect_extras(scene)})
        animation = {"name": "run", "samplers": self._samplers, "channels": self._channels}
        document.add("animations", animation)
        return document.build()

    # -- bodies ---------------------------------------------------------------------------------------

    def _add_ship(self, index: int, ship: Ship) -> int:
        document, track = self._document, ship.track
        paints = dict.fromkeys(LIVERIES, choose_topsides(index))
        shell, fittings = join_shapes(ship.shell), join_fittings(ship.fittings)
        shaded = shade_ship([*shell, *fittings], ship.B)
        children = [self._add_node("hull", self._add_mesh(shell, paints, shaded[: len(shell)]))]
        if fittings:
            children.append(self._add_node("fittings", self._add_mesh(fittings, paints, shaded[len(shell) :])))
        children += [self._add_light(light) for light in ship.lights]
        for scratch in self._scene.scratches:
            if scratch.ship == ship.name:
                children += self._add_stretches(scratch, ship)
        node = document.add(
            "nodes",
            {
                "name": ship.name,
                "translation": [float(x) for x in track.position[0] - self._scene.origin],
                "rotation": [float(x) for x in track.quaternion[0]],
                "children": children,
                "extras": {
                    "ship": ship.name, "model": ship.model, "kind": ship.kind,
                    "L_pp": ship.L_pp, "L_oa": ship.L_oa, "B": ship.B, "T": ship.T,
                },
            },
        )  # fmt: skip
        times = track.times - self._scene.start
        self._animate(node, "translation", times, track.position - self._scene.origin, "LINEAR")
        self._animate(node, "rotation", times, track.quaternion, "LINEAR")
        return node

    def _add_obstacle(self, obstacle: Obstacle) -> int:
        half = 0.5 * obstacle.heading
        return self._add_node(
            obstacle.name,
            self._add_mesh([("concrete", obstacle.surface)], {}),
            translation=[float(x) for x in obstacle.position - self._scene.origin],
            rotation=[0.0, 0.0, float(np.sin(half)), float(np.cos(half))],
            extras={"obstacle": obstacle.name, "kind": obstacle.kind},
        )

    def _add_light(self, light: Light) -> int:
        return self._document.add(
            "nodes",
            {
                "name": f"light {light.kind}",
                "translation": [float(x) for x in light.point],
                "extras": {
                    "light": light.kind, "colour": light.colour, "arc": light.arc, "start": light.start,
                    "end": light.end, "direction": light.direction.tolist(), "range": light.range,
                },
            },
        )  # fmt: skip

    def _add_stretches(self, scratch: Scratch, ship: Ship) -> list[int]:
        """Nodes of a scratch: runs of its triangles, each of which appears at the time of its first triangle."""
        shape = lay_ribbon(scratch, ship.plating, ship.L_pp)
        count = max(1, min(MOST_STRETCHES, STRETCHES // len(self._scene.scratches)))
        appears = shape.times[shape.triangles].max(axis=1) - self._scene.start
        nodes = []
        for number, rows in enumerate(_split_in_time(appears, count)):
            time = float(appears[rows[0]])
            node = self._add_node(
                f"scratch {scratch.id}.{number + 1}",
                self._add_ribbon_mesh(shape, shape.triangles[rows]),
                extras={"scratch": scratch.id, "other": scratch.other, "time": time + self._scene.start},
            )
            if time > 0.0:
                self._animate(node, "scale", np.array([0.0, time]), np.array([[0.0] * 3, [1.0] * 3]), "STEP")
            nodes.append(node)
        return nodes

    # -- meshes ---------------------------------------------------------------------------------------

    def _add_mesh(
        self, shapes: Sequence[Shape], paints: dict[str, Paint], shaded: Sequence[Corners | None] | None = None
    ) -> int:
        primitives = []
        for (paint, surface), corners in zip(shapes, shaded or [None] * len(shapes), strict=True):
            if len(surface.triangles):
                vertices, normals, triangles, colours = _join_corners(surface, corners)
                attributes = {
                    "POSITION": self._document.add_vertices(vertices),
                    "NORMAL": self._document.add_vertices(normals),
                }
                if colours is not None:
                    attributes["COLOR_0"] = self._document.add_colours(colours)
                primitives.append(
                    {
                        "attributes": attributes,
                        "indices": self._document.add_indices(triangles),
                        "material": self._add_material(paints.get(paint) or find_paint(paint)),
                    }
                )  # fmt: skip
        return self._document.add("meshes", {"primitives": primitives})

    def _add_ribbon_mesh(self, shape: Ribbon, triangles: Indices) -> int:
        used, places = np.unique(triangles, return_inverse=True)
        attributes = {
            "POSITION": self._document.add_vertices(shape.vertices[used]),
            "NORMAL": self._document.add_vertices(shape.normals[used]),
            "_TIME": self._document.add_vertices(shape.times[used] - self._scene.start),
        }
        indices = self._document.add_indices(places.reshape(-1, 3))
        material = self._add_material(find_paint("scratch"))
        primitive = {"attributes": attributes, "indices": indices, "material": material}
        return self._document.add("meshes", {"primitives": [primitive]})

    def _add_material(self, paint: Paint) -> int:
        if paint.name not in self._materials:
            colour = convert_to_linear(paint.colour)
            material: dict[str, Any] = {
                "name": paint.name,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [*colour, 1.0],
                    "metallicFactor": paint.metalness,
                    "roughnessFactor": paint.roughness,
                },
            }
            if paint.glow:
                material |= {"emissiveFactor": [paint.glow * c for c in colour], "doubleSided": True}
            self._materials[paint.name] = self._document.add("materials", material)
        return self._materials[paint.name]

    # -- nodes and animation --------------------------------------------------------------------------

    def _add_node(self, name: str, mesh: int, **more: Any) -> int:
        return self._document.add("nodes", {"name": name, "mesh": mesh, **more})

    def _animate(self, node: int, path: str, times: Array, values: Array, interpolation: str) -> None:
        key = times.tobytes()
        if key not in self._times:
            self._times[key] = self._document.add_keys(times)
        sampler = {"input": self._times[key], "output": self._document.add_keys(values), "interpolation": interpolation}
        self._samplers.append(sampler)
        self._channels.append({"sampler": len(self._samplers) - 1, "target": {"node": node, "path": path}})


def _join_corners(surface: Surface, shaded: Corners | None) -> tuple[Array, Array, Indices, Array | None]:
    """Vertices and normals of a surface, corners with the same of both joined; triangles; grey (n, 3) if shaded."""
    if shaded is not None:
        return shaded.vertices, shaded.normals, shaded.triangles, np.repeat(shaded.shares[:, None], 3, axis=1)
    solid = drop_flat_triangles(surface)
    corners = np.concatenate([solid.vertices[solid.triangles], compute_corner_normals(solid)], axis=2).reshape(-1, 6)
    _, first, place = np.unique(np.round(corners, 6), axis=0, return_index=True, return_inverse=True)
    return corners[first, :3], corners[first, 3:], place.reshape(-1, 3).astype(np.int64), None


def _split_in_time(appears: Array, count: int) -> list[Indices]:
    """Triangles in order of time, in at most `count` runs; those of one time stay together."""
    order = np.argsort(appears, kind="stable")
    sizes = np.array_split(order, min(count, len(order)))
    runs: list[Indices] = []
    for run in sizes:
        if runs and appears[runs[-1][0]] == appears[run[-1]]:
            runs[-1] = np.concatenate([runs[-1], run])
        else:
            runs.append(run)
    return runs


def collect_extras(scene: Scene) -> dict[str, Any]:
    """Contents of a scene that glTF has no place for, as data for JSON."""
    return {
        "description": scene.description,
        "frames": "n: north, east, down from origin [m]; children of a ship: forward, starboard, down from midship",
        "origin": scene.origin.tolist(),
        "start": scene.start,
        "end": scene.end,
        "events": [
            {
                "kind": event.kind, "id": event.id, "time": event.time, "end": event.end,
                "ship_a": event.ship_a, "ship_b": event.ship_b, "point": event.point.tolist(),
                "closing_speed": event.closing_speed, "angle": event.angle,
                "impulse": event.impulse, "energy": event.energy,
            }
            for event in scene.events
        ],
        "effects": [
            {
                "kind": effect.kind, "ship": effect.ship, "scratch": effect.scratch, "point": effect.point.tolist(),
                "outwards": effect.outwards.tolist(), "time": effect.time, "duration": effect.duration,
                "intensity": effect.intensity, "size": effect.size, "seed": effect.seed,
            }
            for effect in scene.effects
        ],
    }  # fmt: skip
