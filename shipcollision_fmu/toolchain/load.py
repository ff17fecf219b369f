"""The native library for this machine, opened by ctypes: as it was installed, else compiled at its first use.

Travels in FMUs, with `installed` and `platforms`, and without what compiles.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from ..errors import HostError
from .installed import LIBRARY, find_installed_library
from .platforms import find_own_target

__all__ = ["LIBRARY", "announce_compiling", "build_own_library", "load_library", "say"]

EXPORTS = ("shipcollision_*",)
"""Names that Python calls."""
INTERFACE = 2
"""Number of the functions' signatures (native/python.cpp); a library with another one is refused."""

FETCHING = "note: pip fetches Bullet's source, 80 MB, once; this takes half a minute or longer"
COMPILING = "note: {} is compiled, once; this takes half a minute, on a busy machine two"
OWN = "the native library"
"""What is compiled for Python, in COMPILING."""


def build_own_library(cache: Path | None = None) -> Path:
    """The library for this machine, in the user's cache or in `cache`. Raises HostError when it cannot be built.

    What takes long is announced by a line on stderr.
    """
    try:
        from .bullet_sources import has_bullet_sources  # opening a library needs none of these
        from .compilers import find_compiler
        from .libraries import build_library, native_cache
        from .sources import list_library_parts
    except ImportError:
        raise HostError(
            "an FMU has no native library and cannot compile it: install the package in the host's Python, "
            "`python -m pip install shipcollision-fmu`"
        ) from None
    target = find_own_target()
    if target is None:
        raise HostError("native code is for Linux and macOS on x86-64 and ARM, and for Windows on x86-64")
    home = native_cache() if cache is None else cache
    if not has_bullet_sources(home):
        find_compiler(target, prefer_system=True)  # else 80 MB would be fetched before it is missed
        say(FETCHING)
    parts = list_library_parts(home)
    return build_library(
        LIBRARY, parts, target, EXPORTS, cache=home, prefer_system=True, report=announce_compiling(OWN)
    )


def announce_compiling(what: str) -> Callable[[int, int], None]:
    """A Report that writes a line on stderr after the first step of compilation, when most steps are still to come."""

    def announce(done: int, total: int) -> None:
        if done == 1 < total:
            say(COMPILING.format(what))

    return announce


def say(line: str) -> None:
    """Write a line on stderr, which a host without a console does not have."""
    if sys.stderr is not None:
        sys.stderr.write(f"{line}\n")
        sys.stderr.flush()


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
