"""Writes glTF 2.0 in its binary form (.glb): one JSON document and one buffer. Khronos, glTF 2.0 specification.

Numbers in the buffer have single precision; numbers in the JSON read back as the same double.
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["Document"]

FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5121, 5123, 5125
VERTICES, INDICES = 34962, 34963
_TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


class Document:
    """A glTF document under construction; every method that adds an item returns its index."""

    def __init__(self, generator: str) -> None:
        self._json: dict[str, Any] = {"asset": {"version": "2.0", "generator": generator}}
        self._chunks: list[bytes] = []
        self._size = 0
        self._accessors: dict[tuple[str, int | None, bytes], int] = {}

    def __setitem__(self, key: str, value: Any) -> None:
        self._json[key] = value

    def add(self, kind: str, item: dict[str, Any]) -> int:
        """Append to a list of the document, such as "nodes"."""
        items = self._json.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def add_vertices(self, values: npt.ArrayLike) -> int:
        """Add an accessor of vertex data (n,) or (n, 3)."""
        return self._add_floats(values, VERTICES)

    def add_colours(self, values: npt.NDArray[np.float64]) -> int:
        """Add an accessor of linear colours (n, 3) from 0 to 1, opaque, a byte each: rows begin at multiples of 4."""
        table = np.full((len(values), 4), 255, dtype=np.uint8)
        table[:, :3] = np.round(255.0 * np.clip(values, 0.0, 1.0))
        return self._add_accessor(
            table.tobytes(), VERTICES,
            {"componentType": UNSIGNED_BYTE, "normalized": True, "count": len(table), "type": "VEC4"},
        )  # fmt: skip

    def add_keys(self, values: npt.ArrayLike) -> int:
        """Add an accessor of times (n,) or values (n, 3 or 4) of an animation."""
        return self._add_floats(values, None)

    def add_indices(self, triangles: npt.NDArray[np.int64]) -> int:
        """Add an accessor of the corners of triangles (m, 3)."""
        flat = triangles.reshape(-1)
        short = int(flat.max()) < 65535  # 65535 itself restarts a primitive
        return self._add_accessor(
            flat.astype("<u2" if short else "<u4").tobytes(), INDICES,
            {
                "componentType": UNSIGNED_SHORT if short else UNSIGNED_INT, "count": len(flat),
                "type": "SCALAR", "min": [int(flat.min())], "max": [int(flat.max())],
            },
        )  # fmt: skip

    def build(self) -> bytes:
        """The .glb file."""
        buffer = b"".join(self._chunks)
        self._json["buffers"] = [{"byteLength": len(buffer)}]
        text = json.dumps(self._json, separators=(",", ":"), allow_nan=False, ensure_ascii=False).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(buffer)
        return b"".join([
            struct.pack("<4sII", b"glTF", 2, size),
            struct.pack("<I4s", len(text), b"JSON"), text,
            struct.pack("<I4s", len(buffer), b"BIN\0"), buffer,
        ])  # fmt: skip

    def _add_floats(self, values: npt.ArrayLike, target: int | None) -> int:
        array = np.asarray(values, dtype="<f4") + np.float32(0.0)  # no negative zeros
        if not np.isfinite(array).all():
            raise ValueError("a number of the scene is not finite in single precision")
        table = array.reshape(len(array), -1)
        return self._add_accessor(
            table.tobytes(), target,
            {
                "componentType": FLOAT, "count": len(table), "type": _TYPES[table.shape[1]],
                "min": [float(x) for x in table.min(axis=0)], "max": [float(x) for x in table.max(axis=0)],
            },
        )  # fmt: skip

    def _add_accessor(self, data: bytes, target: int | None, described: dict[str, Any]) -> int:
        """An accessor of these bytes; the one that is there, if there is one: ships of a model share their surfaces."""
        key = (f"{described['type']} {described['componentType']}", target, data)
        if key not in self._accessors:
            item = {"bufferView": self._add_view(data, target), **described}
            self._accessors[key] = self.add("accessors", item)
        return self._accessors[key]

    def _add_view(self, data: bytes, target: int | None) -> int:
        view: dict[str, Any] = {"buffer": 0, "byteOffset": self._size, "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        data += b"\0" * (-len(data) % 4)
        self._chunks.append(data)
        self._size += len(data)
        return self.add("bufferViews", view)
