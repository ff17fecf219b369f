"""An MMG set for any ship from L, B, T and C_b: `[manoeuvring] estimate = true`.

Hull derivatives by the regressions of Yoshimura & Masumoto (2012), MARSIM, with k = 2 T/L and c = C_b B/L:

    X_vv   = 1.15 c - 0.18                        X_vr = -(-1.91 c + 0.08 + m_y')
    X_rr   = -0.085 c + 0.008 - x_G' m_y'         X_vvvv = -6.68 c + 1.1
    Y_v    = -(pi k/2 + 1.4 c)                    Y_r   = m_x' + 0.5 c
    Y_vvv  = -(0.185 L/B + 0.48)                  Y_vvr = -0.75
    Y_vrr  = -(0.26 (1 - C_b) L/B + 0.11)         Y_rrr = -0.051
    N_v    = -k                                   N_r   = -0.54 k + k^2
    N_vvv  = -(-0.69 C_b + 0.66)                  N_vvr = 1.55 c - 0.76
    N_vrr  = -(0.075 (1 - C_b) L/B - 0.098)       N_rrr = 0.25 c - 0.056

The original is written in the drift angle beta = -v', so every term odd in v has the opposite sign there. With the
original signs a container ship turns within an implausibly small circle.

Full hulls are not behind these regressions. With Y_vvr = -0.75 a VLCC from four numbers drifts 32 deg in a turn, where
KVLCC2 was measured at 20. For C_b >= 0.80, Y_vvr is that of Kijima et al. (1990), J. Soc. Nav. Archit. Japan 168,
5.95 (1 - C_b) T/B (known from memory, not read): 0.41 for KVLCC2, measured 0.379. It is interpolated from C_b = 0.65
on; KCS, with 0.651, was measured at -0.48.

The added masses are the ship's own (added_mass_estimate.py); resistance and propeller are those of
propulsion_estimate.py, the rudder that of rudder_estimate.py, the engine that of engine_estimate.py.

The regressions rest on hulls with L/B 2.6 to 7.1, T/B 0.25 to 0.46 and C_b 0.51 to 0.65 (grade B). Outside (grade C)
the linear part still holds, the rest is extrapolated. C_b below 0.40 is refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import Any

from ...errors import ShipError
from ..ship_type import CARGO_VESSEL, ShipType
from .engine_estimate import estimate_engine
from .motora_charts import Dimensions
from .propulsion_estimate import (
    compute_resistance_coefficient,
    compute_service_power,
    estimate_propeller,
    estimate_wake,
    solve_self_propulsion,
)
from .rudder_estimate import estimate_rudder

__all__ = ["Dimensions", "complete_tables", "estimate_hull_derivatives"]

REACH = (0.40, 0.90)
"""C_b of displacement ships; finer and fuller hulls are refused, because the regressions have none of them."""

BAND = {"L/B": (2.6, 7.1), "T/B": (0.25, 0.46), "C_b": (0.51, 0.65)}
"""The hulls behind the regressions, as their authors state it."""


FULL = (0.65, 0.80)
"""C_b at which Y_vvr begins to leave the fine ships' value, and where it is the full ships'."""


def estimate_hull_derivatives(d: Dimensions, m_x: float, m_y: float) -> dict[str, float]:
    """The table [manoeuvring] but for R_0 and the added masses; m_x, m_y over 1/2 rho L^2 T."""
    k, c, LB, fine = 2.0 * d.T / d.L, d.C_b * d.B / d.L, d.L / d.B, 1.0 - d.C_b
    return {
        "X_vv": 1.15 * c - 0.18,
        "X_vr": -(-1.91 * c + 0.08 + m_y),
        "X_rr": -0.085 * c + 0.008 - d.x_G / d.L * m_y,
        "X_vvvv": -6.68 * c + 1.1,
        "Y_v": -(0.5 * pi * k + 1.4 * c),
        "Y_r": m_x + 0.5 * c,
        "Y_vvv": -(0.185 * LB + 0.48),
        "Y_vvr": _estimate_Y_vvr(d),
        "Y_vrr": -(0.26 * fine * LB + 0.11),
        "Y_rrr": -0.051,
        "N_v": -k,
        "N_r": -0.54 * k + k * k,
        "N_vvv": -(-0.69 * d.C_b + 0.66),
        "N_vvr": 1.55 * c - 0.76,
        "N_vrr": -(0.075 * fine * LB - 0.098),
        "N_rrr": 0.25 * c - 0.056,
    }


def _estimate_Y_vvr(d: Dimensions) -> float:
    """Y_vvr: that of the fine ships up to C_b = 0.65, Kijima's from 0.80 on, linear between."""
    full = min(max((d.C_b - FULL[0]) / (FULL[1] - FULL[0]), 0.0), 1.0)
    return -0.75 + full * (5.95 * d.T / d.B * (1.0 - d.C_b) + 0.75)


