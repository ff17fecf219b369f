"""Ships whose heave and pitch are held, in 3 and 4 degrees of freedom: friction acts as on hulls that give way.

Friction on the side of a hull that rolls is vertical. In 6 degrees of freedom both ships give way to it in heave and
pitch. Against hulls that do not, friction pinned the struck side: no roll at all at a friction of 0.3.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.contact_problem import ContactCaches, ContactProblem
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import Contact, make_contact
from shipcollision_fmu.collision.dynamics.delassus import held_delassus
from shipcollision_fmu.collision.dynamics.passivity import enforce_passivity
from shipcollision_fmu.collision.responses import RESPONSES
from shipcollision_fmu.collision.solvers import held_motions
from shipcollision_fmu.collision.solvers.held_motions import yield_to_friction
from shipcollision_fmu.collision.solvers.work_limit import WorkLimit
from shipcollision_fmu.ship.frames import rotation
from tests.collision.conftest import World
from tests.collision.impacts import Array, Impact, floats, impacts
from tests.collision.solvers.test_gauss_seidel import random_patch

Make, MakeWorld = Callable[..., str], Callable[..., World]

LOW = 'shape = "box"\ndepth = {depth}'
HIGH = 'shape = "parametric"\ndepth = 26.0\nbow_length = 40.0\nstern_length = 50.0\nstem_rake_deg = {rake}'
WEST = pi / 2


def strike(
    make_ship: Make, world: MakeWorld, free: int, friction: float, height: float, north: float, heading: float,
    rake: float, response: str,
) -> World:  # fmt: skip
    """A stem at 7 m/s strikes the side of a ship at rest `height` above CG, after the step of the impact."""
    ships = [make_ship("struck", LOW.format(depth=10.0 + height)), make_ship("striking", HIGH.format(rake=rake))]
    way = 114.0 / sin(heading)
    start = [
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {
            "position": (north - way * cos(heading), -15.0 - way * sin(heading), 0),
            "attitude": (0, 0, heading), "nu": (7, 0, 0, 0, 0, 0),
        },
    ]  # fmt: skip
    w = world(ships, start, degrees_of_freedom=free, friction=friction, restitution=0.0, response=response)
    while not w.model.outputs.collision_count and w.t < 8.0:
        w.step(max(0.01, 0.9 * w.model.outputs.clearance / 7.0))
    assert w.model.outputs.contact_active
    return w


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("response", "height", "north", "heading", "rake"),
    [
        ("pgs", 3.0, 0.0, WEST, 2.0), ("pgs", 8.0, 30.0, WEST, 15.0), ("pgs", 8.0, -20.0, 1.0, 15.0),
        ("closed_form", 3.0, 0.0, WEST, 2.0),
    ],
)  # fmt: skip
def test_a_struck_ship_rolls_in_four_degrees_of_freedom_as_in_six(
    make_ship: Make, world: MakeWorld, response: str, height: float, north: float, heading: float, rake: float
) -> None:
    """Over friction of 0 to 0.6, within a quarter. With a nearly plumb stem, the energy lost within 6 %."""
    for friction in (0.0, 0.1, 0.3, 0.6):
        four, six = (
            strike(make_ship, world, free, friction, height, north, heading, rake, response) for free in (4, 6)
        )
        rolls = [float(w.nu[0][3]) for w in (four, six)]
        assert abs(rolls[1]) > 0.01
        assert rolls[0] == pytest.approx(rolls[1], rel=0.25), friction
        lost = [w.model.outputs.energy.dissipated for w in (four, six)]
        assert lost[0] == pytest.approx(lost[1], rel=0.06 if rake == 2.0 else 0.2), friction


# -- the law, over random ships ---------------------------------------------------------------------------------------


class Touching:
    """A detector for one pair, whose contacts are given."""

    def __init__(self, contacts: Sequence[Contact]) -> None:
        self._contacts = list(contacts)

    def contacts(self, *_: object) -> list[Contact]:
        return self._contacts


def respond(impact: Impact, response: str) -> Array:
    """Impulse (3,) in n on ship b by a response of the model, made passive as the model does."""
    states: list[BodyState] = [impact.a.state(), impact.b.state()]
    contact = make_contact(0, 1, states, impact.point, impact.normal, 0.0)
    problem = ContactProblem([(0, 1)], states, Touching([contact]), [], impact.mu, impact.e, 0.01)  # type: ignore[arg-type]  # stands for a Detector
    impulses, _ = enforce_passivity(RESPONSES[response](problem, ContactCaches()).impulses, states)
    return impulses[0].P


HELD = {"degrees_of_freedom": (3, 4)}
RESPONSE = st.sampled_from(["pgs", "closed_form"])


@given(impacts())
def test_held_motions_add_what_free_ones_would(impact: Impact) -> None:
    """The operator from three plain numbers of a contact is that from the 6 x 6 inverse; none in 6 degrees of
    freedom."""
    states = [impact.a.state(), impact.b.state()]
    H = held_delassus([make_contact(0, 1, states, impact.point, impact.normal, 0.0)], states)
    if impact.a.free == 6:
        assert H is None
        return
    assert H is not None
    np.testing.assert_allclose(H, impact.H, rtol=0.0, atol=1e-9 * np.abs(impact.H).max())


@given(impacts(**HELD, slope=st.just(0.0)))
def test_against_a_level_normal_vertical_friction_meets_all_motions(impact: Impact) -> None:
    down = np.array([0.0, 0.0, 1.0])
    free = 0.0
    for ship in (impact.a, impact.b):
        g = ship.jacobian(impact.point).T @ down
        free += float(g @ ship.axes @ np.linalg.inv(ship.M) @ ship.axes.T @ g)
    u = impact.axes @ down
    assert u @ impact.W_friction @ u == pytest.approx(free, rel=1e-9)


@given(impacts(**HELD), floats(-pi, pi), st.tuples(floats(-1e3, 1e3), floats(-1e3, 1e3)))
def test_the_impulse_turns_swaps_and_mirrors_at_any_heel_slope_and_friction(
    impact: Impact, turn: float, shift: tuple[float, float]
) -> None:
    R = rotation([0.0, 0.0, turn])
    P = respond(impact, "pgs")
    for other, change in (
        (impact.swapped(), -np.eye(3)), (impact.mirrored(), np.diag([1.0, -1.0, 1.0])),
        (impact.moved(R, np.array([*shift, 0.0])), R),
    ):  # fmt: skip
        np.testing.assert_allclose(respond(other, "pgs"), change @ P, rtol=0.0, atol=1e-7 * np.linalg.norm(P))


@given(impacts(**HELD), floats(-5.0, 5.0), floats(-5.0, 5.0), RESPONSE)
def test_the_impulse_is_that_of_a_moving_frame(impact: Impact, north: float, east: float, response: str) -> None:
    """Galilei: one level velocity more for both ships."""
    faster = replace(impact, **{
        name: replace(ship, nu=ship.nu + np.concatenate([ship.R.T @ [north, east, 0.0], np.zeros(3)]))
        for name, ship in (("a", impact.a), ("b", impact.b))
    })  # fmt: skip
    P = respond(impact, response)
    np.testing.assert_allclose(respond(faster, response), P, rtol=0.0, atol=1e-6 * np.linalg.norm(P))


@given(impacts(**HELD), RESPONSE)
def test_no_approach_is_left_and_no_energy_gained(impact: Impact, response: str) -> None:
    """With the ships' own motions and energy; friction stays in its cone."""
    P = impact.axes @ respond(impact, response)
    after, size = impact.after(P), np.linalg.norm(impact.v)
    assert after.scale - impact.scale <= 1e-9 * impact.scale
    assert np.hypot(*P[1:]) <= (impact.mu + 1e-9) * P[0]
    if impact.e == 0.0 and abs(impact.normal[2]) < 0.3:
        assert abs(after.v[0]) <= 1e-9 * size


