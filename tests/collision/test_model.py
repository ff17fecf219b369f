"""The collision model between coasting ships: conservation, symmetry, textbook impacts, the ledger, the whole state."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from math import pi

import numpy as np
import pytest

from shipcollision_fmu.collision import totals
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.errors import InputError, StepError
from tests.collision.conftest import BOX, FORMS, LANGUAGES, NO_ADDED_MASS, QUICK_LANGUAGES, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

HEAD_ON = [
    {"position": [0.0, 0.0, 0.0], "nu": [2.0, 0, 0, 0, 0, 0]},
    {"position": [200.4, 0.0, 0.0], "attitude": (0, 0, pi), "nu": [1.0, 0, 0, 0, 0, 0]},
]
T_BONE = [  # striking ship heads north into the port side of one that heads east
    {"position": [-115.6, 30.0, 0.0], "nu": [4.0, 0.3, 0, 0, 0, 0.002]},
    {"position": [0.0, 0.0, 0.5], "attitude": (0.02, -0.01, pi / 2), "nu": [2.0, 0, 0, 0, 0, 0]},
]
ALGORITHMS = ("gauss-seidel", "jacobi")


def balance(world: World) -> float:
    """Imbalance of what the ships took, linear and about n's origin, relative to the impulses and their moments.

    With a sequential master the worst of any step; with a parallel one, which takes the first impulse at poses for
    which it was not meant and the rest of it later, of the whole run.
    """
    worst, total, size = 0.0, np.zeros(6), np.zeros(6)
    for rows in world.increments:
        if world.algorithm == "gauss-seidel":
            total, size = np.zeros(6), np.zeros(6)
        for x, R, J in rows:
            P, L = R @ J[:3], R @ J[3:] + np.cross(x, R @ J[:3])
            total += np.concatenate([P, L])
            size = np.maximum(size, np.repeat([np.linalg.norm(P), np.linalg.norm(L)], 3))
        if size.any() and (world.algorithm == "gauss-seidel" or rows is world.increments[-1]):
            worst = max(worst, float((np.abs(total) / size).max()))
    return worst


@LANGUAGES
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_head_on_equal_boxes_end_together(make_ship: Make, world: MakeWorld, algorithm: str) -> None:
    """Plastic central impact: both go on with the mean velocity; lost: 1/2 (m/2) (relative speed)^2, m with water."""
    box = make_ship("box", BOX)
    w = world([box, box], HEAD_ON, algorithm=algorithm).run(2.0, 0.05)
    np.testing.assert_allclose(w.nu[0], [0.5, 0, 0, 0, 0, 0], atol=1e-9)
    np.testing.assert_allclose(w.nu[1], [-0.5, 0, 0, 0, 0, 0], atol=1e-9)
    m = w.M[0][0, 0]
    assert m == pytest.approx(1.05 * 40e6)
    assert w.model.outputs.energy.dissipated == pytest.approx(0.5 * (m / 2) * 3.0**2, rel=1e-9)
    assert w.model.outputs.collision_count == 1
    assert w.model.outputs.impact.closing_speed == pytest.approx(3.0)
    assert w.model.outputs.impact.angle == pytest.approx(pi)


@LANGUAGES
@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_head_on_restitution(make_ship: Make, world: MakeWorld, e: float) -> None:
    box = make_ship("box", BOX)
    w = world([box, box], HEAD_ON, restitution=e, friction=0.0).run(2.0, 0.05)
    assert -w.nu[1][0] - w.nu[0][0] == pytest.approx(3.0 * e, abs=1e-6)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@FORMS
def test_oblique_impact_balances_and_loses_energy(
    make_ship: Make, world: MakeWorld, algorithm: str, response: str
) -> None:
    """What is issued is equal and opposite, with equal and opposite moments; what is applied takes energy away."""
    added = "" if response == "pgs" else NO_ADDED_MASS
    ships = [make_ship("a", added_mass=added, r_bg="[0.0, 0.0, 0.0]"), make_ship("b", added_mass=added, mass=25e6)]
    w = world(ships, T_BONE, algorithm=algorithm, response=response, substep=1 / 60)
    w.run(3.0, 0.05)
    assert w.model.outputs.collision_count == 1
    assert balance(w) < 1e-12
    assert sum(w.work) < -1e6
    assert max(w.work) <= 1e-9 * abs(sum(w.work))


@QUICK_LANGUAGES
def test_sequential_master_conserves_virtual_momentum_to_rounding(make_ship: Make, world: MakeWorld) -> None:
    """Applied at the pose at which it was booked, the impulse changes the sum of R M nu by nothing; the energy that the
    ships lose is the energy that the model says."""
    w = world([make_ship("a"), make_ship("b", mass=25e6)], T_BONE)
    lost_by_ships = 0.0
    for _ in range(60):
        before = [(M, R.copy(), x.copy(), nu.copy()) for M, R, x, nu in zip(w.M, w.R, w.x, w.nu, strict=True)]
        w.step(0.05)
        change, size = np.zeros(6), 1.0
        for (M, R, x, nu), (_, _, J) in zip(before, w.increments[-1], strict=True):
            h = M @ (nu + np.linalg.solve(M, J)) - M @ nu
            P = R @ h[:3]
            change += np.concatenate([P, R @ h[3:] + np.cross(x, P)])
            size = max(size, float(np.linalg.norm(M @ nu)))
        assert np.abs(change[:3]).max() <= 1e-12 * size
        assert np.abs(change[3:]).max() <= 1e-12 * size * 200.0
        lost_by_ships -= w.work[-1]
    assert w.model.outputs.energy.dissipated == pytest.approx(lost_by_ships, rel=1e-9)


@LANGUAGES
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_both_masters_end_at_the_same_velocities(make_ship: Make, world: MakeWorld, algorithm: str) -> None:
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    sequential = world(ships, T_BONE).run(4.0, 0.05)
    other = world(ships, T_BONE, algorithm=algorithm).run(4.0, 0.05)
    for i in range(2):
        change = np.abs(sequential.nu[i] - T_BONE[i]["nu"])
        scale = np.repeat([change[:3].max(), change[3:].max()], 3)
        assert np.all(np.abs(other.nu[i] - sequential.nu[i]) <= 0.02 * scale)


@LANGUAGES
def test_a_communication_step_four_times_longer_ends_alike(make_ship: Make, world: MakeWorld) -> None:
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    fine, coarse = world(ships, T_BONE).run(4.0, 0.025), world(ships, T_BONE).run(4.0, 0.1)
    for i in range(2):
        change = np.abs(fine.nu[i] - T_BONE[i]["nu"])
        scale = np.repeat([change[:3].max(), change[3:].max()], 3)
        assert np.all(np.abs(coarse.nu[i] - fine.nu[i]) <= 0.02 * scale)


@LANGUAGES
def test_no_approach_is_left_after_a_plastic_impact(make_ship: Make, world: MakeWorld) -> None:
    w = world([make_ship("a"), make_ship("b", mass=25e6)], T_BONE)
    clearances = []
    for _ in range(200):
        w.step(0.05)
        clearances.append(w.model.outputs.clearance)
    assert min(clearances) > -0.1  # closing speed 4 m/s x substep 0.01 s, and the turning that follows


@LANGUAGES
def test_swapping_the_ships_changes_names_only(make_ship: Make, world: MakeWorld) -> None:
    a, b = make_ship("a"), make_ship("b", mass=25e6)
    one, two = world([a, b], T_BONE).run(3.0, 0.05), world([b, a], T_BONE[::-1]).run(3.0, 0.05)
    for i in range(2):
        np.testing.assert_allclose(one.nu[i], two.nu[1 - i], atol=1e-6)


@LANGUAGES
def test_mirror_image_mirrors_the_answer(make_ship: Make, world: MakeWorld) -> None:
    mirror_x, mirror_nu = np.array([1, -1, 1]), np.array([1, -1, 1, -1, 1, -1])
    mirrored = [
        {
            "position": np.array(s["position"]) * mirror_x,
            "attitude": tuple(np.array(s.get("attitude", (0, 0, 0))) * [-1, 1, -1]),
            "nu": np.array(s["nu"]) * mirror_nu,
        }
        for s in T_BONE
    ]
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    one, two = world(ships, T_BONE).run(3.0, 0.05), world(ships, mirrored).run(3.0, 0.05)
    for i in range(2):
        np.testing.assert_allclose(two.nu[i], one.nu[i] * mirror_nu, atol=1e-5)


@LANGUAGES
def test_turning_and_shifting_the_world_changes_nothing(make_ship: Make, world: MakeWorld) -> None:
    turn, shift = 1.1, np.array([3000.0, -7000.0, 0.0])
    c, s = np.cos(turn), np.sin(turn)
    R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    moved = [
        {
            "position": R @ np.array(p["position"]) + shift,
            "attitude": tuple(np.array(p.get("attitude", (0, 0, 0))) + [0, 0, turn]),
            "nu": p["nu"],
        }
        for p in T_BONE
    ]
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    one, two = world(ships, T_BONE).run(3.0, 0.05), world(ships, moved).run(3.0, 0.05)
    for i in range(2):
        np.testing.assert_allclose(two.nu[i], one.nu[i], atol=1e-5)


@LANGUAGES
def test_far_ships_are_left_alone_and_clearance_is_capped(make_ship: Make, world: MakeWorld) -> None:
    far = [HEAD_ON[0], {**HEAD_ON[1], "position": [5000.0, 0.0, 0.0]}]
    box = make_ship("box", BOX)
    w = world([box, box], far, clearance_range=150.0).run(1.0, 0.05)
    assert w.model.outputs.clearance == 150.0
    assert not w.model.outputs.contact_active
    np.testing.assert_array_equal(w.applied, np.zeros((2, 6)))


@QUICK_LANGUAGES
def test_ships_in_three_degrees_of_freedom_take_no_roll(make_ship: Make, world: MakeWorld) -> None:
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    flat = [
        {**T_BONE[0], "attitude": (0, 0, 0)},
        {**T_BONE[1], "position": [0.0, 0.0, 0.0], "attitude": (0, 0, pi / 2)},
    ]
    w = world(ships, flat, degrees_of_freedom=3).run(1.0, 0.05)
    for state in w.model.outputs.ships:
        assert state.velocity[2] == 0.0
        assert state.rate[:2] == [0.0, 0.0]
    assert w.model.outputs.collision_count == 1
    assert max(w.work) <= 1e-9 * abs(sum(w.work))


@LANGUAGES
def test_contact_points_add_up_to_the_ledger(make_ship: Make, world: MakeWorld) -> None:
    w = world([make_ship("a"), make_ship("b", mass=25e6)], T_BONE)
    P, energy = np.zeros(3), 0.0
    for _ in range(60):
        w.step(0.05)
        out = w.model.outputs
        step = np.zeros(3)
        for slot in out.contacts[: out.contact_count]:
            assert (slot.ship_a, slot.ship_b, slot.collision) == (1, 2, 1)
            assert np.linalg.norm(slot.normal) == pytest.approx(1.0)
            normal_part = float(np.dot(slot.impulse, slot.normal))
            assert slot.impulse_normal == pytest.approx(
                normal_part, rel=1e-3
            )  # the normal turns with the hull in a step
            assert slot.impulse_tangential <= 0.3 * slot.impulse_normal * (1 + 1e-9)
            step += slot.impulse
            energy += slot.energy
        assert all(slot.ship_a == 0 for slot in out.contacts[out.contact_count :])
        _, R, J = w.increments[-1][1]
        np.testing.assert_allclose(step, R @ J[:3], rtol=1e-9, atol=1e-3)
        P += step
    assert np.linalg.norm(P) > 1e7
    assert energy == pytest.approx(w.model.outputs.energy.dissipated, rel=1e-12)


@LANGUAGES
def test_events_of_one_incident(make_ship: Make, world: MakeWorld) -> None:
    w = world([make_ship("a"), make_ship("b", mass=25e6)], T_BONE).run(8.0, 0.05)
    out = w.model.outputs
    assert out.collision_count == 1
    assert out.impact.angle == pytest.approx(pi / 2, abs=0.02)
    assert out.impact.closing_speed == pytest.approx(4.0, abs=0.3)
    assert out.impact.point[0] == pytest.approx(-15.0, abs=0.3)


# -- what the ship models answer --------------------------------------------------------------------


@LANGUAGES
def test_each_first_contact_is_one_line(make_ship: Make, world: MakeWorld) -> None:
    """Two strike the one between them in the same step: two lines, once. After the first, plastic impact of equal
    ships the one in the middle moves on with 3/2 m/s, so the other closes at 4 + 3/2 m/s."""
    box = make_ship("box", BOX)
    start = [
        {"position": [0.0, y, 0.0], "nu": [0.0, v, 0, 0, 0, 0]}
        for y, v in ((-30.05, 3.0), (0.0, 0.0), (30.1, -4.0))
    ]  # fmt: skip
    w = world([box] * 3, start, degrees_of_freedom=3)
    lines = []
    for _ in range(20):
        w.step(0.1)
        lines.append(w.model.events)
    assert [len(found) for found in lines] == [2] + [0] * 19
    for number, (line, other) in enumerate(zip(lines[0], ("s0", "s2"), strict=True), 1):
        assert line.startswith(f"collision {number}: ")
        assert f"{other} " in line
        assert "s1 " in line
        assert " at t = 0.0" in line
        assert line.endswith("0 deg between their headings")
    assert "closing at 3.00 m/s" in lines[0][0]
    assert "closing at 5.50 m/s" in lines[0][1]


@LANGUAGES
def test_none_issues_one_impact_per_collision(make_ship: Make, world: MakeWorld) -> None:
    """A ship model that ignores the impulse sails on through; it is told once."""
    box = make_ship("box", BOX)
    w = world([box, box], HEAD_ON, feedback="none")
    issued = []
    for _ in range(60):
        w.step(0.05)
        w.nu = [np.array(s["nu"]) for s in HEAD_ON]
        issued.append(w.model.outputs.ships[0].impulse[0])
    assert len(set(issued)) == 2
    assert issued[-1] == pytest.approx(-42e6 * 1.5, rel=1e-6)
    assert w.model.outputs.collision_count == 1


@LANGUAGES
@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("feedback", ["force", "state"])
def test_answers_without_an_echo_are_seen_in_the_velocity(
    make_ship: Make, world: MakeWorld, algorithm: str, feedback: str
) -> None:
    box = make_ship("box", BOX)
    w = world([box, box], HEAD_ON, algorithm=algorithm, feedback=feedback)
    for _ in range(40):
        w.step(0.05)
        w.model.inputs.ships[0].impulse_applied[:] = [0.0] * 6
    np.testing.assert_allclose([w.nu[0][0], -w.nu[1][0]], [0.5, 0.5], atol=1e-9)


def test_a_ship_held_upright_that_adopts_the_state_is_stopped_once(make_ship: Make) -> None:
    """Struck high up by a wall: most of such an impulse goes into roll, which a ship in 3 degrees of freedom does not
    have; what she shows of it is what she can take, and it must not be given twice."""
    model = ShipCollision(("own",))
    model.parameters.ships[0].ship, model.parameters.ships[0].degrees_of_freedom = make_ship("box", BOX), 3
    model.parameters.feedback, model.parameters.friction = "state", 0.0
    model.parameters.obstacles = """
        [wall]
        kind = "quay"
        shape = "box"
        length = 400.0
        breadth = 10.0
        position = [0.0, 21.0]
        top = 30.0
        bottom = -8.0
        """
    own = model.inputs.ships[0]
    own.velocity[:] = [0.0, 1.0, 0.0]
    model.initialise()
    seen = []
    for k in range(40):
        model.step(0.05 * k, 0.05)
        post = model.outputs.ships[0]
        own.position[:], own.attitude[:], own.velocity[:], own.rate[:] = (
            post.position,
            post.attitude,
            post.velocity,
            post.rate,
        )
        seen.append(post.velocity[1])
    model.close()
    assert min(seen) >= -1e-9
    assert max(seen[-5:]) <= 1e-9


@pytest.mark.needs("pybullet")
def test_bullet_answers_a_wall_of_two_parts_as_one(make_ship: Make, world: MakeWorld) -> None:
    """Two pairs that touch at once are not solved together, but the second sees what the first did: no rebound of
    more than half the speed."""
    wall = '[{}]\nkind = "quay"\nshape = "box"\nlength = {}\nbreadth = 10.0\nposition = [{}, 21.0]\n'
    after = []
    for parts in ([("a", 200.0, 0.0)], [("a", 100.0, -50.0), ("b", 100.0, 50.0)]):
        obstacles = "".join(wall.format(*part) for part in parts)
        start = [{"position": (0, 0, 0), "nu": (0, 1, 0, 0, 0, 0)}]
        ship = [make_ship("box", BOX, NO_ADDED_MASS)]
        w = world(ship, start, response="bullet", friction=0.0, restitution=0.0, obstacles=obstacles)
        after.append(0.5 * float(w.run(2.0, 0.05).nu[0] @ w.M[0] @ w.nu[0]) / (0.5 * 40e6))
    assert (
        after[1] < 2.0 * after[0]
    )  # 0.126 against 0.068 of the energy, which is what Bullet's one contact point leaves


# -- the whole state --------------------------------------------------------------------------------


@FORMS
def test_saved_state_repeats_every_bit_in_the_middle_of_a_contact(
    make_ship: Make, world: MakeWorld, response: str
) -> None:
    ships = [make_ship("a", added_mass=NO_ADDED_MASS), make_ship("b", added_mass=NO_ADDED_MASS, mass=25e6)]
    w = world(ships, T_BONE, response=response)
    while not w.model.outputs.contact_active:
        w.step(0.05)
    saved = json.loads(json.dumps(w.model.get_state()))
    w.send()
    runs = []
    for _ in range(3):
        w.model.set_state(saved)
        w.model.step(w.t, 0.05)
        w.model.step(w.t + 0.05, 0.05)
        runs.append(repr(w.model.outputs))
        w.model.step(w.t + 0.1, 0.3)  # something else in between
    assert runs[0] == runs[1] == runs[2]


@LANGUAGES
def test_two_models_do_not_disturb_each_other(make_ship: Make, world: MakeWorld) -> None:
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    alone = world(ships, T_BONE).run(1.0, 0.05)
    one, two = world(ships, T_BONE), world(ships[::-1], HEAD_ON)
    for _ in range(20):
        one.step(0.05)
        two.step(0.05)
    assert repr(one.model.outputs) == repr(alone.model.outputs)


@LANGUAGES
def test_jitter_in_the_step_does_not_reach_the_solver(make_ship: Make, world: MakeWorld) -> None:
    ships = [make_ship("a"), make_ship("b", mass=25e6)]
    exact, jitter = world(ships, T_BONE), world(ships, T_BONE)
    for k in range(30):
        exact.step(0.05)
        jitter.step((k + 1) * 0.05 - k * 0.05)
    np.testing.assert_allclose(jitter.nu, exact.nu, atol=1e-12)


# -- refusals ---------------------------------------------------------------------------------------


@LANGUAGES
@pytest.mark.parametrize(
    ("quantity", "value", "message"),
    [
        ("velocity", float("nan"), r"s1.velocity = \[nan, .*is not finite: check the ship model's output"),
        ("impulse_applied", float("inf"), r"s1.impulse_applied .* is not finite"),
        ("velocity", 1e4, r"s1.velocity is 10000 m/s at t = 0.05 s, above 1000 m/s: check the signal and its unit"),
    ],
)
def test_absurd_inputs_end_the_step_and_change_nothing(
    make_ship: Make, world: MakeWorld, quantity: str, value: float, message: str
) -> None:
    w = world([make_ship("a"), make_ship("b")], T_BONE)
    w.step(0.05)
    before, outputs = w.model.get_state(), repr(w.model.outputs)
    w.send()
    getattr(w.model.inputs.ships[1], quantity)[0] = value
    with pytest.raises(StepError, match=message):
        w.model.step(w.t, 0.05)
    assert (w.model.get_state(), repr(w.model.outputs)) == (before, outputs)


@QUICK_LANGUAGES
@pytest.mark.parametrize("coasting", ["straight", "free"])
@pytest.mark.parametrize(("k", "value"), [(1, 1e300), (3, -1e300), (0, 1e12)])
def test_an_absurd_impulse_applied_is_refused_and_named(
    make_ship: Make, world: MakeWorld, coasting: str, k: int, value: float
) -> None:
    """What is pending then would throw the ship away, or give numbers that are none; zero, as before, is taken."""
    w = world([make_ship("a"), make_ship("b")], T_BONE, coasting=coasting)
    w.step(0.05)
    w.send()
    before, outputs = w.model.get_state(), repr(w.model.outputs)
    w.model.inputs.ships[1].impulse_applied[k] = value
    listed = re.escape(repr(w.model.inputs.ships[1].impulse_applied[:]))
    words = (
        rf"^s1\.impulse_applied = {listed} at t = 0\.05 s leaves an impulse pending that would move the ship at "
        r"\S+ m/s, above 1000 m/s: return the part of s1\.impulse that the ship has applied, at first zero$"
    )
    with pytest.raises(StepError, match=words):
        w.model.step(w.t, 0.05)
    assert (w.model.get_state(), repr(w.model.outputs)) == (before, outputs)
    w.model.inputs.ships[1].impulse_applied[k] = 0.0
    w.model.step(w.t, 0.05)
    assert w.model.get_state() != before


@QUICK_LANGUAGES
@pytest.mark.parametrize("away", [0.0, 3000.0])
def test_a_step_that_the_law_of_a_far_ship_refuses_changes_nothing(
    make_ship: Make, world: MakeWorld, away: float
) -> None:
    """Two ships in contact, or moved apart since, and a buoy far off that spins as if its rate were in another unit."""
    far = {"position": [9000.0, 0.0, 0.0], "nu": [0.1, 0, 0, 0, 0, 0.0]}
    w = world([make_ship("a"), make_ship("b"), "buoy"], [*T_BONE, far], coasting="free", substep=0.05)
    while not w.model.outputs.contact_active:
        w.step(0.05)
    w.send()
    w.model.inputs.ships[0].position[0] -= away
    w.model.inputs.ships[2].rate[2] = 400.0
    before, outputs = w.model.get_state(), repr(w.model.outputs)
    words = r"^s2: a step of 3 s takes 1\.2e\+04 substeps of a ship that coasts, at most 10000: take shorter steps, or"
    with pytest.raises(StepError, match=words):
        w.model.step(w.t + 1.0, 3.0)
    assert (w.model.get_state(), repr(w.model.outputs)) == (before, outputs)
    w.model.inputs.ships[2].rate[2] = 0.4
    w.model.step(w.t + 1.0, 3.0)
    assert w.model.get_state() != before


def test_answers_that_did_not_converge_are_counted_and_warned_of_once(
    make_ship: Make, world: MakeWorld, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Any answer is one, with a limit below zero."""
    monkeypatch.setattr(totals, "CONVERGED", -1.0)
    w = world([make_ship("a"), make_ship("b")], T_BONE)
    before, warned = 0, 0
    for k in range(80):
        w.step(0.05)
        rise, before = w.model.outputs.solver.unconverged - before, w.model.outputs.solver.unconverged
        assert w.model.warning.startswith(
            f"contact was not solved to -1 of the approach {rise} times in the step from t = {0.05 * k:g} s"
            if rise and not warned
            else ""
        )
        assert bool(w.model.warning) == (rise > 0 and not warned)
        warned += rise > 0
    assert 1 < warned < 80


