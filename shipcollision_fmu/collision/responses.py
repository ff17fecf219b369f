"""The rival responses: how two ships answer a contact. One signature, one table.

    respond(encounter) -> impulses        what ship b takes at each contact point in this substep, in n

pgs      Projected Gauss-Seidel on the 6x6 masses: cleaned contacts, friction cone, iterated to a residual
bullet   Bullet's own dynamics with a scalar mass and Bullet's own contacts: what Guan et al. 2014 ran
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .axes import contact_axes
from .contact import Impulse, contact_velocity, make_contact
from .delassus import contact_jacobian, delassus
from .detection import Detector, KeptNormals
from .engine import BulletBody
from .restitution import solve_impact
from .shadow import Shadow

__all__ = ["RESPONSES", "Encounter", "respond_bullet", "respond_pgs"]


@dataclass(frozen=True)
class Encounter:
    """What a response is given: ships within reach of each other, at one substep.

    pairs: indices (a, b) of ships near each other; shadows: of all ships, hulls already placed there; kept: normals of
    the last shallow contacts; bodies: the ships as Bullet knows them; friction, restitution: of every pair; h: length
    of the substep [s].
    """

    pairs: Sequence[tuple[int, int]]
    shadows: Sequence[Shadow]
    detector: Detector
    kept: KeptNormals
    bodies: Sequence[BulletBody]
    friction: float
    restitution: float
    h: float


def respond_pgs(encounter: Encounter) -> list[Impulse]:
    """All contacts of all pairs solved together by block Projected Gauss-Seidel (pgs.py)."""
    shadows = encounter.shadows
    contacts = [c for a, b in encounter.pairs for c in encounter.detector.contacts(a, b, shadows, encounter.kept)]
    if not contacts:
        return []
    G, ships = contact_jacobian(contacts)
    axes = [contact_axes(c.normal) for c in contacts]
    velocity = np.concatenate([axis @ contact_velocity(c, shadows) for axis, c in zip(axes, contacts, strict=True)])
    if velocity[0::3].min() >= 0.0:  # touching, but parting
        return [Impulse(c, np.zeros(3)) for c in contacts]
    local = np.vstack([axis @ G[3 * i : 3 * i + 3] for i, axis in enumerate(axes)])
    solution = solve_impact(delassus(local, ships, shadows), velocity, encounter.friction, encounter.restitution)
    return [Impulse(c, axis.T @ P) for c, axis, P in zip(contacts, axes, solution.P, strict=True)]


def respond_bullet(encounter: Encounter) -> list[Impulse]:
    """One step of Bullet's own dynamics for every pair that touches; its contact impulses are taken over as they are.

    Bullet would act one step before touch, and so lose the restitution or not, by chance of the step: hence the wait.
    """
    shadows, impulses = encounter.shadows, []
    for a, b in encounter.pairs:
        if not encounter.detector.touching(a, b):
            continue
        rows = encounter.detector.engine.dynamic_step(
            (a, b),
            (encounter.bodies[a], encounter.bodies[b]),
            ((shadows[a].x, shadows[a].R), (shadows[b].x, shadows[b].R)),
            (shadows[a].nu, shadows[b].nu),
            encounter.h,
            encounter.friction,
            encounter.restitution,
        )
        for on_a, on_b, normal, gap, P in rows:
            impulses.append(Impulse(make_contact(a, b, shadows, 0.5 * (on_a + on_b), normal, gap), P))
    return impulses


RESPONSES: dict[str, Callable[[Encounter], list[Impulse]]] = {"pgs": respond_pgs, "bullet": respond_bullet}
