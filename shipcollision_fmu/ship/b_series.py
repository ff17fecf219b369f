"""Thrust of a propeller in all four quadrants: Wageningen B4-70, four blades, area ratio 0.70, measured in open water.

    beta = atan2(u_P, 0.7 pi n D)      angle of the flow at 0.7 of the radius
             0 pulling on the spot; to 90 deg ahead, 90 stopped; to 180 turning astern while the ship runs ahead;
             180 turning astern on the spot; -180 to -90 both astern; -90 to 0 turning ahead while the ship runs astern
    T    = C_T*(beta) rho/2 (u_P^2 + (0.7 pi n D)^2) pi/4 D^2,   C_T* = sum_k A_k cos(k beta) + B_k sin(k beta)

Coefficients: Roddy, Hess and Faller (2006), Neural network predictions of the 4-quadrant Wageningen propeller series,
NSWCCD-50-TR-2006/004 (a public report of the US Navy), after van Lammeren, van Manen and Oosterveld (1969), The
Wageningen B-screw series, Trans. SNAME 77. Read in one public transcription; where the propeller pulls ahead they give
the K_T of the series' regression polynomials, which others transcribed, within 0.012 (P/D 0.6 to 1.0) and 0.03 (1.2).
"""

from __future__ import annotations

from bisect import bisect_left
from functools import reduce
from math import cos, pi, radians, sin
from operator import add  # sum() rounds otherwise from Python 3.12 on

__all__ = ["FOURIER", "PITCHES", "ROTATION", "compute_bollard_pull", "compute_coefficient", "find_pitch"]

ROTATION = 0.7 * pi
"""Speed of a blade at 0.7 of the radius over n D."""

FOURIER: dict[float, tuple[tuple[float, ...], tuple[float, ...]]] = {
    0.6: ((
        3.8804, 8.3653, -0.85859, 2.3607, -1.0596, -4.1596, 0.46247, 3.333, -0.37098, -1.9768, -0.11972, 1.757,
        0.027679, -0.43212, 0.028939, 0.78009, -0.0080617, 0.19424, 0.12056, 0.35168, -0.067099, 0.12167, 0.16065,
        0.18555, -0.052739, -0.038986, -0.085151, 0.020961, -0.051549, -0.083052, -0.038942,
    ), (
        0.0, -79.381, -1.3907, 11.251, -0.78851, 4.2391, 0.94902, -0.43077, -0.90581, 1.6585, 0.86297, -0.079001,
        -0.60216, 0.80185, 0.34344, -0.16327, -0.003006, 0.44053, 0.054953, -0.40025, -0.176, 0.13029, -0.0014661,
        -0.30406, -0.17165, -0.031444, 0.022516, -0.10705, -0.095616, -0.071008, 0.05025,
    )),
    0.8: ((
        2.8757, 13.007, 0.62869, 2.8104, -1.6832, -4.4894, 0.37703, 3.1647, -0.13492, -1.9905, 0.17576, 1.975,
        -0.11063, -0.069828, 0.25665, 0.80681, -0.18781, 0.29821, 0.48643, 0.33893, -0.26851, 0.096098, 0.2145,
        0.06644, -0.1321, 0.016378, 0.012367, -0.16113, -0.10536, -0.041139, -0.0089569,
    ), (
        0.0, -77.762, -1.3032, 10.58, -1.0413, 4.5769, 1.4296, -0.39612, -0.9917, 2.0759, 0.90153, -0.029877,
        -0.56354, 0.94773, 0.23681, -0.53204, -0.071537, 0.52768, 0.0174, -0.68105, -0.204, 0.14086, -0.057914,
        -0.44898, -0.11454, -0.012005, -0.11932, -0.24427, 0.049882, 0.063587, -0.073611,
    )),
    1.0: ((
        2.6617, 17.802, 1.3828, 2.7871, -1.624, -5.3084, 0.1918, 3.8318, -0.22892, -1.8656, 0.349, 2.2321, -0.35976,
        0.13606, 0.47192, 0.87235, -0.35748, 0.35955, 0.52896, 0.21045, -0.27057, 0.10509, 0.27733, -0.11596,
        -0.1745, 0.040782, 0.099247, -0.3465, -0.12357, 0.063929, 0.061933,
    ), (
        0.0, -74.797, -1.3632, 10.246, -1.0865, 4.7346, 1.1355, -0.9318, -0.72471, 2.3747, 0.86208, 0.0070224,
        -0.36422, 0.91758, 0.089383, -0.59364, -0.070954, 0.48825, -0.090587, -0.81163, -0.056659, 0.12011, -0.13042,
        -0.48187, 0.045412, -0.019469, -0.21858, -0.16314, 0.14865, 0.10185, -0.16735,
    )),
    1.2: ((
        2.4003, 22.762, 1.7143, 2.1316, -1.4846, -5.912, 0.025876, 4.2514, -0.28765, -1.8761, 0.50888, 2.3192,
        -0.40999, 0.63295, 0.6453, 0.55885, -0.30962, 0.47413, 0.40053, 0.099838, -0.18166, 0.040827, 0.038262,
        -0.41911, -0.083219, 0.070326, -0.10107, -0.54178, -0.027507, 0.042468, -0.13783,
    ), (
        0.0, -71.042, -1.2393, 9.2564, -1.3138, 4.926, 0.78601, -1.0738, -0.37068, 2.803, 0.48259, -0.053271,
        -0.39799, 0.95456, 0.00062669, -0.99188, 0.031957, 0.42703, -0.32774, -1.0834, 0.01807, 0.038407, -0.31692,
        -0.39395, 0.066227, -0.029338, -0.22194, 0.0080383, 0.15926, 0.15056, -0.045321,
    )),
}  # fmt: skip
"""A_k and B_k for k = 0 to 30, in hundredths, by P/D."""

PITCHES = tuple(FOURIER)


def compute_coefficient(pitch: float, beta_deg: float) -> float:
    """C_T* at an angle [deg], linear in P/D between the measured pitches; beyond them that of the nearest."""
    pitch = min(PITCHES[-1], max(PITCHES[0], pitch))
    k = max(1, bisect_left(PITCHES, pitch))
    low, high = PITCHES[k - 1], PITCHES[k]
    share = (pitch - low) / (high - low)
    return (1.0 - share) * _measured(low, beta_deg) + share * _measured(high, beta_deg)


def compute_bollard_pull(pitch: float) -> float:
    """K_T on the spot, turning ahead."""
    return pi / 8.0 * ROTATION**2 * compute_coefficient(pitch, 0.0)


def find_pitch(k_0: float) -> float:
    """P/D of the propeller of the series that pulls K_T = k_0 on the spot, within the measured pitches."""
    low, high = PITCHES[0], PITCHES[-1]
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if compute_bollard_pull(middle) < k_0 else (low, middle)
    return 0.5 * (low + high)


def _measured(pitch: float, beta_deg: float) -> float:
    beta = radians(beta_deg)
    A, B = FOURIER[pitch]
    return 0.01 * reduce(
        add, (a * cos(k * beta) + b * sin(k * beta) for k, (a, b) in enumerate(zip(A, B, strict=True)))
    )
