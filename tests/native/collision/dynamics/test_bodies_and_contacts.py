"""native/collision/dynamics: bodies, chords and contacts beside their Python twins, on random input."""

from __future__ import annotations

from math import pi

import numpy as np

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.chord import find_chord
from shipcollision_fmu.collision.dynamics.contact import (
    Contact,
    Impulse,
    book_impulses,
    make_contact,
    mean_velocity,
)
from shipcollision_fmu.collision.dynamics.contact_frame import contact_axes
from shipcollision_fmu.collision.dynamics.other_forces import OtherForces
from shipcollision_fmu.ship.frames import Array, rotation
from tests.native.collision.kernels import evaluate
from tests.native.comparison import assert_close

COUNT = 200
BODY = 52
"""Numbers of a body: position, attitude, nu, M_inverse, r_bg, and whether it is fixed."""
CLOSE = 1e-12
"""Sums of products of a hull's length and a force lose digits in the small one of their results."""


def draw_normals(random: np.random.Generator, count: int) -> Array:
    """Unit vectors, some of them steep."""
    normals = random.normal(0.0, 1.0, (count, 3)) * np.where(np.arange(count)[:, None] % 3, 1.0, [0.1, 0.1, 1.0])
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))


def draw_bodies(random: np.random.Generator, count: int) -> Array:
    """Ships (count, BODY) that turn or do not, with and without an arm of CG, and obstacles among them."""
    position = random.normal(0.0, 200.0, (count, 3))
    attitude = random.normal(0.0, 1.0, (count, 3)) * [0.3, 0.1, pi]
    nu = random.normal(0.0, 1.0, (count, 6)) * [5.0, 1.0, 0.1, 0.02, 0.01, 0.03]
    nu[::4, 3:] = 0.0
    factors = random.normal(0.0, 1.0, (count, 6, 6)) * [1.0, 0.8, 0.7, 0.02, 0.01, 0.01]
    inverse = 1e-8 * np.einsum("nki,nkj->nij", factors, factors)
    r_bg = random.normal(0.0, 1.0, (count, 3)) * [10.0, 0.1, 5.0]
    r_bg[::3] = 0.0
    fixed = (np.arange(count) % 7 == 0)[:, None]
    inverse[fixed[:, 0]], nu[fixed[:, 0]] = 0.0, 0.0
    return np.hstack([position, attitude, nu, inverse.reshape(-1, 36), r_bg, fixed])


def make_body(row: Array) -> BodyState:
    """The state of a row of draw_bodies."""
    state = BodyState.at(row[:3], row[3:6], row[6:12], row[12:48].reshape(6, 6), row[48:51])
    state.fixed = bool(row[51])
    return state


def list_twists(state: BodyState) -> list[float]:
    velocity, omega = state.predicted_motion()
    return np.concatenate([
        state.nu, state.nu_mean, state.nu_path, state.nu_energy, state.issued, state.twist_at_predicted_pose(), state.x,
        state.R.ravel(), velocity, np.zeros(3) if omega is None else omega,
    ]).tolist()  # fmt: skip


def test_axes_of_contacts() -> None:
    normals = draw_normals(np.random.default_rng(1), COUNT)
    assert_close(evaluate("dynamics", "frame", normals, 9), [contact_axes(n).ravel() for n in normals], 1e-15)


def test_chords() -> None:
    random = np.random.default_rng(2)
    bodies, H = draw_bodies(random, COUNT), 10.0 ** random.uniform(-2.0, 1.0, (COUNT, 1))
    attitudes = bodies[:, 3:6] + random.choice([0.0, 1e-9, 0.1, 0.8], (COUNT, 1)) * random.normal(0.0, 1.0, (COUNT, 3))
    places = bodies[:, :3] + random.normal(0.0, 3.0, (COUNT, 3))
    rotations = [rotation(row[3:6]) for row in bodies]
    inputs = np.hstack([
        bodies[:, :3], np.reshape(rotations, (-1, 9)), places, attitudes, bodies[:, 48:51], bodies[:, 6:12], H,
    ])  # fmt: skip
    expected = [
        np.concatenate(find_chord((x.tolist(), R.tolist()), place, attitude, body[48:51], body[6:12], float(h)))
        for x, R, place, attitude, body, (h,) in zip(
            bodies[:, :3], rotations, places, attitudes, bodies, H, strict=True
        )
    ]
    assert_close(evaluate("dynamics", "chord", inputs, 12), expected, CLOSE)


