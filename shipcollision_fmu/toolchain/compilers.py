"""Compilers: Zig's from PyPI, which compiles for every target, or the system's own, for its machine alone.

Both give the same numbers: no source depends on a library, and contraction of products and sums is off. Zig's runs on
older systems than the one it compiles on; what the system's compiler makes may need as new a C library as there is.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from ..errors import HostError, describe_installation
from ..files import user_cache
from .platforms import PLATFORMS, Target, find_own_target

__all__ = ["Compiler", "find_compiler"]

_ZIG_FLAGS = ("-fvisibility-global-new-delete=force-hidden",)
"""Ours are not a host's: macOS and Windows have no list of exports."""
_SYSTEM = {"g++": "gcc", "clang++": "clang", "c++": "cc"}
"""Names of C++ compilers, and of the C compilers beside them; Windows has none of them as a rule."""


@dataclass(frozen=True)
class Compiler:
    """Commands of a compiler for one target.

    name     with its version, for people and for keys
    compile  turns C++ into an object
    flags    for this compiler only
    link     turns objects into a library, without a run-time library of C++
    """

    name: str
    compile: tuple[str, ...]
    link: tuple[str, ...]
    flags: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)


def find_compiler(target: Target, *, prefer_system: bool = False) -> Compiler:
    """A compiler for `target`. Raises HostError, with what to install.

    An FMU takes Zig's where there is a choice, for older systems; a library that stays here takes the system's with
    `prefer_system`, which need not build Zig's own libraries first.
    """
    system = _find_system() if target == find_own_target() and not target.is_windows else None
    zig = _find_zig()
    if system is not None and (prefer_system or zig is None):
        return system
    if zig is None:
        raise HostError(_describe_lack(target))
    path, version = zig
    kept = {"ZIG_GLOBAL_CACHE_DIR": str(_ZIG_CACHE), "ZIG_LOCAL_CACHE_DIR": str(_ZIG_CACHE)}
    # Without -target Zig would use instructions that other machines may not have.
    aim = ("-target", target.zig)
    return Compiler(f"zig {version}", (path, "c++", *aim), (path, "cc", *aim), _ZIG_FLAGS, kept)


_ZIG_CACHE = user_cache().parent / "zig"
"""Zig's own folder: the first use of a target builds its C library there, which takes up to a minute."""


def _describe_lack(target: Target) -> str:
    """Why nothing compiles for `target`, and what to install."""
    own, remedy = find_own_target(), describe_installation("native")
    if target == own and not target.is_windows:
        return f"there is no C++ compiler for native code: {remedy}, or install g++ or clang++"
    lack = f"native code for {target.folder} is compiled by Zig, which is not installed: {remedy}"
    alone = next((one.name for one in PLATFORMS.values() if own in one.targets), None)
    if _find_system() is None or alone is None:
        return lack
    return f"{lack}; or build for this machine alone, with --platforms {alone}"


@cache
def _find_zig() -> tuple[str, str] | None:
    """Zig's program from the PyPI package, and its version."""
    found = find_spec("ziglang")
    for folder in (found.submodule_search_locations or ()) if found is not None else ():
        program = Path(folder) / ("zig.exe" if os.name == "nt" else "zig")
        version = _ask(str(program), "version")
        if version:
            return str(program), version
    return None


@cache
def _find_system() -> Compiler | None:
    """The system's compiler. Its C driver links, which adds no library of C++."""
    for name, beside in _SYSTEM.items():
        path, driver = shutil.which(name), shutil.which(beside)
        version = _ask(path, "--version") if path is not None and driver is not None else ""
        if path is not None and driver is not None and version:
            return Compiler(version, (path,), (driver,))
    return None


def _ask(*command: str) -> str:
    """The first line that a program says; none where it is missing or does not run here."""
    try:
        said = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""
    return said.partition("\n")[0].strip()