@given(impacts(**HELD, mu=st.just(0.0)), RESPONSE)
def test_without_friction_it_is_the_impact_of_the_free_motions(impact: Impact, response: str) -> None:
    P = impact.axes @ respond(impact, response)
    assert P[0] == pytest.approx(-(1.0 + impact.e) * impact.v[0] / impact.W[0, 0], rel=1e-9)


@given(impacts(**HELD, mu=floats(0.0, 0.4), slope=st.just(0.0) | floats(-0.3, 0.3)), floats(-1e-7, 1e-7), RESPONSE)
def test_the_impulse_is_continuous_in_the_slope_of_the_normal(impact: Impact, more: float, response: str) -> None:
    """Through the level, too, where the slip of held motions vanishes."""
    across = np.cross([impact.normal[1], -impact.normal[0], 0.0], impact.normal)
    tilted = impact.normal + more * across / np.linalg.norm(across)
    P, moved = respond(impact, response), respond(replace(impact, normal=tilted), response)
    np.testing.assert_allclose(moved, P, rtol=0.0, atol=1e-4 * np.linalg.norm(P))


def test_the_slip_of_hulls_that_heel_little_is_as_exact_as_it_needs_to_be(monkeypatch: pytest.MonkeyPatch) -> None:
    """P_n of a jam is solved less exactly the smaller H_tn is; H_tn P_n is the same to 1e-7 of the approach, at a part
    of the work."""
    for seed in range(6):
        W, v = random_patch(seed, 9, scatter=0.02)
        v[0::3] = -np.abs(v[0::3])
        H = 1e-3 * random_patch(seed + 100, 9, scatter=0.3)[0]
        H *= np.diag(W).max() / np.diag(H).max() * 1e-3
        work, exact_work = WorkLimit(1e6), WorkLimit(1e6)
        slip = yield_to_friction(W, v, 0.3, H, None, work).slip
        with monkeypatch.context() as exact:
            exact.setattr(held_motions, "SLIP_TOLERANCE", 1e-300)
            exact_slip = yield_to_friction(W, v, 0.3, H, None, exact_work).slip
        assert np.abs(exact_slip).max() > 0.0
        np.testing.assert_allclose(slip, exact_slip, rtol=0.0, atol=1e-7 * -v[0::3].min())
        assert work.left >= exact_work.left
