"""The packages of the extra `live`, with one line for a machine that lacks them."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

from ..errors import HostError, describe_installation

__all__ = ["require_live", "require_protocols"]

_MODULES = ("starlette", "uvicorn", "websockets")
_PROTOCOLS = ("pyais", "pynmeagps")


def require_live() -> None:
    """Raise HostError, with the command that installs them, when packages of a live run are missing."""
    _require("a live run", (*_MODULES, *_PROTOCOLS))


def require_protocols() -> None:
    """The same for packages of NMEA and AIS alone."""
    _require("NMEA and AIS", _PROTOCOLS)


def _require(what: str, modules: Sequence[str]) -> None:
    missing = [name for name in modules if find_spec(name) is None]
    if missing:
        verb, is_ = ("need", "are") if what.startswith("NMEA") else ("needs", "is")
        raise HostError(f"{what} {verb} {', '.join(missing)}, which {is_} missing: {describe_installation('live')}")
