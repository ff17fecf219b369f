"""The replay page of a run as an object that a notebook shows."""

from __future__ import annotations

import html
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

__all__ = ["RunPage", "run_page"]


@dataclass(frozen=True)
class RunPage:
    """A replay page: `text` is the whole HTML file, `height` that of its frame in a notebook [pixels]."""

    text: str = field(repr=False)
    height: int

    def _repr_html_(self) -> str:
        """A frame that holds the page. It may run the page's scripts, and reach nothing of the notebook around it."""
        return (
            f'<iframe srcdoc="{html.escape(self.text)}" sandbox="allow-scripts" '
            f'style="width: 100%; height: {self.height}px; border: 0"></iframe>'
        )


def run_page(write: Callable[[Path], None], height: int) -> RunPage:
    """The page of the run that `write` writes into a folder. Raises HostError when the page's bundle is missing."""
    from ..show.page import build_page  # only a run that is shown needs the pictures
    from ..show.scene.scene import load_scene

    with TemporaryDirectory(prefix="shipcollision-") as folder:
        write(Path(folder))
        return RunPage(build_page(load_scene(Path(folder))), height)
