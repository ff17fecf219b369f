"""Wind forces after Blendermann (1994), against the formulas written out again, and their signs."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.manoeuvring.wind import WindForces
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.windage import compute_windage

Start = Callable[..., ShipManoeuvring]
SHIP = load_ship("kvlcc2")
W = compute_windage(SHIP)
wind = WindForces(W, SHIP.L_oa)


def at(V: float, gamma: float) -> tuple[float, float, float, float]:
    """X, Y, K, N in a wind of V [m/s] from gamma on the starboard bow."""
    return wind(V * cos(gamma), V * sin(gamma))


@pytest.mark.parametrize("degrees", [0.0, 30.0, 75.0, 90.0, 120.0, 179.0, 180.0])
def test_coefficients_of_the_tanker(degrees: float) -> None:
    """Loaded tanker: C_Dt 0.70, C_Dl 0.90 from ahead and 0.55 from astern, delta 0.40, kappa 3.1."""
    V, e = 20.0, radians(degrees)
    C_Dl = 0.90 if degrees <= 90 else 0.55
    share = C_Dl * W.A_Fw / W.A_Lw / 0.70
    c = 1 - 0.5 * 0.40 * (1 - share) * sin(2 * e) ** 2
    q = 0.5 * 1.225 * V**2
    C_X, C_Y = -C_Dl * cos(e) / c, 0.70 * sin(e) / c  # C_Y: away from the wind, here to port
    C_K = 3.1 * W.s_H / (W.A_Lw / SHIP.L_oa) * C_Y
    C_N = (W.s_L / SHIP.L_oa - 0.18 * (e - pi / 2)) * C_Y
    X, Y, K, N = at(V, e)
    assert pytest.approx(q * W.A_Fw * C_X, rel=1e-12, abs=1e-6) == X
    assert pytest.approx(-q * W.A_Lw * C_Y, rel=1e-12, abs=1e-6) == Y
    assert pytest.approx(-q * W.A_Lw * W.A_Lw / SHIP.L_oa * C_K, rel=1e-12, abs=1e-6) == K
    assert pytest.approx(-q * W.A_Lw * SHIP.L_oa * C_N, rel=1e-12, abs=1e-4) == N


def test_from_ahead_and_astern_there_is_no_side_force() -> None:
    for gamma in (0.0, pi):
        X, Y, K, N = at(15.0, gamma)
        assert X * cos(gamma) < 0.0
        assert pytest.approx((0.0, 0.0, 0.0), abs=1e-5 * abs(X)) == (Y, K, N)


def test_signs_with_the_wind_from_starboard() -> None:
    X, Y, K, N = at(15.0, radians(60.0))
    assert X < 0.0  # braked
    assert Y < 0.0  # pushed to port
    assert K < 0.0  # heeled to port, away from the wind
    assert N < 0.0  # the bow pushed to port
    assert at(15.0, radians(150.0))[3] > 0.0  # from the quarter: the stern pushed to port


@given(st.floats(-30.0, 30.0), st.floats(-30.0, 30.0))
def test_mirror_symmetry(u: float, v: float) -> None:
    X, Y, K, N = wind(u, v)
    assert wind(u, -v) == (X, -Y, -K, -N)


@pytest.mark.parametrize("gamma", [-pi, -pi / 2, 0.0, pi / 2, pi])
def test_no_jump_in_any_direction(gamma: float) -> None:
    scale = [1e5, 1e6, 1e7, 1e8]
    np.testing.assert_allclose(
        np.array(at(20.0, gamma + 1e-9)) / scale, np.array(at(20.0, gamma - 1e-9)) / scale, atol=1e-6
    )


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_wind_from_the_west_drives_east(start: Start, degrees_of_freedom: int) -> None:
    """A ship that heads north, at rest: the wind comes from 270 deg, from abeam to port."""
    keys = {"hydrodynamics": True, "degrees_of_freedom": degrees_of_freedom}
    ship = start(**keys, wind=[20.0, radians(270.0)], substep=0.5)
    X, Y, K, N = wind(0.0, -20.0)
    o = ship.outputs
    expected = [X, Y, 0.0, K if degrees_of_freedom > 3 else 0.0, 0.0, N]
    np.testing.assert_allclose(o.wind, expected, rtol=1e-9, atol=1e-6)
    assert o.wind[1] > 0.0
    for k in range(120):
        ship.step(5.0 * k, 5.0)
    assert ship.outputs.position[1] > 50.0
    if degrees_of_freedom > 3:
        assert ship.outputs.attitude[0] > 0.0  # heeled to starboard, to leeward


def test_what_the_ship_feels_is_the_apparent_wind(start: Start) -> None:
    keys = {"hydrodynamics": True, "degrees_of_freedom": 3}
    ahead = start(**keys, attitude=[0.0, 0.0, 1.0], velocity=[8.0, 0.0, 0.0], wind=[10.0, 1.0])
    np.testing.assert_allclose(ahead.outputs.wind[0], wind(18.0, 0.0)[0], rtol=1e-12)
    with_the_wind = start(**keys, attitude=[0.0, 0.0, 1.0], velocity=[8.0, 0.0, 0.0], wind=[8.0, 1.0 + pi])
    np.testing.assert_allclose(with_the_wind.outputs.wind, 0.0, atol=1e-9)


@pytest.mark.parametrize("hydrodynamics", [True, False])
def test_calm_and_coasting_know_no_wind(start: Start, hydrodynamics: bool) -> None:
    ship = start(
        hydrodynamics=hydrodynamics, degrees_of_freedom=3, velocity=[8.0, 0.0, 0.0],
        wind=[0.0, 1.0] if hydrodynamics else [30.0, 1.0],
    )  # fmt: skip
    assert ship.outputs.wind == [0.0] * 6
    ship.step(0.0, 1.0)
    assert ship.outputs.wind == [0.0] * 6
    assert ship.outputs.velocity[1] == 0.0
