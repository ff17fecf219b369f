"""The contacts of one pair as a single contact: what the closed forms of an impact can answer.

The point and the normal are those of the resultant of a frictionless plastic impact at all the contacts:

    lambda = normal impulses of that impact (gauss_seidel.py, mu = 0)
    point  = sum(lambda_i point_i) / sum(lambda_i)        normal = sum(lambda_i n_i), of length 1

For parallel normals that one impulse does to both ships what all of them do, so no contact is left approaching: it is
the centre of percussion of the patch, and moves over it with the ships' rotation. A centre weighted by overlap would
follow the depth of a past moment instead. Contacts that do not approach have no share.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..dynamics.body_state import BodyState
from ..dynamics.contact import Contact, make_contact
from ..dynamics.delassus import approach_velocities, delassus
from .gauss_seidel import solve_gauss_seidel

__all__ = ["reduce_to_resultant"]


def reduce_to_resultant(contacts: Sequence[Contact], states: Sequence[BodyState]) -> Contact | None:
    """One contact for all of a pair's; None when nothing approaches. Its gap is the deepest."""
    velocity = approach_velocities(contacts, states)
    if velocity[0::3].min() >= 0.0:
        return None
    if len(contacts) == 1:
        return contacts[0]
    share = solve_gauss_seidel(delassus(contacts, states), velocity, 0.0).P[:, 0]
    share = share / share.sum()
    point = sum((w * c.point for w, c in zip(share, contacts, strict=True)), np.zeros(3))
    normal = sum((w * c.normal for w, c in zip(share, contacts, strict=True)), np.zeros(3))
    return make_contact(
        contacts[0].a, contacts[0].b, states, point, normal / np.linalg.norm(normal), min(c.gap for c in contacts)
    )
