"""Energy of a plastic impact in plan after Pedersen and Zhang (1998): the hulls stick, or slide on each other.

    mu*   = (eta_0 D_xi - xi_0 D_eta) / (xi_0 K_eta - eta_0 K_xi)     impulse ratio at stick;  sticks if |mu*| <= mu
    stick   I_xi = (xi_0 K_eta - eta_0 D_eta)/D,   I_eta = mu* I_xi,   D = D_xi K_eta - D_eta^2
    slide   I_xi = xi_0 / (D_xi + s mu D_eta),     I_eta = s mu I_xi,  s = sign(eta_0)
    E     = 1/2 I_xi (xi_0 + xi_f) + 1/2 I_eta (eta_0 + eta_f)        xi_f = 0, eta_f: velocities afterwards

The slip keeps its first direction. Where it ends and turns back within the impact, the formula lets friction push the
hulls along: `turns_back` marks such cases.

    m_x = 0.05,  m_y = 0.85,  j_z = 0.21,  r_z = L/4,  CG amidships       as in the examples of the paper

Source: Pedersen and Zhang (1998), Marine Structures 11:429-449. Secondary source: formulae and factors are quoted or
recalled; the paper itself, with its table of results, was not at hand.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...ship.frames import Array
from .planar_impact import PlanarImpacts, PlanarShips

__all__ = ["PedersenZhang", "pedersen_zhang", "pedersen_zhang_ships"]

SURGE, SWAY, YAW = 0.05, 0.85, 0.21
"""Added masses and added yaw inertia as shares of the ship's own. They are for the short time of an impact."""


@dataclass(frozen=True, eq=False)
class PedersenZhang:
    """Answers (n,): energy [J]; mu*; whether the hulls stick, or slide and the slip turns back.

    energy is NaN for ships that do not close. Sliding always has an answer: with D_xi + s mu D_eta <= 0 it sticks.
    """

    energy: Array
    ratio: Array
    sticks: npt.NDArray[np.bool_]
    turns_back: npt.NDArray[np.bool_]


def pedersen_zhang_ships(L: Array, mass: Array) -> PlanarShips:
    """Ships with the added masses of the paper, of a length [m] and a displacement [kg] (n,)."""
    return PlanarShips(
        M_x=(1.0 + SURGE) * mass, M_y=(1.0 + SWAY) * mass, J_z=(1.0 + YAW) * mass * L**2 / 16.0, x=np.zeros_like(mass)
    )


def pedersen_zhang(impacts: PlanarImpacts) -> PedersenZhang:
    """The answers to the impacts."""
    n, t, eta_0, mu = impacts.normal, impacts.tangent, impacts.slip, impacts.friction
    xi_0 = np.where(impacts.closing > 0.0, impacts.closing, np.nan)
    D_xi, K_eta, D_eta = impacts.mobility(n, n), impacts.mobility(t, t), impacts.mobility(n, t)
    D = D_xi * K_eta - D_eta**2
    at_stick = (xi_0 * K_eta - eta_0 * D_eta) / D
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = (eta_0 * D_xi - xi_0 * D_eta) / (xi_0 * K_eta - eta_0 * D_eta)
        sticks = (at_stick > 0.0) & (np.abs(ratio) <= mu)
        s = np.where(eta_0 == 0.0, -np.sign(D_eta), np.sign(eta_0))
        I_xi = np.where(sticks, at_stick, xi_0 / (D_xi + s * mu * D_eta))
        I_eta = np.where(sticks, ratio, s * mu) * I_xi
    xi_f, eta_f = xi_0 - D_xi * I_xi - D_eta * I_eta, eta_0 - D_eta * I_xi - K_eta * I_eta
    energy = 0.5 * I_xi * (xi_0 + xi_f) + 0.5 * I_eta * (eta_0 + eta_f)
    return PedersenZhang(energy, ratio, sticks, ~sticks & (s * eta_f < 0.0))
