"""Packages that only some pictures need."""

from __future__ import annotations

import sys
from importlib.util import find_spec

from ..errors import HostError

__all__ = ["require"]

_EXTRAS = {"matplotlib": "plots", "PIL": "film", "imageio_ffmpeg": "mp4"}
"""By name of the module: the extra that brings it."""


def require(module: str, what: str) -> None:
    """Raise HostError, with the command that helps, when `module` is not installed. `what`: needs it, in words."""
    if find_spec(module) is None:
        extra = _EXTRAS[module]
        raise HostError(
            f"{what} needs packages that are not installed: run "
            f"`{sys.executable} -m pip install 'shipcollision-fmu[{extra}]'` (in a clone: '.[{extra}]')"
        )
