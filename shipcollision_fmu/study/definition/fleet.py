"""The ships among which the rows of a study choose: ships by name, each at some draughts, and pools of sampled ones.

    u in (0, 1)  ->  a choice, by its share of the weights  ->  a ship of it, each with the same share

A ship of a fleet has a number, counted through all choices. Ships from files travel to other machines as their tables.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...errors import ShipError, StudyError
from ...files import is_file
from ...ship.frames import Array
from ...ship.loading.library import list_ship_names, load_ship, read_ship_tables
from ...ship.loading.messages import suggest_or_list
from .distributions import Constant, Discrete, TableColumn, cumulate
from .empirical import EmpiricalTable
from .fleet_tables import FleetTable, PoolTable
from .partial_loading import load_partially

__all__ = ["Fleet", "NamedShip", "Pool", "digest_ships", "make_fleet"]


@dataclass(frozen=True)
class NamedShip:
    """A ship by name at a draught.

    source   what load_ship takes: a shipped name, or the tables of a file
    mesh     name and content of its mesh file, which a worker on another machine does not have
    """

    label: str
    weight: float
    source: str | Mapping[str, Any]
    mesh: tuple[str, bytes] | None = None
    count: int = 1


@dataclass(frozen=True)
class Pool:
    """`count` ships sampled by kind. key: begins the names of their random numbers; label: begins their own names."""

    key: str
    label: str
    table: PoolTable

    @property
    def weight(self) -> float:
        """Its weight in the fleet."""
        return self.table.weight

    @property
    def count(self) -> int:
        """Number of its ships."""
        return self.table.count


@dataclass(frozen=True, eq=False)
class Fleet:
    """The choices of a role, and their cumulated shares; column: of a table, if a table names the ship of each row."""

    choices: tuple[NamedShip | Pool, ...]
    cumulated: Array
    first: npt.NDArray[np.int64]
    column: TableColumn | None = None

    @property
    def size(self) -> int:
        """Number of its ships."""
        return sum(choice.count for choice in self.choices)

    def choose(self, u: Array) -> npt.NDArray[np.int64]:
        """The numbers of the ships at these shares u in (0, 1)."""
        choice = np.searchsorted(self.cumulated, u, side="right")
        below = np.concatenate([[0.0], self.cumulated])[choice]
        share = (u - below) / (self.cumulated[choice] - below)
        counts = np.array([entry.count for entry in self.choices])[choice]
        numbers: npt.NDArray[np.int64] = self.first[choice] + np.minimum((share * counts).astype(np.int64), counts - 1)
        return numbers

    def find_named(self, labels: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
        """The numbers of the ships of these names."""
        number = {choice.label: i for i, choice in enumerate(self.choices) if isinstance(choice, NamedShip)}
        return np.array([number[str(label)] for label in labels], np.int64)

    def locate(self, number: int) -> tuple[NamedShip | Pool, int]:
        """The choice that a ship is of, and its place in it."""
        choice = int(np.searchsorted(self.first, number, side="right")) - 1
        return self.choices[choice], number - int(self.first[choice])


def make_fleet(
    role: str, table: FleetTable | None, tables: Mapping[str, EmpiricalTable], folder: Path, source: str, sails: bool
) -> Fleet:  # fmt: skip
    """The fleet of [own] or [target], empty without the table.

    sails: whether the ships are under way. Raises StudyError for a ship that cannot be loaded, or that cannot sail.
    """
    if table is None:
        return Fleet((), np.zeros(0), np.zeros(0, np.int64))
    place = f"{source}: [{role}]"
    if isinstance(table.ships, TableColumn):
        names = dict.fromkeys(sorted(set(tables[table.ships.table].columns[table.ships.column].tolist())), 1.0)
        column: TableColumn | None = table.ships
        if not isinstance(table.loading, Constant):
            raise StudyError(f"{place} loading must be a number where a table names the ships: give one, such as 1.0")
    else:
        names, column = table.ships or {}, None
    choices: list[NamedShip | Pool] = [
        ship for name, weight in names.items() for ship in _list_loadings(name, weight, table, folder, place, column)
    ]
    if sails:
        _check_sailing(choices, place)
    choices += list_pools(role, table.sampled)
    counts = [choice.count for choice in choices]
    return Fleet(
        tuple(choices), cumulate([choice.weight for choice in choices]),
        np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64), column,
    )  # fmt: skip


def list_pools(role: str, tables: Sequence[PoolTable]) -> list[Pool]:
    """The pools; several of one kind are numbered, so that each ship has a name of its own."""
    kinds = [table.kind for table in tables]
    return [
        Pool(
            f"{role}.sampled.{i}",
            kind if kinds.count(kind) == 1 else f"{kind}, pool {kinds[: i + 1].count(kind)}:",
            tables[i],
        )
        for i, kind in enumerate(kinds)
    ]


def _list_loadings(
    name: str, weight: float, table: FleetTable, folder: Path, place: str, column: TableColumn | None
) -> Iterator[NamedShip]:
    loading = table.loading
    shares: list[Any] = loading.values if isinstance(loading, Discrete) else [getattr(loading, "value", 1.0)]
    weights = (isinstance(loading, Discrete) and loading.weights) or [1.0] * len(shares)
    total = sum(weights)
    for share, part in zip(shares, weights, strict=True):
        try:
            source: Any = _find_source(name, folder)
            ship = load_ship(source)
            if share != 1.0:
                source = load_partially(ship, share)
                load_ship(source)
        except ShipError as error:
            at = "" if share == 1.0 else f" at loading = {share:g}"
            raise StudyError(f"{place} ships: {name}{at}: {error}") from None
        label = name if share == 1.0 or column is not None else f"{name} at {share:g} T"
        yield NamedShip(label, weight * part / total, source, _read_mesh(source))


def _check_sailing(choices: Sequence[NamedShip | Pool], place: str) -> None:
    for choice in choices:
        if isinstance(choice, NamedShip) and load_ship(choice.source).manoeuvring is None:
            raise StudyError(
                f"{place} ships: {choice.label} can only coast, it has no [manoeuvring]: take level = "
                '"encounter", or another ship'
            )


def _read_mesh(source: str | Mapping[str, Any]) -> tuple[str, bytes] | None:
    file = None if isinstance(source, str) else source.get("hull", {}).get("file")
    return None if file is None else (Path(file).name, Path(file).read_bytes())


def _find_source(name: str, folder: Path) -> str | dict[str, Any]:
    """A shipped name, or the tables of a file, whose path begins in the study file's folder and no other."""
    if name in list_ship_names():
        return name
    if not is_file(folder / name) and (name.endswith(".toml") or "/" in name):
        beside = suggest_or_list(name, sorted(path.name for path in folder.glob("*.toml")))
        raise ShipError(f"no such file in {folder}, the study file's folder:{beside}")
    return read_ship_tables(folder / name if is_file(folder / name) else name)


def digest_ships(role: str, fleet: Fleet) -> dict[str, str]:
    """SHA-256 of the content of each ship by name. Weights and pools are in the study file."""
    digests = {}
    for choice in fleet.choices:
        if isinstance(choice, Pool):
            continue
        tables = read_ship_tables(choice.source) if isinstance(choice.source, str) else choice.source
        hull, mesh = dict(tables.get("hull", {})), choice.mesh or _read_mesh(tables)
        if mesh is not None:  # its content counts, not its place on this machine
            hull["file"] = sha256(mesh[1]).hexdigest()
        content = json.dumps({**tables, "hull": hull}, sort_keys=True, default=repr)
        digests[f"ship {choice.label} of [{role}]"] = sha256(content.encode()).hexdigest()
    return digests
