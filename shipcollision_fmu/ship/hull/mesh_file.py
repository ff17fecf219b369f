"""Vertices and triangles of a user's OBJ, STL, DAE or glTF file, in the file's own coordinates and unit.

trimesh reads the formats (DAE with pycollada). A DAE file states its unit and its upward axis; glTF 2.0 has metres and
+y upwards (sections 3.4 and 3.6 of its specification). Files that are cut short are told from those with holes.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ...errors import HostError, ShipError, describe_installation
from ..frames import Array
from .convex import Indices

__all__ = ["MeshFile", "find_mesh_file", "read_mesh_file"]

KINDS = ("obj", "stl", "dae", "glb", "gltf")
LARGEST_FILE = 200 * 2**20
"""Bytes of a file that are read at all."""
GLTF_JSON = 0x4E4F534A
"""Type of the chunk of a binary glTF file that holds its JSON."""


@dataclass(frozen=True)
class MeshFile:
    """What a file holds, and what it or its format states: metres per unit and the axis that points up."""

    vertices: Array
    faces: Indices
    metres: float = 1.0
    up: str = "+z"


def find_mesh_file(path: Path) -> Path:
    """The path, of a file of a kind and size that is read. Raises ShipError."""
    kinds = [f".{kind}" for kind in KINDS]
    if path.suffix.lower() not in kinds:
        raise ShipError(
            f"{path.name}: is none of {', '.join(kinds)}: save the hull as one of these, and give its name as file"
        )
    if not path.is_file():
        raise ShipError(
            f"{path.name}: does not exist in {path.parent.resolve()}: [hull] file is relative to the ship file"
        )
    if (size := path.stat().st_size) > LARGEST_FILE:
        raise ShipError(f"{path.name}: has {size} bytes, more than {LARGEST_FILE}: simplify the mesh")
    return path


def read_mesh_file(path: Path) -> MeshFile:
    """The content of a mesh file. Raises ShipError when it is refused, HostError when a package is missing."""
    kind = path.suffix.lower().removeprefix(".")
    content = path.read_bytes()
    if said := _find_cut(kind, content):
        raise ShipError(f"{path.name}: is cut short: {said}: export it again")
    if others := _list_other_files(kind, content):
        raise ShipError(f"{path.name}: has its vertices in another file, {others[0]}: save the hull as one file, .glb")
    vertices, faces = _load(path, kind)
    if len(faces) == 0:
        raise ShipError(
            f"{path.name}: has no faces: export the hull's surface as {kind.upper()}, not its lines or points"
        )
    if not np.isfinite(vertices).all():
        raise ShipError(f"{path.name}: has vertices that are not finite numbers: export it again")
    return MeshFile(vertices, faces, *_read_statements(kind, content))


def _load(path: Path, kind: str) -> tuple[Array, Indices]:
    trimesh = _import_optional("trimesh", "a hull from a mesh file is read with it")
    if kind == "dae":
        _import_optional("collada", "a hull from a DAE file is read with pycollada")
    options = {"skip_materials": True} if kind == "obj" else {}
    try:
        with path.open("rb") as file:
            mesh: Any = trimesh.load_mesh(file, file_type=kind, process=False, **options)
        return np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3)
    except Exception as error:  # whatever a broken file makes the reader stumble on
        said = " ".join(str(error).split())
        raise ShipError(f"{path.name}: cannot be read as {kind.upper()} ({said}): export it again") from None


def _import_optional(name: str, purpose: str) -> ModuleType:
    try:
        return import_module(name)
    except ImportError as error:
        raise HostError(
            f"{name} cannot be imported ({error}), and {purpose}: {describe_installation('mesh')}"
        ) from None


# -- the formats ------------------------------------------------------------------------------------


def _find_cut(kind: str, content: bytes) -> str:
    """What shows that a file ends too early; else no text."""
    if kind == "stl":
        return _find_cut_of_stl(content)
    if kind == "glb" and len(content) >= 12 and len(content) < (whole := int.from_bytes(content[8:12], "little")):
        return f"its header states {whole} bytes, and it has {len(content)}"
    if kind == "dae" and b"<COLLADA" in content and not content.rstrip().endswith(b"</COLLADA>"):
        return "it does not end with </COLLADA>"
    if kind == "obj" and (last := content[content.rstrip().rfind(b"\n") + 1 :].split()) and _is_cut_line(last):
        return f"its last line is '{b' '.join(last).decode(errors='replace')[:40]}'"
    return ""


def _find_cut_of_stl(content: bytes) -> str:
    """A binary STL has 80 bytes of header, a count, and 50 bytes per triangle; one in text ends with endsolid."""
    if b"\0" not in content[:1024] or len(content) < 84:
        text = content.rstrip().lower()
        is_text = text.startswith(b"solid") and b"facet" in text[:4096]
        return "it does not end with endsolid" if is_text and b"endsolid" not in text[-1024:] else ""
    count = int.from_bytes(content[80:84], "little")
    if len(content) < (whole := 84 + 50 * count):
        return f"its {count} triangles take {whole} bytes, and it has {len(content)}"
    return ""


def _is_cut_line(words: list[bytes]) -> bool:
    """Whether a line of an OBJ file is a vertex or a face with less than three numbers."""
    return words[0] in (b"v", b"f") and len(words) < 4


def _list_other_files(kind: str, content: bytes) -> list[str]:
    """Files that a glTF file takes its buffers from. A run's digests and an FMU's files would not know of them."""
    if kind not in ("glb", "gltf"):
        return []
    if kind == "glb":
        size, chunk = (int.from_bytes(content[i : i + 4], "little") for i in (12, 16))
        content = content[20 : 20 + size] if chunk == GLTF_JSON else b""
    try:
        buffers = json.loads(content).get("buffers", [])
        return [b["uri"] for b in buffers if not b.get("uri", "data:").startswith("data:")]
    except (ValueError, AttributeError, TypeError):  # no glTF: the reader says so
        return []


def _read_statements(kind: str, content: bytes) -> tuple[float, str]:
    """Metres per unit and the upward axis that a file or its format states."""
    if kind in ("glb", "gltf"):
        return 1.0, "+y"
    if kind == "dae":
        unit = re.search(rb'<unit\b[^>]*\bmeter=["\x27]([0-9.eE+-]+)', content)
        axis = re.search(rb"<up_axis>\s*([XYZ])_UP", content)
        metres = float(unit[1]) if unit else 1.0
        return metres if metres > 0.0 else 1.0, f"+{axis[1].decode().lower()}" if axis else "+y"
    return 1.0, "+z"
