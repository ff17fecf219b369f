"""Messages of clients: JSON text becomes a command, or an InputError that says what is wrong with it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

from pydantic import Field, ValidationError

from ...errors import InputError
from ...scenario.tables.environment import WindTable
from ...ship.loading.messages import describe_error
from ...ship.tables.table import Pair, Table
from ..json_object import read_object
from ..session import commands
from ..session.commands import Command

__all__ = ["ROLES", "BadMessageError", "RequestId", "parse_message"]

ROLES = ("bridge", "instructor")
RequestId = int | str
LONGEST_ID = 64
"""Characters of an id, which is sent back."""


class BadMessageError(InputError):
    """A message that cannot be read. `request` is its id, if it has one."""

    def __init__(self, text: str, request: RequestId | None = None) -> None:
        super().__init__(text)
        self.request = request


class _Message(Table):
    type: str
    id: RequestId | None = None


class _Order(_Message):
    ship: str
    rudder_deg: float | None = None
    heading_deg: float | None = None
    rev_per_s: float | None = None
    telegraph: int | None = None

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Order(
            client, self.ship, self.rudder_deg, self.heading_deg, self.rev_per_s, self.telegraph
        )  # fmt: skip


class _Take(_Message):
    ship: str
    take: bool = True

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.TakeCommand(client, self.ship, self.take, force=is_instructor)


class _Horn(_Message):
    ship: str
    on: bool

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Horn(client, self.ship, self.on)


class _Rate(_Message):
    rate: float

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Rate(self.rate)


class _Pause(_Message):
    paused: bool

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Pause(self.paused)


class _Step(_Message):
    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Step()


class _Environment(_Message):
    current: Pair | None = None
    wind: WindTable | None = None

    def command(self, client: str, is_instructor: bool) -> Command:
        if self.current is None and self.wind is None:
            raise InputError("environment changes nothing: give current or wind")
        return commands.ChangeEnvironment(
            None if self.current is None else (self.current[0], self.current[1]),
            None if self.wind is None else (self.wind.speed, self.wind.from_deg),
        )


class _Fail(_Message):
    ship: str
    what: Literal["rudder", "blackout"]
    on: bool

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Fail(self.ship, self.what, self.on)


class _Arm(_Message):
    ship: str
    what: Literal["rudder", "blackout"]
    at: float | None = None
    of: str | None = None
    within: float | None = None

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Arm(self.ship, self.what, self.at, self.of, self.within)


class _Disarm(_Message):
    ship: str
    what: Literal["rudder", "blackout"]

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Disarm(self.ship, self.what)


class _Mark(_Message):
    name: str = Field(max_length=60)
    note: str = Field("", max_length=200)

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Mark(self.name, self.note)


class _Back(_Message):
    name: str = Field(max_length=60)

    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.Back(self.name)


class _End(_Message):
    def command(self, client: str, is_instructor: bool) -> Command:
        return commands.End()


_BRIDGE: dict[str, type[Any]] = {"order": _Order, "command": _Take, "horn": _Horn}
_TIME: dict[str, type[Any]] = {"rate": _Rate, "pause": _Pause, "step": _Step}
_INSTRUCTOR: dict[str, type[Any]] = {
    "environment": _Environment, "fail": _Fail, "arm": _Arm, "disarm": _Disarm, "mark": _Mark, "back": _Back,
    "end": _End,
}  # fmt: skip


def parse_message(text: str, client: str, role: str, *, sets_pace: bool) -> tuple[RequestId | None, Command]:
    """The id and the command of a message of a client in a role; sets_pace: whether a bridge may set rate and pause.

    Raises BadMessageError.
    """
    data = _read_object(text)
    request = _read_id(data)
    kind, known = data.get("type"), {**_BRIDGE, **_TIME, **_INSTRUCTOR}
    if not isinstance(kind, str) or kind not in known:
        raise BadMessageError(f"type = {str(kind)[:40]!r} is unknown: give one of {', '.join(known)}", request)
    if role != "instructor" and (kind in _INSTRUCTOR or (kind in _TIME and not sets_pace)):
        raise BadMessageError(f"{kind} is the instructor's: ask there", request)
    model = known[kind]
    try:
        message = model.model_validate(data)
    except ValidationError as error:
        raise BadMessageError(f"{kind}: {describe_error(error, model)}", request) from None
    make: Callable[[str, bool], Command] = message.command
    try:
        return request, make(client, role == "instructor")
    except InputError as error:
        raise BadMessageError(str(error), request) from None


def _read_object(text: str) -> dict[str, Any]:
    try:
        data = read_object(text)
    except InputError as error:
        raise BadMessageError(str(error)) from None
    except (ValueError, RecursionError) as error:
        raise BadMessageError(f"the message is not JSON ({error}): send one object") from None
    if not isinstance(data, dict):
        raise BadMessageError(f"the message is a {type(data).__name__}: send one object with a type")
    return data


def _read_id(data: dict[str, Any]) -> RequestId | None:
    request = data.get("id")
    if request is None or (type(request) is int and abs(request) < 2**53):
        return request
    if isinstance(request, str) and len(request) <= LONGEST_ID:
        return request
    raise BadMessageError(f"id must be a whole number or a text of at most {LONGEST_ID} characters")
