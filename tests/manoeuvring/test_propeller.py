"""Propeller: the paper's thrust ahead, a measured series' in the other quadrants, no jump between them."""

from __future__ import annotations

from math import exp, radians, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.manoeuvring.propeller import Propeller, speed_and_drift_angle
from shipcollision_fmu.ship.loading.library import load_ship

SHIP = load_ship("kvlcc2")
assert SHIP.propeller is not None
PROPELLER = Propeller(SHIP, SHIP.propeller)
RHO, D_P = 1025.0, 9.86


@pytest.mark.parametrize(("u_P", "n"), [(0.0, 1.0), (5.0, 1.2), (2.0, 0.5)])
def test_thrust_of_the_paper(u_P: float, n: float) -> None:
    J = u_P / (n * D_P)
    K_T = 0.2931 - 0.2753 * J - 0.1385 * J**2
    assert PROPELLER.compute_thrust(u_P, n) == pytest.approx(RHO * n**2 * D_P**4 * K_T, rel=1e-13)


@given(st.floats(-10.0, 10.0))
def test_a_stopped_propeller_drags(u_P: float) -> None:
    assert PROPELLER.compute_thrust(u_P, 0.0) * u_P <= 0.0


@given(st.floats(0.0, 10.0), st.floats(0.0, 2.0))
def test_turning_against_the_flow_it_pulls_against_it(speed: float, n: float) -> None:
    assert PROPELLER.compute_thrust(speed, -n) <= 0.0
    assert PROPELLER.compute_thrust(-speed, n) >= 0.0


@pytest.mark.parametrize("name", ["kvlcc2", "kcs", "guan2014_own_manoeuvring"])
def test_thrust_has_no_jump(name: str) -> None:
    """All round, a tenth of a degree at a time: where a curve ends and another begins as well."""
    ship = load_ship(name)
    assert ship.propeller is not None
    propeller = Propeller(ship, ship.propeller)
    around = np.radians(np.linspace(-180.0, 180.0, 3601))
    thrust = [
        propeller.compute_thrust(5.0 * np.sin(a), 5.0 * np.cos(a) / propeller.D_P) / propeller.unit for a in around
    ]
    assert thrust[0] == pytest.approx(thrust[-1], rel=1e-12)
    assert np.abs(np.diff(thrust)).max() < 0.02 * np.abs(thrust).max()


def test_on_the_spot_it_pulls_astern_three_quarters_of_what_it_pulls_ahead() -> None:
    """B4-70: 0.69 at P/D 0.6, 0.74 at 0.8, as measured."""
    assert 0.69 < -PROPELLER.compute_thrust(0.0, -1.0) / PROPELLER.compute_thrust(0.0, 1.0) < 0.74


@pytest.mark.parametrize(("J", "least", "most"), [(0.25, 0.44, 0.6), (0.5, 0.44, 0.6), (1.0, 0.75, 0.95)])
def test_astern_it_stalls_while_the_ship_runs_ahead(J: float, least: float, most: float) -> None:
    """Of the thrust of the mirrored curve, k_0 - k_1 J - k_2 J^2: B4-70 at P/D 0.8 has 0.54, 0.51, 0.87 of its own."""
    mirrored = -PROPELLER.unit * D_P**2 * (0.2931 + 0.2753 * J + 0.1385 * J**2)
    assert least < PROPELLER.compute_thrust(J * D_P, -1.0) / mirrored < most


def test_a_curve_that_never_comes_to_zero_is_refused() -> None:
    assert SHIP.propeller is not None
    with pytest.raises(
        ShipError, match=r"'KVLCC2': \[propeller\] k_0 = 0.2931, k_1 = 0.1, k_2 = 0.2 never come to zero"
    ):
        Propeller(SHIP, SHIP.propeller.model_copy(update={"k_1": 0.1, "k_2": 0.2}))


@given(st.floats(0.0, 10.0), st.floats(0.0, 1.9))
def test_more_revolutions_give_more_thrust(u_P: float, n: float) -> None:
    """Ahead, wherever the paper's curve counts."""
    if PROPELLER.compute_thrust(u_P, n) > 0.0:
        assert PROPELLER.compute_thrust(u_P, n + 0.1) > PROPELLER.compute_thrust(u_P, n)


@pytest.mark.parametrize(("u", "v", "r"), [(6.0, -1.0, 0.01), (6.0, 1.0, -0.01), (6.0, 0.0, 0.0)])
def test_wake_of_the_paper(u: float, v: float, r: float) -> None:
    U = np.hypot(u, v)
    beta_P = np.arctan2(-v, u) + 0.48 * r * 320.0 / U
    C_2 = 1.6 if beta_P > 0 else 1.1
    through = 0.65 * (1 + (1 - exp(-2.0 * abs(beta_P))) * (C_2 - 1))
    assert PROPELLER.compute_inflow(u, *speed_and_drift_angle(u, v), r) == pytest.approx(u * through, rel=1e-13)


@given(st.floats(-12.0, 12.0), st.floats(-12.0, 12.0), st.floats(-0.1, 0.1))
def test_inflow_goes_with_the_ship(u: float, v: float, r: float) -> None:
    """Between the undisturbed wake and its widest, in any motion."""
    low, high = sorted((0.65 * u, 0.65 * 1.6 * u))
    assert low - 1e-12 <= PROPELLER.compute_inflow(u, *speed_and_drift_angle(u, v), r) <= high + 1e-12


def test_at_rest() -> None:
    assert PROPELLER.compute_inflow(0.0, *speed_and_drift_angle(0.0, 0.0), 0.0) == 0.0
    assert PROPELLER.compute_inflow(0.0, *speed_and_drift_angle(0.0, 0.0), 0.1) == 0.0
    assert PROPELLER.compute_inflow(0.0, *speed_and_drift_angle(0.0, 3.0), 0.1) == 0.0


def test_no_jump_when_the_ship_passes_through_standstill() -> None:
    v = 5.0 * tan(radians(80.0))
    assert PROPELLER.compute_inflow(1e-9, *speed_and_drift_angle(1e-9, v), 0.01) == pytest.approx(
        PROPELLER.compute_inflow(-1e-9, *speed_and_drift_angle(-1e-9, v), 0.01), abs=1e-8
    )


def test_astern_factor_scales_what_turns_astern() -> None:
    """Ahead nothing changes; a stopped propeller drags as before; at n < 0 what turning adds is scaled."""
    assert SHIP.propeller is not None
    weaker = Propeller(SHIP, SHIP.propeller.model_copy(update={"astern_factor": 0.5}))
    for u_P, n in ((5.0, 1.2), (-2.0, 0.8), (5.0, 0.0), (0.0, 0.0)):
        assert weaker.compute_thrust(u_P, n) == PROPELLER.compute_thrust(u_P, n)
    assert weaker.compute_thrust(0.0, -1.0) == 0.5 * PROPELLER.compute_thrust(0.0, -1.0)
    drag = PROPELLER.compute_thrust(4.0, 0.0)
    assert weaker.compute_thrust(4.0, -1.0) - drag == pytest.approx(0.5 * (PROPELLER.compute_thrust(4.0, -1.0) - drag))
    assert weaker.compute_thrust(4.0, -1e-9) == pytest.approx(drag, rel=1e-6)
