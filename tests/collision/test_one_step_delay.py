"""Impulses that a ship is known to take one step late: Galilei, the law of contact by then, energy kept for ever."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import point_jacobian
from shipcollision_fmu.collision.dynamics.impulse_ledger import ImpulseLedger, Reading
from shipcollision_fmu.ship.frames import rotation
from tests.collision.conftest import BOX, LANGUAGES, NO_ADDED_MASS, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

SIX = st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6).map(np.array)


@given(SIX, SIX, SIX)
def test_the_twist_is_that_of_the_pose_at_which_she_takes_impulses(
    pose: np.ndarray, way: np.ndarray, nu: np.ndarray
) -> None:
    """Velocity of CG and angular velocity constant in n; no matter where the hull is seen from."""
    r_bg = np.array([3.0, 0.0, 1.0])
    state = BodyState.at(100.0 * pose[:3], pose[3:], nu, np.eye(6), r_bg)
    x_0, R_0 = state.x_applied, state.R_applied
    x, R = x_0 + way[:3], rotation(way[3:]) @ R_0
    state.apply_at(x, R, 2.0 * np.eye(6))
    omega, v_g = R_0 @ nu[3:], R_0 @ (nu[:3] + np.cross(nu[3:], r_bg))
    np.testing.assert_allclose(state.nu[3:], R.T @ omega, atol=1e-12)
    np.testing.assert_allclose(state.nu[:3], R.T @ (v_g - np.cross(omega, R @ r_bg)), atol=1e-12)
    np.testing.assert_allclose(point_jacobian(R, r_bg) @ state.nu, v_g, atol=1e-12)  # of CG, by then
    assert state.x is x_0  # contact is detected from the pose received
    assert state.R is R_0


def test_a_known_delay_outlasts_an_impulse_that_is_lost_in_rounding() -> None:
    """1e-9 N s beside 1e9 N s that were issued before: nothing is there that the ship could apply."""
    ledger, x, R, still = ImpulseLedger(), np.zeros(3), np.eye(3), np.zeros(6)

    def read(applied: np.ndarray) -> Reading:
        return ledger.read("ledger", x, R, still, applied, 1e-7 * np.eye(6), 100.0, 0.05)

    surge = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    for applied, issued in ((0.0, 1e9), (0.0, 1e-9)):
        ledger.close(read(applied * surge), issued * surge, still, x, R)
    assert read(1e9 * surge).one_step_delay is True


@LANGUAGES
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_a_host_that_rounds_what_was_applied_shows_no_other_order(
    make_ship: Make, world: MakeWorld, algorithm: str
) -> None:
    """A host may hand impulse_applied on in single precision: what is left of an impulse then is rounding, no delay."""
    ship = make_ship("ship", hull=BOX)
    start = [
        {"position": [0.0, 0.0, 0.0], "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
        {"position": [-40.0, -55.0, 0.0], "attitude": (0.0, 0.0, 0.25), "nu": [6.0, 0.0, 0.0, 0.0, 0.0, 0.02]},
    ]
    exact, rounded = (
        world([ship, ship], start, algorithm=algorithm, degrees_of_freedom=3, friction=0.3, substep=0.05)
        for _ in range(2)
    )
    send = rounded.send

    def send_rounded() -> None:
        kept = rounded.applied
        rounded.applied = [np.float32(each).astype(float) for each in kept]
        send()
        rounded.applied = kept

    rounded.send = send_rounded
    for w in (exact, rounded):
        w.run(24.0, 0.2)
    assert sum(work != 0.0 for work in exact.work) > 3
    for one, other, before in zip(exact.nu, rounded.nu, (s["nu"] for s in start), strict=True):
        np.testing.assert_allclose(other, one, atol=1e-5 * np.abs(one - before).max())


def late_impulse(world: MakeWorld, ship: str, V: tuple[float, float], e: float, H: float) -> tuple[World, np.ndarray]:
    """The first impulse on the second of two turning ships that are known to be late, in n, and the world then. Both
    ships have the velocity V [m/s] in n beside their own."""
    start = [
        {"position": [x, y, 0.0], "attitude": (0.0, 0.0, psi),
         "nu": [*(rotation([0.0, 0.0, psi]).T @ np.array([u + V[0], v + V[1], 0.0])), 0.0, 0.0, r]}
        for x, y, psi, u, v, r in ((0.0, 0.0, 0.0, 0.0, 0.0, 0.01), (20.0, -125.0, 1.3, 0.5, 3.0, -0.012))
    ]  # fmt: skip
    w = world([ship, ship], start, algorithm="jacobi", degrees_of_freedom=3, friction=0.3, restitution=e, substep=0.05)
    w.know_delays()
    while not (w.work and w.work[-1]):
        w.step(H)
        assert w.t < 20.0
    _, R, J = w.increments[-1][1]
    return w, R @ J[:3]


@pytest.mark.one_in(2)
@LANGUAGES
@pytest.mark.parametrize("V", [(8.0, 0.0), (0.0, 8.0)])
@pytest.mark.parametrize("e", [0.0, 1.0])
def test_ships_that_go_on_together_feel_the_same(
    make_ship: Make, world: MakeWorld, V: tuple[float, float], e: float
) -> None:
    """Galilei: a common velocity changes nothing but the places, with added mass too as far as the first impulse.

    It holds for ships that coast straight. By Kirchhoff's equations it does not: the water is at rest.
    """
    for added_mass in (NO_ADDED_MASS, "m_x = 0.05\nm_y = 0.9"):
        ship = make_ship("ship", added_mass=added_mass)
        at_rest, P = late_impulse(world, ship, (0.0, 0.0), e, 0.5)
        on_the_way, P_V = late_impulse(world, ship, V, e, 0.5)
        np.testing.assert_allclose(P_V, P, rtol=1e-10, atol=1e-10 * float(np.linalg.norm(P)))
        assert on_the_way.work[-1] == pytest.approx(at_rest.work[-1], rel=1e-9)
        assert on_the_way.nu[1][5] == pytest.approx(at_rest.nu[1][5], rel=1e-9)


def test_a_corner_that_meets_a_wall_late_has_stopped_there(make_ship: Make, world: MakeWorld) -> None:
    """Plastic, no friction, while she runs ahead at 8 m/s and turns: her corner does not approach the wall any more."""
    box = make_ship("box", BOX, added_mass="m_x = 0.05\nm_y = 0.9")
    start = [{"position": [0.0, 0.0, 0.0], "attitude": (0.0, 0.0, 0.05), "nu": [8.0, 2.0, 0.0, 0.0, 0.0, 0.01]},
             {"position": [9000.0, 0.0, 0.0], "nu": [0.0] * 6}]  # fmt: skip
    quay = '[quay]\nkind = "quay"\nshape = "box"\nlength = 6000.0\nbreadth = 20.0\nposition = [0.0, 60.0]'
    w = world([box, box], start, algorithm="jacobi", degrees_of_freedom=3, friction=0.0, restitution=0.0,
              obstacles=quay, substep=0.05)  # fmt: skip
    w.model._exchange.ledgers[1].one_step_delay = True  # of the other ship: so this one will be late, too
    corner = np.array([100.0, 15.0, 0.0])
    while not (w.work and w.work[-1]):
        R, nu = w.R[0], w.nu[0]
        w.step(0.1)
        assert w.t < 20.0
    struck = nu + w.upright[0] @ w.increments[-1][0][2]
    before, after = ((R @ (twist[:3] + np.cross(twist[3:], corner)))[1] for twist in (nu, struck))
    assert before > 3.0
    assert abs(after) <= 1e-12 * before


WALLS = """
[east]
kind = "quay"
shape = "box"
length = 3000.0
breadth = 10.0
position = [0.0, 160.0]
[west]
kind = "quay"
shape = "box"
length = 3000.0
breadth = 10.0
position = [0.0, -160.0]
"""


@pytest.mark.parametrize(
    ("degrees_of_freedom", "coasting"),
    [(6, "straight"), *(pytest.param(*case, marks=pytest.mark.slow) for case in ((3, "straight"), (3, "kirchhoff"))),
     (6, "free")],
)  # fmt: skip
@pytest.mark.parametrize("algorithm", ["gauss-seidel", pytest.param("jacobi", marks=pytest.mark.slow)])
def test_a_ship_springs_between_two_walls_without_losing_or_gaining(
    make_ship: Make, world: MakeWorld, degrees_of_freedom: int, coasting: str, algorithm: str
) -> None:
    """Restitution 1, no friction, turning as she goes. Under a parallel master all but the first impulse is right."""
    box = make_ship("box", BOX, added_mass="m_x = 0.05\nm_y = 0.9\nm_z = 1.0")
    start = [{"position": [0.0, 0.0, 0.0], "attitude": (0.0, 0.0, 0.1), "nu": [2.0, 6.0, 0.0, 0.0, 0.0, 0.004]}]
    start.append({"position": [5000.0, 0.0, 0.0], "nu": [0.0] * 6})
    w = world([box, box], start, algorithm=algorithm, degrees_of_freedom=degrees_of_freedom, friction=0.0,
              restitution=1.0, obstacles=WALLS, coasting=coasting)  # fmt: skip
    bounces, H = 0, 0.2
    first: float | None = None
    for _ in range(1200):
        before = w.energy(0)
        w.step(H)
        if w.increments[-1][0][2].any():  # a bounce without loss may leave the energy as it was to the last bit
            bounces += 1
            if bounces == 1:
                first = abs(w.work[-1]) / before
            elif bounces > 2 or algorithm == "gauss-seidel":  # the second makes good what the first one lacked
                assert abs(w.work[-1]) <= 1e-12 * before, (w.t, w.work[-1] / before)
    assert first is not None
    assert first < 1e-2
    assert bounces > 4
