"""A JSON object as programs send it: strict, since two readers of a lax one may take different values from it."""

from __future__ import annotations

import json
from typing import Any

from ..errors import InputError

__all__ = ["read_object"]


def read_object(text: str) -> Any:
    """What a JSON text holds.

    Raises InputError for a key that an object has twice, and for NaN and Infinity, which are no JSON; ValueError or
    RecursionError for what is no JSON at all.
    """
    return json.loads(text, object_pairs_hook=_make_object, parse_constant=_refuse_constant)


def _make_object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for key, value in pairs:
        if key in made:
            raise InputError(f"{key[:40]!r} is there twice: give it once")
        made[key] = value
    return made


def _refuse_constant(text: str) -> Any:
    raise InputError(f"{text} is not JSON: give a finite number")
