"""group_pairs(): cases by pair of ships; OpenPairs: pairs of ships that stay open from one batch to the next."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ...errors import ShipError
from ...ship.ship import Ship
from ..definition.study import Study
from .cases import Cases
from .fleet_ships import FleetShip, find_ship
from .results import Results

__all__ = ["Impacts", "OpenPairs", "group_pairs", "refuse_all"]

PAIRS_KEPT = 256
"""Pairs that stay open. To open one costs as much as thirty impacts; each takes some 250 kB."""


class Impacts(Protocol):
    """The impacts of a pair of ships, in the native library or in Python."""

    def run(self, cases: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """A row of IMPACTS for each of the cases."""

    def close(self) -> None:
        """Free what it holds."""


class OpenPairs(threading.local):
    """The pairs of one thread, the least recently used one closed first."""

    def __init__(self, make: Callable[[FleetShip, FleetShip, int], Impacts]) -> None:
        self._make = make
        self._open: OrderedDict[tuple[int, int, int], tuple[Impacts, Ship, Ship]] = OrderedDict()

    def find(self, own: FleetShip, target: FleetShip, degrees_of_freedom: int) -> Impacts:
        """The impacts of these ships. Raises ShipError for a ship that is refused."""
        key = (id(own.loaded), id(target.loaded), degrees_of_freedom)  # ships are kept, so their ids stay theirs
        if key in self._open:
            self._open.move_to_end(key)
            return self._open[key][0]
        made = self._make(own, target, degrees_of_freedom)
        self._open[key] = made, own.loaded, target.loaded
        while len(self._open) > PAIRS_KEPT:
            self._open.popitem(last=False)[1][0].close()
        return made


def group_pairs(
    study: Study, cases: Cases, results: Results
) -> Iterator[tuple[FleetShip, FleetShip, npt.NDArray[np.intp]]]:
    """The pairs of ships that occur, and the places of their cases. Cases of a ship that is refused are refused."""
    own, target = cases.ships["own"], cases.ships["target"]
    pairs = own * study.target.size + target
    order = np.argsort(pairs, kind="stable")
    for places in np.split(order, np.flatnonzero(np.diff(pairs[order])) + 1):
        ships = [find_ship(study, role, int(cases.ships[role][places[0]])) for role in ("own", "target")]
        reason = next((ship.reason for ship in ships if ship.ship is None), None)
        if reason is None:
            yield ships[0], ships[1], places
        else:
            refuse_all(results, places, reason)


def refuse_all(results: Results, places: npt.NDArray[np.intp], reason: str | ShipError) -> None:
    """Refuse the cases at all these places."""
    for place in places:
        results.refuse(int(place), str(reason))
