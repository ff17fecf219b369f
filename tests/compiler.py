"""compile_c(): the machine's C compiler, or Zig's from PyPI where it has none. compile_for_windows(): Zig's."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from shipcollision_fmu.toolchain.sources import find_native

__all__ = ["compile_c", "compile_for_windows"]

CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "zig"
"""Zig's own folder, taken before the tests set another cache: the first compilation builds a C library in 9 s."""


def compile_c(*arguments: object, target: str = "") -> None:
    """Run a C compiler, which must say nothing. For a target, as Zig calls it, Zig's compiles."""
    system = None if target else shutil.which("cc") or shutil.which("gcc")
    # With a target Zig takes its own headers, so that a machine needs none.
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", target or f"{platform.machine()}-linux-gnu"]
    caches = {"ZIG_GLOBAL_CACHE_DIR": str(CACHE), "ZIG_LOCAL_CACHE_DIR": str(CACHE)}
    done = subprocess.run(
        [*([system] if system else zig), "-Wall", "-Wextra", "-Werror", *map(str, arguments)],
        capture_output=True, text=True, check=False, timeout=600, env=os.environ | caches,
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def compile_for_windows(program: Path, *sources: Path, flags: Sequence[str] = ()) -> None:
    """A program for Windows of sources in C and C++, without the start-up code of MinGW."""
    target, start = "x86_64-windows-gnu", Path(__file__).parent / "native" / "hosts" / "windows_start.c"
    objects = []
    for source in (*sources, start, find_native() / "windows.cpp"):
        objects.append(program.with_name(f"{program.stem}-{source.stem}.o"))
        compile_c("-O1", "-fno-exceptions", "-fno-rtti", *flags, "-c", source, "-o", objects[-1], target=target)
    entry = "-Wl,--subsystem,console", "-Wl,-e,mainCRTStartup"
    compile_c("-nostdlib", *entry, *objects, "-o", program, "-lucrtbase", "-lkernel32", "-lshell32", target=target)
