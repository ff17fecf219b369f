"""A line of the order port: one JSON object, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...errors import InputError
from ..json_object import read_object

__all__ = ["Line", "NotJsonError", "parse_line"]

NUMBERS = ("rudder_deg", "heading_deg", "rev_per_s")
KEYS = ("ship", *NUMBERS, "telegraph", "command", "state", "token", "id")
LONGEST_NAME = 64
"""Characters in the name of a ship, and in an id."""
LONGEST_TOKEN = 256
"""Characters of a token."""
LARGEST = 1e6
"""Limit of a number; the ship has limits of its own."""


class NotJsonError(InputError):
    """A line that is not JSON."""


@dataclass(frozen=True)
class Line:
    """A line as read: an order to a ship, a change of command, or a question for the state; a token may go alone."""

    ship: str | None = None
    order: Mapping[str, float | int] = field(default_factory=dict)
    command: bool | None = None
    state: bool = False
    token: str | None = None
    id: str | int | None = None


def parse_line(raw: bytes) -> Line:
    """The content of a line. Raises InputError, in one line, for what is no request."""
    data = _read_object(raw)
    identifier = data.get("id")
    if not (identifier is None or (isinstance(identifier, str | int) and len(str(identifier)) <= LONGEST_NAME)):
        raise InputError(f"id must be a text or a whole number of up to {LONGEST_NAME} characters")
    token = data.get("token")
    if not (token is None or (isinstance(token, str) and len(token) <= LONGEST_TOKEN)):
        raise InputError(f"token must be a text of up to {LONGEST_TOKEN} characters")
    if "state" in data:
        if data["state"] is not True or set(data) - {"state", "token", "id"}:
            raise InputError('state goes alone, as {"state": true}')
        return Line(state=True, token=token, id=identifier)
    if token is not None and not set(data) - {"token", "id"}:
        return Line(token=token, id=identifier)
    ship, command = data.get("ship"), data.get("command")
    if not isinstance(ship, str) or not 0 < len(ship) <= LONGEST_NAME:
        raise InputError("ship is missing: give the name of a ship of the scenario")
    if not (command is None or isinstance(command, bool)):
        raise InputError(f"command = {_shorten(command)} must be true or false")
    order = _read_order(data)
    if not order and command is None:
        raise InputError(f"the order is empty: give {', '.join(NUMBERS)} or telegraph, or command")
    return Line(ship, order, command, False, token, identifier)


def _read_object(raw: bytes) -> dict[str, Any]:
    """The JSON object of a line, with known keys."""
    try:
        data = read_object(raw.decode("utf-8"))
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


def _shorten(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
