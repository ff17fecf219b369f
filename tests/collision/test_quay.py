"""A ship held against a quay by a steady side force: bounded, no creep, no energy gained, one collision.

The ship is pushed as a ship model is: exactly, for a constant force in the plane, an impulse at the start of a step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import cos, sin

import numpy as np
import pytest

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.ship.degrees_of_freedom import free_inverse
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import load_ship
from tests.collision.conftest import BOX

Make = Callable[..., str]

FORCE = 3.2e6  # N to the quay: 43 mm/s2, ten times a gale on a large ship's side
QUAY = '[quay]\nkind = "quay"\nshape = "box"\nlength = 800.0\nbreadth = 20.0\nposition = [0.0, 25.5]'  # face at 15.5


class Berthed:
    """A box of 200 x 30 m at a quay to starboard, in surge, sway and yaw, pushed by force(t) [N] abeam in n."""

    def __init__(
        self, ship: str, algorithm: str, *, speed: float = 0.0, twist: float = 0.0, quay: str = QUAY,
        response: str = "pgs", force: Callable[[float], float] = lambda t: FORCE, moves_by: float = 0.5,
        along: float = 0.0, restitution: float = 0.0,
    ) -> None:  # fmt: skip
        """moves_by: share of a step's force in the velocity that she moves by; 1/2 is exact. along: force ahead [N]."""
        self.moves_by, self.along = moves_by, along
        self.model = ShipCollision(("own",))
        p = self.model.parameters
        p.ships[0].ship, p.ships[0].degrees_of_freedom, p.obstacles, p.response = ship, 3, quay, response
        p.substep, p.restitution = 0.05, restitution  # substep [s]
        self.M = load_ship(ship).M
        self.M_inverse = free_inverse(self.M, 3)
        self.algorithm, self.force, self.twist = algorithm, force, twist
        self.x, self.psi = np.array([0.0, 0.0]), 0.0
        self.nu = np.array([speed, 0.1, 0, 0, 0, 0])
        self.applied, self.waiting = np.zeros(6), np.zeros(6)
        self.t, self.contact_work = 0.0, [0.0]
        self._send()
        self.model.initialise()

    def _send(self) -> None:
        i = self.model.inputs.ships[0]
        i.position[:2], i.attitude[2] = self.x.tolist(), self.psi
        i.velocity[:], i.rate[:] = self.nu[:3].tolist(), self.nu[3:].tolist()
        i.impulse_applied[:] = self.applied.tolist()

    def step(self, H: float) -> None:
        self._send()
        self.model.step(self.t, H)
        issued = np.array(self.model.outputs.ships[0].impulse)
        if self.algorithm == "jacobi":
            issued, self.waiting = self.waiting, issued
        nu = self.nu + self.M_inverse @ (issued - self.applied)
        self.contact_work.append(0.5 * (nu @ self.M @ nu - self.nu @ self.M @ self.nu))
        self.applied = issued
        kick = self.M_inverse @ np.array([self.along, self.force(self.t), 0, 0, 0, self.twist]) * H
        moving = nu + self.moves_by * kick
        c, s = cos(self.psi), sin(self.psi)
        self.x = self.x + H * np.array([c * moving[0] - s * moving[1], s * moving[0] + c * moving[1]])
        self.psi += H * moving[5]
        self.nu = nu + kick
        self.t += H

    def run(self, duration: float, H: float) -> np.ndarray:
        """East of CO [m] at every step."""
        places = []
        for _ in range(round(duration / H)):
            self.step(H)
            places.append(self.x[1])
        return np.array(places)


@pytest.fixture
def berthed(make_ship: Make) -> Iterator[Callable[..., Berthed]]:
    made: list[Berthed] = []

    def make(*args: object, **kwargs: object) -> Berthed:
        made.append(Berthed(make_ship("box", BOX), *args, **kwargs))  # type: ignore[arg-type]  # passed on
        return made[-1]

    yield make
    for b in made:
        b.model.close()


MakeBerthed = Callable[..., Berthed]


