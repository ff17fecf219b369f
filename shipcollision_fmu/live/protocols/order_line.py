"""A line of the order port: one JSON object, checked."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...errors import InputError

__all__ = ["Line", "NotJsonError", "parse_line"]

NUMBERS = ("rudder_deg", "heading_deg", "rev_per_s")
KEYS = ("ship", *NUMBERS, "telegraph", "command", "state", "id")
LONGEST_NAME = 64
"""Characters in the name of a ship, and in an id."""
LARGEST = 1e6
"""Limit of a number; the ship has limits of its own."""


class NotJsonError(InputError):
    """A line that is not JSON."""


@dataclass(frozen=True)
class Line:
    """A line as read: an order to a ship, a change of command, or a question for the state."""

    ship: str | None = None
    order: Mapping[str, float | int] = field(default_factory=dict)
    command: bool | None = None
    state: bool = False
    id: str | int | None = None


def parse_line(raw: bytes) -> Line:
    """The content of a line. Raises InputError, in one line, for what is no request."""
    data = _read_object(raw)
    identifier = data.get("id")
    if not (identifier is None or (isinstance(identifier, str | int) and len(str(identifier)) <= LONGEST_NAME)):
        raise InputError(f"id must be a text or a whole number of up to {LONGEST_NAME} characters")
    if "state" in data:
        if data["state"] is not True or set(data) - {"state", "id"}:
            raise InputError('state goes alone, as {"state": true}')
        return Line(state=True, id=identifier)
    ship, command = data.get("ship"), data.get("command")
    if not isinstance(ship, str) or not 0 < len(ship) <= LONGEST_NAME:
        raise InputError("ship is missing: give the name of a ship of the scenario")
    if not (command is None or isinstance(command, bool)):
        raise InputError(f"command = {_shorten(command)} must be true or false")
    order = _read_order(data)
    if not order and command is None:
        raise InputError(f"the order is empty: give {', '.join(NUMBERS)} or telegraph, or command")
    return Line(ship, order, command, False, identifier)


def _read_object(raw: bytes) -> dict[str, Any]:
    """The JSON object of a line, with known keys."""
    try:
        data = json.loads(raw.decode("utf-8"), parse_constant=_refuse_constant)
    except InputError:
        raise
    except (ValueError, RecursionError):
        raise NotJsonError('the line is not JSON: send an object such as {"ship": "own", "rudder_deg": 5}') from None
    if not isinstance(data, dict):
        raise InputError(f"the line is {type(data).__name__}, not an object: put it into braces")
    for key in data:
        if key not in KEYS:
            raise InputError(f"{key[:40]!r} is no key: known are {', '.join(KEYS)}")
    return data


def _read_order(data: Mapping[str, Any]) -> dict[str, float | int]:
    order: dict[str, float | int] = {}
    for key in NUMBERS:
        if data.get(key) is not None:
            value = data[key]
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise InputError(f"{key} = {_shorten(value)} must be a number")
            if not abs(value) < LARGEST:
                raise InputError(f"{key} = {_shorten(value)} must be between -{LARGEST:g} and {LARGEST:g}")
            order[key] = float(value)
    telegraph = data.get("telegraph")
    if telegraph is not None:
        if isinstance(telegraph, bool) or not isinstance(telegraph, int) or not -4 <= telegraph <= 4:
            raise InputError(f"telegraph = {_shorten(telegraph)} must be a whole number, -4 (full astern) to 4 (ahead)")
        order["telegraph"] = telegraph
    return order


def _refuse_constant(text: str) -> Any:
    raise InputError(f"{text} is not JSON: give a finite number")


def _shorten(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
