"""The names that the package exports, as directives of mkdocstrings."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import shipcollision_fmu
from shipcollision_fmu import errors
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.scenario.scenario import Scenario
from shipcollision_fmu.ship.ship import Ship

__all__ = ["api", "exported"]

_RESULTS = (Run, Scenario, Ship)
_MODELS = (ShipCollision, ShipManoeuvring)


def api() -> str:
    """The exported functions, what they return, the models and the errors; every object once."""
    parts: list[str] = []
    done: set[str] = set()
    for heading, objects in (
        ("Functions", [thing for thing in exported() if not isinstance(thing, type)]),
        ("What they return", [*_RESULTS, *(thing for thing in exported() if _is_result(thing))]),
        ("Models", list(_MODELS)),
        ("Errors", [getattr(errors, name) for name in errors.__all__]),
    ):
        parts.append(f"## {heading}\n")
        for thing in objects:
            path = f"{thing.__module__}.{thing.__qualname__}"
            if path not in done:
                done.add(path)
                parts.append(f"::: {path}\n")
    return "\n".join(parts)


def exported() -> list[Any]:
    """The objects behind the package's names, in their order; names that are values (the version) are left out."""
    things = [getattr(shipcollision_fmu, name) for name in shipcollision_fmu.__all__]
    return [thing for thing in things if hasattr(thing, "__qualname__") and not isinstance(thing, ModuleType)]


def _is_result(thing: Any) -> bool:
    return isinstance(thing, type) and not issubclass(thing, BaseException) and thing not in _MODELS
