"""The response "closed_form", the impact process, between ships: ledger, energy, symmetries, resultant contact."""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import make_contact, mean_velocity
from shipcollision_fmu.collision.solvers.resultant_contact import reduce_to_resultant
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.loading.library import load_ship
from tests.collision.conftest import BOX, World

MakeShip, MakeWorld = Callable[..., str], Callable[..., World]
HALF_PI = np.pi / 2

CROSSING = [
    {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
    {"position": (20, -118, 0), "attitude": (0, 0, HALF_PI - 0.3), "nu": (5, 0.5, 0, 0, 0, 0.005)},
]
HEAD_ON = [
    {"position": (0, 0, 0), "nu": (4, 0, 0, 0, 0, 0)},
    {"position": (201, 0, 0), "attitude": (0, 0, np.pi), "nu": (4, 0, 0, 0, 0, 0)},
]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_collision_balances_the_ledger(
    make_ship: MakeShip, world: MakeWorld, algorithm: str, restitution: float
) -> None:
    """Impulses balance, linear and about n's origin; a sequential master's energy falls by what is reported."""
    ships = [make_ship("one"), make_ship("other", mass=50e6)]
    w = world(ships, CROSSING, response="closed_form", friction=0.3, restitution=restitution, algorithm=algorithm)
    w.run(8.0, 0.05)
    assert w.model.outputs.collision_count >= 1
    total = np.zeros(6)
    size = 0.0
    for rows in w.increments:
        for x, R, J in rows:
            linear, angular = R @ J[:3], R @ J[3:]
            total += np.concatenate([linear, angular + np.cross(x, linear)])
            size += np.linalg.norm(linear)
    assert np.abs(total).max() <= 1e-9 * size * 100.0
    if algorithm == "gauss-seidel":
        assert max(w.work) <= 1e-6
        assert -sum(w.work) == pytest.approx(w.model.outputs.energy.dissipated, rel=1e-9)


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
def test_head_on_equal_ships_go_back_with_the_share_e(make_ship: MakeShip, world: MakeWorld, e: float) -> None:
    ships = [make_ship("one", hull=BOX), make_ship("other", hull=BOX)]
    w = world(ships, HEAD_ON, response="closed_form", friction=0.3, restitution=e).run(3.0, 0.05)
    for nu in w.nu:
        assert nu[0] == pytest.approx(-4.0 * e, abs=1e-6)


def test_single_impact_is_that_of_pgs(make_ship: MakeShip, world: MakeWorld) -> None:
    """A stem on a side, e = 0: both responses, step by step, end alike; their friction may turn differently."""
    ships = [make_ship("one"), make_ship("other")]
    ends = [
        world(ships, CROSSING, response=response, friction=0.2, degrees_of_freedom=3).run(6.0, 0.05).nu
        for response in ("closed_form", "pgs")
    ]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0.0, atol=0.03)


def test_swapped_ships_end_alike(make_ship: MakeShip, world: MakeWorld) -> None:
    ships = [make_ship("one"), make_ship("other", mass=50e6)]
    one = world(ships, CROSSING, response="closed_form", friction=0.3, restitution=0.3).run(6.0, 0.05)
    other = world(ships[::-1], CROSSING[::-1], response="closed_form", friction=0.3, restitution=0.3).run(6.0, 0.05)
    np.testing.assert_allclose(one.nu[0], other.nu[1], atol=1e-6)
    np.testing.assert_allclose(one.nu[1], other.nu[0], atol=1e-6)


