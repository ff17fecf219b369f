"""A ship from its validated file: its matrices, and estimates of missing values by named formulas.

    k_xx = 0.37 B      k_yy = k_zz = 0.25 L_pp        radii of gyration about CG

The added mass is that of added_mass_estimate.py where the file gives none.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...errors import ShipError
from ..inertia import is_positive_definite, rigid_body_inertia
from ..seakeeping import compute_seakeeping
from ..ship import Ship
from ..windage import compute_windage
from .added_mass_estimate import assemble_added_mass
from .ship_file import ShipFile

__all__ = ["assemble_ship"]


def assemble_ship(content: ShipFile, file: str) -> Ship:
    """The ship that a validated file describes; `file` names it in messages.

    Raises ShipError when the inertia that comes out is not positive definite.
    """
    p = content.particulars
    estimated = list(content.estimated)

    def or_estimate(value: float | None, formula: str, otherwise: float) -> float:
        if value is None:
            estimated.append(formula)
            return otherwise
        return value

    L_oa = or_estimate(p.L_oa, "L_oa = L_pp", p.L_pp)
    radii = np.array([
        or_estimate(p.k_xx, "k_xx = 0.37 B", 0.37 * p.B),
        or_estimate(p.k_yy, "k_yy = 0.25 L_pp", 0.25 * p.L_pp),
        or_estimate(p.k_zz, "k_zz = 0.25 L_pp", 0.25 * p.L_pp),
    ])  # fmt: skip
    r_bg = np.array(p.r_bg if p.r_bg is not None else [0.0, 0.0, 0.0], dtype=float)
    if p.r_bg is None:
        estimated.append("r_bg = (0, 0, 0)")

    M_RB = rigid_body_inertia(p.mass, r_bg, radii)
    M_A = assemble_added_mass(content, p.mass * radii**2, estimated, file)
    M = M_RB + M_A
    if not is_positive_definite(M):
        raise ShipError(
            f"{file}: the inertia M_RB + M_A is not positive definite (diagonal {np.diag(M).tolist()}): check r_bg, "
            "the radii of gyration and [added_mass]"
        )
    for array in (r_bg, M_RB, M_A, M):
        array.flags.writeable = False
    ship = Ship(
        name=content.ship.name, kind=content.ship.kind, source=content.ship.source,
        L_pp=p.L_pp, L_oa=L_oa, B=p.B, T=p.T, mass=p.mass, rho=p.rho, r_bg=r_bg, M_RB=M_RB, M_A=M_A, M=M,
        GM_T=p.GM_T, GM_L=p.GM_L, hull=content.hull, manoeuvring=content.manoeuvring, propeller=content.propeller,
        rudder=content.rudder, engine=content.engine, seakeeping=content.seakeeping, wind=content.wind,
        estimated=tuple(estimated),
    )  # fmt: skip
    return ship if ship.manoeuvring is None else replace(ship, estimated=(*estimated, *_list_sailing_estimates(ship)))


def _list_sailing_estimates(ship: Ship) -> tuple[str, ...]:
    """Notes on estimated values of heave, roll, pitch and wind, which a coasting ship does not use."""
    try:
        floating = compute_seakeeping(ship).estimated
    except ShipError:  # raised again for a run in 4 or 6 degrees of freedom
        floating = ()
    return (*floating, *compute_windage(ship).estimated)
