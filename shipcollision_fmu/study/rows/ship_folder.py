"""ShipFolder: ships as files, for what reads a ship by name or path alone."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType

from ...scenario.toml_writer import format_toml
from .fleet_ships import FleetShip

__all__ = ["ShipFolder"]


class ShipFolder:
    """A folder of ship files, each written once. It is removed at the end of the context."""

    def __enter__(self) -> ShipFolder:
        self._folder = TemporaryDirectory(prefix="shipcollision-")
        self._paths: dict[int, str] = {}
        self._ships: list[FleetShip] = []  # kept alive, for their ids are keys
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._folder.cleanup()

    def name_ships(self, text: str) -> str:
        """The text with the ships' names in place of their paths, which differ from machine to machine."""
        for ship in self._ships:
            text = text.replace(self._paths[id(ship)], ship.label)
        return text

    def write(self, ship: FleetShip) -> str:
        """The name or path of the ship."""
        if isinstance(ship.source, str):
            return ship.source
        if id(ship) not in self._paths:
            path = Path(self._folder.name, f"{len(self._paths)}.toml")
            path.write_text(format_toml((), ship.source), encoding="utf-8")
            self._paths[id(ship)] = str(path)
            self._ships.append(ship)
        return self._paths[id(ship)]
