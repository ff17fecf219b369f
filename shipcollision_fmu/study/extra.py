"""The packages of the extra `study`, with one line for a machine that lacks them."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import HostError, describe_installation

__all__ = ["import_pyarrow"]


def import_pyarrow(module: str = "pyarrow") -> Any:
    """pyarrow, or a module of it. Raises HostError, with the command that installs it, when it is missing."""
    try:
        return import_module(module)
    except ImportError:
        raise HostError(f"studies need pyarrow, which is missing: {describe_installation('study')}") from None
