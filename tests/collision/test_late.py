"""Impulses that a ship takes one step late: identities of work, and a ship that springs to and fro for ever."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.late import apply_late
from shipcollision_fmu.collision.shadow import Shadow
from shipcollision_fmu.ship.frames import rotation
from tests.collision.conftest import BOX, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

NUMBER = st.floats(-1.0, 1.0)


SIX = st.lists(NUMBER, min_size=6, max_size=6).map(np.array)


@given(SIX, SIX, SIX, SIX, st.booleans())
def test_the_work_is_that_which_the_ship_will_do(
    pose: np.ndarray, way: np.ndarray, nu: np.ndarray, J: np.ndarray, carried_over: bool
) -> None:
    """J.(nu + d(nu)/2) where it is solved, J'.(nu' + d(nu')/2) where it is applied, worked out there in n."""
    r_bg, M_inverse = np.array([3.0, 0.0, 1.0]), np.diag([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    shadow = Shadow.at(100.0 * pose[:3], pose[3:], nu, np.eye(6), r_bg)
    x_0, R_0 = shadow.x_received, shadow.R_received
    x, R = x_0 + way[:3], rotation(way[3:]) @ R_0
    apply_late(shadow, x, R, M_inverse, carried_over=carried_over)
    work = J @ (shadow.centred + 0.5 * shadow.M_inverse @ J)

    omega, v_g = R_0 @ nu[3:], R_0 @ (nu[:3] + np.cross(nu[3:], r_bg))  # constant in n
    nu_then = np.concatenate([R.T @ (v_g - np.cross(omega, R @ r_bg)), R.T @ omega])
    taken = J
    if carried_over:  # the same force and moment in n, about the ship's place by then
        force = R_0 @ J[:3]
        taken = np.concatenate([R.T @ force, R.T @ (R_0 @ J[3:] + np.cross(x_0 - x, force))])
    assert work == pytest.approx(taken @ (nu_then + 0.5 * M_inverse @ taken), rel=1e-10, abs=1e-10)


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


@pytest.mark.parametrize("degrees_of_freedom", [3, 6])
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_a_ship_springs_between_two_walls_without_losing_or_gaining(
    make_ship: Make, world: MakeWorld, degrees_of_freedom: int, algorithm: str
) -> None:
    """Restitution 1, no friction, turning as she goes. Under a parallel master all but the first impulse is right."""
    box = make_ship("box", BOX, added_mass="m_x = 0.05\nm_y = 0.9\nm_z = 1.0")
    start = [{"position": [0.0, 0.0, 0.0], "attitude": (0.0, 0.0, 0.1), "nu": [2.0, 6.0, 0.0, 0.0, 0.0, 0.004]}]
    start.append({"position": [5000.0, 0.0, 0.0], "nu": [0.0] * 6})
    w = world([box, box], start, algorithm=algorithm, degrees_of_freedom=degrees_of_freedom, friction=0.0,
              restitution=1.0, obstacles=WALLS)  # fmt: skip
    bounces, H = 0, 0.2
    first: float | None = None
    for _ in range(1200):
        before = w.energy(0)
        w.step(H)
        if w.work[-1] != 0.0:
            bounces += 1
            if bounces == 1:
                first = abs(w.work[-1]) / before
            elif bounces > 2 or algorithm == "gauss-seidel":  # the second makes good what the first one lacked
                assert abs(w.work[-1]) <= 1e-12 * before, (w.t, w.work[-1] / before)
    assert first is not None
    assert first < 1e-2
    assert bounces > 4
