"""Inertia as the contacts feel it: the Delassus operator W and the free contact velocities.

    v_i = G_b nu_b - G_a nu_a                     velocity of b relative to a at contact i, in n     [m/s]
    W_ij = sum over ships s of +- G_s,i M_s^-1 G_s,j^T       (3 x 3 blocks)                         [1/kg]
    v(P) = v(0) + W P                             P (3k,) impulses on the b ships                    [N s]

W is symmetric and positive semi-definite. It is J M^-1 J^T of Guan et al. 2014, equations (10)-(11), with M the 6x6
rigid-body mass plus added mass of each ship, in place of their scalar mass and inertia, and with each ship's own arm.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...ship.frames import Array
from .body_state import BodyState
from .contact import Contact

__all__ = ["contact_jacobian", "delassus", "mobility"]


def contact_jacobian(contacts: Sequence[Contact]) -> tuple[Array, list[int]]:
    """G (3k, 6m) from the twists of the m ships that touch to the k relative velocities; and those ships' indices."""
    ships = sorted({s for c in contacts for s in (c.a, c.b)})
    G = np.zeros((3 * len(contacts), 6 * len(ships)))
    for i, c in enumerate(contacts):
        for ship, G_ship in ((c.a, -c.G_a), (c.b, c.G_b)):
            column = 6 * ships.index(ship)
            G[3 * i : 3 * i + 3, column : column + 6] = G_ship
    return G, ships


def delassus(G: Array, ships: Sequence[int], states: Sequence[BodyState]) -> Array:
    """W = G M^-1 G^T; (3k, 3k) [1/kg]."""
    GM = np.hstack([G[:, 6 * i : 6 * i + 6] @ states[ship].M_inverse for i, ship in enumerate(ships)])
    W: Array = GM @ G.T
    symmetric: Array = 0.5 * (W + W.T)
    return symmetric


def mobility(c: Contact, states: Sequence[BodyState]) -> Array:
    """W of one contact alone, in n: what a unit impulse does to its relative velocity; (3, 3) [1/kg]."""
    W: Array = c.G_a @ states[c.a].M_inverse @ c.G_a.T + c.G_b @ states[c.b].M_inverse @ c.G_b.T
    return W
