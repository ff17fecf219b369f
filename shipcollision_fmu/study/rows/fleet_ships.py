"""find_ship(): a ship of a study's fleet by its number, made once and kept.

The main dimensions of a sampled ship are drawn by its number in its pool, so that it is the same in every row, batch
and process.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ...errors import ShipError
from ...files import write_file
from ...ship.loading.library import load_ship
from ...ship.ship import Ship
from ..definition.distributions import Constant, Distribution, TableColumn
from ..definition.fleet import NamedShip, Pool
from ..definition.partial_loading import load_partially
from ..definition.study import Study
from .uniform_numbers import draw_shares

__all__ = ["FleetShip", "find_ship"]

SHIPS_KEPT = 1024
"""Ships kept in memory, about 80 kB each. With fewer than a study has, they are made again for later rows."""


@dataclass(frozen=True, eq=False)
class FleetShip:
    """A ship of a fleet.

    source   what load_ship takes: a shipped name, or tables
    ship     the ship; None where it is refused, for this `reason`
    """

    label: str
    source: str | Mapping[str, Any]
    ship: Ship | None
    reason: str = ""

    @property
    def loaded(self) -> Ship:
        """The ship. Raises ShipError where it is refused."""
        if self.ship is None:
            raise ShipError(self.reason)
        return self.ship


def find_ship(study: Study, role: str, number: int) -> FleetShip:
    """The ship of this number."""
    return _find(_Fleet(study, role), number)


class _Fleet:
    """A fleet of a study, compared by the study's fingerprint."""

    def __init__(self, study: Study, role: str) -> None:
        self.study, self.role = study, role
        self.key = (study.fingerprint, role if study.own is not study.target else "own")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Fleet) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)


@lru_cache(maxsize=SHIPS_KEPT)
def _find(of: _Fleet, number: int) -> FleetShip:
    choice, member = getattr(of.study, of.role).locate(number)
    label = choice.label if isinstance(choice, NamedShip) else f"{choice.label} {member + 1}"
    source: str | Mapping[str, Any] = ""
    try:
        source = _find_source(choice) if isinstance(choice, NamedShip) else _make(of, choice, member)
        return FleetShip(label, source, load_ship(source))
    except ShipError as error:
        return FleetShip(label, source, None, f"{of.role}: {label}: {error}")


def _find_source(ship: NamedShip) -> str | Mapping[str, Any]:
    """What load_ship takes, with the mesh file as this process has it."""
    if ship.mesh is None or isinstance(ship.source, str):
        return ship.source
    name, content = ship.mesh
    path = Path(_mesh_folder().name, sha256(content).hexdigest(), name)
    if not path.is_file():
        write_file(path, content)  # at once: another thread may look for it
    return {**ship.source, "hull": {**ship.source["hull"], "file": str(path)}}


@lru_cache(maxsize=1)
def _mesh_folder() -> TemporaryDirectory[str]:
    """The folder of this process' mesh files, removed at its end."""
    return TemporaryDirectory(prefix="shipcollision-")


def _make(of: _Fleet, pool: Pool, member: int) -> dict[str, Any]:
    """The tables of the ship at this place in the pool."""
    table = pool.table
    L_pp = _draw(of, pool, "L_pp", member)
    B = L_pp / _draw(of, pool, "L_over_B", member) if table.B is None else _draw(of, pool, "B", member)
    T = B / _draw(of, pool, "B_over_T", member) if table.T is None else _draw(of, pool, "T", member)
    loading = _draw(of, pool, "loading", member)
    tables = {
        "ship": {"name": f"{pool.label} {member + 1}", "kind": table.kind, "source": "Sampled by a study."},
        "particulars": {"L_pp": L_pp, "B": B, "T": T, "C_b": _draw(of, pool, "C_b", member)},
    }
    return tables if loading == 1.0 else load_partially(load_ship(tables), loading)


def _draw(of: _Fleet, pool: Pool, name: str, member: int) -> float:
    given: Distribution = getattr(pool.table, name)
    if isinstance(given, Constant):
        return float(given.value)
    if isinstance(given, TableColumn):
        table = of.study.tables[given.table]
        line: Any = table.find_lines(draw_shares(of.study.seed, f"{pool.key}.table.{given.table}", member, 1))
        return float(table.columns[given.column][line[0]])
    u = draw_shares(of.study.seed, f"{pool.key}.{name}", member, 1)
    return float(np.asarray(given.quantile(u))[0])
