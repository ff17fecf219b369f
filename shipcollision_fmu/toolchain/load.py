"""The native library for this machine, opened by ctypes: as it was installed, else compiled at its first use.

Travels in FMUs, with `installed` and `platforms`, and without what compiles.
"""

from __future__ import annotations

import ctypes
from functools import lru_cache
from pathlib import Path

from ..errors import HostError
from .installed import LIBRARY, find_installed_library
from .platforms import find_own_target

__all__ = ["LIBRARY", "build_own_library", "load_library"]

EXPORTS = ("shipcollision_*",)
"""Names that Python calls."""
INTERFACE = 1
"""Number of the functions' signatures (native/python.cpp); a library with another one is refused."""


def build_own_library(cache: Path | None = None) -> Path:
    """The library for this machine, in the user's cache or in `cache`. Raises HostError when it cannot be built."""
    try:
        from .libraries import build_library, native_cache  # opening a library needs neither of them
        from .sources import list_library_parts
    except ImportError:
        raise HostError(
            "an FMU has no native library and cannot compile it: install the package in the host's Python, "
            "`python -m pip install shipcollision-fmu`"
        ) from None
    target = find_own_target()
    if target is None:
        raise HostError("native code is for Linux and macOS on x86-64 and ARM, and for Windows on x86-64")
    parts = list_library_parts(native_cache() if cache is None else cache)
    return build_library(LIBRARY, parts, target, EXPORTS, cache=cache, prefer_system=True)


@lru_cache
def load_library(cache: Path | None = None) -> ctypes.CDLL:
    """The library, opened once: the installed one, else one compiled in the user's cache. Raises HostError.

    cache: a folder to compile in, whatever is installed.
    """
    installed = find_installed_library() if cache is None else None
    path = installed if installed is not None else build_own_library(cache)
    try:
        library = ctypes.CDLL(str(path))
        found = int(library.shipcollision_interface())
    except (OSError, AttributeError) as error:
        raise HostError(f"cannot use {path}: {error}; install the package again") from None
    if found != INTERFACE:
        raise HostError(
            f"{path} has version {found} of its interface, and {INTERFACE} is needed: install the same version of "
            "shipcollision-fmu in this Python"
        )
    return library
