"""The rival responses to contact: how two bodies answer. One signature, one table.

    respond(problem, caches) -> solution        impulses on body b at the contact points of this substep, in n

pgs          Projected Gauss-Seidel on the 6x6 masses: all contacts at once, friction cone, iterated to a residual
closed_form  the impact process of one contact: one resultant contact per pair, its impact followed along the slip
             (Keller, Stronge; impact_process.py)
bullet       Bullet's own dynamics with a scalar mass and Bullet's own contacts: what Guan et al. 2014 ran
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ..ship.frames import Array
from .contact_problem import ContactCaches, ContactProblem, ContactSolution
from .dynamics.body_state import BodyState
from .dynamics.contact import Contact, Impulse, make_contact
from .dynamics.delassus import approach_velocities, delassus, held_delassus
from .geometry.adapter import choose_adapter
from .geometry.bullet import BulletAdapter, require_dynamics
from .solvers.gauss_seidel import solve_gauss_seidel
from .solvers.held_motions import yield_to_friction
from .solvers.impact_process import solve_impact_process
from .solvers.poisson_restitution import LEAST_REBOUNDING_APPROACH, solve_poisson_impact
from .solvers.touching_pair import TouchingPair
from .solvers.warm_start import guess_impulses, keep_impulses

__all__ = ["ADAPTERS", "RESPONSES", "require_adapter", "respond_bullet", "respond_closed_form", "respond_pgs"]

AT_REST = 1e-12
"""Approach [m/s] that is the rounding left by a solved contact. With zero, contacts at rest would be solved again in
every substep, at the cost of an impact."""


MAX_ANSWERS = 10
"""Impacts per pair that touches, in one substep. Fewer leave a row of ships closing, which then depends on the order of
the answers; more only cost time, since the next substep goes on."""

PRESSING = 2.25
"""Communication steps of other forces whose approach is no impact, though it exceeds LEAST_REBOUNDING_APPROACH. Under a
parallel master a ship pressed to a quay closes by multiples of half a step's, up to that of two: between multiples, so
that rounding does not choose. With 0.6 such a ship springs back in every step, and creeps into the quay."""

AT_REST_SHARE = 1e-6
"""Approach, as a share of the largest of the substep, that is left to the next substep."""


def respond_pgs(problem: ContactProblem, caches: ContactCaches) -> ContactSolution:
    """All contacts of all pairs solved together by block Projected Gauss-Seidel (gauss_seidel.py)."""
    pairs, states = problem.pairs, problem.states
    contacts = [c for a, b in pairs for c in problem.detector.contacts(a, b, states, caches.last_normals)]
    if not contacts:
        return ContactSolution([])
    velocity = approach_velocities(contacts, states)
    if velocity[0::3].min() >= -AT_REST:  # touching, but parting, or stopped in the substep before
        return ContactSolution([Impulse(c, np.zeros(3)) for c in contacts])
    W, H, slip = delassus(contacts, states), held_delassus(contacts, states), None
    work = caches.work.lend()
    start = guess_impulses(contacts, [c.axes for c in contacts], caches.warm_starts)
    if H is not None:
        W, slip, start = yield_to_friction(W, velocity, problem.friction, H, start, work)
    e = problem.restitution if -velocity[0::3].min() >= _least_rebounding_approach(contacts, states) else 0.0
    solution = solve_poisson_impact(W, velocity, problem.friction, e, start, slip, work)
    caches.work.settle(work)
    impulses = [Impulse(c, c.axes.T @ P) for c, P in zip(contacts, solution.P, strict=True)]
    keep_impulses(impulses, caches.warm_starts)
    return ContactSolution(impulses, solution.residual, solution.sweeps)


def respond_closed_form(problem: ContactProblem, caches: ContactCaches) -> ContactSolution:
    """One pair after the other, each as one impact at its resultant contact (resultant_contact.py, impact_process.py).

    The pair that approaches fastest is answered first, with the twists that the impacts before it left: the order in
    which ships are named does not matter. A pair is answered again when the impact of another one has left it closing.
    Contacts that a substep leaves closing, by the friction of the resultant, after MAX_ANSWERS or when the work of the
    step is spent, are solved in the next. Then there are as many answers as pairs, by plastic impacts.
    """
    states = list(problem.states)
    touching = [
        TouchingPair(contacts)
        for a, b in problem.pairs
        if (contacts := problem.detector.contacts(a, b, states, caches.last_normals))
    ]
    largest = max((pair.measure_approach(states) for pair in touching), default=0.0)
    least, scale = AT_REST_SHARE * largest, max(largest, LEAST_REBOUNDING_APPROACH)
    work, residual = caches.work.lend(), 0.0
    for answers in range(MAX_ANSWERS * len(touching)):
        pair = max(touching, key=TouchingPair.urgency)
        if pair.approach <= least:
            break
        if work.is_spent and answers >= len(touching):  # what is left of the approach is missed
            residual = max(residual, pair.approach / scale)
            break
        contact = pair.reduce(states, work)
        e = problem.restitution if pair.approach >= _least_rebounding_approach([contact], states) else 0.0
        W, velocity = delassus([contact], states), approach_velocities([contact], states)
        if work.is_spent:  # the restitution is missed
            P, residual = solve_gauss_seidel(W, velocity, problem.friction).P[0], max(residual, e)
        else:
            H = held_delassus([contact], states)
            process = solve_impact_process(W, velocity, problem.friction, e, H)
            P = process.P
            work.spend_impact_process(process.stretches)
        P = contact.axes.T @ P
        _apply_to_states(contact, P, states)
        pair.take(P)
        for other in touching:
            if other is not pair and other.shares_ship(pair, states):
                other.measure_approach(states)
    caches.work.settle(work)
    return ContactSolution([impulse for pair in touching for impulse in pair.impulses()], residual)


def _least_rebounding_approach(contacts: Sequence[Contact], states: Sequence[BodyState]) -> float:
    """Approach [m/s] below which nothing springs back: LEAST_REBOUNDING_APPROACH, or what other forces make of rest in
    PRESSING communication steps."""
    pressed = 0.0
    for c in contacts:
        closing = 0.0
        for sign, body, G in ((2.0, c.a, c.G_a), (-2.0, c.b, c.G_b)):
            if (bias := states[body].velocity_bias) is not None:  # the mean over the step: half of its end
                closing += sign * float(c.normal @ G @ bias)
        pressed = max(pressed, closing)
    return max(LEAST_REBOUNDING_APPROACH, PRESSING * pressed)


def respond_bullet(problem: ContactProblem, caches: ContactCaches) -> ContactSolution:
    """One step of Bullet's own dynamics for every pair that touches; its contact impulses are taken as they are.

    Each pair is solved with the twists that the pairs before it left, as with closed_form. Bullet is called only once
    the hulls touch: one step before, Bullet would keep or lose the restitution by chance of the step.
    """
    states, impulses = list(problem.states), list[Impulse]()
    bodies, adapter = problem.bullet_bodies, problem.detector.narrow_phase
    assert isinstance(adapter, BulletAdapter)  # see ADAPTERS
    for a, b in problem.pairs:
        if not problem.detector.touching(a, b, states):
            continue
        rows = adapter.dynamic_step(
            (a, b),
            (bodies[a], bodies[b]),
            ((states[a].x, states[a].R), (states[b].x, states[b].R)),
            (states[a].nu, states[b].nu),
            problem.h,
            problem.friction,
            problem.restitution,
        )
        for on_a, on_b, normal, gap, P in rows:
            contact = make_contact(a, b, states, 0.5 * (on_a + on_b), normal, gap)
            impulses.append(Impulse(contact, P))
            _apply_to_states(contact, P, states)
    return ContactSolution(impulses)


def _apply_to_states(contact: Contact, P: Array, states: list[BodyState]) -> None:
    """Replace the states of both bodies in the list by copies that have taken the impulse P (3,) in n."""
    for i, J in ((contact.a, -(P @ contact.G_a)), (contact.b, P @ contact.G_b)):
        states[i] = replace(states[i], nu=states[i].nu + states[i].M_inverse @ J)


RESPONSES: dict[str, Callable[[ContactProblem, ContactCaches], ContactSolution]] = {
    "pgs": respond_pgs,
    "closed_form": respond_closed_form,
    "bullet": respond_bullet,
}
ADAPTERS = {"bullet": "pybullet"}
"""Which adapter of the narrow phase a response must have (geometry/adapter.py); the others take either."""


def require_adapter(response: str | None) -> None:
    """Raise HostError, with the remedy, when this Python lacks what a response needs for contact; None: the default."""
    if response in ADAPTERS:
        require_dynamics()
    else:
        choose_adapter()
