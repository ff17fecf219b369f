"""The packages of the extra `live`, with one line for a machine that lacks them."""

from __future__ import annotations

from importlib.util import find_spec

from ..errors import HostError, describe_installation

__all__ = ["require_live"]

_MODULES = ("starlette", "uvicorn", "websockets")


def require_live() -> None:
    """Raise HostError, with the command that installs them, when packages of a live run are missing."""
    missing = [name for name in _MODULES if find_spec(name) is None]
    if missing:
        raise HostError(f"a live run needs {', '.join(missing)}, which is missing: {describe_installation('live')}")
