"""native/collision: ledgers, other forces, collisions, contact points and totals beside their Python twins."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.collisions import Collisions
from shipcollision_fmu.collision.contact_points import (
    ContactPoint,
    fill_contacts,
    fit_contact_points,
    merge_contact_point,
    merge_impulses,
)
from shipcollision_fmu.collision.contact_problem import ContactSolution
from shipcollision_fmu.collision.dynamics.contact import Impulse, make_contact
from shipcollision_fmu.collision.dynamics.impulse_ledger import ImpulseLedger
from shipcollision_fmu.collision.dynamics.other_forces import ReceivedState, estimate_other_forces
from shipcollision_fmu.collision.feedback import SHIP_FEEDBACKS
from shipcollision_fmu.collision.interface import CollisionOutputs, ContactOutput, ShipPost
from shipcollision_fmu.collision.totals import Totals
from shipcollision_fmu.ship.frames import Array, rotation
from tests.native.collision.dynamics.test_bodies_and_contacts import draw_bodies, draw_normals, make_body
from tests.native.collision.kernels import evaluate
from tests.native.collision.test_bodies import OBSTACLES, SHIPS, prepare_both
from tests.native.comparison import assert_close

COUNT, STEPS, INSTANTS = 60, 8, 12
CLOSE = 1e-11


def draw_poses(random: np.random.Generator, count: int) -> Array:
    """Places and rotations (count, 12)."""
    attitudes = random.normal(0.0, 1.0, (count, 3)) * [0.1, 0.05, pi]
    return np.hstack([random.normal(0.0, 300.0, (count, 3)), [rotation(a).ravel() for a in attitudes]])


def run_ledger(row: Array) -> list[float]:
    """What the kernel `ledger` gives, by the Python model."""
    feedback, inverse, (reach, H) = SHIP_FEEDBACKS[int(row[0])], row[1:37].reshape(6, 6), row[37:39]
    books, before, last, found = ImpulseLedger(), np.zeros(6), np.zeros(6), list[float]()
    for step in row[39:].reshape(STEPS, 43):
        mode, (x, R), nu, any_applied, J = (
            int(step[0]),
            (step[1:4], step[4:13].reshape(3, 3)),
            *step[13:31].reshape(3, 6),
        )
        if mode == 0:
            nu = nu + inverse @ last
        applied = books.issued if mode == 0 else before if mode == 1 else any_applied
        before = books.issued
        reading = books.read(feedback, x, R, nu, applied, inverse, float(reach), float(H))
        pose = (step[31:34], step[34:].reshape(3, 3)) if mode == 1 else (reading.x, reading.R)
        books.close(reading, J, reading.nu, *pose)
        last = books.issued - before
        found += [
            *reading.nu, *reading.applied_n, *reading.pending, *reading.deficit, reading.one_step_delay is True,
            reading.out_of_range, *books.issued, books.is_settled, True,
        ]  # fmt: skip
    return found


def test_ledgers() -> None:
    random = np.random.default_rng(1)
    modes = random.choice([0, 1, 2], (COUNT, 1), p=[0.4, 0.4, 0.2])
    steps = [
        np.hstack([
            np.where(random.random((COUNT, 1)) < 0.9, modes, 0), draw_poses(random, COUNT),
            random.normal(0.0, 1.0, (COUNT, 6)) * [3.0, 1.0, 0.1, 0.01, 0.01, 0.02],
            random.normal(0.0, 1e6, (COUNT, 6)),
            random.normal(0.0, 1e7, (COUNT, 6)) * random.choice([0.0, 1.0], (COUNT, 1)), draw_poses(random, COUNT),
        ])
        for _ in range(STEPS)
    ]  # fmt: skip
    inverses = draw_bodies(random, COUNT)[:, 12:48]
    reach, H = random.choice([2.0, 100.0], (COUNT, 1)), random.choice([0.05, 0.5], (COUNT, 1))
    rows = np.hstack([1 + np.arange(COUNT)[:, None] % 5, inverses, reach, H, *steps])
    expected = [run_ledger(row) for row in rows]
    assert_close(evaluate("books", "ledger", rows, len(expected[0])), expected, CLOSE)


def test_a_known_delay_outlasts_an_impulse_that_is_lost_in_rounding() -> None:
    """1e-9 N s beside 1e9 N s: the last column but five of a step says whether the delay is known."""
    steps = np.zeros((STEPS, 43))
    steps[:, 0] = 1.0
    steps[:, [4, 8, 12, 34, 38, 42]] = 1.0  # upright
    steps[0, 25], steps[1:, 25] = 1e9, 1e-9
    row = np.concatenate([[1.0], 1e-7 * np.eye(6).ravel(), [100.0, 0.05], steps.ravel()])
    expected = run_ledger(row)
    found = evaluate("books", "ledger", [row], len(expected))[0].reshape(STEPS, -1)
    delays = 24
    assert found[:, delays].tolist() == [0.0] + [1.0] * (STEPS - 1)
    assert_close([found.ravel()], [expected], CLOSE)


@pytest.mark.needs("pybullet")
def test_other_forces(tmp_path: Path) -> None:
    """Of ships that coast by each law, after small and large pushes, and after the time jumped."""
    bodies = prepare_both(tmp_path, OBSTACLES.format(fender=""))
    random = np.random.default_rng(2)
    rows, expected, count = [], [], 60
    for k in range(count):
        body, H = bodies[k % len(SHIPS)], float(random.choice([0.05, 0.5]))
        attitude = (random.normal(0.0, 1.0, 3) * [0.05, 0.02, pi] * (body.free > 3)).tolist()
        nu = random.normal(0.0, 1.0, 6) * [5.0, 1.0, 0.0, 0.0, 0.0, 0.01]
        J = random.normal(0.0, 1.0, 6) * 1e5
        push = random.normal(0.0, 1.0, 6) * [1.0, 1.0, 0.1, 0.01, 0.01, 0.01] * random.choice([0.0, 1e-3, 1.0]) * H
        start = nu + body.inverse_at(attitude) @ J
        position = random.normal(0.0, 100.0, 3)
        if body.coasting is None:
            x, end, after = position + rotation(attitude) @ start[:3] * H, attitude, start
        else:
            law = body.coasting.coast(position.tolist(), attitude, *start.reshape(2, 3).tolist(), H)
            x, end, after = np.array(law[0]), list(law[1]), np.array([*law[2], *law[3]])
        push *= random.choice([0.0, 1.0], p=[0.2, 0.8])
        x = x + 0.5 * H * push[:3]
        jump = float(random.choice([0.0, 0.3], p=[0.9, 0.1]))
        before = ReceivedState(10.0, H, position.tolist(), attitude, nu.tolist(), [0.0] * 6)
        now = ReceivedState(10.0 + H + jump, 0.0, x.tolist(), end, (after + push).tolist(), J.tolist())
        forces = estimate_other_forces(
            before, now, body.inverse_at(attitude), body.bullet.r_bg, body.reach, body.coasting
        )
        rows.append([k % len(SHIPS), body.reach, *flatten(before), *flatten(now)])
        error = None if forces is None else forces.scheme_error
        expected.append(
            [0.0] * 19 if forces is None
            else [1.0, *forces.velocity_bias, *forces.velocity_gain, *(np.zeros(6) if error is None else error)]
        )  # fmt: skip
    assert 0.2 * count < sum(row[0] for row in expected) < count
    assert_close(evaluate("books", "forces", rows, 19), expected, 1e-9)


def flatten(received: ReceivedState) -> list[float]:
    return [received.t, received.H, *received.position, *received.attitude, *received.nu, *received.applied]


def list_points(outputs: Sequence[ContactOutput]) -> list[float]:
    found: list[float] = []
    for each in outputs:
        vectors = (each.point, each.normal, each.r_a, each.r_b, each.impulse, each.couple, each.first)
        found += [x for vector in vectors for x in vector]
        found += [
            each.gap, each.impulse_normal, each.impulse_tangential, each.energy, each.start, each.closing_speed,
            each.angle, each.ship_a, each.ship_b, each.collision, each.scratch,
        ]  # fmt: skip
    return found


def run_contacts(row: Array) -> list[float]:
    """What the kernel `contacts` gives, by the Python model."""
    states = [make_body(each) for each in row[1:157].reshape(3, 52)]
    collisions, totals, found = Collisions(2.0, {1}, {0, 2}), Totals(), list[float]()
    points: list[ContactPoint] = []
    out = CollisionOutputs([ShipPost()])
    for k, instant in enumerate(row[157:].reshape(INSTANTS, 1 + 3 * 14)):
        t, impulses, losses = float(instant[0]), [], []
        collisions.close_old(t)
        for c in instant[1:].reshape(3, 14):
            pair = int(c[0]), int(c[1])
            impulses.append(Impulse(make_contact(*pair, states, c[2:5], c[5:8], float(c[8])), c[9:12]))
            losses.append((float(c[12]), float(c[13])))
            found.append(bool(collisions.split_by_answer([pair])[1]))
        numbers = collisions.register(t, [impulse.contact for impulse in impulses], states)
        points = merge_impulses(points, impulses, losses, numbers)
        if k % 4 == 1:
            points = merge_contact_point(points, ContactPoint.of(impulses[1].contact, impulses[1].P, 3.0, 0, 0))
        totals.add(ContactSolution(impulses, losses[0][0] * 1e-10, k), losses[0][0] * 1e-5, losses)
        colliding, open_pairs = collisions.bodies_in_collision(), 0
        for a, b in collisions.open_pairs():
            open_pairs = 10 * open_pairs + 3 * a + b
        found += [*(i in colliding for i in range(3)), open_pairs]
        if k % 4 == 3:
            outputs = [ContactOutput() for _ in range(int(row[0]))]
            points = fit_contact_points(points, len(outputs))
            fill_contacts(points, outputs)
            found += [any(p.collision for p in points), max(p.scratch for p in points), *list_points(outputs)]
            points = []
            totals.fill(out)
            energy, solver = out.energy, out.solver
            found += [energy.dissipated, energy.normal, energy.tangential, solver.residual]
            found.append(solver.sweeps + 100 * solver.unconverged + 10000 * solver.scaled)
    return [*found, collisions.count, collisions.latest.closing_speed, collisions.latest.angle]


@pytest.mark.parametrize("most", [3, 8])
def test_collisions_contact_points_and_totals(most: int) -> None:
    """Over three communication steps, with more points than there is room for."""
    random = np.random.default_rng(3)
    bodies = [draw_bodies(random, COUNT) for _ in range(3)]
    rows = [np.full((COUNT, 1), most), *bodies]
    places = random.normal(0.0, 2.0, (COUNT, 3)) + [0.0, 0.0, 0.0]
    for k in range(INSTANTS):
        rows.append(np.full((COUNT, 1), 0.3 * k) + random.choice([0.0, 1.5 * k], (COUNT, 1), p=[0.9, 0.1]))
        for _ in range(3):
            pairs = np.array([(0, 1), (0, 2), (1, 2)])[random.integers(0, 3, COUNT)]
            rows += [
                pairs, places + random.normal(0.0, 1.0, (COUNT, 3)), draw_normals(random, COUNT),
                -random.random((COUNT, 1)), random.normal(0.0, 1e6, (COUNT, 3)), random.random((COUNT, 2)) * 20.0,
            ]  # fmt: skip
    inputs = np.hstack(rows)
    inputs[:, 157::43] = np.maximum.accumulate(inputs[:, 157::43], axis=1)
    expected = [run_contacts(row) for row in inputs]
    assert_close(evaluate("books", "contacts", inputs, len(expected[0])), expected, CLOSE)
