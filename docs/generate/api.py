"""The names that the package exports, as directives of mkdocstrings."""

from __future__ import annotations

from typing import Any

import shipcollision_fmu
from shipcollision_fmu import ShipCollision, ShipManoeuvring

__all__ = ["api", "exported"]

_MODELS = (ShipCollision, ShipManoeuvring)


def api() -> str:
    """The exported functions, the types that they return, the models and the errors."""
    functions = [thing for thing in exported() if not isinstance(thing, type)]
    types = [thing for thing in exported() if isinstance(thing, type)]
    errors = [thing for thing in types if issubclass(thing, BaseException)]
    results = [thing for thing in types if thing not in errors and thing not in _MODELS]
    parts = {"Functions": functions, "What they return": results, "Models": _MODELS, "Errors": errors}
    return "\n".join(f"## {heading}\n\n{''.join(map(_entry, things))}" for heading, things in parts.items())


def exported() -> list[Any]:
    """The objects behind the package's names, in their order; names that are values (the version) are left out."""
    things = [getattr(shipcollision_fmu, name) for name in shipcollision_fmu.__all__]
    return [thing for thing in things if hasattr(thing, "__qualname__")]


def _entry(thing: Any) -> str:
    return f"::: {thing.__module__}.{thing.__qualname__}\n\n"
