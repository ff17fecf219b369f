"""The rival responses: how two ships answer a contact. One signature, one table.

    respond(problem) -> answer          what ship b takes at each contact point in this substep, in n

pgs          Projected Gauss-Seidel on the 6x6 masses: cleaned contacts, friction cone, iterated to a residual
closed_form  one resultant contact per pair, its impact followed along the slip: Keller, Stronge (impact_process.py)
bullet       Bullet's own dynamics with a scalar mass and Bullet's own contacts: what Guan et al. 2014 ran
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..ship.frames import Array
from .dynamics.body_state import BodyState
from .dynamics.contact import Contact, Impulse, contact_velocity, make_contact
from .dynamics.contact_frame import contact_axes
from .dynamics.delassus import contact_jacobian, delassus
from .geometry.bullet import BulletBody
from .geometry.detection import Detector, LastNormals
from .solvers.impact_process import solve_impact_process
from .solvers.poisson_restitution import solve_poisson_impact
from .solvers.resultant_contact import reduce_to_resultant
from .solvers.warm_start import WarmStarts, guess_impulses, keep_impulses

__all__ = ["RESPONSES", "Answer", "ContactProblem", "respond_bullet", "respond_closed_form", "respond_pgs"]


AT_REST = 1e-12
"""Approach [m/s] that is rounding: what a solved contact is left with. Solving it again would cost as much as an
impact."""


@dataclass(frozen=True)
class ContactProblem:
    """What a response is given: ships within reach of each other, at one substep.

    pairs: indices (a, b) of ships near each other; states: of all ships, hulls already placed there; last_normals: of
    shallow contacts; warm: impulses of the substep before; bodies: the ships as Bullet knows them; friction,
    restitution: of every pair; h: length of the substep [s].
    """

    pairs: Sequence[tuple[int, int]]
    states: Sequence[BodyState]
    detector: Detector
    last_normals: LastNormals
    warm: WarmStarts
    bodies: Sequence[BulletBody]
    friction: float
    restitution: float
    h: float


@dataclass(frozen=True)
class Answer:
    """Impulses of a substep; by how much the law of contact is missed, as a share of the approach, and the sweeps."""

    impulses: list[Impulse]
    residual: float = 0.0
    sweeps: int = 0


def respond_pgs(problem: ContactProblem) -> Answer:
    """All contacts of all pairs solved together by block Projected Gauss-Seidel (gauss_seidel.py)."""
    states = problem.states
    contacts = [c for a, b in problem.pairs for c in problem.detector.contacts(a, b, states, problem.last_normals)]
    if not contacts:
        return Answer([])
    G, ships = contact_jacobian(contacts)
    axes = [contact_axes(c.normal) for c in contacts]
    velocity = np.concatenate([axis @ contact_velocity(c, states) for axis, c in zip(axes, contacts, strict=True)])
    if velocity[0::3].min() >= -AT_REST:  # touching, but parting, or stopped in the substep before
        return Answer([Impulse(c, np.zeros(3)) for c in contacts])
    local = np.vstack([axis @ G[3 * i : 3 * i + 3] for i, axis in enumerate(axes)])
    solution = solve_poisson_impact(
        delassus(local, ships, states), velocity, problem.friction, problem.restitution,
        guess_impulses(contacts, axes, problem.warm),
    )  # fmt: skip
    impulses = [Impulse(c, axis.T @ P) for c, axis, P in zip(contacts, axes, solution.P, strict=True)]
    keep_impulses(impulses, problem.warm)
    return Answer(impulses, solution.residual, solution.sweeps)


def respond_closed_form(problem: ContactProblem) -> Answer:
    """One pair after the other, each as one impact at its resultant contact (resultant_contact.py, impact_process.py).

    A pair sees what the pairs before it did to its ships. What is not answered exactly in a substep, contacts that the
    resultant's friction or another pair closes, is met again in the next.
    """
    states, impulses = list(problem.states), []
    for a, b in problem.pairs:
        contacts = problem.detector.contacts(a, b, states, problem.last_normals)
        contact = reduce_to_resultant(contacts, states) if contacts else None
        if contact is None:  # apart, or touching but parting
            impulses += [Impulse(c, np.zeros(3)) for c in contacts]
            continue
        axis = contact_axes(contact.normal)
        G, ships = contact_jacobian([contact])
        W = delassus(axis @ G, ships, states)
        path = solve_impact_process(W, axis @ contact_velocity(contact, states), problem.friction, problem.restitution)
        P = axis.T @ path.P
        _apply_to_states(contact, P, states)
        impulses.append(Impulse(contact, P))
    return Answer(impulses)


def _apply_to_states(contact: Contact, P: Array, states: list[BodyState]) -> None:
    """What the next pair meets: both ships with the impulse P (in n) taken. Places in the list change, not states."""
    for i, taken in ((contact.a, -(P @ contact.G_a)), (contact.b, P @ contact.G_b)):
        states[i] = replace(states[i], nu=states[i].nu + states[i].M_inverse @ taken)


def respond_bullet(problem: ContactProblem) -> Answer:
    """One step of Bullet's own dynamics for every pair that touches; its contact impulses are taken over as they are.

    A pair sees what the pairs before it did to its ships, as with closed_form: they are not solved together.

    Bullet would act one step before touch, and so lose the restitution or not, by chance of the step: hence the wait.
    """
    states, impulses = list(problem.states), list[Impulse]()
    for a, b in problem.pairs:
        if not problem.detector.touching(a, b):
            continue
        rows = problem.detector.bullet.dynamic_step(
            (a, b),
            (problem.bodies[a], problem.bodies[b]),
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
    return Answer(impulses)


RESPONSES: dict[str, Callable[[ContactProblem], Answer]] = {
    "pgs": respond_pgs,
    "closed_form": respond_closed_form,
    "bullet": respond_bullet,
}
