"""compile_c(): the machine's C compiler, or Zig's from PyPI where it has none."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

__all__ = ["compile_c"]

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
