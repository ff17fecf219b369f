"""require(): a clear line where a package that only some pictures need is missing."""

from __future__ import annotations

import sys
from importlib.util import find_spec

from ..errors import HostError

__all__ = ["require"]

_EXTRAS = {"matplotlib": "plots", "PIL": "film", "imageio_ffmpeg": "mp4"}
"""Extras of the package by the module that each installs."""


def require(module: str, what: str) -> None:
    """Raise HostError, with the command that installs it, when `module` is missing. what: its user, in words."""
    if find_spec(module) is None:
        extra = _EXTRAS[module]
        raise HostError(
            f"{what} needs packages that are not installed: run "
            f"`{sys.executable} -m pip install 'shipcollision-fmu[{extra}]'` (in a clone: '.[{extra}]')"
        )
