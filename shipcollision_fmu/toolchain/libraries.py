"""A shared library linked from parts, kept in the user's cache by a digest of all that it is made from."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path
from time import time

from ..files import IN_PLACE, user_cache, write_file
from .compilers import Compiler, find_compiler
from .objects import compile_object, digest_source, run
from .pe import clear_time_stamps
from .platforms import Target
from .sources import Part

__all__ = ["Report", "build_library", "native_cache"]

Report = Callable[[int, int], None]
"""Is told how many sources of how many are compiled."""

_SAY_NOTHING: Report = lambda done, total: None  # noqa: E731

KEPT_DAYS = 30
"""Days after which what no build used is removed from the cache."""


def native_cache() -> Path:
    """Folder of the user's cache for what is compiled here."""
    return user_cache() / "native"


def build_library(
    name: str,
    parts: Sequence[Part],
    target: Target,
    exports: Sequence[str],
    *,
    cache: Path | None = None,
    prefer_system: bool = False,
    report: Report = _SAY_NOTHING,
) -> Path:
    """The library of that name for `target`, compiled and linked if it is not in the cache.

    `exports` are patterns of the names that a host may call. Raises HostError when nothing here compiles for the
    target, or when a source does not compile.
    """
    home = native_cache() if cache is None else cache
    sources = [(part, file) for part in parts for file in part.files]
    digests = [digest_source(part, file, target) for part, file in sources]
    kind = "here" if prefer_system else "fmu"  # these may come from different compilers
    key = sha256(repr((name, target.zig, tuple(exports), kind, digests)).encode()).hexdigest()
    kept = home / key[:32] / f"{name}{target.suffix}"
    if kept.is_file():
        os.utime(kept)
        return kept
    compiler = find_compiler(target, prefer_system=prefer_system)

    def compile_one(source: tuple[Part, str]) -> Path:
        part, file = source
        return compile_object(part, file, target, compiler, home / "objects")

    objects: list[Path] = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for made in pool.map(compile_one, sources):
            objects.append(made)
            report(len(objects), len(sources))
    library = _link(name, objects, target, compiler, exports)
    _remove_unused(home)
    return write_file(kept, library, IN_PLACE)


def _link(name: str, objects: Sequence[Path], target: Target, compiler: Compiler, exports: Sequence[str]) -> bytes:
    """The bytes of the library, which depend on objects and target alone."""
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:
        made = Path(aside, f"{name}{target.suffix}")
        flags = _list_link_flags(target, Path(aside), exports)
        command = [*compiler.link, "-O2", "-shared", "-o", made.name, *map(str, objects), *flags]
        run(command, compiler, f"cannot link for {target.folder}", Path(aside))
        data = made.read_bytes()
    return clear_time_stamps(data) if target.is_windows else data


def _list_link_flags(target: Target, folder: Path, exports: Sequence[str]) -> list[str]:
    if target.is_windows:
        return ["-s", "-nostdlib", "-lucrtbase", "-lkernel32"]  # native/windows.cpp is the start-up code
    if target.is_macos:
        return ["-Wl,-x", "-Wl,-dead_strip"]
    script = folder / "exports.map"
    script.write_text(f"{{ global: {' '.join(f'{pattern};' for pattern in exports)} local: *; }};\n", encoding="ascii")
    return ["-s", "-Wl,--no-undefined", "-Wl,--build-id=none", f"-Wl,--version-script={script.name}"]


def _remove_unused(home: Path) -> None:
    """Remove what no build used for KEPT_DAYS."""
    oldest = time() - KEPT_DAYS * 86400
    for path in [*home.glob("objects/*.o"), *home.glob("*/*.so"), *home.glob("*/*.dll"), *home.glob("*/*.dylib")]:
        try:
            if path.stat().st_mtime < oldest:
                path.unlink()
                path.parent.rmdir()
        except OSError:  # another build was first, the folder is not empty, or the file is in use
            continue
