"""Actions: does the commands that change ships, surroundings and marks, and tells of them.

Each raises InputError for what is refused, and then has changed nothing.
"""

from __future__ import annotations

from ...errors import InputError
from .armed import Armed
from .commands import FAILURES, Arm, ChangeEnvironment, Disarm, Fail, Mark, Order
from .in_command import InCommand
from .live_run import LiveRun
from .news import Tell

__all__ = ["START", "Actions"]

START = "start"
"""Name of the mark at the beginning."""
LONGEST_NAME = 60
"""Characters in the name of a mark."""
LONGEST_NOTE = 200
"""Characters in the note on a mark."""


class Actions:
    """What is done to a run."""

    def __init__(self, run: LiveRun, in_command: InCommand, tell: Tell) -> None:
        self._run, self._in_command, self._tell = run, in_command, tell

    def order(self, command: Order) -> None:
        """An order to a ship."""
        self._in_command.require(command.client, command.ship)
        self._run.bridges[command.ship].order(
            command.rudder_deg, command.heading_deg, command.rev_per_s, command.telegraph
        )

    def fail(self, command: Fail) -> None:
        """A failure begins or ends."""
        self._in_command.require_ship(command.ship)
        _require_failure(command.what)
        self._run.bridges[command.ship].fail(command.what, command.on)
        self._tell("failure", ship=command.ship, what=command.what, on=command.on)

    def arm(self, command: Arm) -> None:
        """A failure is to begin by itself."""
        for ship in (command.ship, *([] if command.of is None else [command.of])):
            self._in_command.require_ship(ship)
        _require_failure(command.what)
        self._run.arm(Armed(command.ship, command.what, command.at, command.of, command.within))
        self.tell_of_armed()

    def disarm(self, command: Disarm) -> None:
        """It is not to begin."""
        self._run.armed.disarm(command.ship, command.what)
        self.tell_of_armed()

    def tell_of_armed(self) -> None:
        """Tell of all failures that are armed."""
        self._tell("armed", armed=self._run.armed.as_dicts())

    def change(self, command: ChangeEnvironment) -> None:
        """Another current or wind."""
        self._run.change(command.current, command.wind)
        environment = self._run.observe_environment()
        self._tell(
            "environment", current=list(environment.current),
            wind={"speed": environment.wind.speed, "from_deg": environment.wind.from_deg},
        )  # fmt: skip

    def mark(self, command: Mark) -> None:
        """Keep the state under a name."""
        name = command.name
        if not name.strip() or len(name) > LONGEST_NAME or not name.isprintable():
            raise InputError(f"mark {name[:LONGEST_NAME]!r}: give a name of 1 to {LONGEST_NAME} printable characters")
        if name == START:
            raise InputError(f"mark {name!r} is the beginning of the run: take another name")
        note = command.note.strip()
        if len(note) > LONGEST_NOTE or not note.isprintable():
            raise InputError(f"mark {name!r}: give a note of up to {LONGEST_NOTE} printable characters, in one line")
        self._run.mark(name, note)
        self._tell("mark", name=name, note=note)


def _require_failure(what: str) -> None:
    if what not in FAILURES:
        raise InputError(f"failure {what!r} is unknown: give {' or '.join(FAILURES)}")
