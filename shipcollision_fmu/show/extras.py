"""require(): a clear line where a package that only some pictures need is missing."""

from __future__ import annotations

from importlib.util import find_spec

from ..errors import HostError, describe_installation

__all__ = ["require"]

_MODULES = {"plots": ("matplotlib",), "film": ("PIL",), "mp4": ("PIL", "imageio_ffmpeg")}
"""Modules that each extra of the package installs."""


def require(extra: str, what: str) -> None:
    """Raise HostError, with the command that installs it, when a module of `extra` is missing. what: its user."""
    if any(find_spec(module) is None for module in _MODULES[extra]):
        raise HostError(f"{what} needs packages that are not installed: {describe_installation(extra)}")
