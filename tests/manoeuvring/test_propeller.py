"""Propeller: the paper's thrust ahead, continuous in all four quadrants."""

from __future__ import annotations

from math import exp, radians, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.propeller import Propeller, drift
from shipcollision_fmu.ship.library import load_ship

SHIP = load_ship("kvlcc2")
assert SHIP.propeller is not None
PROPELLER = Propeller(SHIP, SHIP.propeller)
RHO, D_P = 1025.0, 9.86


@pytest.mark.parametrize(("u_P", "n"), [(0.0, 1.0), (5.0, 1.2), (2.0, 0.5)])
def test_thrust_of_the_paper(u_P: float, n: float) -> None:
    J = u_P / (n * D_P)
    K_T = 0.2931 - 0.2753 * J - 0.1385 * J**2
    assert PROPELLER.thrust(u_P, n) == pytest.approx(RHO * n**2 * D_P**4 * K_T, rel=1e-13)


@given(st.floats(-10.0, 10.0), st.floats(-2.0, 2.0))
def test_thrust_is_odd_and_opposes_the_motion_when_stopped(u_P: float, n: float) -> None:
    assert PROPELLER.thrust(-u_P, -n) == -PROPELLER.thrust(u_P, n)
    assert PROPELLER.thrust(u_P, 0.0) * u_P <= 0.0


@given(st.floats(-10.0, 10.0), st.floats(-2.0, 1.9))
def test_more_revolutions_give_more_thrust_in_slow_water(u_P: float, n: float) -> None:
    """Where the paper's curve rises with n: at |J| not above 1."""
    if abs(u_P) <= abs(n) * D_P and abs(u_P) <= abs(n + 0.1) * D_P and n * (n + 0.1) > 0.0:
        assert PROPELLER.thrust(u_P, n + 0.1) > PROPELLER.thrust(u_P, n)


@pytest.mark.parametrize(("u", "v", "r"), [(6.0, -1.0, 0.01), (6.0, 1.0, -0.01), (6.0, 0.0, 0.0)])
def test_wake_of_the_paper(u: float, v: float, r: float) -> None:
    U = np.hypot(u, v)
    beta_P = np.arctan2(-v, u) + 0.48 * r * 320.0 / U
    C_2 = 1.6 if beta_P > 0 else 1.1
    through = 0.65 * (1 + (1 - exp(-2.0 * abs(beta_P))) * (C_2 - 1))
    assert PROPELLER.inflow(u, *drift(u, v), r) == pytest.approx(u * through, rel=1e-13)


@given(st.floats(-12.0, 12.0), st.floats(-12.0, 12.0), st.floats(-0.1, 0.1))
def test_inflow_goes_with_the_ship(u: float, v: float, r: float) -> None:
    """Between the undisturbed wake and its widest, in any motion."""
    low, high = sorted((0.65 * u, 0.65 * 1.6 * u))
    assert low - 1e-12 <= PROPELLER.inflow(u, *drift(u, v), r) <= high + 1e-12


def test_at_rest() -> None:
    assert PROPELLER.inflow(0.0, *drift(0.0, 0.0), 0.0) == 0.0
    assert PROPELLER.inflow(0.0, *drift(0.0, 0.0), 0.1) == 0.0
    assert PROPELLER.inflow(0.0, *drift(0.0, 3.0), 0.1) == 0.0


def test_no_jump_when_the_ship_passes_through_standstill() -> None:
    v = 5.0 * tan(radians(80.0))
    assert PROPELLER.inflow(1e-9, *drift(1e-9, v), 0.01) == pytest.approx(
        PROPELLER.inflow(-1e-9, *drift(-1e-9, v), 0.01), abs=1e-8
    )


def test_astern_factor_scales_what_turns_astern() -> None:
    """Ahead nothing changes; a stopped propeller drags as before; at n < 0 the terms with n are scaled."""
    assert SHIP.propeller is not None
    weaker = Propeller(SHIP, SHIP.propeller.model_copy(update={"astern_factor": 0.5}))
    for u_P, n in ((5.0, 1.2), (-2.0, 0.8), (5.0, 0.0), (0.0, 0.0)):
        assert weaker.thrust(u_P, n) == PROPELLER.thrust(u_P, n)
    assert weaker.thrust(0.0, -1.0) == 0.5 * PROPELLER.thrust(0.0, -1.0)
    drag = PROPELLER.thrust(4.0, 0.0)
    assert weaker.thrust(4.0, -1.0) - drag == pytest.approx(0.5 * (PROPELLER.thrust(4.0, -1.0) - drag))
    assert weaker.thrust(4.0, -1e-12) == pytest.approx(drag, rel=1e-9)
