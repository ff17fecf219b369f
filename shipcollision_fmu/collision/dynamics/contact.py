"""What is known of one contact point.

The normal points from ship a to ship b; `gap` is negative in overlap; P acts on b and -P on a. Geometry is that of the
instant of contact. The impulse is booked at `at`, one point in n for both ships, midway between where their two
material points are at the poses of application: so the two moments balance about any fixed point.

Guan et al. 2014, equation (9), the contacts and where they act on either body: here G_a and G_b.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...ship.frames import Array
from .body_state import BodyState

__all__ = ["Contact", "Impulse", "actual_velocity", "book", "contact_velocity", "make_contact"]


@dataclass(frozen=True, eq=False)
class Contact:
    """A point at which two hulls touch.

    a, b: indices of the ships; point, normal (3,) in n [m, 1]; gap [m]; r_a, r_b (3,): the point in b of either ship
    [m]; at (3,): where the impulse is booked, in n [m]; G_a, G_b (3, 6): velocity of that point of either ship in n is
    G nu, and the impulse P there is G' P in b about CO.
    """

    a: int
    b: int
    point: Array
    normal: Array
    gap: float
    r_a: Array
    r_b: Array
    at: Array
    G_a: Array
    G_b: Array


@dataclass(frozen=True, eq=False)
class Impulse:
    """The impulse P (3,) [N s], in n, that ship b takes at a contact; ship a takes -P."""

    contact: Contact
    P: Array


def make_contact(a: int, b: int, states: Sequence[BodyState], point: Array, normal: Array, gap: float) -> Contact:
    """Contact at `point` (in n, predicted poses) of ships a and b."""
    one, other = states[a], states[b]
    r_a, r_b = one.body(point), other.body(point)
    at = 0.5 * (one.point_applied(r_a) + other.point_applied(r_b))
    return Contact(a, b, point, normal, gap, r_a, r_b, at, one.jacobian(at), other.jacobian(at))


def contact_velocity(contact: Contact, states: Sequence[BodyState]) -> Array:
    """Velocity of b relative to a at a contact, in n [m/s]; (3,). Approaching when its normal part is negative.

    It is the mean expected over the step, which is what a response has to stop; the ships' own is actual_velocity.
    """
    v: Array = contact.G_b @ states[contact.b].expected - contact.G_a @ states[contact.a].expected
    return v


def actual_velocity(contact: Contact, states: Sequence[BodyState]) -> Array:
    """The same with the ships' twists as they are now, without what other forces may add; (3,)."""
    v: Array = contact.G_b @ states[contact.b].nu_energy - contact.G_a @ states[contact.a].nu_energy
    return v


def book(impulse: Impulse, states: Sequence[BodyState]) -> None:
    """The impulse into the twists and ledgers of both bodies; an obstacle has neither."""
    c, P = impulse.contact, impulse.P
    for i, G, sign in ((c.a, c.G_a, -1.0), (c.b, c.G_b, 1.0)):
        if not states[i].fixed:
            states[i].book(sign * P @ G)
