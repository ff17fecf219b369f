"""Ships that coast by Kirchhoff's equations and collide: no energy comes from coasting, and no bow climbs a quay."""

from __future__ import annotations

from collections.abc import Callable
from math import degrees, sqrt, tan

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics import other_forces
from shipcollision_fmu.collision.dynamics.other_forces import ReceivedState, estimate_other_forces
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.coasting_law import make_coasting
from shipcollision_fmu.ship.frames import attitude_from_rotation, rotation
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.restoring import Restoring
from shipcollision_fmu.ship.seakeeping import compute_seakeeping
from tests.collision.conftest import BOX, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

FAR = {"position": [9000.0, 0.0, 0.0], "nu": [0.0] * 6}
BASIN = "".join(
    f'[{name}]\nkind = "quay"\nshape = "box"\nlength = {length}\nbreadth = {breadth}\nposition = [{x}, {y}]\n'
    for name, length, breadth, x, y in (
        ("north", 20.0, 360.0, 170.0, 0.0), ("south", 20.0, 360.0, -170.0, 0.0),
        ("east", 400.0, 20.0, 0.0, 150.0), ("west", 400.0, 20.0, 0.0, -150.0),
    )
)  # fmt: skip
"""A closed basin of 320 x 280 m around the origin."""


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    ("language", "degrees_of_freedom", "duration"),
    [
        ("Python", 3, 80.0),
        ("Python", 6, 60.0),
        *(pytest.param("native", n, 60.0, marks=pytest.mark.slow) for n in (3, 4, 6)),
        *(pytest.param("Python", n, 1200.0, marks=pytest.mark.slow) for n in (3, 4, 6)),
    ],
    indirect=["language"],
)
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_a_ship_in_a_closed_basin_gains_no_energy(
    make_ship: Make, world: MakeWorld, algorithm: str, degrees_of_freedom: int, duration: float
) -> None:
    """Restitution 1, no friction: T/T0 is at most 1 for ever. In 3 degrees of freedom it stays 1.

    A parallel master's first impulse is issued before its delay is known; the second makes good what it lacked.
    """
    ship = make_ship("box", BOX, added_mass="m_x = 0.05\nm_y = 0.9\nm_z = 1.0")
    start = {"position": [0.0, 0.0, 0.0], "attitude": (0.0, 0.0, 0.3), "nu": [3.0, 2.0, 0.0, 0.0, 0.0, 0.01]}
    w = world([ship, ship], [start, FAR], algorithm=algorithm, degrees_of_freedom=degrees_of_freedom,
              coasting="kirchhoff", friction=0.0, restitution=1.0, obstacles=BASIN, substep=0.05)  # fmt: skip
    sea = Restoring(compute_seakeeping(load_ship(ship)))

    def energy() -> float:
        phi, theta, _ = attitude_from_rotation(w.R[0])
        return w.energy(0) + (sea.compute_energy(w.x[0][2], phi, theta) if degrees_of_freedom == 6 else 0.0)

    before, bounces, settled = energy(), 0, 2 if algorithm == "jacobi" else 0
    for _ in range(round(duration / 0.2)):
        w.step(0.2)
        bounces += w.work[-1] != 0.0
        if bounces <= settled and settled:
            before = energy()
        assert energy() <= before * (1.0 + (1e-9 if degrees_of_freedom == 3 else 1e-4)), w.t
        assert w.energy(0) <= before * (1.0 + 1e-9)
    assert bounces > 1
    if degrees_of_freedom == 3:
        assert energy() == pytest.approx(before, rel=1e-9)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_raked_bow_climbs_no_more_than_its_buoyancy_lets_it(
    make_ship: Make, world: MakeWorld, friction: float
) -> None:
    """Straight at a quay at 7 m/s, raked by 40 deg; the straight law lifts it by 95 m.

    Upper bounds: the impulse M u tan(40 deg) at the stem, all at once, on an undamped ship that floats:
    z = P/(M_33 w_33), theta = P L/2/(M_55 w_55).
    """
    raked = 'shape = "parametric"\ndepth = 20.0\nbow_length = 40.0\nstern_length = 50.0\nstem_rake_deg = 40.0'
    file = make_ship("raked", raked)
    quay = '[quay]\nkind = "quay"\nshape = "box"\nlength = 20.0\nbreadth = 400.0\nposition = [130.0, 0.0]'
    w = world([file, file], [{"position": [0.0] * 3, "nu": [7.0, 0.0, 0.0, 0.0, 0.0, 0.0]}, FAR], coasting="kirchhoff",
              friction=friction, restitution=0.0, obstacles=quay)  # fmt: skip
    ship, before, rise, pitch = load_ship(file), w.energy(0), 0.0, 0.0
    sea = compute_seakeeping(ship)
    restoring = Restoring(sea)
    for _ in range(200):
        w.step(0.1)
        phi, theta, _ = attitude_from_rotation(w.R[0])
        rise, pitch = max(rise, -w.x[0][2]), max(pitch, abs(theta))
        assert w.energy(0) + restoring.compute_energy(w.x[0][2], phi, theta) <= before * (1.0 + 1e-6)
    P = ship.M[0, 0] * 7.0 * tan(0.7)
    assert 0.1 < rise < P / sqrt(ship.M[2, 2] * sea.K_33)
    assert 0.5 < degrees(pitch) < degrees(P * 100.0 / sqrt(ship.M[4, 4] * sea.K_55))
    assert abs(w.x[0][2]) < 0.5  # and it floats again


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_what_a_ship_does_by_its_law_is_no_other_force(degrees_of_freedom: int) -> None:
    """The ship model coasts for a step: what it did is known, so nothing is left to other forces, nor counted twice.

    To a collision model that expects the ship to go straight, it is one.
    """
    ship, law = ShipManoeuvring(), make_coasting(load_ship("kvlcc2"), degrees_of_freedom, "kirchhoff")
    p = ship.parameters
    p.degrees_of_freedom, p.initial_velocity[:], p.initial_rate[2] = degrees_of_freedom, [5.0, 1.0, 0.0], 0.02
    p.initial_attitude[:] = [0.1 if degrees_of_freedom > 3 else 0.0, 0.0, 0.4]
    ship.initialise()
    H, received = 0.5, []
    for k in range(2):
        o = ship.outputs
        received.append(
            ReceivedState(k * H, H, [*o.position], [*o.attitude], [*o.velocity, *o.rate], [*o.impulse_applied])
        )
        ship.step(k * H, H)
    r_bg = load_ship("kvlcc2").r_bg
    assert estimate_other_forces(*received, np.zeros((6, 6)), r_bg, 160.0, law) is None
    straight = estimate_other_forces(*received, np.zeros((6, 6)), r_bg, 160.0)
    assert straight is not None
    assert np.abs(straight.velocity_gain).max() > 1e3 * other_forces.ROUNDING


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
@pytest.mark.parametrize("near", [False, True], ids=["far", "near"])
def test_both_models_find_the_same_motion(
    make_ship: Make, world: MakeWorld, degrees_of_freedom: int, near: bool
) -> None:
    """Pose and twist of the collision model after a step without contact, near other ships and far from them."""
    ship = make_ship("box", BOX, added_mass="m_x = 0.05\nm_y = 0.9\nm_z = 1.0")
    heel = 0.1 if degrees_of_freedom > 3 else 0.0
    start = {"position": [0.0] * 3, "attitude": (heel, 0.0, 0.5), "nu": [4.0, 1.0, 0.0, 0.0, 0.0, 0.02]}
    other = {
        "position": [0.0, 230.0 if near else 5000.0, 0.0],
        "attitude": (0.0, 0.0, 0.5),
        "nu": [0.0, -8.0, 0, 0, 0, 0],
    }
    w = world([ship, ship], [start, other], degrees_of_freedom=degrees_of_freedom, coasting="kirchhoff")
    for _ in range(4):
        w.step(0.5)
        post = w.model.outputs.ships[0]
        np.testing.assert_allclose(post.position, w.x[0], rtol=1e-12, atol=1e-9)
        np.testing.assert_allclose(post.attitude, attitude_from_rotation(w.R[0]), atol=1e-12)
        np.testing.assert_allclose([*post.velocity, *post.rate], w.nu[0], atol=1e-11)
    assert not any(w.work)


