"""Energy of a collision after Popov et al. (1967): the work along the normal, without friction.

    E   = xi_0^2 / (2 (C_A/M_A + C_B/M_B))                         xi_0: closing speed along the normal
    C   = l^2/(1 + m_x) + m^2/(1 + m_y) + eta^2/(r_z^2 (1 + j_z))  mass reduction of a ship, in plan
    l, m, eta   normal in the ship's b, arm of the normal about its CG
    m_x = 0,  m_y = 2 T/B,  j_z = 0.3 + 0.05 L/B,  r_z = L/4,  CG amidships

Popov's other body is a floe: its C/M stands beside the ship's as the second ship's does here. In plan the frame angle
is zero, and roll, heave and pitch have no arm.

Source: Popov, Faddeyev, Kheisin, Yakovlev (1967), Strength of ships sailing in ice, as in Daley (1999), POAC '99.
Secondary source: M_e = M/C is read in a quotation, C and the factors are recalled.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array
from .planar_impact import PlanarImpacts, PlanarShips

__all__ = ["popov_energy", "popov_ships"]


def popov_ships(L: Array, B: Array, T: Array, mass: Array) -> PlanarShips:
    """Ships with Popov's added masses, of main dimensions [m] and displacement [kg] (n,)."""
    return PlanarShips(
        M_x=mass, M_y=(1.0 + 2.0 * T / B) * mass, J_z=(1.3 + 0.05 * L / B) * mass * L**2 / 16.0, x=np.zeros_like(mass)
    )


def popov_energy(impacts: PlanarImpacts) -> Array:
    """E [J] (n,), NaN for ships that do not close."""
    closing = np.where(impacts.closing > 0.0, impacts.closing, np.nan)
    energy: Array = closing**2 / (2.0 * impacts.mobility(impacts.normal, impacts.normal))
    return energy
