"""Pairs that stay open: as many as there is room for, the others closed, and the rows the same."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_ship
from shipcollision_fmu.study.rows import impact_rows, pairs
from shipcollision_fmu.study.rows.compute import compute_rows
from shipcollision_fmu.study.rows.fleet_ships import FleetShip
from shipcollision_fmu.study.rows.pairs import OpenPairs
from tests.study.rows.test_compute import as_bytes, read_impacts


class Pair:
    """A pair that records whether it is open."""

    def __init__(self, own: FleetShip, target: FleetShip, degrees_of_freedom: int) -> None:
        self.names, self.is_open = (own.label, target.label, degrees_of_freedom), True

    def run(self, cases: Any) -> Any:
        return np.zeros(len(cases))

    def close(self) -> None:
        self.is_open = False


def test_the_pair_used_least_recently_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pairs, "PAIRS_KEPT", 2)
    made: list[Pair] = []

    def make(own: FleetShip, target: FleetShip, degrees_of_freedom: int) -> Pair:
        made.append(Pair(own, target, degrees_of_freedom))
        return made[-1]

    a, b = (FleetShip(name, name, load_ship(name)) for name in ("kcs", "kvlcc2"))
    open_pairs = OpenPairs(make)
    first = open_pairs.find(a, b, 3)
    assert open_pairs.find(b, a, 3) is not first
    assert open_pairs.find(a, b, 3) is first  # now the other one is the oldest
    open_pairs.find(a, a, 3)
    assert [(pair.names, pair.is_open) for pair in made] == [
        (("kcs", "kvlcc2", 3), True), (("kvlcc2", "kcs", 3), False), (("kcs", "kcs", 3), True),
    ]  # fmt: skip
    assert open_pairs.find(a, b, 4) is not first


def test_rows_are_the_same_when_every_pair_is_opened_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    study = read_impacts()
    whole = as_bytes(compute_rows(study, 0, 80))
    monkeypatch.setattr(pairs, "PAIRS_KEPT", 1)
    monkeypatch.setitem(impact_rows.PAIRS, "native", OpenPairs(impact_rows._open_native))
    halves = [as_bytes(compute_rows(study, first, 40)) for first in (0, 40)]
    assert [halves[0][table] + halves[1][table] for table in (0, 1)] == whole
