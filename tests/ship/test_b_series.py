"""The four-quadrant series against the regression polynomials of the same series, another fit by other people."""

from __future__ import annotations

from math import atan2, degrees, pi

import numpy as np
import pytest

from shipcollision_fmu.ship.b_series import (
    FOURIER,
    PITCHES,
    ROTATION,
    compute_bollard_pull,
    compute_coefficient,
    find_pitch,
)

K_T = (
    (0.00880496, 0, 0, 0, 0), (-0.204554, 1, 0, 0, 0), (0.166351, 0, 1, 0, 0), (0.158114, 0, 2, 0, 0),
    (-0.147581, 2, 0, 1, 0), (-0.481497, 1, 1, 1, 0), (0.415437, 0, 2, 1, 0), (0.0144043, 0, 0, 0, 1),
    (-0.0530054, 2, 0, 0, 1), (0.0143481, 0, 1, 0, 1), (0.0606826, 1, 1, 0, 1), (-0.0125894, 0, 0, 1, 1),
    (0.0109689, 1, 0, 1, 1), (-0.133698, 0, 3, 0, 0), (0.00638407, 0, 6, 0, 0), (-0.00132718, 2, 6, 0, 0),
    (0.168496, 3, 0, 1, 0), (-0.0507214, 0, 0, 2, 0), (0.0854559, 2, 0, 2, 0), (-0.0504475, 3, 0, 2, 0),
    (0.010465, 1, 6, 2, 0), (-0.00648272, 2, 6, 2, 0), (-0.00841728, 0, 3, 0, 1), (0.0168424, 1, 3, 0, 1),
    (-0.00102296, 3, 3, 0, 1), (-0.0317791, 0, 3, 1, 1), (0.018604, 1, 0, 2, 1), (-0.00410798, 0, 2, 2, 1),
    (-0.000606848, 0, 0, 0, 2), (-0.0049819, 1, 0, 0, 2), (0.0025983, 2, 0, 0, 2), (-0.000560528, 3, 0, 0, 2),
    (-0.00163652, 1, 2, 0, 2), (-0.000328787, 1, 6, 0, 2), (0.000116502, 2, 6, 0, 2), (0.000690904, 0, 0, 1, 2),
    (0.00421749, 0, 3, 1, 2), (5.65229e-05, 3, 6, 1, 2), (-0.00146564, 0, 3, 2, 2),
)  # fmt: skip
"""Terms (C, powers of J, P/D, A_E/A_0, Z) of K_T. Oosterveld and van Oossanen (1975), Further computer-analyzed data of
the Wageningen B-screw series, Int. Shipbuilding Progress 22; as in Bernitsas, Ray and Kinley (1981), University of
Michigan report 237."""


def polynomial(J: float, pitch: float) -> float:
    return float(sum(C * J**s * pitch**t * 0.7**u * 4**v for C, s, t, u, v in K_T))


def measured(J: float, pitch: float) -> float:
    return pi / 8 * (J**2 + ROTATION**2) * compute_coefficient(pitch, degrees(atan2(J, ROTATION)))


@pytest.mark.parametrize(("pitch", "tolerance"), [(0.6, 0.012), (0.8, 0.012), (1.0, 0.012), (1.2, 0.03)])
def test_ahead_it_is_the_series_as_others_fitted_it(pitch: float, tolerance: float) -> None:
    """From the spot to nearly no thrust: a wrong digit in a large coefficient would show."""
    for J in np.linspace(0.0, 0.95 * pitch, 20):
        assert measured(float(J), pitch) == pytest.approx(polynomial(float(J), pitch), abs=tolerance)


def test_it_is_whole() -> None:
    assert PITCHES == (0.6, 0.8, 1.0, 1.2)
    assert all(len(part) == 31 for parts in FOURIER.values() for part in parts)


@pytest.mark.parametrize("pitch", [0.5, 0.6, 0.7, 0.85, 1.0, 1.1, 1.2, 1.4])
def test_signs_of_the_quadrants(pitch: float) -> None:
    """Astern in a flow from ahead it pulls astern all the way; ahead in a flow from astern, ahead."""
    assert all(compute_coefficient(pitch, beta) < 0.0 for beta in np.linspace(90.0, 180.0, 91))
    assert all(compute_coefficient(pitch, beta) > 0.0 for beta in np.linspace(-90.0, 0.0, 91))
    assert compute_coefficient(pitch, 180.0) == pytest.approx(compute_coefficient(pitch, -180.0), abs=1e-12)


@pytest.mark.parametrize("k_0", [0.27, 0.2931, 0.35, 0.45, 0.5])
def test_the_pitch_for_a_thrust_on_the_spot(k_0: float) -> None:
    assert compute_bollard_pull(find_pitch(k_0)) == pytest.approx(k_0, rel=1e-9)


def test_beyond_the_measured_pitches_the_nearest_is_taken() -> None:
    assert find_pitch(0.1) == pytest.approx(0.6)
    assert find_pitch(0.9) == pytest.approx(1.2)
