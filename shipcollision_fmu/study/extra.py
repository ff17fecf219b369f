"""The packages of the extra `study`, with one line for a machine that lacks them."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from ..errors import HostError, describe_installation

__all__ = ["import_pyarrow", "require_dask"]


def import_pyarrow(module: str = "pyarrow") -> Any:
    """pyarrow, or a module of it. Raises HostError, with the command that installs it, when it is missing."""
    try:
        return import_module(module)
    except ImportError:
        raise HostError(f"studies need pyarrow, which is missing: {describe_installation('study')}") from None


def require_dask() -> None:
    """Raises HostError, with the command that installs it, when Dask's scheduler and workers are missing."""
    if find_spec("distributed") is None:
        raise HostError(
            f"studies on many cores need Dask, which is missing: {describe_installation('study')}, or give --workers 0"
        )
