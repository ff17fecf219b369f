"""InCommand: which client is in command of which ship. Only it orders the ship and sounds its horn."""

from __future__ import annotations

from ...errors import InputError
from .bridge import Bridge
from .commands import Horn, Leave, TakeCommand
from .news import Tell

__all__ = ["InCommand"]


class InCommand:
    """Clients by the ship that they command."""

    def __init__(self, bridges: dict[str, Bridge], tell: Tell) -> None:
        self._bridges, self._tell = bridges, tell
        self._clients: dict[str, str] = {}

    @property
    def clients(self) -> dict[str, str]:
        """A copy: the client by ship, without ships that nobody commands."""
        return dict(self._clients)

    def require_ship(self, ship: str) -> None:
        """Raises InputError for a ship that is not there."""
        if ship not in self._bridges:
            raise InputError(f"there is no ship {ship!r}: the ships are {', '.join(self._bridges)}")

    def require(self, client: str, ship: str) -> None:
        """Raises InputError unless the client is in command of the ship, and the ship takes orders."""
        self._require_steered(ship)
        in_command = self._clients.get(ship)
        if in_command != client:
            who = f"{in_command} is in command of {ship}" if in_command else f"nobody is in command of {ship}"
            raise InputError(f"{who}: take command first")

    def take(self, command: TakeCommand) -> None:
        """Take command of a ship, or give it up."""
        ship = command.ship
        self._require_steered(ship)
        in_command = self._clients.get(ship)
        if not command.take:
            if in_command == command.client:
                self._give_up(ship)
            return
        if in_command not in (None, command.client) and not command.force:
            raise InputError(f"{in_command} is in command of {ship}: ask for it, or let the instructor take it")
        if in_command != command.client:
            self._silence(ship)
        self._clients[ship] = command.client
        self._tell("command", ship=ship, client=command.client)

    def leave(self, command: Leave) -> None:
        """A client has gone."""
        for ship in [ship for ship, client in self._clients.items() if client == command.client]:
            self._give_up(ship)

    def sound(self, command: Horn) -> None:
        """Sound the horn, or stop it."""
        self.require(command.client, command.ship)
        self._set_horn(command.ship, command.on)

    def _require_steered(self, ship: str) -> None:
        self.require_ship(ship)
        self._bridges[ship].require_limits()

    def _give_up(self, ship: str) -> None:
        self._silence(ship)
        del self._clients[ship]
        self._tell("command", ship=ship, client=None)

    def _silence(self, ship: str) -> None:
        """Who sounded the horn can no longer end it."""
        if self._bridges[ship].horn:
            self._set_horn(ship, False)

    def _set_horn(self, ship: str, on: bool) -> None:
        self._bridges[ship].horn = on
        self._tell("horn", ship=ship, on=on)
