"""Times and power of an estimated engine: by type and size, and no longer the same in a tug as in a VLCC."""

from __future__ import annotations

import pytest

from shipcollision_fmu.manoeuvring.actuators import make_engine
from shipcollision_fmu.ship.loading.engine_estimate import MACHINERY, choose_machinery, estimate_engine
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship_type import SHIP_TYPES, find_ship_type
from shipcollision_fmu.ship.tables.manoeuvring import EngineTable
from tests.ship_files import ship_tables


def time_to_full_astern(kind: str, L: float) -> float:
    """Seconds from the order at service speed until the propeller turns full astern."""
    n = 2.0
    table, _ = estimate_engine(find_ship_type(kind), L, 1e6, n)
    engine, t, speed, gear = make_engine(EngineTable(**table)), 0.0, n, (1.0, 0.0)
    while speed > -0.999 * table["max_astern_rev_per_s"]:
        speed, gear = engine.follow(speed, gear, -99.0, 0.1)
        t += 0.1
    return t


@pytest.mark.parametrize("L", [100.0, 200.0, 300.0])
def test_astern_thrust_of_a_slow_diesel_is_there_within_the_60_s_of_the_IMO(L: float) -> None:
    """MSC/Circ.1053, appendix 3, table 3: 60 s for ships of 100, 200 and 300 m; here half of the revolutions astern."""
    table, _ = estimate_engine(find_ship_type("tanker"), L, 1e6, 2.0)
    half = 2.0 / table["rate"] + table["reversal_delay"] + 0.5 * table["max_astern_rev_per_s"] / table["rate"]
    assert half == pytest.approx(60.0, abs=6.0)


def test_a_tug_reverses_sooner_than_a_VLCC() -> None:
    """It took 90 s and the two runs in both."""
    tug, ferry, boat, vlcc = (
        time_to_full_astern(*ship) for ship in (("tug", 29.0), ("ferry", 150.0), ("launch", 12.0), ("tanker", 320.0))
    )
    assert boat < 20.0
    assert tug < 20.0
    assert 20.0 < ferry < 45.0
    assert 60.0 < vlcc < 90.0


def test_the_margins_are_those_of_the_engine_makers() -> None:
    """15 % for the sea and 10 % of the engine: 1.278 times the power in calm water, at the cube root in revolutions."""
    table, _ = estimate_engine(find_ship_type("bulk carrier"), 200.0, 8.0e6, 1.5)
    assert table["power"] == pytest.approx(8.0e6 * 1.15 / 0.9)
    assert table["max_rev_per_s"] == pytest.approx(1.5 * (1.15 / 0.9) ** (1.0 / 3.0))


@pytest.mark.parametrize("kind", SHIP_TYPES)
@pytest.mark.parametrize("L", [10.0, 30.0, 120.0, 400.0])
def test_astern_revolutions_are_at_least_those_of_IACS(kind: str, L: float) -> None:
    """UR M25: astern running at 70 % of the ahead revolutions."""
    table, _ = estimate_engine(SHIP_TYPES[kind], L, 1e6, 2.0)
    assert table["max_astern_rev_per_s"] >= 0.7 * table["max_rev_per_s"] - 1e-12
    assert choose_machinery(SHIP_TYPES[kind], L) in MACHINERY


def test_what_is_estimated_is_told_and_what_is_given_is_kept() -> None:
    def load(**engine: float) -> tuple[EngineTable, str]:
        tables = ship_tables(ship={"kind": "tanker"}, manoeuvring={"estimate": True})
        ship = load_ship({**tables, "engine": engine})
        assert ship.engine is not None
        return ship.engine, next(note for note in ship.estimated if note.startswith("[engine]"))

    engine, note = load()
    assert "power = " in note
    assert "slow diesel" in note
    given, note = load(power=3.0e6, reversal_delay=40.0)
    assert (given.power, given.reversal_delay, given.rate) == (3.0e6, 40.0, engine.rate)
    assert "power" not in note


def test_revolutions_that_do_not_drive_the_ship_size_no_engine() -> None:
    table, _ = estimate_engine(find_ship_type("tanker"), 200.0, -1.0, 0.1)
    assert "power" not in table
