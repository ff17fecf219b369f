"""A step of ships that rest against each other and a quay, pressed on by a breeze, takes a bounded work.

Work is counted in Newton's steps and gradient steps of the solvers of last resort, not in time.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision import responses
from shipcollision_fmu.collision.conservative_advancement import limit_substeps
from shipcollision_fmu.collision.geometry.bullet import ITERATIONS, bullet_module
from shipcollision_fmu.collision.geometry.detection import Detector
from shipcollision_fmu.collision.solvers import (
    aclm_fixed_point,
    alart_curnier,
    gauss_seidel,
    impact_process,
    work_limit,
)
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import load_ship
from tests.collision.conftest import BULLET, QUICK_LANGUAGES, World
from tests.ship_files import ship_toml

MakeWorld = Callable[..., World]

QUAY = '[quay]\nkind = "quay"\nshape = "box"\nlength = 600.0\nbreadth = 20.0\nposition = [0.0, 38.2]'
MOST = 400
"""Steps of Newton's method and of the gradient method in a communication step; 51 s were half a million."""


@pytest.fixture
def box(tmp_path: Path) -> str:
    """Path of the file of a box 82.5 x 18.8 m."""
    path = tmp_path / "box.toml"
    path.write_text(
        ship_toml(
            particulars={
                "L_pp": 82.5, "B": 18.8, "T": 7.6, "mass": 4e6, "allow_inconsistent": "a light ship in a deep hull",
            },
            hull={"depth": 12.0},
        )
    )  # fmt: skip
    return str(path)