@pytest.mark.parametrize("degrees_of_freedom", [3, 6])
def test_a_ship_that_adopts_the_state_after_impact_keeps_the_books(
    make_ship: Make, world: MakeWorld, degrees_of_freedom: int
) -> None:
    """feedback = "state": the kinetic energy of the state given back is that which the impulse left."""
    ship = make_ship("box", BOX, added_mass="m_x = 0.05\nm_y = 0.9\nm_z = 1.0")
    start = {"position": [0.0] * 3, "attitude": (0.0, 0.0, 0.3), "nu": [2.0, 4.0, 0.0, 0.0, 0.0, 0.01]}
    w = world([ship, ship], [start, FAR], degrees_of_freedom=degrees_of_freedom, coasting="free",
              restitution=1.0, friction=0.0, obstacles=BASIN, feedback="state", substep=0.05)  # fmt: skip
    before = w.energy(0)
    for _ in range(300):
        w.send()
        w.model.step(w.t, 0.2)
        post = w.model.outputs.ships[0]
        w.x[0], w.nu[0] = np.array(post.position), np.array([*post.velocity, *post.rate])
        w.R[0] = rotation(post.attitude)
        w.t += 0.2
        if w.model.outputs.collision_count:
            break
    assert w.model.outputs.collision_count
    assert w.energy(0) == pytest.approx(before, rel=1e-9)
