"""What each mechanism of the collision model is for: behaviour that is lost when that mechanism is switched off.

tests/collision/test_ablation.py switches each one off and expects the test named there to fail.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sin
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.contact import Contact
from shipcollision_fmu.collision.geometry.detection import Detector
from shipcollision_fmu.ship.frames import rotation
from tests.collision.conftest import BOX, World
from tests.collision.test_quay import FORCE, QUAY, Berthed, MakeBerthed, berthed

__all__ = ["berthed"]

Make = Callable[..., str]
MakeWorld = Callable[..., World]


# -- work of the solver, as counts of sweeps: the answer itself is the same without ---------------------------------


def sweeps_per_step(ship: Berthed) -> list[int]:
    """Most sweeps of a substep, in each of 50 steps."""
    sweeps = []
    for _ in range(50):
        ship.step(0.1)
        sweeps.append(ship.model.outputs.solver.sweeps)
    return sweeps


def test_a_ship_at_rest_at_a_quay_costs_one_sweep_per_substep(berthed: MakeBerthed) -> None:
    """Held by a steady wind, the ship needs the impulses of the substep before: from them the first sweep changes
    nothing. Without the warm start: 5 sweeps. Of four ships, one outside the other, it saves 60 and Newton's method."""
    ship = berthed("gauss-seidel")
    ship.run(10.0, 0.1)
    assert ship.model.outputs.contact_count == 4
    assert set(sweeps_per_step(ship)) == {1}


def test_a_ship_that_slides_along_a_quay_costs_few_sweeps(berthed: MakeBerthed) -> None:
    """Sliding changes the patch in every substep, so that the impulses of the one before are no answer. The sweeps
    approach the answer along one direction, by the same share each time. Without extrapolation: 41 sweeps."""
    ship = berthed("gauss-seidel", speed=3.0)
    ship.run(10.0, 0.1)
    assert ship.model.outputs.contact_count == 4
    assert 2 <= max(sweeps_per_step(ship)) <= 15
    assert ship.nu[0] > 1.0


