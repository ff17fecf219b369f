"""No verdict where a ship has left the range of its hull's polynomials, and sizes of a set that are in another unit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu.cli.trial_table import make_trial_table
from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.manoeuvring.trials.steady_course import find_steady_course
from shipcollision_fmu.manoeuvring.trials.trial import Moment, make_trial
from shipcollision_fmu.manoeuvring.trials.trials import sail_turning_circle
from shipcollision_fmu.ship.loading.library import load_ship
from tests.manoeuvring.conftest import started

SPINNING = """
extends = "kvlcc2"
[manoeuvring]
N_v = -0.60
N_r = -0.004
N_vvr = 0.0
"""
"""A hull that broaches: it is turned by its own drift, and hardly damped."""


def test_a_set_that_spins_gets_no_verdict(tmp_path: Path) -> None:
    """Its tactical diameter is far below 5 L, and was called kept."""
    path = tmp_path / "spinning.toml"
    path.write_text(SPINNING, encoding="utf-8")
    sailed = sail_turning_circle(find_steady_course(str(path)), 35.0)
    assert sailed["tactical diameter"] < 2.0
    assert {figure.within for figure in sailed.figures.values()} == {None}
    assert sailed.figures["advance"].limit == 4.5  # the limit is still told
    assert "no verdict: the ship drifts by up to " in sailed.doubt
    assert "turns with up to r L/U = " in sailed.doubt
    assert "look at the signs and sizes of the set" in sailed.doubt
    cells = [str(cell) for cell in make_trial_table(find_steady_course(str(path)), sailed).columns[-1].cells]
    assert sorted(set(cells)) == ["", "no verdict"]


@pytest.mark.parametrize(
    ("change", "doubtful"),
    [
        ({"sway": -4.0, "surge": 7.0}, False),  # 30 deg
        ({"sway": -5.5, "surge": 7.0}, True),  # 38 deg
        ({"yaw_rate": 0.03, "surge": 7.0}, False),  # r' = 1.37
        ({"yaw_rate": 0.035, "surge": 7.0}, True),  # 1.6
        ({"sway": -1.0, "surge": 0.1}, False),  # at the end of a crash stop
    ],
)
def test_the_range_is_a_drift_and_a_rate_of_turn(change: dict[str, float], doubtful: bool) -> None:
    """35 deg of drift, r' = 1.5; slower than a fifth of the approach nothing is asked."""
    start = find_steady_course("kvlcc2")
    first = Moment(0.0, 0.0, 0.0, 0.0, start.speed, 0.0, 0.0, 0.0, start.rev_per_s)
    assert bool(make_trial(start, "", [], [first, replace(first, **change)]).doubt) is doubtful


def variant(**tables: dict[str, Any]) -> dict[str, Any]:
    return {"extends": "kvlcc2", **tables}


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        (  # kg m2
            {"manoeuvring": {"J_z": 1.2e12}},
            r"J_z = 1.2e\+12 is .* times the ship's own m' = 0.294, must be at most 0.15 times: give it over 1/2 rho "
            r"L_pp\^4 T",
        ),
        ({"manoeuvring": {"J_z": 0.21}}, r"J_z = 0.21 is 0.715 times .* nor as a fraction of the ship's"),
        ({"manoeuvring": {"m_y": 2.4e8}}, r"m_y = 2.4e\+08 is .* neither in kg or kg m2"),
        ({"manoeuvring": {"m_y": 0.85}}, r"m_y = 0.85 is 2.9 times the ship's own m' = 0.294"),
        ({"rudder": {"x_R": -160.0}}, r"\[rudder\] x_R = -160.0 must be .*-0.6.*x_R / L, .*, not in metres"),
        ({"rudder": {"x_R": -0.0016}}, r"\[rudder\] x_R = -0.0016 must be .*-0.3"),
        ({"rudder": {"x_H": -148.5}}, r"x_H = -148.5 .*x_H / L, not in metres"),
        ({"rudder": {"l_R": -227.0}}, r"l_R = -227.0 .*l_R / L in the inflow formula, not in metres"),
        ({"propeller": {"x_P": -153.6}}, r"x_P = -153.6 .*x_P / L in the wake formula, not in metres"),
        (
            {"particulars": {"r_bg": [148.8, 0.0, 2.2]}},
            r"r_bg: x = 148.8 m is 0.47 L_pp, with \[manoeuvring\] at most 0.15 either way: give CG in metres",
        ),
    ],
)  # fmt: skip
def test_sizes_in_another_unit_are_refused(tables: dict[str, dict[str, Any]], message: str) -> None:
    with pytest.raises(ShipError, match=message):
        load_ship(variant(**tables))


def test_an_x_G_that_looks_like_a_fraction_is_warned_of(tmp_path: Path) -> None:
    """x_G' = 0.035 in the place of 11.2 m: it may be meant, so the ship loads, and its first step's log says so."""
    path = tmp_path / "small.toml"
    path.write_text('extends = "kvlcc2"\n[particulars]\nr_bg = [0.035, 0.0, 2.2]\n', encoding="utf-8")
    ship = load_ship(path)
    assert len(ship.suspicious) == 1
    assert "x = 0.035 m looks like x_G/L_pp" in ship.suspicious[0]
    assert "else give 11.2" in ship.suspicious[0]
    model = started(str(path), degrees_of_freedom=3, hydrodynamics=True)
    assert "looks like x_G/L_pp" in model.warning
    model.step(0.0, 0.1)
    assert model.warning == ""
    assert load_ship("kvlcc2").suspicious == ()
