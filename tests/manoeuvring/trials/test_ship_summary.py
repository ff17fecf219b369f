"""The figures that `shipcollision ships NAME` prints are those of the parts they come from."""

from __future__ import annotations

from math import isnan

import pytest

from shipcollision_fmu.manoeuvring.trials.ship_summary import summarise_ship
from shipcollision_fmu.manoeuvring.trials.steady_course import find_steady_course
from shipcollision_fmu.manoeuvring.trials.trials import sail_crash_stop
from shipcollision_fmu.ship.loading.library import load_ship


def test_figures_of_a_ship_that_sails() -> None:
    name = "guan2014_target_manoeuvring"
    ship = load_ship(name)
    summary, stop = summarise_ship(name, ship), sail_crash_stop(find_steady_course(name))
    assert summary.GM_T == 0.64
    assert pytest.approx(ship.T + 4.5) == summary.KG
    assert summary.roll_period == pytest.approx(summary.code_period, rel=0.01)  # k_xx at its upper bound of 0.45 B
    assert ship.engine is not None
    assert summary.power == ship.engine.power
    assert summary.track_reach == stop["track reach"] * ship.L_pp
    assert summary.time_to_stop == stop["time to stop"]
    assert summary.notes == ()


def test_a_ship_that_coasts_has_no_speed_and_says_why() -> None:
    summary = summarise_ship("floating_log", load_ship("floating_log"))
    assert isnan(summary.service_speed)
    assert isnan(summary.track_reach)
    assert summary.notes[-1].startswith("it coasts")


def test_a_ship_without_hydrostatics_has_no_GM_and_says_why() -> None:
    summary = summarise_ship("guan2014_own", load_ship("guan2014_own"))
    assert isnan(summary.GM_T)
    assert "C_b" in summary.notes[0]