def test_ships_that_approach_are_examined_when_they_could_meet(
    make_ship: Make, world: MakeWorld, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two ships close 12.4 m at 5 m/s in a step of 250 substeps. Conservative advancement examines them some times at
    the end of the step; without, they are examined in every substep."""
    examined = []
    contacts = Detector.contacts

    def count(self: Detector, *args: Any) -> list[Contact]:
        examined.append(args)
        return contacts(self, *args)

    monkeypatch.setattr(Detector, "contacts", count)
    box = make_ship("box", BOX)
    start = [
        {"position": [0.0, 0.0, 0.0], "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
        {"position": [212.4, 0.0, 0.0], "nu": [0.0] * 6},
    ]
    w = world([box, box], start, degrees_of_freedom=3)
    w.step(2.5)
    assert w.model.outputs.collision_count == 1
    assert 1 <= len(examined) <= 20


def test_three_ships_abreast_at_a_quay_are_solved(make_ship: Make, world: MakeWorld) -> None:
    """12 contacts that pass the push of the wind on to each other. Without Newton's method: 60 sweeps leave some of the
    approach, in every step."""
    box = make_ship("box", BOX)
    start = [{"position": [40.0 * i, -30.3 * i, 0.0], "nu": [0.0, 0.1, 0.0, 0.0, 0.0, 0.0]} for i in range(3)]
    w = world([box] * 3, start, degrees_of_freedom=3, obstacles=QUAY, substep=0.05)
    for _ in range(80):
        w.step(0.1)
        for nu in w.nu:
            nu[1] += 0.04 * 0.1  # wind: 0.04 m/s2
    assert w.model.outputs.contact_count == 12
    assert w.model.outputs.solver.unconverged == 0


# -- energy ---------------------------------------------------------------------------------------------------------


@pytest.mark.one_in(2)
@pytest.mark.parametrize("response", ["pgs", "closed_form"])
@pytest.mark.parametrize("restitution", [0.0, 1.0])
def test_a_wind_that_dies_away_lets_no_contact_add_energy(
    berthed: MakeBerthed, response: str, restitution: float
) -> None:
    """Contact is solved with the velocity that the wind is expected to give. A gust that ends leaves a ship with the
    impulse for a velocity that it never had. Without passivity: 80 J are gained in a step by a ship at rest, and
    54 kJ in an impact by an elastic ship that bounces."""
    ship = berthed("gauss-seidel", response=response, force=lambda t: FORCE * (1.0 + sin(2.0 * t)))
    ship.model.parameters.restitution = restitution
    ship.model.initialise()
    dissipated = [0.0]
    for _ in range(300):
        ship.step(0.1)
        dissipated.append(ship.model.outputs.energy.dissipated)
    size = 0.5 * ship.M[1, 1] * 0.1**2  # J, of the ship at the start
    assert max(ship.contact_work) <= 1e-9 * size
    assert np.diff(dissipated).min() >= -1e-9 * size
    assert ship.model.outputs.solver.scaled > 0


# -- the direction of contact ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("response", ["pgs", "closed_form"])
def test_a_ship_put_deep_inside_another_is_stopped_sideways(make_ship: Make, world: MakeWorld, response: str) -> None:
    """A host puts a ship of 30 m beam and 20 m depth 21 m inside another. Least overlap in space is then vertical, and
    along it nothing approaches. Without the overlap in plan: no impulse, the ships go on through each other."""
    box = make_ship("box", BOX)
    start = [
        {"position": [0.0, 0.0, 0.0], "nu": [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]},
        {"position": [0.0, 9.0, 0.0], "nu": [0.0] * 6},
    ]
    w = world([box, box], start, response=response, friction=0.0)
    w.step(0.05)
    normal = w.model.outputs.contacts[0].normal
    assert abs(normal[1]) == pytest.approx(1.0)
    np.testing.assert_allclose([nu[1] for nu in w.nu], 0.5, atol=1e-9)  # a plastic impact of equal ships
    assert w.model.outputs.energy.dissipated == pytest.approx(0.25 * w.M[0][1, 1], rel=1e-9)


def test_the_side_that_was_struck_stays_the_side_in_deep_overlap(make_ship: Make, world: MakeWorld) -> None:
    """A stern strikes the outermost 2 m of a side at 8 m/s, without friction. Under a parallel master with steps of 0.5
    s the ships overlap by more than 2 m before the impulse is applied. The last normal from shallow overlap tells the
    side. Without it, least overlap tells the bow, and the struck ship loses most of its speed ahead."""
    box = make_ship("box", BOX)
    start = [
        {"position": [198.0, -30.5, 0.0], "nu": [0.0, 8.0, 0.0, 0.0, 0.0, 0.0]},
        {"position": [0.0, 0.0, 0.0], "nu": [2.0, 0.0, 0.0, 0.0, 0.0, 0.0]},
    ]
    w = world([box, box], start, algorithm="jacobi", degrees_of_freedom=3, friction=0.0, restitution=0.0)
    w.run(3.0, 0.5)
    P = sum((R @ J[:3] for _, R, J in (rows[1] for rows in w.increments)), np.zeros(3))
    assert P[1] > 4e7
    assert abs(P[0]) < 0.01 * P[1]


def test_ships_that_meet_flush_touch_with_all_corners(make_ship: Make, world: MakeWorld) -> None:
    """Two sides meet at the very end of a substep, on 20 headings: rounding alone decides whether they touch yet. If
    they do, they touch with four corners. Without the tolerance: with one or two on some headings."""
    box, rng = make_ship("box", BOX), np.random.default_rng(0)
    points = []
    for psi in rng.uniform(-np.pi, np.pi, 20):
        R, x = rotation([0.0, 0.0, psi]), np.array([*rng.uniform(-1000.0, 1000.0, 2), 0.0])
        start = [
            {"position": x, "attitude": (0.0, 0.0, psi), "nu": [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]},
            {"position": x + R @ [20.0, 30.01, 0.0], "attitude": (0.0, 0.0, psi), "nu": [0.0] * 6},
        ]
        w = world([box, box], start, degrees_of_freedom=3, friction=0.0)
        w.step(0.01)
        points.append(w.model.outputs.contact_count)
    assert set(points) == {0, 4}
