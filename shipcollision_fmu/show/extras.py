"""Packages that only some pictures need."""

from __future__ import annotations

from importlib.util import find_spec

from ..errors import HostError

__all__ = ["require"]

_PACKAGES = {"matplotlib": "matplotlib", "PIL": "pillow", "imageio_ffmpeg": "imageio-ffmpeg"}
"""By name of the module: what pip knows it by."""


def require(module: str, what: str) -> None:
    """Raise HostError, with the command that helps, when `module` is not installed. `what`: needs it, in words."""
    if find_spec(module) is None:
        package = _PACKAGES[module]
        raise HostError(f"{what} needs the package {package}: run `python -m pip install {package}`")