def run_body(row: Array) -> list[float]:
    """What the kernel `body` gives, by the Python model."""
    state, rest = make_body(row), row[BODY:]
    calls, bias, error, end, H = int(rest[0]), rest[1:7], rest[7:13], rest[13:25].reshape(4, 3), float(rest[25])
    J, twist = rest[26:32], rest[32:38]
    if calls & 1:
        state.expect(OtherForces(bias, bias, error if calls & 2 else None))
    if calls & 4:
        x, attitude, velocity, rate = end.tolist()
        state.follow((x, attitude, velocity, rate), state.nu.tolist(), H)
    state.book([J])
    state.advance(0.25 * H, 3)
    x_before, R_before = state.pose_before
    x_after, R_after = state.pose_after(twist, H)
    found = [*list_twists(state), *x_before, *R_before.ravel(), *x_after, *R_after.ravel()]
    if calls & 8:
        state.apply_at(*state.pose_after(state.nu, H), state.M_inverse)
        state.book([J])
        state.advance(0.5 * H)
    return [*found, *list_twists(state), *state.in_body(twist[:3])]


def test_bodies() -> None:
    random = np.random.default_rng(3)
    bodies = draw_bodies(random, COUNT)
    bodies[::5, 48:51] = 0.0
    H = 10.0 ** random.uniform(-2.0, 0.5, (COUNT, 1))
    moved = bodies[:, :12] + H * random.normal(0.0, 1.0, (COUNT, 12)) * (
        [5.0] * 3 + [0.05] * 3 + [0.3] * 3 + [0.01] * 3
    )
    inputs = np.hstack([
        bodies, np.arange(COUNT)[:, None] % 16,
        random.normal(0.0, 0.1, (COUNT, 12)) * ([1.0, 1.0, 1.0, 0.1, 0.1, 0.1] * 2),
        moved, H, random.normal(0.0, 1e7, (COUNT, 6)), random.normal(0.0, 0.1, (COUNT, 6)),
    ])  # fmt: skip
    expected = [run_body(row) for row in inputs]
    assert_close(evaluate("dynamics", "body", inputs, len(expected[0])), expected, CLOSE)


def list_contact(contact: Contact) -> list[float]:
    parts = (contact.axes, contact.r_a, contact.r_b, contact.at, contact.G_a, contact.G_b)
    return np.concatenate([part.ravel() for part in parts]).tolist()


def run_contacts(row: Array) -> list[float]:
    """What the kernel `contacts` gives, by the Python model."""
    states = [make_body(row[:BODY]), make_body(row[BODY : 2 * BODY])]
    for state in states:
        state.expect(OtherForces(state.nu_received + state.nu_received, state.nu, state.nu_received))
        state.advance(1.5)
    found, impulses = [], []
    for each in row[2 * BODY :].reshape(2, 10):
        contact = make_contact(0, 1, states, each[:3], each[3:6], float(each[6]))
        impulses.append(Impulse(contact, each[7:]))
        found += [*list_contact(contact), *mean_velocity(contact, states)]
    for booked in book_impulses(impulses, states):
        found += [*booked.before, *booked.after, booked.lost]
    for state in states:
        found += [*state.nu, *state.issued]
    return found


def test_contacts() -> None:
    random = np.random.default_rng(4)
    contacts = [
        np.hstack([
            random.normal(0.0, 200.0, (COUNT, 3)), draw_normals(random, COUNT), -random.random((COUNT, 1)),
            random.normal(0.0, 1e7, (COUNT, 3)) * random.choice([0.0, 1.0], (COUNT, 1), p=[0.2, 0.8]),
        ])
        for _ in range(2)
    ]  # fmt: skip
    inputs = np.hstack([draw_bodies(random, COUNT), draw_bodies(random, COUNT)[::-1], *contacts])
    expected = [run_contacts(row) for row in inputs]
    assert_close(evaluate("dynamics", "contacts", inputs, len(expected[0])), expected, CLOSE)
