"""Pairs that stay open: as many as there is room for, the others closed, and the rows the same."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_ship
from shipcollision_fmu.batch import impact
from shipcollision_fmu.ship.hull.hull import build_hull
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
    monkeypatch.setitem(impact_rows.PAIRS, "native", OpenPairs(impact_rows.OpenNative()))
    halves = [as_bytes(compute_rows(study, first, 40)) for first in (0, 40)]
    assert [halves[0][table] + halves[1][table] for table in (0, 1)] == whole


def test_a_ship_is_prepared_and_cut_once_for_all_its_pairs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nine pairs of three ships: three files, and a section for each ship and height of contact."""
    files, sections = [], []
    write, cut = Path.write_bytes, impact.cut_section

    def write_bytes(path: Path, content: Any) -> int:
        files.append(path)
        return write(path, content)

    def cut_section(hull: Any, z: float) -> Any:
        sections.append((id(hull), z))
        return cut(hull, z)

    monkeypatch.setattr(Path, "write_bytes", write_bytes)
    monkeypatch.setattr(impact, "cut_section", cut_section)
    impact._cut_ship.cache_clear()
    ships = [FleetShip(name, name, load_ship(name)) for name in ("kcs", "kvlcc2", "guan2014_target")]
    decks = [float(build_hull(s.L_oa, s.B, s.T, s.hull).vertices[:, 2].min()) for s in (f.loaded for f in ships)]
    open_native = impact_rows.OpenNative()
    for own in ships:
        for target in ships:
            open_native(own, target, 3).close()
    assert len(files) == 3
    assert len(sections) == len({(i, max(a, b)) for i, a in enumerate(decks) for b in decks})


def test_no_more_prepared_ships_stay_than_are_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(impact_rows, "FILES_KEPT", 3)
    open_native = impact_rows.OpenNative()
    ship = FleetShip("kcs", "kcs", load_ship("kcs"))
    others = [FleetShip(name, name, load_ship(name)) for name in ("kvlcc2", "buoy", "buoy")]
    folders = []
    for other in others:
        open_native(ship, other, 3).close()
        assert open_native._files is not None
        folders.append(open_native._files.folder)
    assert folders[0] == folders[1] != folders[2]
    assert [folder.exists() for folder in folders] == [False, False, True]
    del open_native
    assert not folders[-1].exists()
