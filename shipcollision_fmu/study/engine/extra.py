"""require_extra(): a clear line where a package that studies need is missing."""

from __future__ import annotations

from importlib.util import find_spec

from ...errors import HostError, describe_installation

__all__ = ["require_extra"]

_MODULES = ("pyarrow", "dask", "distributed")
"""Modules that the extra `study` of the package installs."""


def require_extra() -> None:
    """Raises HostError, with the command that installs it, when a module of the extra `study` is missing."""
    if any(find_spec(module) is None for module in _MODULES):
        raise HostError(f"a study needs packages that are not installed: {describe_installation('study')}")