@pytest.mark.parametrize("h", [0.0, -0.1, float("nan"), float("inf")])
def test_impossible_steps_are_refused(make_ship: Make, world: MakeWorld, h: float) -> None:
    w = world([make_ship("a"), make_ship("b")], T_BONE)
    with pytest.raises(StepError, match="both must be finite and the step positive"):
        w.model.step(0.0, h)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("friction", -0.1, "friction = -0.1 is outside 0 to 10: give Coulomb's coefficient"),
        ("restitution", 1.5, "restitution = 1.5 is outside 0 to 1"),
        ("restitution", float("nan"), "restitution = nan is outside 0 to 1"),
        ("substep", 0.0, "substep = 0.0 must be a positive number: leave it out, or give e.g. 0.01 s"),
        ("minimum_separation_time", -1.0, "minimum_separation_time = -1.0 must be a positive number"),
    ],
)
def test_parameters_out_of_range_are_refused(name: str, value: float, message: str) -> None:
    model = ShipCollision()
    setattr(model.parameters, name, value)
    with pytest.raises(InputError, match=message):
        model.initialise()


@pytest.mark.parametrize(("name", "value"), [("response", "ode"), ("feedback", "wish")])
def test_unknown_choices_are_refused(name: str, value: str) -> None:
    model = ShipCollision()
    setattr(model.parameters, name, value)
    with pytest.raises(InputError, match=f"{name} = '{value}' is not known: choose one of"):
        model.initialise()


def test_bullets_scalar_mass_refuses_added_mass(make_ship: Make) -> None:
    model = ShipCollision(("one", "two"))
    model.parameters.response = "bullet"
    for slot in model.parameters.ships:
        slot.ship = make_ship("wet")
    with pytest.raises(InputError, match="response 'bullet' knows a scalar mass only, and one = 'wet' has added mass"):
        model.initialise()


def test_a_state_of_another_kind_is_refused_in_one_line() -> None:
    with pytest.raises(StepError, match=r"^ShipCollision is not initialised: call initialise\(\) before set_state"):
        ShipCollision().set_state({"a": 1})
    model = ShipCollision()
    model.initialise()
    with pytest.raises(StepError, match=r"^the state has no 'exchange': give what get_state\(\) returned$"):
        model.set_state({"a": 1})
    model.close()