def complete_tables(
    d: Dimensions,
    given: Mapping[str, Mapping[str, Any]],
    own_masses: tuple[float, float],
    of: ShipType = CARGO_VESSEL,
) -> tuple[dict[str, dict[str, Any]], list[str]]:
    """The tables manoeuvring, propeller, rudder and engine, with missing values estimated; and a note on each estimate.

    own_masses: m_x, m_y over 1/2 rho L^2 T of the ship; those of a given [manoeuvring] take their place.
    Raises ShipError when C_b is out of the regressions' reach.
    """
    if not REACH[0] <= d.C_b <= REACH[1]:
        raise ShipError(
            f"[manoeuvring] estimate = true with C_b = mass / (rho L_pp B T) = {d.C_b:.3f}: must be {REACH[0]:.2f} to "
            f"{REACH[1]:.2f}; give a mass that fits the draught, or the MMG set, or remove the table: the ship coasts"
        )
    made = _Tables(given)
    made.notes.append(f"[manoeuvring] Yoshimura & Masumoto (2012), {_name_grade(d)}")
    propeller = _estimate_propeller(d, made, of)
    _estimate_hull(d, made, own_masses, propeller["service_speed"])
    if "service_rev_per_s" not in propeller:
        propeller["service_rev_per_s"] = solve_self_propulsion(d, made.tables["manoeuvring"]["R_0"], propeller)
        made.notes.append(f"[propeller] service_rev_per_s = {propeller['service_rev_per_s']:.4g} (self-propulsion)")
    _estimate_rudder(d, made, of)
    engine, how = estimate_engine(of, d.L, compute_service_power(d, propeller), propeller["service_rev_per_s"])
    made.lay_under("engine", engine, how)
    return made.tables, made.notes


class _Tables:
    """Tables during their completion, and a note on each estimate."""

    def __init__(self, given: Mapping[str, Mapping[str, Any]]) -> None:
        self.given = given
        self.tables: dict[str, dict[str, Any]] = {}
        self.notes: list[str] = []

    def lay_under(self, name: str, values: Mapping[str, float], how: str = "") -> dict[str, Any]:
        """The table with `values` where nothing is given."""
        own = dict(self.given.get(name, {}))
        new = [key for key in values if key not in own]
        self.tables[name] = {**values, **own}
        if new and how:
            self.notes.append(f"[{name}] {', '.join(f'{key} = {values[key]:.4g}' for key in new)} ({how})")
        return self.tables[name]


def _estimate_propeller(d: Dimensions, made: _Tables, of: ShipType) -> dict[str, Any]:
    how = f"Taylor's wake, which vanishes in large drift; generic K_T; speed of a {of.name}"
    return made.lay_under("propeller", estimate_propeller(d, of), how)


def _estimate_hull(d: Dimensions, made: _Tables, masses: tuple[float, float], speed: float) -> None:
    """The table manoeuvring; masses: m_x, m_y of the ship, unless the table gives its own."""
    own = made.given.get("manoeuvring", {})
    if own.get("m_x") is not None:
        masses = own["m_x"], own["m_y"]
    values = estimate_hull_derivatives(d, *masses)
    values["R_0"] = compute_resistance_coefficient(d, speed)
    if "R_0" not in own:
        made.notes.append(f"[manoeuvring] R_0 = {values['R_0']:.4g} (Holtrop and Mennen at service speed)")
    made.lay_under("manoeuvring", values).pop("estimate", None)


def _estimate_rudder(d: Dimensions, made: _Tables, of: ShipType) -> None:
    own = made.given.get("rudder", {})
    values = estimate_rudder(d, of.name, estimate_wake(d), own.get("A_R"), own.get("H_R"))
    made.lay_under("rudder", values, f"area of a {of.name}, aspect ratio 1.8; Yoshimura & Masumoto (2012)")


def _name_grade(d: Dimensions) -> str:
    """'grade B', or 'grade C: ...' with what lies outside the regressions' band."""
    outside = []
    for name, value in (("L/B", d.L / d.B), ("T/B", d.T / d.B), ("C_b", d.C_b)):
        low, high = BAND[name]
        if not low <= value <= high:
            outside.append(f"{name} = {value:.2f} outside {low} to {high}")
    return f"grade C: {', '.join(outside)}" if outside else "grade B"
