"""Commands to a live session: what a client may ask for. The session checks them, one after the other, in its thread.

A client is a text that names whoever asks: a browser, a program at the order port. Only the client in command of a ship
may order it. What is refused changes nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

__all__ = [
    "FAILURES", "Arm", "Back", "ChangeEnvironment", "Command", "Disarm", "End", "Fail", "Horn", "Leave", "Mark",
    "Order", "Pause", "Rate", "Step", "TakeCommand",
]  # fmt: skip

FAILURES = ("rudder", "blackout")
"""rudder: it stays where it is. blackout: the revolutions go to 0 as well."""


@dataclass(frozen=True)
class Order:
    """An order to a ship: rudder [deg] (positive to starboard) or heading [deg], and revolutions [1/s] or telegraph
    (-4 full astern ... 0 stop ... 4 full ahead). What is None stays as it is."""

    client: str
    ship: str
    rudder_deg: float | None = None
    heading_deg: float | None = None
    rev_per_s: float | None = None
    telegraph: int | None = None


@dataclass(frozen=True)
class TakeCommand:
    """Take command of a ship, or give it up. `force` takes it from another client, as an instructor may."""

    client: str
    ship: str
    take: bool = True
    force: bool = False


@dataclass(frozen=True)
class Leave:
    """A client has gone: it gives up every command."""

    client: str


@dataclass(frozen=True)
class Horn:
    """Sound the horn of a ship, or stop it. It has no effect but on pages."""

    client: str
    ship: str
    on: bool


@dataclass(frozen=True)
class Fail:
    """A failure of a ship begins or ends; see FAILURES."""

    ship: str
    what: str
    on: bool


@dataclass(frozen=True)
class Arm:
    """A failure of a ship that is to begin at the run time `at` [s], or once ship `of` is nearer than `within` [m]."""

    ship: str
    what: str
    at: float | None = None
    of: str | None = None
    within: float | None = None


@dataclass(frozen=True)
class Disarm:
    """What was armed is not to begin."""

    ship: str
    what: str


@dataclass(frozen=True)
class ChangeEnvironment:
    """Another current, velocity of the water [north, east] [m/s], or another wind, speed [m/s] and from_deg [deg]."""

    current: tuple[float, float] | None = None
    wind: tuple[float, float] | None = None


@dataclass(frozen=True)
class Mark:
    """Keep the whole state under a name, to go back to it. `note`: a line on it."""

    name: str
    note: str = ""


@dataclass(frozen=True)
class Back:
    """Go back to the mark of that name. What was recorded since is forgotten."""

    name: str


@dataclass(frozen=True)
class Rate:
    """Simulated seconds per second, 1/4 to 20."""

    rate: float


@dataclass(frozen=True)
class Pause:
    """Pause, or go on."""

    paused: bool


@dataclass(frozen=True)
class Step:
    """One communication step, while paused."""


@dataclass(frozen=True)
class End:
    """End the run and write its folder. `reason` is a line for the pages."""

    reason: Literal["ended by the instructor", "interrupted"] | str = "ended by the instructor"


Command: TypeAlias = (
    Order
    | TakeCommand
    | Leave
    | Horn
    | Fail
    | Arm
    | Disarm
    | ChangeEnvironment
    | Mark
    | Back
    | Rate
    | Pause
    | Step
    | End
)
