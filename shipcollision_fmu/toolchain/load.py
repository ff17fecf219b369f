"""The native library for this machine, opened by ctypes; it is compiled at its first use."""

from __future__ import annotations

import ctypes
from functools import lru_cache
from pathlib import Path

from ..errors import HostError
from .libraries import build_library
from .platforms import find_own_target
from .sources import list_library_parts

__all__ = ["LIBRARY", "build_own_library", "load_library"]

LIBRARY = "shipcollision"
EXPORTS = ("shipcollision_*",)
"""Names that Python calls."""


def build_own_library(cache: Path | None = None) -> Path:
    """The library for this machine, in the user's cache or in `cache`. Raises HostError when it cannot be built."""
    target = find_own_target()
    if target is None:
        raise HostError("native code is for Linux and macOS on x86-64 and ARM, and for Windows on x86-64")
    return build_library(LIBRARY, list_library_parts(), target, EXPORTS, cache=cache, prefer_system=True)


@lru_cache
def load_library(cache: Path | None = None) -> ctypes.CDLL:
    """The library, opened once. Raises HostError."""
    path = build_own_library(cache)
    try:
        return ctypes.CDLL(str(path))
    except OSError as error:
        raise HostError(f"cannot open {path}: {error}") from None
