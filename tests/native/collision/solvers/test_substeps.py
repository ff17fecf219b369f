"""The substeps of a run, one by one: from contacts to booked impulses, by both languages from the same state."""

from __future__ import annotations

from copy import copy

import numpy as np
import pytest

from shipcollision_fmu import simulate
from shipcollision_fmu.collision import responses
from shipcollision_fmu.collision.contact_problem import ContactCaches, ContactProblem, ContactSolution
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import book_impulses
from shipcollision_fmu.collision.dynamics.passivity import enforce_passivity
from shipcollision_fmu.collision.dynamics.self_stress import remove_self_stress
from shipcollision_fmu.collision.solvers.energy_split import split_losses
from shipcollision_fmu.collision.solvers.warm_start import WarmStarts
from shipcollision_fmu.collision.solvers.work_limit import SHARE
from shipcollision_fmu.ship.frames import Array
from tests.native.collision.kernels import evaluate

CLOSE = 1e-9


def list_body(state: BodyState) -> list[float]:
    """A body as the kernel takes it."""
    optional = [state.velocity_bias, state.scheme_error]
    given = [np.array([part is not None, *(np.zeros(6) if part is None else part)]) for part in optional]
    held = np.zeros(9) if state.held is None else state.held.ravel()
    poses = [state.x_applied, state.R_applied.ravel(), state.x, state.R.ravel()]
    parts = [*poses, state.nu, state.M_inverse.ravel(), *given, np.array([state.fixed, state.held is not None]), held]
    return [float(number) for part in parts for number in np.ravel(part)]


def list_problem(
    problem: ContactProblem, warm: WarmStarts, work: float, solution: ContactSolution, bodies: list[int]
) -> list[float]:
    """A substep as the kernel takes it; bodies: those that touch."""
    contacts, place = [impulse.contact for impulse in solution.impulses], bodies.index
    row = [float(len(bodies)), *(x for body in bodies for x in list_body(problem.states[body])), len(contacts)]
    for c in contacts:
        row += [place(c.a), place(c.b), *c.point, c.gap, *c.axes.ravel()]
    known = [(a, b, at, P) for (a, b), rows in warm.items() if {a, b} <= set(bodies) for at, P in rows]
    row.append(len(known))
    for a, b, at, P in known:
        row += [place(a), place(b), *at, *P]
    return [*row, problem.friction, problem.restitution, work]


def book(problem: ContactProblem, solution: ContactSolution, bodies: list[int]) -> list[Array]:
    """What the kernel gives after its residual and its sweeps, by the Python model, on copies of the bodies."""
    states = [copy(state) for state in problem.states]
    for state in states:
        state.issued = np.zeros(6)
    impulses, taken_off = enforce_passivity(solution.impulses, states)
    booked = book_impulses(impulses, states)
    losses = split_losses(booked, states, problem.friction, problem.restitution)
    shown = remove_self_stress(impulses, states, problem.friction)
    return [
        np.array([taken_off]), np.concatenate([i.P for i in impulses]), np.ravel(losses),
        np.concatenate([i.P for i in shown]), np.concatenate([states[body].nu for body in bodies]),
        np.concatenate([states[body].issued for body in bodies]),
    ]  # fmt: skip


@pytest.mark.slow
def test_each_substep_of_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    solved, missed = 0, []

    def respond(problem: ContactProblem, caches: ContactCaches) -> ContactSolution:
        nonlocal solved
        warm, work = dict(caches.warm_starts), caches.work.lend().left / SHARE
        solution = responses.respond_pgs(problem, caches)
        if not solution.impulses:
            return solution
        bodies = sorted({body for i in solution.impulses for body in (i.contact.a, i.contact.b)})
        expected, k, n = book(problem, solution, bodies), len(solution.impulses), len(bodies)
        row = list_problem(problem, warm, work, solution, bodies)
        found = evaluate("impulses", "substep", [row], 3 + 8 * k + 12 * n)[0]
        twists = found[3 + 8 * k :].reshape(n, 2, 6)
        native = np.split(found[2 : 3 + 8 * k], [1, 1 + 3 * k, 1 + 5 * k])
        for one, other in zip([*native, twists[:, 0].ravel(), twists[:, 1].ravel()], expected, strict=True):
            missed.append(float(np.abs(one - other).max()) / (float(np.abs(other).max()) or 1.0))
        solved += solution.sweeps > 0
        return solution

    monkeypatch.setitem(responses.RESPONSES, "pgs", respond)
    simulate("kvlcc2_crossing", in_process=True)
    assert solved > 20
    assert max(missed) <= CLOSE