@pytest.fixture
def last_resort(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """[calls of the equations of Newton's method and of the projection of the gradient method]."""
    calls = [0]

    def counted(owner: object, name: str) -> None:
        plain: Callable[..., Any] = getattr(owner, name)

        def call(*args: object) -> Any:
            calls[0] += 1
            if calls[0] > 20 * MOST:
                pytest.fail(f"more than {20 * MOST} steps of the solvers of last resort")
            return plain(*args)

        monkeypatch.setattr(owner, name, call)

    counted(alart_curnier, "_evaluate_equations")
    counted(aclm_fixed_point, "_project_on_cones")
    return calls


@QUICK_LANGUAGES
@pytest.mark.parametrize(
    ("ships", "substep", "substeps"), [(3, 1e-5, 5000), (5, 2e-5, 2500), (2, 1e-5, 0), (5, 0.01, 0)]
)
def test_pairs_near_each_other_share_the_substeps_of_a_step(
    world: MakeWorld, box: str, ships: int, substep: float, substeps: int
) -> None:
    """Boxes abreast, 0.9 m apart, that go ahead as one: near, and never in touch. 12 jammed ships took 10 000 substeps
    of 0.15 ms natively in a step."""
    start = [{"position": [0.0, 19.7 * i, 0.0], "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]} for i in range(ships)]
    w = world([box] * ships, start, substep=substep, degrees_of_freedom=3)
    w.step(0.1)
    said = (
        f"{ships - 1} pairs of hulls are near each other in the step from t = 0 s by 0.1 s, which has {substeps} "
        f"substeps in place of {0.1 / substep:.0f}: take a longer substep, or shorter steps"
    )
    assert w.model.warning == (said if substeps else "")


def test_usual_substeps_are_never_fewer() -> None:
    """In a harbour with hundreds of ships near each other, and in long steps."""
    assert limit_substeps(10, 0.1, 5000) == 10
    assert limit_substeps(50, 0.5, 5000) == 50
    assert limit_substeps(10_000, 100.0, 5000) == 10_000
    assert limit_substeps(10_000, 1.0, 100) == 1000


SLOW = [pytest.param(e, marks=pytest.mark.slow) for e in (0.05, 0.1, 0.5)]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("restitution", [0.0, *SLOW, 1.0])
def test_ships_pressed_on_each_other_and_a_quay(
    world: MakeWorld, box: str, last_resort: list[int], restitution: float
) -> None:
    """Two flush boxes at a quay with a side force on each; the laws hold in every step."""
    start = [{"position": (0.0, 0.0, 0.0), "nu": np.zeros(6)}, {"position": (3.0, 18.8, 0.0), "nu": np.zeros(6)}]
    w = world([box] * 2, start, obstacles=QUAY, friction=0.3, restitution=restitution)
    force, lost = np.array([0.0, 1e5, 0.0, 0.0, 0.0, 0.0]), 0.0
    for _ in range(25):
        for i in range(2):
            w.nu[i] = w.nu[i] + 0.1 * w.upright[i] @ force
        last_resort[0], had = 0, sum(w.energy(i) for i in range(2))
        w.step(0.1)
        out = w.model.outputs
        assert last_resort[0] <= MOST
        assert w.work[-1] <= 1e-6 * had, "energy from contact"
        assert out.energy.dissipated >= lost - 1e-6 * had
        lost = out.energy.dissipated
        assert max(x[1] for x in w.x) < 18.8 + 1e-2, "in the quay"
    assert out.solver.unconverged <= 2
    assert abs(w.x[1][1] - 18.8) < 1e-2
    assert abs(w.x[0][1]) < 1e-2


def test_two_ships_moored_alongside_at_a_small_restitution(world: MakeWorld, last_resort: list[int]) -> None:
    """Two tankers side by side at a quay in a breeze on their sides, with e = 0.05."""
    B, M = load_ship("kvlcc2").B, 3.2e8
    quay = QUAY.replace("38.2", str(1.5 * B + 10.0))
    start = [{"position": (0.0, 0.0, 0.0), "nu": np.zeros(6)}, {"position": (3.0, B, 0.0), "nu": np.zeros(6)}]
    w = world(["kvlcc2"] * 2, start, obstacles=quay, friction=0.3, restitution=0.05)
    gained = np.array([0.0, 0.1 * 1e6 / M, 0.0, 0.0, 0.0, 0.0])
    for _ in range(10):
        for i in range(2):
            w.nu[i] = w.nu[i] + gained
        last_resort[0] = 0
        w.step(0.1)
        assert last_resort[0] <= MOST
    assert w.model.outputs.solver.unconverged == 0


def test_ships_wedged_in_a_lock(world: MakeWorld, box: str, last_resort: list[int]) -> None:
    """Three flush boxes between two walls, each pushed another way and turned: no energy comes from contact, all
    stay in place, and the work is bounded."""
    walls = QUAY.replace("38.2", str(2.5 * 18.8 + 10.0)) + QUAY.replace("[quay]", "\n[side]").replace(
        "38.2", str(-0.5 * 18.8 - 10.0)
    )
    start = [{"position": (3.0 * i, 18.8 * i, 0.0), "nu": np.zeros(6)} for i in range(3)]
    w = world([box] * 3, start, obstacles=walls, friction=0.6, restitution=0.5)
    push = [np.array([1e5, 1e6, 0.0, 0.0, 0.0, 1e7]), np.array([-1e5, -1e6, 0.0, 0.0, 0.0, -1e7]), np.zeros(6)]
    for _ in range(10):
        for i in range(3):
            w.nu[i] = w.nu[i] + 0.1 * w.upright[i] @ push[i]
        last_resort[0], had = 0, sum(w.energy(i) for i in range(3))
        w.step(0.1)
        assert last_resort[0] <= MOST
        assert w.work[-1] <= 1e-6 * had + 1e-3, "energy from contact"
        assert all(-1e-2 < x[1] - 18.8 * i < 1e-2 for i, x in enumerate(w.x)), "in a wall, or in each other"


@pytest.mark.parametrize("restitution", [0.0, 0.9])
def test_closed_form_follows_a_bounded_length_of_slip(
    world: MakeWorld, box: str, monkeypatch: pytest.MonkeyPatch, restitution: float
) -> None:
    """When the work of a step is spent, a substep still has as many answers as pairs that touch, by plastic impacts.
    What that lacks in restitution, and what it leaves of the approach, is counted."""
    stretches = [0]
    plain = responses.solve_impact_process

    def counted(*args: Any) -> Any:
        process = plain(*args)
        stretches[0] += process.stretches
        return process

    monkeypatch.setattr(responses, "solve_impact_process", counted)
    monkeypatch.setattr(work_limit, "FOUR_SHIPS", 1.0)
    quay = QUAY.replace("38.2", str(3.5 * 18.8 + 10.0))
    start = [{"position": (3.0 * i, 18.8 * i, 0.0), "nu": np.array([0.0, 1.0 - 0.3 * i, 0, 0, 0, 0])} for i in range(4)]
    w = world([box] * 4, start, obstacles=quay, friction=0.3, restitution=restitution, response="closed_form")
    had = sum(w.energy(i) for i in range(4))
    w.step(0.1)
    assert stretches[0] <= 2 * impact_process.MAX_STRETCHES, "one impact, and the events on its path"
    assert w.work[-1] <= 1e-6 * had, "energy from contact"
    assert max(nu[1] for nu in w.nu) < 0.3, "the row runs on into the quay at its first speed of up to 1 m/s"
    assert w.model.outputs.solver.unconverged > 0
    assert w.model.outputs.solver.residual >= max(restitution, 0.1), "a pair of the row is left closing"


def motion_in_n(R: np.ndarray, nu: np.ndarray, r_bg: np.ndarray) -> np.ndarray:
    """Velocity of CG [m/s] and angular velocity [rad/s] in n, (6,), of a twist nu in b with the attitude R."""
    return np.concatenate([R @ (nu[:3] + np.cross(nu[3:], r_bg)), R @ nu[3:]])


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_an_early_end_keeps_momentum_and_moves_each_ship_by_its_impulse(
    world: MakeWorld, box: str, last_resort: list[int], monkeypatch: pytest.MonkeyPatch, restitution: float
) -> None:
    """Three flush boxes closed on each other without any work allowed: the impulses miss the law of contact, and are
    counted so, but act on both ships of a pair alike. No walls, so the momentum of all is constant."""
    monkeypatch.setattr(work_limit, "FOUR_SHIPS", 0.0)
    monkeypatch.setattr(gauss_seidel, "LEAST_NEWTON_STEPS", 1)
    monkeypatch.setattr(gauss_seidel, "LEAST_SWEEPS", 1)
    speed = [0.5, -0.2, -0.9]
    start = [
        {"position": (3.0 * i, 18.8 * i, 0.0), "nu": np.array([0.3 * i, speed[i], 0.0, 0.0, 0.0, 0.002 * i])}
        for i in range(3)
    ]
    w = world([box] * 3, start, friction=0.3, restitution=restitution)
    for _ in range(5):
        last_resort[0] = 0
        w.step(0.02)
        assert last_resort[0] <= 60, "work beyond the bound"
        assert w.work[-1] <= 1e-6 * w.energy(0), "energy from contact"
        total, moment, largest = np.zeros(3), np.zeros(3), 0.0
        for i, ((x, R, J), out) in enumerate(zip(w.increments[-1], w.model.outputs.ships, strict=True)):
            # The world has changed the twist by M^-1 J, the model by what it solved: the same motion in n.
            world_motion = motion_in_n(w.R[i], w.nu[i], w.r_bg[i])
            model_motion = motion_in_n(rotation(out.attitude), np.array([*out.velocity, *out.rate]), w.r_bg[i])
            np.testing.assert_allclose(model_motion, world_motion, rtol=0.0, atol=1e-10)
            total, moment = total + R @ J[:3], moment + np.cross(x, R @ J[:3]) + R @ J[3:]
            largest = max(largest, float(np.abs(J[:3]).max()))
        assert np.abs(total).max() <= 1e-10 * largest
        assert np.abs(moment).max() <= 1e-10 * largest * 80.0
    assert w.model.outputs.solver.unconverged > 0


@pytest.mark.parametrize("response", ["pgs", "closed_form", BULLET])
def test_boats_that_rattle_between_a_ship_and_a_quay(
    world: MakeWorld, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, response: str
) -> None:
    """Three elastic boats at 25 m/s between a ship and a quay, eight pairs, touch some hundred times in 0.1 s. Counted
    are the pairs examined, or the steps of Bullet's own dynamics, each of a fixed count of iterations."""
    no_added_mass = dict.fromkeys(("m_x", "m_y", "m_z", "j_x", "j_y", "j_z", "z_y"), 0.0)
    ships = []
    for name, (L, B, T, mass) in {"ship": (60.0, 10.0, 4.0, 2e6), "boat": (4.0, 1.0, 0.5, 1e3)}.items():
        path = tmp_path / f"{name}.toml"
        particulars = {"L_pp": L, "B": B, "T": T, "mass": mass, "allow_inconsistent": "a box"}
        path.write_text(ship_toml(particulars=particulars, hull={"depth": 2.0 * T}, added_mass=no_added_mass))
        ships.append(str(path))
    examined, steps, iterations = [0], [0], set[int]()
    contacts = Detector.contacts

    def count(counter: list[int], plain: Callable[..., Any]) -> Callable[..., Any]:
        def call(*args: Any, **named: Any) -> Any:
            counter[0] += 1
            return plain(*args, **named)

        return call

    monkeypatch.setattr(Detector, "contacts", count(examined, contacts))
    if response == "bullet":
        bullet = bullet_module()
        step, parameter = bullet.stepSimulation, bullet.setPhysicsEngineParameter

        def set_parameter(**named: Any) -> None:
            iterations.add(named["numSolverIterations"])
            parameter(**named)

        monkeypatch.setattr(bullet, "stepSimulation", count(steps, step))
        monkeypatch.setattr(bullet, "setPhysicsEngineParameter", set_parameter)
    start = [{"position": (0.0, -5.01, 0.0), "nu": np.zeros(6)}] + [
        {"position": (-6.0 + 6.0 * i, 0.51, 0.0), "nu": np.array([3.0, 25.0, 0.0, 0.0, 0.0, 0.3])} for i in range(3)
    ]
    quay = QUAY.replace("38.2", "11.05")
    w = world([ships[0]] + [ships[1]] * 3, start, obstacles=quay, friction=0.3, restitution=1.0, response=response)
    w.step(0.1)
    if response == "bullet":
        assert 50 <= steps[0] <= 250, "two steps for each of five pairs that touch, at 25 instants"
        assert iterations == {ITERATIONS}
    else:
        assert 30 <= examined[0] <= 200, "120 at first touches, 8 pairs at ten substeps"
