"""The contacts of one pair reduced to a single contact, as the impact process of one contact needs it.

Point and normal are those of the resultant of a frictionless plastic impact at all contacts:

    lambda = normal impulses of that impact (gauss_seidel.py, mu = 0)
    point  = sum(lambda_i point_i) / sum(lambda_i)        normal = sum(lambda_i n_i), of length 1

The point is the centre of percussion of the patch and moves over the patch with the rotation of the ships. For parallel
normals the resultant does to both ships what all impulses do, so no contact is left approaching. A centre weighted by
overlap would follow the depth of a past moment instead. Contacts that do not approach have no share.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..dynamics.body_state import BodyState
from ..dynamics.contact import Contact, make_contact
from ..dynamics.delassus import approach_velocities, delassus
from .gauss_seidel import solve_gauss_seidel
from .work_limit import WorkLimit

__all__ = ["reduce_to_resultant"]


def reduce_to_resultant(
    contacts: Sequence[Contact], states: Sequence[BodyState], work: WorkLimit | None = None
) -> Contact | None:
    """One contact in place of all contacts of a pair, with the deepest gap; None when none of them approaches.

    work: the bound on what the solver may do. An approximate resultant lies between the same contacts."""
    velocity = approach_velocities(contacts, states)
    if velocity[0::3].min() >= 0.0:
        return None
    if len(contacts) == 1:
        return contacts[0]
    share = solve_gauss_seidel(delassus(contacts, states), velocity, 0.0, work=work).P[:, 0]
    if not share.any():  # the solver ended before it was begun
        share = np.maximum(-velocity[0::3], 0.0)
    share = share / share.sum()
    point = sum((w * c.point for w, c in zip(share, contacts, strict=True)), np.zeros(3))
    normal = sum((w * c.normal for w, c in zip(share, contacts, strict=True)), np.zeros(3))
    return make_contact(
        contacts[0].a, contacts[0].b, states, point, normal / np.linalg.norm(normal), min(c.gap for c in contacts)
    )