def test_three_ships_in_a_row_pass_the_push_on(make_ship: MakeShip, world: MakeWorld) -> None:
    """One pair after the other: the third ship moves, and momentum is that of the first."""
    ships = [make_ship(name, hull=BOX) for name in ("one", "two", "three")]
    start = [
        {"position": (-201.0, 0, 0), "nu": (3, 0, 0, 0, 0, 0)},
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (200.2, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
    ]
    w = world(ships, start, response="closed_form", friction=0.3)
    before = w.momentum()
    w.run(4.0, 0.05)
    np.testing.assert_allclose(w.momentum()[:3], before[:3], rtol=0.0, atol=1e-9 * before[0])
    assert [nu[0] for nu in w.nu] == pytest.approx([1.0, 1.0, 1.0], abs=1e-3)


# -- the reduction to one contact -------------------------------------------------------------------------------------


def box_against_box(nu_a: tuple[float, ...], nu_b: tuple[float, ...]) -> list[BodyState]:
    inverse = free_inverse(load_ship("kvlcc2").M, 3)
    return [
        BodyState.at(np.array(x, dtype=float), np.zeros(3), np.array(nu, dtype=float), inverse)
        for x, nu in (((0, 0, 0), nu_a), ((0, 60, 0), nu_b))
    ]


def face(states: list[BodyState], ends: tuple[float, ...]) -> list:
    """Contacts along a side, at x = ends, normal to starboard."""
    return [
        make_contact(0, 1, states, np.array([x, 30.0, 1.0]), np.array([0.0, 1.0, 0.0]), -0.01 * i)
        for i, x in enumerate(ends)
    ]


def test_sides_that_meet_squarely_touch_in_the_middle() -> None:
    states = box_against_box((0, 1, 0, 0, 0, 0), (0, 0, 0, 0, 0, 0))
    contact = reduce_to_resultant(face(states, (-100.0, 100.0)), states)
    assert contact is not None
    r_g = load_ship("kvlcc2").M[1, 5] / load_ship("kvlcc2").M[1, 1]  # through both centres of sway inertia
    np.testing.assert_allclose(contact.point, [r_g, 30.0, 1.0], atol=1e-6)
    np.testing.assert_allclose(contact.normal, [0.0, 1.0, 0.0])
    assert contact.gap == -0.01


def test_a_turning_side_touches_at_its_end() -> None:
    states = box_against_box((0, 0.1, 0, 0, 0, 0.02), (0, 0, 0, 0, 0, 0))
    contact = reduce_to_resultant(face(states, (-100.0, 20.0, 100.0)), states)
    assert contact is not None
    np.testing.assert_allclose(contact.point, [100.0, 30.0, 1.0], atol=1e-6)


def test_the_frictionless_resultant_leaves_no_contact_approaching() -> None:
    rng = np.random.default_rng(3)
    for _ in range(50):
        nus = [(rng.normal(), rng.normal(), 0, 0, 0, 0.02 * rng.normal()) for _ in range(2)]
        states = box_against_box(*nus)
        contacts = face(states, tuple(rng.uniform(-150.0, 150.0, size=3)))
        contact = reduce_to_resultant(contacts, states)
        if contact is None:
            assert min(mean_velocity(c, states)[1] for c in contacts) >= 0.0
            continue
        G_a, G_b = contact.G_a[1], contact.G_b[1]
        W_nn = G_a @ states[0].M_inverse @ G_a + G_b @ states[1].M_inverse @ G_b
        P = -mean_velocity(contact, states)[1] / W_nn
        assert P > 0.0
        states[0].book([-P * G_a])
        states[1].book([P * G_b])
        assert min(mean_velocity(c, states)[1] for c in contacts) >= -1e-9


def test_no_approach_no_contact_and_one_contact_is_itself() -> None:
    parting = box_against_box((0, -1, 0, 0, 0, 0), (0, 0, 0, 0, 0, 0))
    assert reduce_to_resultant(face(parting, (-10.0, 10.0)), parting) is None
    closing = box_against_box((0, 1, 0, 0, 0, 0), (0, 0, 0, 0, 0, 0))
    (only,) = face(closing, (40.0,))
    assert reduce_to_resultant([only], closing) is only


# -- several pairs at once --------------------------------------------------------------------------------------------

WEDGED = [  # a ship runs square into the middle of two that lie side by side, the outer one a little ahead
    {"position": (0, 0, 0), "attitude": (0, 0, HALF_PI), "nu": (0.5, 0, 0, 0, 0, 0)},
    {"position": (20.0, 31.0, 0), "nu": (0.3, -1.2, 0, 0, 0, 0.002)},
    {"position": (-25.0, 31.0 + 30.02, 0), "nu": (0.0, -1.5, 0, 0, 0, -0.001)},
    {"position": (-160.0, 41.0, 0), "nu": (2.0, -0.3, 0, 0, 0, 0.0)},
]
ROW = [
    {"position": (0.0, 0.0, 0), "nu": (0.2, 2.0, 0, 0, 0, 0)},
    {"position": (3.0, 30.1, 0), "nu": (0, 0, 0, 0, 0, 0)},
    {"position": (-4.0, 60.2, 0), "nu": (-0.2, -2.0, 0, 0, 0, 0)},
]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize("start", [WEDGED[:3], ROW, pytest.param(WEDGED, marks=pytest.mark.slow)])
def test_the_order_in_which_ships_are_named_does_not_matter(
    make_ship: MakeShip, world: MakeWorld, start: list[dict], restitution: float
) -> None:
    ships = [make_ship(f"s{i}", hull=BOX, mass=40e6 + 4e6 * i) for i in range(len(start))]
    ends = []
    for order in list(permutations(range(len(start))))[:: 2 if len(start) == 3 else 5]:
        w = world(
            [ships[i] for i in order], [start[i] for i in order], response="closed_form", friction=0.3,
            restitution=restitution, degrees_of_freedom=3, substep=0.05,
        ).run(1.0, 0.1)  # fmt: skip
        assert w.model.outputs.collision_count >= 2
        ends.append(np.array([w.nu[order.index(i)] for i in range(len(start))]))
    for end in ends[1:]:
        np.testing.assert_allclose(end, ends[0], rtol=0.0, atol=1e-6)
