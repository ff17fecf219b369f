"""Ships that heel when they meet: contact and ship models mean the same by 3 and 4 degrees of freedom.

A ship without heave and pitch keeps the level part of M nu: the momentum along and across the heading and the one about
the vertical. Velocities are taken from the track (north, east, heading, heel), not from the conventions of the models.
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.degrees_of_freedom import FREE, level_axes
from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.ship.loading.library import load_ship

SHIP = "kvlcc2"
M, L, B = load_ship(SHIP).M, load_ship(SHIP).L_oa, load_ship(SHIP).B
INSTANT = 1e-16


def started(
    free: int, sails: bool, position: list[float], attitude: list[float], level: list[float]
) -> ShipManoeuvring:
    """A ship with the level velocities (u, v, phi_dot, psi_dot)."""
    model = ShipManoeuvring()
    p = model.parameters
    p.ship, p.degrees_of_freedom, p.hydrodynamics = SHIP, free, sails
    u, v, p_phi, r = level
    nu = level_axes(attitude) @ [u, v, 0.0, p_phi, 0.0, r]
    p.initial_position[:], p.initial_attitude[:] = position, attitude
    p.initial_velocity[:], p.initial_rate[:] = nu[:3].tolist(), nu[3:].tolist()
    model.initialise()
    return model


def level_momentum(model: ShipManoeuvring, free: int) -> Array:
    """North, east, and about the vertical through the origin."""
    o = model.outputs
    phi, theta, psi = o.attitude
    north, east, _ = rotation(o.attitude) @ o.velocity
    p, q, r = o.rate
    psi_dot = (q * sin(phi) + r * cos(phi)) / cos(theta)
    phi_dot = p + psi_dot * sin(theta)
    c, s = cos(psi), sin(psi)
    motion = np.array([c * north + s * east, c * east - s * north, 0.0, phi_dot, 0.0, psi_dot])
    rows = list(FREE[free])
    h = M[np.ix_(rows, rows)] @ motion[rows]
    P = np.array([c * h[0] - s * h[1], s * h[0] + c * h[1]])
    return np.array([*P, h[-1] + o.position[0] * P[1] - o.position[1] * P[0]])


@settings(max_examples=12, deadline=None)
@given(
    st.sampled_from([(3, False), (4, False), (4, True)]), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2),
    st.floats(0.6, 2.4), st.floats(0.0, 1.0), st.floats(-1.0, 1.0), st.floats(-0.01, 0.01),
)  # fmt: skip
def test_level_momentum_is_kept(
    mode: tuple[int, bool], phi: float, phi_struck: float, heading: float, mu: float, sway: float, rolling: float
) -> None:
    free, sails = mode
    rolling *= free == 4
    bow = np.array([cos(heading), sin(heading)]) * 0.5 * L
    target_point = np.array([30.0, -0.5 * B])
    ships = [
        started(free, sails, [*(target_point - bow).tolist(), 0.0], [phi, 0.0, heading], [6.0, sway, rolling, 0.002]),
        started(free, sails, [0.0, 0.0, 0.0], [phi_struck, 0.0, 0.0], [4.0, 0.3, -rolling, -0.001]),
    ]  # fmt: skip
    collision = ShipCollision(["a", "b"])
    for slot in collision.parameters.ships:
        slot.ship, slot.degrees_of_freedom = SHIP, free
    collision.parameters.friction = mu
    for inputs, ship in zip(collision.inputs.ships, ships, strict=True):
        _shown(inputs, ship)
    try:
        collision.initialise()
        assert _advance_to_contact(collision, ships, free)
    finally:
        collision.close()


def _advance_to_contact(collision: ShipCollision, ships: list[ShipManoeuvring], free: int) -> bool:
    in_contact, t = False, 0.0
    for k in range(8):
        before = [level_momentum(ship, free) for ship in ships]
        for inputs, ship in zip(collision.inputs.ships, ships, strict=True):
            _shown(inputs, ship)
        collision.step(0.5 * k, 0.5)
        for outputs, ship in zip(collision.outputs.ships, ships, strict=True):
            ship.inputs.impulse[:] = outputs.impulse
            ship.step(t, INSTANT)
        after = [level_momentum(ship, free) for ship in ships]
        exchanged = np.abs(after[0] - before[0])
        if exchanged[:2].max() > 1e6:
            in_contact = True
            change = np.abs(after[0] + after[1] - before[0] - before[1])
            assert change[:2].max() <= 1e-10 * exchanged[:2].max()
            assert change[2] <= 1e-10 * max(exchanged[2], L * exchanged[:2].max())
        for ship in ships:
            ship.step(t, 0.5)
        t += 0.5
    return in_contact


def _shown(inputs: object, ship: ShipManoeuvring) -> None:
    for name in ("position", "attitude", "velocity", "rate", "impulse_applied"):
        getattr(inputs, name)[:] = getattr(ship.outputs, name)


def test_a_plastic_blow_leaves_no_approach_between_heeled_sides() -> None:
    """Side to side, both heeled towards each other by 5 degrees: what touches stops, as their own hulls move."""
    heel = 5 * pi / 180
    ships = [
        started(4, False, [0.0, 0.0, 0.0], [heel, 0.0, 0.0], [0.0, 1.0, 0.01, 0.0]),
        started(4, False, [20.0, B + 0.3, 0.0], [-heel, 0.0, 0.0], [0.0, -1.0, -0.01, 0.0]),
    ]
    collision = ShipCollision(["a", "b"])
    for slot in collision.parameters.ships:
        slot.ship, slot.degrees_of_freedom = SHIP, 4
    for inputs, ship in zip(collision.inputs.ships, ships, strict=True):
        _shown(inputs, ship)
    collision.initialise()
    collision.step(0.0, 0.01)
    assert collision.outputs.contact_active
    for outputs, ship in zip(collision.outputs.ships, ships, strict=True):
        ship.inputs.impulse[:] = outputs.impulse
        ship.step(0.0, INSTANT)
    for contact in collision.outputs.contacts:
        if not contact.ship_a:
            continue
        moves = [
            rotation(s.outputs.attitude) @ (np.array(s.outputs.velocity) + np.cross(s.outputs.rate, r))
            for s, r in zip(ships, (contact.r_a, contact.r_b), strict=True)
        ]
        assert (moves[1] - moves[0]) @ contact.normal >= -1e-9
    for ship in ships:
        assert rotation(ship.outputs.attitude)[2] @ ship.outputs.velocity == pytest.approx(0.0, abs=1e-12)
