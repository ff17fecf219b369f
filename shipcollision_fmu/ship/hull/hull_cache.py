"""Hulls from mesh files in the user's cache, each with what the user is warned of.

The key is a digest of all that a hull depends on. A cached file that cannot be read is made anew.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from importlib import metadata
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from ...errors import HostError
from ...files import user_cache, write_file
from .child_process import read_arrays, write_arrays
from .solid import HullMesh

__all__ = ["Kept", "compute_key", "find_hull", "keep_hull"]

PACKAGES = ("coacd", "manifold3d", "numpy", "pycollada", "trimesh")
"""Packages whose other version may give other parts."""

_log = logging.getLogger("shipcollision_fmu")


@dataclass(frozen=True)
class Kept:
    """A hull, and what the user is told of it whenever it is loaded."""

    hull: HullMesh
    warnings: tuple[str, ...] = ()


def compute_key(*facts: object) -> str:
    """Digest of facts that print alike when they are alike, of the packages used, and of the program in this folder."""
    return sha256(repr((facts, _list_versions(), _digest_program())).encode()).hexdigest()[:32]


@lru_cache(maxsize=1)
def _list_versions() -> tuple[str, ...]:
    return tuple(_find_version(name) for name in PACKAGES)


def _find_version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""


@lru_cache(maxsize=1)
def _digest_program() -> str:
    return sha256(b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))).hexdigest()


def find_hull(key: str) -> Kept | None:
    """The hull of this key; None where there is none that can be read."""
    try:
        return _unpack(_find_file(key).read_bytes())
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):  # absent, or not what was written
        return None


def keep_hull(name: str, key: str, kept: Kept) -> None:
    """Write the hull into the user's cache; warn when it cannot be written."""
    try:
        write_file(_find_file(key), _pack(kept), "its parts are cut again in every process until it is writable")
    except HostError as error:
        _log.warning("%s: %s", name, error)


def _find_file(key: str) -> Path:
    return user_cache() / "mesh-hulls" / f"{key}.npz"


def _pack(kept: Kept) -> bytes:
    hull = kept.hull
    arrays = {
        "vertices": hull.vertices, "triangles": hull.triangles, "warnings": np.array(kept.warnings, dtype=np.str_),
        "measures": np.array([hull.volume_error, hull.bulge]), "count": np.array(len(hull.parts)),
    }  # fmt: skip
    for i, (part, planes) in enumerate(zip(hull.parts, hull.planes, strict=True)):
        arrays |= {f"part{i}": part, f"planes{i}": planes}
    return write_arrays(arrays)


def _unpack(content: bytes) -> Kept:
    arrays = read_arrays(content)
    count = range(int(arrays["count"]))
    hull = HullMesh(
        arrays["vertices"], arrays["triangles"], tuple(arrays[f"part{i}"] for i in count),
        tuple(arrays[f"planes{i}"] for i in count), *arrays["measures"].tolist(),
    )  # fmt: skip
    return Kept(hull, tuple(arrays["warnings"].tolist()))
