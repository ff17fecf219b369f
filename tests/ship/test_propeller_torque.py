"""The propeller's torque against the regression polynomials of the Wageningen B-series."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.ship.propeller_torque import find_idle_advance, make_torque_law

from .test_b_series import polynomial

K_Q = (
    (0.00379368, 0, 0, 0, 0), (0.00886523, 2, 0, 0, 0), (-0.032241, 1, 1, 0, 0), (0.00344778, 0, 2, 0, 0),
    (-0.0408811, 0, 1, 1, 0), (-0.108009, 1, 1, 1, 0), (-0.0885381, 2, 1, 1, 0), (0.188561, 0, 2, 1, 0),
    (-0.00370871, 1, 0, 0, 1), (0.00513696, 0, 1, 0, 1), (0.0209449, 1, 1, 0, 1), (0.00474319, 2, 1, 0, 1),
    (-0.00723408, 2, 0, 1, 1), (0.00438388, 1, 1, 1, 1), (-0.0269403, 0, 2, 1, 1), (0.0558082, 3, 0, 1, 0),
    (0.0161886, 0, 3, 1, 0), (0.00318086, 1, 3, 1, 0), (0.015896, 0, 0, 2, 0), (0.0471729, 1, 0, 2, 0),
    (0.0196283, 3, 0, 2, 0), (-0.0502782, 0, 1, 2, 0), (-0.030055, 3, 1, 2, 0), (0.0417122, 2, 2, 2, 0),
    (-0.0397722, 0, 3, 2, 0), (-0.00350024, 0, 6, 2, 0), (-0.0106854, 3, 0, 0, 1), (0.00110903, 3, 3, 0, 1),
    (-0.000313912, 0, 6, 0, 1), (0.0035985, 3, 0, 1, 1), (-0.00142121, 0, 6, 1, 1), (-0.00383637, 1, 0, 2, 1),
    (0.0126803, 0, 2, 2, 1), (-0.00318278, 2, 3, 2, 1), (0.00334268, 0, 6, 2, 1), (-0.00183491, 1, 1, 0, 2),
    (0.000112451, 3, 2, 0, 2), (-2.97228e-05, 3, 6, 0, 2), (0.000269551, 1, 0, 1, 2), (0.00083265, 2, 0, 1, 2),
    (0.00155334, 0, 2, 1, 2), (0.000302683, 0, 6, 1, 2), (-0.0001843, 0, 0, 2, 2), (-0.000425399, 0, 3, 2, 2),
    (8.69243e-05, 3, 3, 2, 2), (-0.0004659, 0, 6, 2, 2), (5.54194e-05, 1, 6, 2, 2),
)  # fmt: skip
"""Terms (C, powers of J, P/D, A_E/A_0, Z) of K_Q. Oosterveld and van Oossanen (1975), Further computer-analyzed data of
the Wageningen B-screw series, Int. Shipbuilding Progress 22; as in Bernitsas, Ray and Kinley (1981), University of
Michigan report 237."""


def torque(J: float, pitch: float) -> float:
    return float(sum(C * J**s * pitch**t * 0.7**u * 4**v for C, s, t, u, v in K_Q))


def fit(pitch: float) -> tuple[float, float, float]:
    """k_0, k_1, k_2 of the series' thrust ahead."""
    J = np.linspace(0.0, 0.95 * pitch, 20)
    k_2, k_1, k_0 = np.polyfit(J, [polynomial(float(j), pitch) for j in J], 2)
    return float(k_0), float(k_1), float(k_2)


@pytest.mark.parametrize("pitch", [0.65, 0.8, 0.95, 1.1])
def test_ahead_it_is_the_torque_of_the_series(pitch: float) -> None:
    """From the spot to nearly no thrust, of the local torque."""
    k_0, k_1, k_2 = fit(pitch)
    law = make_torque_law(k_0, k_1, k_2)
    for J in np.linspace(0.0, 0.9 * find_idle_advance(k_0, k_1, k_2), 12):
        K_T = k_0 + k_1 * J + k_2 * J**2
        assert law.compute(float(K_T), float(J), 1.0) == pytest.approx(torque(float(J), pitch), rel=0.06)


def test_an_efficiency_is_never_above_that_of_the_series() -> None:
    """J K_T/(2 pi K_Q) of B4-70 at P/D 0.8 has its best, 0.64, near J = 0.66."""
    k = fit(0.8)
    law = make_torque_law(*k)
    best = max(
        float(J * (k[0] + k[1] * J + k[2] * J**2) / (2.0 * np.pi * law.compute(k[0] + k[1] * J + k[2] * J**2, J, 1.0)))
        for J in np.linspace(0.1, 0.85, 50)
    )
    assert best == pytest.approx(0.64, abs=0.02)


def test_astern_it_is_the_thrust_times_the_pitch() -> None:
    law = make_torque_law(0.35, -0.30, -0.16)
    assert law.compute(-2.0, 3.0, -1.0) == -2.0 * law.arm


def test_a_curve_that_never_comes_to_zero_has_no_advance() -> None:
    """It is refused when a ship sails with it."""
    assert find_idle_advance(0.3, 0.1, 0.2) == 0.0
    assert make_torque_law(0.3, 0.1, 0.2).b == 0.0
