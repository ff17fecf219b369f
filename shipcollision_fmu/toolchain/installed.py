"""The native library that was compiled when the package was installed, or that an earlier use compiled.

    shipcollision_fmu/compiled/x86_64-linux/shipcollision.so
    shipcollision_fmu/compiled/x86_64-linux/inputs.sha256       of native/, as it was then

Installing compiles it on a Python without wheels of PyBullet (hatch_build.py). An FMU has this module and no library:
it takes that of the package in the host's Python.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

from .platforms import find_own_target

__all__ = [
    "COMPILED",
    "LIBRARY",
    "STAMP",
    "digest_native",
    "find_installed_library",
    "find_library_of",
    "has_pybullet_wheels",
]

LIBRARY = "shipcollision"
"""Name of the library, without the end that a system gives it."""
COMPILED, STAMP = "compiled", "inputs.sha256"
"""Folder in the package, and the file beside the library."""


def has_pybullet_wheels() -> bool:
    """Whether PyPI has wheels of pybullet for this interpreter: as the marker in pyproject.toml says it."""
    target = find_own_target()
    is_linux = target is not None and target.folder == "x86_64-linux"
    return is_linux and sys.implementation.name == "cpython" and sys.version_info < (3, 12)


def find_installed_library() -> Path | None:
    """The library of this package, or of an installed one of the same name; None without one made from its sources."""
    return next(filter(None, map(find_library_of, _packages())), None)


def digest_native(native: Path) -> str:
    """SHA-256 over names and texts of the C++ sources; a few milliseconds."""
    total = sha256()
    for path in sorted(path for end in ("cpp", "hpp") for path in native.rglob(f"*.{end}")):
        content = path.read_bytes()
        total.update(f"{path.relative_to(native).as_posix()}\0{len(content)}\0".encode() + content)
    return total.hexdigest()


def _packages() -> Iterator[Path]:
    """Folders of packages of this name: the one that runs, then those on the path."""
    own = Path(__file__).resolve().parents[1]
    yield own
    for entry in sys.path:
        if (found := Path(entry or ".", own.name)) != own:
            yield found


def find_library_of(package: Path) -> Path | None:
    """The library in a package's folder; None when its sources, where they are there, have changed since."""
    target = find_own_target()
    if target is None:
        return None
    folder = package / COMPILED / target.folder
    library, stamp = folder / f"{LIBRARY}{target.suffix}", folder / STAMP
    if not (library.is_file() and stamp.is_file()):
        return None
    native = next((place for place in (package / "native", package.parent / "native") if place.is_dir()), None)
    if native is not None and stamp.read_text(encoding="ascii").strip() != digest_native(native):
        return None
    return library
