"""A reader of .glb files of the tests' own: JSON, accessors, and the pose of a node at a time by linear and slerp."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

from shipcollision_fmu.ship.frames import Array, rotation_from_quaternion

COMPONENTS = {5126: "<f4", 5121: "u1", 5123: "<u2", 5125: "<u4"}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


class Glb:
    """A .glb file as read."""

    def __init__(self, data: bytes | Path) -> None:
        content = data.read_bytes() if isinstance(data, Path) else data
        magic, version, size = struct.unpack_from("<4sII", content)
        assert (magic, version, size) == (b"glTF", 2, len(content))
        length, kind = struct.unpack_from("<I4s", content, 12)
        assert kind == b"JSON"
        self.json: dict[str, Any] = json.loads(content[20 : 20 + length])
        _, kind = struct.unpack_from("<I4s", content, 20 + length)
        assert kind == b"BIN\0"
        self._buffer = content[28 + length :]

    def accessor(self, index: int) -> Array:
        """Values of an accessor, (n,) or (n, width)."""
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        width = WIDTHS[accessor["type"]]
        values = np.frombuffer(
            self._buffer, COMPONENTS[accessor["componentType"]], accessor["count"] * width, view["byteOffset"]
        ).astype(float)
        return values.reshape(-1, width) if width > 1 else values

    def nodes(self, key: str) -> dict[Any, int]:
        """Indices of the nodes whose extras have `key`, by its value; the first of equals."""
        found: dict[Any, int] = {}
        for i, node in enumerate(self.json["nodes"]):
            if key in node.get("extras", {}):
                found.setdefault(node["extras"][key], i)
        return found

    def animated(self, node: int, path: str, time: float) -> Array | None:
        """Value of an animated property at a time, or None when it is not animated."""
        for channel in self.json["animations"][0]["channels"]:
            if channel["target"] == {"node": node, "path": path}:
                sampler = self.json["animations"][0]["samplers"][channel["sampler"]]
                times, values = self.accessor(sampler["input"]), self.accessor(sampler["output"])
                i = int(np.clip(np.searchsorted(times, time, side="right") - 1, 0, len(times) - 1))
                if sampler["interpolation"] == "STEP" or i == len(times) - 1:
                    return np.array(values[i])
                share = (time - times[i]) / (times[i + 1] - times[i])
                mixed = (1 - share) * values[i] + share * values[i + 1]
                if path != "rotation":
                    return np.array(mixed)
                angle = np.arccos(min(1.0, float(values[i] @ values[i + 1])))
                if angle < 1e-6:
                    return np.array(mixed)
                a, b = np.sin((1 - share) * angle), np.sin(share * angle)
                return np.array((a * values[i] + b * values[i + 1]) / np.sin(angle))
        return None

    def placed(self, ship: str, points: Array, time: float) -> Array:
        """Points of a ship's b in n, from the file's own origin, at a time."""
        node = self.nodes("ship")[ship]
        translation, rotation = (self.animated(node, path, time) for path in ("translation", "rotation"))
        assert translation is not None
        assert rotation is not None
        return translation + points @ rotation_from_quaternion(rotation).T
