"""Energy lost along the normal and by friction: neither is negative, and both are those of the impact process.

The sum is the kinetic energy that the ships lose. Of P.(v- + v+)/2 the part across the normal is no work of friction
where the slip stops or turns within the impact: it was 0.06 of 13.7 MJ, and negative in other runs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shipcollision_fmu.collision.contact_problem import ContactCaches, ContactProblem
from shipcollision_fmu.collision.dynamics.contact import book_impulses, make_contact
from shipcollision_fmu.collision.dynamics.passivity import enforce_passivity
from shipcollision_fmu.collision.responses import RESPONSES
from shipcollision_fmu.collision.solvers.energy_split import split_losses
from shipcollision_fmu.collision.solvers.impact_process import estimate_losses, solve_impact_process
from tests.collision.conftest import BOX, World
from tests.collision.impacts import Impact, floats, impacts
from tests.collision.test_held_motions import WEST, Touching, strike

Make, MakeWorld = Callable[..., str], Callable[..., World]
RESPONSE = st.sampled_from(["pgs", "closed_form"])


def answer(impact: Impact, places: list[np.ndarray], response: str) -> tuple[float, float, float]:
    """Energy lost along the normal and by friction, and what both ships lose, of contacts at places about the point."""
    states = [impact.a.state(), impact.b.state()]
    contacts = [make_contact(0, 1, states, impact.point + place, impact.normal, 0.0) for place in places]
    problem = ContactProblem([(0, 1)], states, Touching(contacts), [], impact.mu, impact.e, 0.01)  # type: ignore[arg-type]  # stands for a Detector
    impulses, _ = enforce_passivity(RESPONSES[response](problem, ContactCaches()).impulses, states)
    booked = book_impulses(impulses, states)
    losses = np.array(split_losses(booked, states, impact.mu, impact.e))
    ships = [replace(ship, nu=state.nu) for ship, state in zip((impact.a, impact.b), states, strict=True)]
    along, across = losses.sum(axis=0).tolist()
    return along, across, impact.scale - sum(ship.energy for ship in ships)


@given(impacts(), st.lists(st.tuples(floats(-8, 8), floats(-8, 8), floats(-6, 6)), min_size=1, max_size=3), RESPONSE)
def test_neither_part_is_negative_and_both_are_what_the_ships_lose(
    impact: Impact, places: list[tuple[float, float, float]], response: str
) -> None:
    along, across, lost = answer(impact, [np.zeros(3), *map(np.array, places[1:])], response)
    rounding = 1e-9 * impact.scale
    assert along >= -rounding
    assert across >= -rounding
    assert along + across == pytest.approx(lost, rel=1e-9, abs=1e-3 * rounding)


@given(impacts(degrees_of_freedom=(6,)), RESPONSE)
def test_of_one_contact_they_are_in_the_ratio_of_the_impact_process(impact: Impact, response: str) -> None:
    _, across, lost = answer(impact, [np.zeros(3)], response)
    process = solve_impact_process(impact.W, impact.v, impact.mu, impact.e)
    parts = process.energy_normal + process.energy_tangential
    assume(parts > 1e-9 * impact.scale < lost)
    assert across / lost == pytest.approx(process.energy_tangential / parts, abs=0.01)


@given(impacts())
def test_the_share_of_friction_is_estimated_to_one_per_cent(impact: Impact) -> None:
    """Only the ratio is used: the sum is that of the ships, and is estimated to a tenth."""
    estimate = np.array(estimate_losses(impact.W_friction, impact.v, impact.mu, impact.e))
    process = solve_impact_process(impact.W_friction, impact.v, impact.mu, impact.e)
    exact = np.array([process.energy_normal, process.energy_tangential])
    assert estimate.min() >= -1e-12 * exact.sum()
    assume(exact.sum() > 1e-9 * impact.scale)
    assert estimate[1] / estimate.sum() == pytest.approx(exact[1] / exact.sum(), abs=0.01)
    assert estimate.sum() == pytest.approx(exact.sum(), rel=0.1)


def test_losses_of_a_slip_that_keeps_its_direction_are_exact() -> None:
    """By hand, in the plane: slip of 1 m/s stops, and the contact sticks, or slides back."""
    W, v = np.array([[1.0, 0.4], [0.4, 0.5]]), np.array([-5.0, -1.0])
    for mu in (0.1, 0.3, 0.9):
        p = 1.0 / (0.4 + 0.5 * mu)  # until the slip has stopped
        by_friction = 0.5 * mu * p
        v_n = -5.0 + p * (1.0 + 0.4 * mu)
        rest = 0.0
        if mu < 0.8:  # slides back
            rest = -v_n / (1.0 - 0.4 * mu)
            by_friction += 0.5 * mu * rest * rest * (0.4 - 0.5 * mu)
            normal = 0.5 * p * (5.0 - v_n) - 0.5 * rest * v_n
        else:
            normal = 0.5 * p * (5.0 - v_n) + 0.5 * v_n * v_n / (1.0 - 0.4 * 0.4 / 0.5)
        np.testing.assert_allclose(estimate_losses(W, v, mu, 0.0), (normal, by_friction), rtol=1e-12)


@pytest.mark.parametrize("free", [4, 6])
def test_a_raked_stem_that_stops_sliding_on_a_side(make_ship: Make, world: MakeWorld, free: int) -> None:
    """Both parts in a run of the model; the sum is what the ships lose. In 4 degrees of freedom friction lost -36 of
    549 MJ."""
    w = strike(make_ship, world, free, 0.3, 8.0, 30.0, WEST, 15.0, "pgs")
    energy = w.model.outputs.energy
    assert 0.005 * energy.dissipated < energy.tangential < 0.2 * energy.dissipated
    assert energy.normal + energy.tangential == pytest.approx(energy.dissipated, rel=1e-12)
    assert energy.dissipated == pytest.approx(-sum(w.work), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("algorithm", "response"), [("gauss-seidel", "pgs"), ("jacobi", "pgs"), ("jacobi", "closed_form")]
)
@pytest.mark.parametrize("restitution", [0.0, 0.8])
def test_neither_part_falls_in_a_run_of_three_ships(
    make_ship: Make, world: MakeWorld, algorithm: str, response: str, restitution: float
) -> None:
    """One ship pushes another into a third, oblique and rough, under both masters."""
    ships = [make_ship(name, BOX) for name in ("one", "two", "three")]
    start = [
        {"position": (-203.0, 4.0, 0), "attitude": (0, 0, 0.05), "nu": (5, 0.4, 0, 0, 0, 0.003)},
        {"position": (0, 0, 0), "nu": (0, 0, 0, 0, 0, 0)},
        {"position": (118.5, 98.0, 0), "attitude": (0, 0, pi / 2), "nu": (0, -0.2, 0, 0, 0, 0)},
    ]
    w = world(ships, start, degrees_of_freedom=3, friction=0.4, restitution=restitution, response=response,
              algorithm=algorithm)  # fmt: skip
    normal, tangential = [0.0], [0.0]
    for _ in range(60):
        w.step(0.1)
        normal.append(w.model.outputs.energy.normal)
        tangential.append(w.model.outputs.energy.tangential)
    total = w.model.outputs.energy.dissipated
    assert w.model.outputs.collision_count == 2
    assert min(np.diff(normal).min(), np.diff(tangential).min()) >= -1e-9 * total
    assert tangential[-1] > 0.0
