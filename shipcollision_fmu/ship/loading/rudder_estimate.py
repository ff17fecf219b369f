"""The rudder of a ship without data: its area by the type of ship, and its interaction with hull and propeller.

    A_R = L T max( (1 + 25 (B/L)^2)/100, share of the type )      span = min( sqrt(1.8 A_R), 0.9 T ) [m]
    f_alpha = 6.13 Lam/(Lam + 2.25),   Lam = span^2/A_R            Fujii
    t_R = 0.39   a_H = 3.6 c   x_H = -0.40   l_R = -0.9   gamma_R = 2.06 c + 0.14          Yoshimura & Masumoto (2012)
    epsilon = 2.26 - 1.82 (1 - w_P0)   kappa = 0.55/epsilon        c = C_b B/L

The first area is the least that Det Norske Veritas asks for behind a propeller. Built rudders are larger where a ship
must steer well: the shares are the middles of the usual ranges that handbooks list, over L T: tankers 1.3 to 1.9 %,
single-screw ships 1.6 to 1.9 %, large fast passenger ships 1.8 to 2.0 %, coasters 2.3 to 3.3 %, ships with increased
manoeuvrability 2 to 4 %, pilot vessels and ferries 2.5 to 4 %, fishing vessels 2.5 to 5.5 %, motor boats 4 to 5 %, tugs
3 to 6 %. The list is known from memory of such handbooks, not read. Rudders of ships that were built and tested: KVLCC2
1.69 % (DNV asks for 1.82), Esso Osaka 1.70 (1.66), KCS 1.82 (1.49), Seiun Maru 2.1 (1.7), S-175 2.2 % (1.5).

Two rudders or azimuth thrusters are one rudder of the whole area here.
"""

from __future__ import annotations

from math import sqrt

from .motora_charts import Dimensions

__all__ = ["AREA", "estimate_rudder"]

AREA = {
    "tanker, loaded": 0.016, "tanker, in ballast": 0.016, "bulk carrier": 0.016, "liquefied natural gas tanker": 0.016,
    "cargo vessel, loaded": 0.0175, "cargo vessel, container on deck": 0.0175, "container ship, loaded": 0.0175,
    "car carrier": 0.0175, "passenger liner": 0.019, "ferry": 0.019, "destroyer": 0.021, "drilling vessel": 0.03,
    "diving support vessel": 0.03, "offshore supply vessel": 0.03, "research vessel": 0.03, "fishing vessel": 0.04,
    "tender": 0.0325, "speed boat": 0.045, "tug": 0.045,
}  # fmt: skip
"""Area over L T by type. A third more makes the tactical diameter of a container ship a sixth smaller."""

COASTER, COASTER_AREA = 80.0, 0.028
"""Merchant ships of less than this length [m] have the larger share of coasters."""

SMALL_CRAFT = 0.022
"""Shares above are those of working craft and boats. Ships of their shape of more than twice the length of a coaster
have this one: with 4 % of L T, a trawler of 400 m would spin on the spot."""

ASPECT, SPAN = 1.8, 0.9
"""Aspect ratio, and the most of the draught that the span takes: more leaves no clearance to keel and water surface."""

RATE, RATE_LENGTH = 65.0 / 28.0, 60.0
"""Rudder rate [deg/s] of SOLAS II-1, regulation 29: 65 deg in 28 s. Ships below 60 m are quicker by Froude's law, 5.7
deg/s at 10 m: with SOLAS' rate a boat sails six lengths before its rudder is over."""


def estimate_rudder(
    d: Dimensions, ship_type: str, w_P0: float, A_R: float | None = None, H_R: float | None = None
) -> dict[str, float]:
    """The table [rudder]; A_R [m2], H_R [m] where the file gives them."""
    share = AREA.get(ship_type, AREA["cargo vessel, loaded"])
    if share < SMALL_CRAFT:
        share = COASTER_AREA if d.L < COASTER else share
    else:
        share += (SMALL_CRAFT - share) * min(max((d.L - COASTER) / COASTER, 0.0), 1.0)
    area = d.L * d.T * max(0.01 * (1.0 + 25.0 * (d.B / d.L) ** 2), share) if A_R is None else A_R
    span = min(sqrt(ASPECT * area), SPAN * d.T) if H_R is None else H_R
    aspect = span * span / area
    c, epsilon = d.C_b * d.B / d.L, 2.26 - 1.82 * (1.0 - w_P0)
    gamma = 2.06 * c + 0.14
    return {
        "A_R": area, "H_R": span, "f_alpha": 6.13 * aspect / (aspect + 2.25), "t_R": 0.39, "a_H": 3.6 * c,
        "x_H": -0.40, "x_R": -0.5, "l_R": -0.9, "gamma_R_minus": gamma, "gamma_R_plus": gamma,
        "epsilon": epsilon, "kappa": 0.55 / epsilon, "rate_deg_per_s": RATE * max(1.0, sqrt(RATE_LENGTH / d.L)),
    }  # fmt: skip
