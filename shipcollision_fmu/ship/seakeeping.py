"""Restoring and damping of a ship in heave, roll and pitch.

    K_33 = rho g A_wp      K_44 = m g GM_T      K_55 = m g GM_L               restoring [N/m, N m/rad]
    D_ii = 2 zeta_i w_i M_ii,   w_i = sqrt(K_ii/M_ii)                         linear damping [N s/m, N m s/rad]
    D_44q = (3 pi/4) zeta_4q M_44                                             of |p| p [N m s2/rad2]

M_ii are the entries of the ship's M, added mass included; zeta_i damping ratios. zeta_4q is the increase of the
damping ratio in roll per radian of amplitude: over a cycle of amplitude phi_a, D_44q |p| p dissipates as much energy
as 2 zeta_4q phi_a w_4 M_44 p.

Values that a file leaves out: zeta_heave 0.2, zeta_pitch 0.25, zeta_roll 0.05 (bare hull to bilge keels),
zeta_roll_per_rad 0.3, which are rules of thumb; GM by hydrostatics.py. The sway force on the hull acts at z_H = T/2,
that on the rudder at its centroid. The rudder's foot and the propeller's tips are taken to be level with the keel.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from ..errors import ShipError
from .hydrostatics import GRAVITY, compute_hydrostatics
from .ship import Ship

__all__ = ["BLOCK", "Seakeeping", "compute_seakeeping"]

RATIOS = {"zeta_heave": 0.2, "zeta_roll": 0.05, "zeta_pitch": 0.25, "zeta_roll_per_rad": 0.3}
"""Damping ratios where the file gives none; with less roll damping, ships roll on for longer after an impact."""

LEAST_GM = 0.002
"""GM_T over B, 0.1 m for the largest ships. With less, ships that loll or have a wrong CG would be accepted."""

BLOCK = (0.40, 0.90)
"""C_b for which the formulas of hydrostatics hold; outside, the estimated GM is not to be trusted."""


@dataclass(frozen=True)
class Seakeeping:
    """Stiffness and damping in heave, roll and pitch, and where forces act; see the module for the symbols.

    BM_T [m] and tan_deck, the tangent of the heel at which the deck edge comes to the water, are for large heel.
    z_H, z_R, z_P [m] below CO; z_R, z_P are 0 for a ship without rudder and propeller.
    """

    K_33: float
    K_44: float
    K_55: float
    D_33: float
    D_44: float
    D_44q: float
    D_55: float
    GM_T: float
    GM_L: float
    BM_T: float
    tan_deck: float
    x_F: float
    z_H: float
    z_R: float
    z_P: float
    estimated: tuple[str, ...]


def compute_seakeeping(ship: Ship) -> Seakeeping:
    """Stiffness and damping of a ship. Raises ShipError for a ship that does not float upright."""
    C_b = ship.C_b
    if not BLOCK[0] <= C_b <= BLOCK[1]:
        raise ShipError(
            f"ship {ship.name!r}: C_b = mass / (rho L_pp B T) = {C_b:.3f} is outside {BLOCK[0]:.2f} to {BLOCK[1]:.2f}, "
            "so its heave, roll and pitch cannot be estimated: take degrees_of_freedom = 3, or give a mass that fits"
        )
    table, notes = ship.seakeeping, []
    water = compute_hydrostatics(ship.L_pp, ship.B, ship.T, C_b, float(ship.r_bg[2]), GM_T=ship.GM_T, GM_L=ship.GM_L)
    if water.GM_T < LEAST_GM * ship.B:
        how = "" if ship.GM_T is not None else f", estimated with KG = {ship.T - float(ship.r_bg[2]):.2f} m"
        raise ShipError(
            f"ship {ship.name!r}: GM_T = {water.GM_T:.3f} m{how}, must be at least {LEAST_GM} B = "
            f"{LEAST_GM * ship.B:.3f} m, or it does not float upright: give [particulars] GM_T, or r_bg with CG lower"
        )
    if water.GM_L <= 0.0:  # of a body that is broader than long
        raise ShipError(
            f"ship {ship.name!r}: GM_L = {water.GM_L:.3f} m must be greater than 0, or it does not float on an even "
            "keel: give [particulars] GM_L, or r_bg with CG lower"
        )

    def or_estimate(value: float | None, formula: str, otherwise: float) -> float:
        if value is None:
            notes.append(formula)
            return otherwise
        return value

    if ship.GM_T is None:
        notes.append(f"GM_T = KB + BM_T - KG = {water.GM_T:.2f} m")
    if ship.GM_L is None:
        notes.append(f"GM_L = KB + BM_L - KG = {water.GM_L:.1f} m")
    zeta = {key: or_estimate(getattr(table, key), f"{key} = {value}", value) for key, value in RATIOS.items()}
    x_F = or_estimate(table.x_F, "x_F = 0", 0.0)
    z_H = or_estimate(table.z_H, "z_H = T/2", 0.5 * ship.T)
    z_R = z_P = 0.0
    if ship.rudder is not None:
        z_R = or_estimate(ship.rudder.z_R, "z_R = T - H_R/2", ship.T - 0.5 * ship.rudder.H_R)
    if ship.propeller is not None:
        z_P = or_estimate(ship.propeller.z_P, "z_P = T - D_p/2", ship.T - 0.5 * ship.propeller.D_p)

    weight = ship.mass * GRAVITY
    K_33, K_44, K_55 = ship.rho * GRAVITY * water.A_wp, weight * water.GM_T, weight * water.GM_L
    M_33, M_44, M_55 = (float(ship.M[i, i]) for i in (2, 3, 4))
    return Seakeeping(
        K_33=K_33, K_44=K_44, K_55=K_55,
        D_33=2.0 * zeta["zeta_heave"] * sqrt(K_33 * M_33),
        D_44=2.0 * zeta["zeta_roll"] * sqrt(K_44 * M_44),
        D_44q=0.75 * pi * zeta["zeta_roll_per_rad"] * M_44,
        D_55=2.0 * zeta["zeta_pitch"] * sqrt(K_55 * M_55),
        GM_T=water.GM_T, GM_L=water.GM_L, BM_T=water.BM_T, tan_deck=2.0 * (ship.hull.depth - ship.T) / ship.B,
        x_F=x_F, z_H=z_H, z_R=z_R, z_P=z_P, estimated=tuple(notes),
    )  # fmt: skip
