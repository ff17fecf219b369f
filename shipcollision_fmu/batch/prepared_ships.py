"""Ships and obstacles as files that the native library reads, for as long as a call lasts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from types import TracebackType
from typing import Any, TypeAlias
from weakref import WeakKeyDictionary, finalize

from ..collision.prepared_obstacles import SUFFIX as OBSTACLES_SUFFIX
from ..collision.prepared_obstacles import prepare_obstacles
from ..manoeuvring.prepared_ship import SUFFIX, describe_ship
from ..ship.loading.library import load_ship
from ..ship.ship import Ship

__all__ = ["AnyShip", "PreparedShips", "find_ship"]

AnyShip: TypeAlias = "Ship | str | Path | Mapping[str, Any]"
"""A ship, its name, the path of its file, or the file's tables."""


_CONTENTS: WeakKeyDictionary[Ship, bytes] = WeakKeyDictionary()
"""Prepared files by ship, for the next call: to prepare one takes 5 ms."""


def find_ship(ship: AnyShip) -> Ship:
    """The ship that is meant. Raises ShipError when there is none."""
    return ship if isinstance(ship, Ship) else load_ship(ship)


class PreparedShips:
    """A folder of prepared ships and obstacles, each written once.

    It is removed at the end of the context, by close(), or with the object.
    """

    def __init__(self) -> None:
        self.folder = Path(mkdtemp(prefix="shipcollision-"))
        self._remove = finalize(self, rmtree, self.folder, ignore_errors=True)
        self._paths: dict[int, str] = {}
        self._ships: list[Ship] = []  # kept alive, for their ids are keys
        self._obstacles: dict[str, str] = {}

    def __len__(self) -> int:
        """How many ships are written."""
        return len(self._paths)

    def __enter__(self) -> PreparedShips:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Remove the folder."""
        self._remove()

    def write(self, ship: Ship) -> str:
        """The path of the ship's file. Raises ShipError or HostError for a ship without a hull."""
        if id(ship) not in self._paths:
            path = self.folder / f"{len(self._paths)}{SUFFIX}"
            path.write_bytes(_describe(ship))
            self._paths[id(ship)] = str(path)
            self._ships.append(ship)
        return self._paths[id(ship)]

    def write_obstacles(self, text: str) -> str:
        """The path of a file of obstacles, from their TOML text; empty without obstacles."""
        if not text:
            return ""
        if text not in self._obstacles:
            path = self.folder / f"{len(self._obstacles)}{OBSTACLES_SUFFIX}"
            path.write_bytes(prepare_obstacles(text))
            self._obstacles[text] = str(path)
        return self._obstacles[text]


def _describe(ship: Ship) -> bytes:
    """The content of a ship's prepared file."""
    content = _CONTENTS.get(ship)
    if content is None:
        content = _CONTENTS[ship] = describe_ship(ship, needs_hull=True)
    return content
