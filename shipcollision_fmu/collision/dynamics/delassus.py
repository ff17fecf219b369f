"""The law of motion at the contacts: relative velocities, and the Delassus operator W.

    v_i = G_b nu_b - G_a nu_a                     velocity of b relative to a at contact i           [m/s]
    W_ij = sum over bodies s of +- G_s,i M_s^-1 G_s,j^T      (3 x 3 blocks)                          [1/kg]
    v(P) = v(0) + W P                             P (3k,) impulses on the b bodies                   [N s]

Heave and pitch of a ship in 3 and 4 degrees of freedom are held, and so is roll in 3. What they would add along the
vertical, if they were free, has an operator of its own. It decides which way friction acts (solvers/held_motions.py):

    H_ij = sum over bodies s of +- z g_s,i D_s g_s,j^T z^T       D = M^-1 - M_free^-1 (3 x 3): held_mobility     [1/kg]

z: unit vector down; g (3,): vertical velocity of the contact per heave, roll and pitch.

v, W and P are in the contacts' axes (normal, t1, t2). W is symmetric and positive semi-definite. It is J M^-1 J^T of
Guan et al. 2014, equations (10)-(11), with M the 6x6 rigid-body mass plus added mass of each ship, in place of their
scalar mass and inertia, and with each ship's own arm.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

import numpy as np

from ...ship.frames import Array
from .body_state import BodyState
from .contact import Contact
from .small_blocks import ROWS, multiply_matrices

__all__ = ["approach_velocities", "delassus", "held_delassus", "mobility"]

ON_END = 1e-12
"""Least cosine of a trim. A ship on end has no heading; without the limit its pitch would be infinitely mobile."""


def approach_velocities(contacts: Sequence[Contact], states: Sequence[BodyState]) -> Array:
    """v (3k,) [m/s], the mean expected over the step (contact.mean_velocity), in contact axes."""
    return np.concatenate([c.axes @ (c.G_b @ states[c.b].nu_mean - c.G_a @ states[c.a].nu_mean) for c in contacts])


def delassus(contacts: Sequence[Contact], states: Sequence[BodyState]) -> Array:
    """W (3k, 3k) [1/kg] in contact axes."""
    bodies = sorted({body for c in contacts for body in (c.a, c.b)})
    column = {body: slice(6 * i, 6 * i + 6) for i, body in enumerate(bodies)}
    G = np.zeros((3 * len(contacts), 6 * len(bodies)))
    for i, c in enumerate(contacts):
        row = slice(3 * i, 3 * i + 3)
        G[row, column[c.a]] = -c.G_a
        G[row, column[c.b]] = c.G_b
        G[row] = c.axes @ G[row]
    GM = np.hstack([G[:, column[body]] @ states[body].M_inverse for body in bodies])
    W: Array = GM @ G.T if GM.size * len(G) <= ROWS**3 else multiply_matrices(GM, G.T)
    symmetric: Array = 0.5 * (W + W.T)
    return symmetric


def mobility(c: Contact, states: Sequence[BodyState]) -> Array:
    """W (3, 3) [1/kg] of one contact alone, in contact axes: what a unit impulse does to its relative velocity."""
    W: Array = c.G_a @ states[c.a].M_inverse @ c.G_a.T + c.G_b @ states[c.b].M_inverse @ c.G_b.T
    in_axes: Array = c.axes @ W @ c.axes.T
    return in_axes


def held_delassus(contacts: Sequence[Contact], states: Sequence[BodyState]) -> Array | None:
    """H (3k, 3k) [1/kg] in contact axes; None where no motion is held."""
    holding = sorted({body for c in contacts for body in (c.a, c.b) if states[body].held is not None})
    if not holding:
        return None
    H: Array | None = None
    at, down = np.array([c.at for c in contacts]), np.array([c.axes[:, 2] for c in contacts])
    ends = np.array([(c.a, c.b) for c in contacts])
    for body in holding:
        sign = (ends == body) @ (-1.0, 1.0)
        g = _vertical_velocities(at, states[body])
        rows = ((sign[:, None] * down)[:, :, None] * g[:, None, :]).reshape(-1, 3)
        added = multiply_matrices(rows @ states[body].held, rows.T)
        H = added if H is None else H + added
    return H


def _vertical_velocities(at: Array, state: BodyState) -> Array:
    """g (k, 3): velocity down [m/s] of points of a body per heave [m/s], roll and pitch [rad/s]."""
    (c_x, s_x), (x, y) = state.R_applied[:2, 0].tolist(), state.x_applied[:2].tolist()  # heading times cos(trim)
    north, east = at[:, 0] - x, at[:, 1] - y
    on_end = max(hypot(c_x, s_x), ON_END)
    return np.column_stack([np.ones(len(at)), c_x * east - s_x * north, -(c_x * north + s_x * east) / on_end])
