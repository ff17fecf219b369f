"""Areas of a ship above the water, their centroid, and the wind coefficients of Blendermann (1994).

Coefficients by type of ship (C_Dt across, C_Dl along with the wind from ahead and from astern, cross-force parameter
delta, rolling moment factor kappa): Blendermann (1994), J. Wind Eng. Ind. Aerodyn. 51:339-351, as tabulated in Fossen
(2021), section 10.1, and in his Marine Systems Simulator.

Areas that a file leaves out are those of a box of the hull above the water, with a deckhouse of the height h = 0.07
L_pp, 0.6 B broad and 0.12 L_pp long; on a ship with containers, these stand 0.4 B high over the breadth and 0.6 L_pp:

    A_Fw = B f + 0.6 B h            A_Lw = L_oa f + 0.12 L_pp h            f = depth - T
         = B (f + 0.4 B)                 = L_oa f + 0.12 L_pp h + 0.6 L_pp 0.4 B         with containers
    s_H  = A_Lw/(2 L_oa)            s_L = 0, with the deckhouse aft: -0.35 L_pp times its share of A_Lw

These are estimates of this project, within some 25 % for merchant ships; a ship file can give the areas.
"""

from __future__ import annotations

from dataclasses import dataclass

from .ship import Ship
from .ship_type import find_ship_type

__all__ = ["BLENDERMANN", "Windage", "compute_windage"]

BLENDERMANN: dict[str, tuple[float, float, float, float, float]] = {
    "car carrier": (0.95, 0.55, 0.60, 0.80, 1.2),
    "cargo vessel, loaded": (0.85, 0.65, 0.55, 0.40, 1.7),
    "cargo vessel, container on deck": (0.85, 0.55, 0.50, 0.40, 1.4),
    "container ship, loaded": (0.90, 0.55, 0.55, 0.40, 1.4),
    "destroyer": (0.85, 0.60, 0.65, 0.65, 1.1),
    "diving support vessel": (0.90, 0.60, 0.80, 0.55, 1.7),
    "drilling vessel": (1.00, 0.85, 0.925, 0.10, 1.7),
    "ferry": (0.90, 0.45, 0.50, 0.80, 1.1),
    "fishing vessel": (0.95, 0.70, 0.70, 0.40, 1.1),
    "liquefied natural gas tanker": (0.70, 0.60, 0.65, 0.50, 1.1),
    "offshore supply vessel": (0.90, 0.55, 0.80, 0.55, 1.2),
    "passenger liner": (0.90, 0.40, 0.40, 0.80, 1.2),
    "research vessel": (0.85, 0.55, 0.65, 0.60, 1.4),
    "speed boat": (0.90, 0.55, 0.60, 0.60, 1.1),
    "tanker, loaded": (0.70, 0.90, 0.55, 0.40, 3.1),
    "tanker, in ballast": (0.70, 0.75, 0.55, 0.40, 2.2),
    "tender": (0.85, 0.55, 0.55, 0.65, 1.1),
}
"""C_Dt, C_Dl bow, C_Dl stern, delta, kappa."""

_NEAREST = {"bulk carrier": "cargo vessel, loaded", "tug": "offshore supply vessel"}
"""Blendermann's type for a type that he has not."""


@dataclass(frozen=True)
class Windage:
    """Areas [m2], centroid forward of midship and above the water [m], and Blendermann's coefficients."""

    A_Fw: float
    A_Lw: float
    s_L: float
    s_H: float
    C_Dt: float
    C_Dl_bow: float
    C_Dl_stern: float
    delta: float
    kappa: float
    estimated: tuple[str, ...]


def compute_windage(ship: Ship) -> Windage:
    """A ship's windage, from its table [wind] and what is estimated."""
    table, notes = ship.wind, []
    kind: str | None = table.type
    if kind is None:
        name = find_ship_type(ship.kind).name
        kind = _NEAREST.get(name, name)
        notes.append(f"[wind] type = {kind!r}")
    freeboard, house = ship.hull.depth - ship.T, 0.07 * ship.L_pp
    side, front = 0.12 * ship.L_pp * house, 0.6 * ship.B * house
    A_L, A_F = ship.L_oa * freeboard + side, ship.B * freeboard + front
    if "container" in kind:
        A_L, A_F = A_L + 0.6 * ship.L_pp * 0.4 * ship.B, ship.B * (freeboard + 0.4 * ship.B)

    def or_estimate(value: float | None, name: str, otherwise: float, unit: str) -> float:
        if value is None:
            notes.append(f"[wind] {name} = {otherwise:.4g} {unit}")
            return otherwise
        return value

    A_Fw = or_estimate(table.A_Fw, "A_Fw", A_F, "m2")
    A_Lw = or_estimate(table.A_Lw, "A_Lw", A_L, "m2")
    s_L = or_estimate(table.s_L, "s_L", -0.35 * ship.L_pp * side / A_L, "m")
    s_H = or_estimate(table.s_H, "s_H", 0.5 * A_Lw / ship.L_oa, "m")
    own = (table.C_Dt, table.C_Dl_bow, table.C_Dl_stern, table.delta, table.kappa)
    C_Dt, C_Dl_bow, C_Dl_stern, delta, kappa = (
        of_type if value is None else value for value, of_type in zip(own, BLENDERMANN[kind], strict=True)
    )
    return Windage(
        A_Fw=A_Fw, A_Lw=A_Lw, s_L=s_L, s_H=s_H, C_Dt=C_Dt, C_Dl_bow=C_Dl_bow, C_Dl_stern=C_Dl_stern, delta=delta,
        kappa=kappa, estimated=tuple(notes),
    )  # fmt: skip
