"""The native library compiled into the package's folder, when the package is installed: called by hatch_build.py."""

from __future__ import annotations

from pathlib import Path

from ..errors import HostError
from ..files import IN_PLACE, write_files
from .compilers import find_compiler
from .installed import COMPILED, STAMP, digest_native, find_library_of
from .load import build_own_library
from .platforms import find_own_target
from .sources import find_native

__all__ = ["has_compiler", "install_library"]


def has_compiler() -> bool:
    """Whether something here compiles for this machine."""
    target = find_own_target()
    try:
        return target is not None and bool(find_compiler(target, prefer_system=True))
    except HostError:
        return False


def install_library(package: Path) -> Path:
    """The library in the package's folder, compiled unless it is there and made from the present sources. Raises
    HostError."""
    if (found := find_library_of(package)) is not None:
        return found
    compiled, target = build_own_library(), find_own_target()
    assert target is not None  # else nothing was compiled
    folder = package / COMPILED / target.folder
    stamp = digest_native(find_native()) + "\n"
    write_files(folder, {compiled.name: compiled.read_bytes(), STAMP: stamp}, IN_PLACE)
    return folder / compiled.name
