"""A shared library linked from parts, kept in the user's cache by a digest of all that it is made from."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from time import time

from ..files import IN_PLACE, check_writable, user_cache, write_file
from .compilers import Compiler, find_compiler
from .objects import compile_object, digest_source, is_kept, read_text, run
from .pe import clear_time_stamps
from .platforms import Target
from .sources import Part

__all__ = ["Report", "build_libraries", "build_library", "ignore_progress", "native_cache"]

Report = Callable[[int, int], None]
"""Called with how many steps of how many are done; a step compiles a source or links a library."""


def ignore_progress(done: int, total: int) -> None:
    """The Report of a caller without a display."""


ANOTHER_CACHE = "make it writable, or name another folder for caches in the environment variable XDG_CACHE_HOME"
"""Remedy in the message about a cache in which nothing can be kept."""

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
    report: Report = ignore_progress,
) -> Path:
    """The library of that name for one target: see build_libraries."""
    made = build_libraries(name, parts, [target], exports, cache=cache, prefer_system=prefer_system, report=report)
    return made[target]


def build_libraries(
    name: str,
    parts: Sequence[Part],
    targets: Sequence[Target],
    exports: Sequence[str],
    *,
    cache: Path | None = None,
    prefer_system: bool = False,
    report: Report = ignore_progress,
) -> dict[Target, Path]:
    """The libraries of that name by target. Those that are not in the cache are compiled and linked, side by side.

    `exports` are patterns of the names that a host may call. Raises HostError when nothing here compiles for a target,
    before anything is compiled, when the cache cannot be written, or when a source does not compile.
    """
    home = native_cache() if cache is None else cache
    kind = "here" if prefer_system else "fmu"  # these may come from different compilers
    kept = {target: _find_place(home, name, parts, target, exports, kind) for target in targets}
    missing = [target for target, path in kept.items() if not is_kept(path)]
    compilers = {target: find_compiler(target, prefer_system=prefer_system) for target in missing}
    if missing:
        check_writable(home, ANOTHER_CACHE)  # where Zig cannot make its folder it may try again for ever
    sources = [(part, file) for part in parts for file in part.files]
    done, total = 0, len(missing) * (len(sources) + 1)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        compiling = {
            target: [
                pool.submit(compile_object, part, file, target, compiler, home / "objects") for part, file in sources
            ]
            for target, compiler in compilers.items()
        }
        linking = {}
        try:
            for target, futures in compiling.items():
                objects = []
                for future in futures:
                    objects.append(future.result())
                    done += 1
                    report(done, total)
                linking[target] = pool.submit(_link, objects, target, compilers[target], exports, kept[target])
            for one in linking.values():
                one.result()
                done += 1
                report(done, total)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    if missing:
        _remove_unused(home)
    return kept


def _find_place(
    home: Path, name: str, parts: Sequence[Part], target: Target, exports: Sequence[str], kind: str
) -> Path:
    """Where the library is kept."""
    read = lru_cache(maxsize=None)(read_text)  # of this call alone: files may be edited before the next
    digests = [digest_source(part, file, target, read) for part in parts for file in part.files]
    key = sha256(repr((name, target.zig, tuple(exports), kind, digests)).encode()).hexdigest()
    return home / key[:32] / f"{name}{target.suffix}"


def _link(objects: Sequence[Path], target: Target, compiler: Compiler, exports: Sequence[str], kept: Path) -> None:
    """Write the library to its place; its bytes depend on objects and target alone."""
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:
        made = Path(aside, kept.name)
        flags = _list_link_flags(target, Path(aside), exports)
        command = [*compiler.link, "-O2", "-shared", "-o", made.name, *map(str, objects), *flags]
        run(command, compiler, f"cannot link for {target.folder}", Path(aside))
        data = made.read_bytes()
    write_file(kept, clear_time_stamps(data) if target.is_windows else data, IN_PLACE)


def _list_link_flags(target: Target, folder: Path, exports: Sequence[str]) -> list[str]:
    """Without start-up code and run-time libraries, which Zig would compile first: only the system's C library."""
    if target.is_windows:
        return ["-s", "-nostdlib", "-lucrtbase", "-lkernel32"]  # native/windows.cpp is the start-up code
    if target.is_macos:
        return ["-Wl,-x", "-Wl,-dead_strip", "-nostdlib", "-lc"]
    script = folder / "exports.map"
    script.write_text(f"{{ global: {' '.join(f'{pattern};' for pattern in exports)} local: *; }};\n", encoding="ascii")
    own = ["-Wl,--no-undefined", "-Wl,--build-id=none", f"-Wl,--version-script={script.name}"]
    return ["-s", *own, "-nostdlib", "-lc"]


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
