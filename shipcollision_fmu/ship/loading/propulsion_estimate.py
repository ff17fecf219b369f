"""Service speed, resistance and propeller of a ship from its dimensions and type.

    U      = the service speed of the type, at most Fn = 0.6 (1.15 - C_b)
    R_0    = R/(1/2 rho L T U^2)                      R at the service speed: holtrop_mennen.py
    w_P0   = 0.5 C_b - 0.05 (Taylor)   t_P = 0.6 w_P0   D_p = min(0.7 T, 9.9 m)   K_T = 0.35 - 0.30 J - 0.16 J^2
    n_s:     (1 - t_P) thrust = R, a quadratic equation in n D_p;     P_s = 2 pi n_s Q (propeller_torque.py)

One coefficient stands for the resistance at all speeds: below the service speed a fast ship, whose waves are left
behind then, is braked too much. Ships do not plane: a fast boat is taken at the speed of a hull that displaces water.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi, sqrt

from ..hydrostatics import GRAVITY
from ..propeller_torque import make_torque_law
from ..ship_type import ShipType
from .holtrop_mennen import compute_resistance, estimate_form
from .motora_charts import Dimensions

__all__ = [
    "compute_resistance_coefficient",
    "compute_service_power",
    "estimate_propeller",
    "estimate_service_speed",
    "estimate_wake",
    "solve_self_propulsion",
]

FULLNESS = 1.15
"""Alexander's formula V/sqrt(L) = 2 (K - C_b) [kn, ft] has K = 1.08, which makes a Panamax bulk carrier of C_b 0.86
sail at 11.7 kn. Ships in service are faster: 14.5 kn needs 1.13, tugs and supply vessels need 1.15 to 1.19."""

K_T = (0.35, -0.30, -0.16)
"""k_0, k_1, k_2 of a propeller without data: about Wageningen B4-70 with P/D = 0.8."""

LARGEST_PROPELLER = 9.9
"""[m] Of ships in service; without it the propeller of a VLCC would be larger than any."""

HEAVIEST = 330e6
"""[kg] The heaviest ship that one such propeller is made for, a VLCC. A heavier one has the disc of several:
with a single one, a ship of a million tonnes takes 22 lengths to stop."""


def estimate_service_speed(d: Dimensions, of: ShipType) -> float:
    """[m/s]"""
    return min(of.speed, 0.6 * (FULLNESS - d.C_b) * sqrt(GRAVITY * d.L))


def estimate_wake(d: Dimensions) -> float:
    """w_P0, Taylor."""
    return 0.5 * d.C_b - 0.05


def estimate_propeller(d: Dimensions, of: ShipType) -> dict[str, float]:
    """The table [propeller] without service_rev_per_s."""
    w_P0 = estimate_wake(d)
    mass = d.rho * d.C_b * d.L * d.B * d.T
    largest = LARGEST_PROPELLER * max(1.0, sqrt(mass / HEAVIEST))
    return {
        "D_p": min(0.7 * d.T, largest), "t_P": 0.6 * w_P0, "w_P0": w_P0, "x_P": -0.48,
        "C_1": 2.0, "C_2_plus": 1.0 / (1.0 - w_P0), "C_2_minus": 1.0 / (1.0 - w_P0),
        "k_0": K_T[0], "k_1": K_T[1], "k_2": K_T[2], "service_speed": estimate_service_speed(d, of),
    }  # fmt: skip


def compute_resistance_coefficient(d: Dimensions, speed: float) -> float:
    """R_0 at a speed [m/s]."""
    return compute_resistance(estimate_form(d), speed, d.rho) / (0.5 * d.rho * d.L * d.T * speed**2)


def solve_self_propulsion(d: Dimensions, R_0: float, propeller: Mapping[str, float]) -> float:
    """Revolutions [1/s] at which (1 - t_P) thrust is the resistance at service speed."""
    U, D = propeller["service_speed"], propeller["D_p"]
    k_0, k_1, k_2 = propeller["k_0"], propeller["k_1"], propeller["k_2"]
    u_P = U * (1.0 - propeller["w_P0"])
    thrust = 0.5 * d.L * d.T * R_0 * U * U / ((1.0 - propeller["t_P"]) * D * D)  # thrust over rho D_p^2
    b, c = k_1 * u_P, k_2 * u_P * u_P - thrust
    return (-b + sqrt(max(0.0, b * b - 4.0 * k_0 * c))) / (2.0 * k_0) / D


def compute_service_power(d: Dimensions, propeller: Mapping[str, float]) -> float:
    """P_s [W] at the propeller at service speed and revolutions."""
    n, D = propeller["service_rev_per_s"], propeller["D_p"]
    k_0, k_1, k_2 = propeller["k_0"], propeller["k_1"], propeller["k_2"]
    u_P, x = propeller["service_speed"] * (1.0 - propeller["w_P0"]), n * D
    thrust = (k_0 * x + k_1 * u_P) * x + k_2 * u_P * u_P
    return 2.0 * pi * n * d.rho * D**3 * make_torque_law(k_0, k_1, k_2).compute(thrust, u_P, x)