def is_held(b: Berthed, places: np.ndarray, H: float) -> None:
    """Within the overlap that the delay of a parallel master lets in once; not a millimetre more with time."""
    late = 0.5 + (H * (0.24 + 0.06 * H) if b.algorithm == "jacobi" else 0.0)  # 0.5 m on, she closes at 0.23 m/s
    assert places.max() < late + 2e-3
    second_half = places[len(places) // 2 :]
    assert second_half.max() - second_half.min() < 1e-3
    assert abs(b.psi) < 1e-3
    out = b.model.outputs
    assert out.collision_count == 1
    work = np.cumsum(b.contact_work)
    gained = float(np.max(work - np.minimum.accumulate(work)))
    assert gained < 1e-6 * -work[-1]
    assert out.energy.dissipated > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("response", ["pgs", pytest.param("closed_form", marks=pytest.mark.slow)])
def test_a_minute_at_the_quay(berthed: MakeBerthed, algorithm: str, response: str) -> None:
    b = berthed(algorithm, response=response)
    is_held(b, b.run(60.0, 0.1), 0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("restitution", "times", "H", "response"),
    [
        (0.3, 1.0, 0.5, "pgs"), (0.3, 10.0, 0.1, "closed_form"), (0.3, 10.0, 0.5, "pgs"),
        (0.5, 1.0, 0.5, "closed_form"), (0.5, 10.0, 0.1, "pgs"), (0.5, 10.0, 0.5, "closed_form"),
        (1.0, 1.0, 0.5, "pgs"), (1.0, 10.0, 0.1, "closed_form"), (1.0, 10.0, 0.5, "pgs"),
    ],
)  # fmt: skip
def test_a_ship_that_springs_back_does_not_creep(
    berthed: MakeBerthed, response: str, times: float, H: float, restitution: float
) -> None:
    """Under a parallel master it closes by its acceleration times the step, 4 to 200 mm/s here, and rests still."""
    b = berthed("jacobi", response=response, restitution=restitution, force=lambda t: times * FORCE)
    places = b.run(60.0, H)
    rest = places[len(places) * 2 // 3 :]
    assert rest.max() - rest.min() < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("restitution", [0.5, 1.0])
def test_at_whatever_speed_she_comes_she_does_not_creep(berthed: MakeBerthed, restitution: float) -> None:
    """Her approach at rest is a multiple of half a step's acceleration: what is compared with it must lie between."""
    for k in range(16):
        b = berthed("jacobi", restitution=restitution)
        b.nu[1] += 0.00137 * k
        rest = b.run(60.0, 0.5)[-40:]
        assert rest.max() - rest.min() < 1e-3, k


@pytest.mark.soak
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("H", [0.05, 0.5])
def test_ten_minutes_at_the_quay(berthed: MakeBerthed, algorithm: str, H: float) -> None:
    b = berthed(algorithm)
    is_held(b, b.run(600.0, H), H)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("moves_by", "H", "algorithm"),
    [
        (0.0, 0.1, "gauss-seidel"), (0.5, 0.1, "jacobi"), (1.0, 0.1, "gauss-seidel"),
        (0.0, 0.5, "jacobi"), (0.5, 0.5, "gauss-seidel"), (1.0, 0.5, "jacobi"),
    ],
)  # fmt: skip
def test_however_a_ship_model_integrates_she_stays(
    berthed: MakeBerthed, algorithm: str, H: float, moves_by: float
) -> None:
    """Explicit Euler, exact, semi-implicit Euler; held by friction against a push along the quay as well."""
    b = berthed(algorithm, moves_by=moves_by, along=0.2 * FORCE)
    b.run(40.0, H)
    x = b.x.copy()
    b.run(60.0, H)
    assert np.abs(b.x - x).max() < 1e-5
    assert b.model.outputs.collision_count == 1
    assert b.model.outputs.energy.dissipated > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("inner_steps", [3, -5, 20])
def test_nor_does_she_creep_if_her_model_takes_inner_steps(
    berthed: MakeBerthed, algorithm: str, inner_steps: int
) -> None:
    """Semi-implicit Euler in n steps of H/n, explicit where n is negative: she moves by 1/2 + 1/(2 n) of the gain."""
    b = berthed(algorithm, moves_by=0.5 + 0.5 / inner_steps)
    places = b.run(60.0, 0.2)
    assert abs(places[-1] - places[len(places) // 2]) < 1e-5


@pytest.mark.slow
def test_along_the_quay_friction_slows_her_down(berthed: MakeBerthed) -> None:
    """mu N per time: the deceleration is Coulomb's, she does not creep in, and it stays one collision."""
    b = berthed("gauss-seidel", speed=1.0)
    places = b.run(30.0, 0.1)
    before = b.nu[0]
    b.run(10.0, 0.1)
    assert before - b.nu[0] == pytest.approx(0.3 * FORCE * 10.0 / b.M[0, 0], rel=0.02)
    assert places.max() < 0.502
    assert b.model.outputs.collision_count == 1


@pytest.mark.slow
def test_gusts_do_not_pump_her_through(berthed: MakeBerthed) -> None:
    """A force that swings between nothing and twice as much: stopped at the start of steps only, she would be 13 cm in
    after a minute; what is left is the lag of one step, while no answer may add energy."""
    b = berthed("gauss-seidel", force=lambda t: FORCE * (1.0 + sin(2.0 * t)))
    places = b.run(60.0, 0.1)
    assert places.max() < 0.506
    assert b.model.outputs.collision_count == 1


def test_let_go_she_stays_where_she_is(berthed: MakeBerthed) -> None:
    """When the force ends, what was expected of it must not become speed: no more than a H / 2, once."""
    b = berthed("gauss-seidel", force=lambda t: FORCE if t < 20.0 else 0.0)
    b.run(40.0, 0.1)
    assert abs(b.nu[1]) <= 0.5 * FORCE / b.M[1, 1] * 0.1 * (1 + 1e-6)
    assert max(b.contact_work[-190:]) <= 0.0


@pytest.mark.slow
def test_a_fender_takes_the_side_force(berthed: MakeBerthed) -> None:
    """At rest F = k delta: the compression is that of the force, and nothing is dissipated any more."""
    quay = QUAY.replace("25.5", "26.5") + "\nfender = {stiffness = 8e6, damping = 3e7, thickness = 1.0}"
    b = berthed("gauss-seidel", quay=quay)
    places = b.run(90.0, 0.1)
    assert places[-1] == pytest.approx(0.5 + FORCE / 8e6, abs=6e-3)
    assert b.model.outputs.collision_count == 0
    assert b.model.outputs.fender.stored == pytest.approx(0.5 * FORCE**2 / 8e6, rel=0.02)


@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
def test_a_ship_at_rest_under_a_normal_load_shows_no_friction(berthed: MakeBerthed, algorithm: str) -> None:
    """Flush with the quay: contacts that pull at each other would cancel in sum, and are not shown. The points still
    make up what the ledger issues, the motions that are held included."""
    b = berthed(algorithm)
    b.run(12.0, 0.1)
    pressed = 0
    for _ in range(10):
        before = np.array(b.model.outputs.ships[0].impulse)
        b.step(0.1)
        slots, received = b.model.outputs.contacts, b.model.inputs.ships[0]
        for slot in slots:
            pressed += slot.impulse_normal > 0.0
            assert slot.impulse_tangential <= 1e-6 * slot.impulse_normal
        R, x = rotation(received.attitude), received.position
        J = np.array(b.model.outputs.ships[0].impulse) - before
        shown = [
            (-np.array(s.impulse), np.cross(np.subtract(s.point, x), np.negative(s.impulse)) - s.couple) for s in slots
        ]
        np.testing.assert_allclose(sum(P for P, _ in shown), R @ J[:3], rtol=0, atol=1e-6 * np.abs(J[:3]).max())
        np.testing.assert_allclose(sum(M for _, M in shown), R @ J[3:], rtol=0, atol=1e-4 * np.abs(J[:3]).max())
    assert pressed >= 20


def test_a_wind_that_fluctuates_a_little_counts_no_answer_as_scaled(berthed: MakeBerthed) -> None:
    """A wind that changes by 2 % in 20 s makes contact answer a little too much in half of the substeps."""
    b = berthed("gauss-seidel", force=lambda t: FORCE * (1.0 + 0.02 * sin(0.3 * t)))
    b.model.parameters.substep = 0.02
    b.model.initialise()
    b.run(30.0, 0.1)
    assert b.model.outputs.solver.scaled == 0


@pytest.mark.one_in(2)
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("push", [0.0, 0.1])
def test_contact_is_active_in_the_steps_of_touch_and_the_clearance_bounds_the_rest(
    berthed: MakeBerthed, algorithm: str, push: float
) -> None:
    """A sequential master stops a ship by up to one step's way short of the quay. contact.active is then true for one
    step, and again once a force has closed the gap; the clearance stays below that way. A parallel master lets the
    hulls overlap, and contact stays active."""
    H, speed = 0.1, 0.73
    b = berthed(algorithm, force=lambda t: push * FORCE)
    b.nu[1] = speed
    active, gaps = [], []
    for _ in range(200):
        b.step(H)
        active.append(b.model.outputs.contact_active)
        gaps.append(b.model.outputs.clearance)
    first = active.index(True)
    if algorithm == "gauss-seidel":
        assert not any(active[first + 1 : first + 40])
        assert 0.0 < gaps[first + 1] <= (speed + push * FORCE / b.M[1, 1] * first * H) * H
        assert gaps[-1] <= gaps[first + 1] + 1e-9
        assert any(active[first + 40 :]) == (push > 0.0)
    else:
        assert all(active[first:])
        assert max(gaps[first:]) <= 0.0
