"""A contact point, the velocities there, and the booking of an impulse.

The normal points from body a to body b; the gap is negative in overlap; P acts on b and -P on a.

    point       in n, at the predicted poses: where the hulls touch
    r_a, r_b    the two material points, each in b of its hull
    at          midway between these points at the poses of application. One point in n for both bodies: so the two
                moments balance about any fixed point.
    G = [R, -R skew(r)]     velocity of `at` in n is G nu, and the impulse P (in n) there is G' P in b about CO; (3, 6)

Guan et al. 2014, equation (9), the contacts and where they act on either body: here G_a and G_b.

Energy lost at a contact, with v- and v+ the relative velocities before and after all impulses of an instant:

    lost = -P . (v- + v+)/2            summed over the contacts = T(nu-) - T(nu+),    T = 1/2 nu^T M nu      [J]

The sum is an identity for any impulses. How it is split along and across the normal: solvers/energy_split.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from .body_state import BodyState
from .contact_frame import contact_axes

__all__ = [
    "NO_IMPULSE", "Booked", "Contact", "Impulse", "book_impulses", "energy_velocities", "make_contact", "make_contacts",
    "mean_velocity", "point_jacobian",
]  # fmt: skip

NO_IMPULSE = [0.0, 0.0, 0.0]
"""The entries of P of a contact without load. To compare lists takes a fifth of the time of `any`."""


@dataclass(frozen=True, eq=False)
class Contact:
    """A point at which two hulls touch.

    a, b: indices of the bodies; point (3,) in n [m]; axes (3, 3): rows normal, t1, t2 in n; gap [m]; r_a, r_b (3,):
    in b of either hull [m]; at (3,): where the impulse is booked, in n [m]; G_a, G_b (3, 6).
    """

    a: int
    b: int
    point: Array
    normal: Array
    axes: Array
    gap: float
    r_a: Array
    r_b: Array
    at: Array
    G_a: Array
    G_b: Array


@dataclass(frozen=True, eq=False)
class Impulse:
    """The impulse P (3,) [N s], in n, on body b at a contact; body a takes -P."""

    contact: Contact
    P: Array


@dataclass(frozen=True, eq=False)
class Booked:
    """An impulse, the relative velocities (3,) in n before and after all impulses of its instant, and the energy lost
    [J]."""

    impulse: Impulse
    before: Array
    after: Array
    lost: float


def point_jacobian(R_nb: Array, r_b: Array) -> Array:
    """G (3, 6): velocity in n of the point r_b [m] (in b from CO) is G nu; the impulse P in n is G' P in b about CO."""
    G = np.empty((3, 6))
    G[:, :3] = R_nb
    x, y, z = r_b.tolist()
    G[:, 3:] = R_nb @ np.array([(0.0, z, -y), (-z, 0.0, x), (y, -x, 0.0)])  # skew(-r_b), in place: the hottest line
    return G


def make_contact(a: int, b: int, states: Sequence[BodyState], point: Array, normal: Array, gap: float) -> Contact:
    """Contact at `point` (in n, predicted poses) of bodies a and b."""
    return _make_contact(a, b, states, point, normal, contact_axes(normal), gap)


def make_contacts(
    a: int, b: int, states: Sequence[BodyState], places: Sequence[tuple[Array, float]], normal: Array, axes: Array
) -> list[Contact]:
    """Contacts at places (point in n, gap) with one normal, and the axes that belong to it."""
    return [_make_contact(a, b, states, point, normal, axes, gap) for point, gap in places]


def _make_contact(
    a: int, b: int, states: Sequence[BodyState], point: Array, normal: Array, axes: Array, gap: float
) -> Contact:
    one, other = states[a], states[b]
    r_a, r_b = one.R.T @ (point - one.x), other.R.T @ (point - other.x)
    at = 0.5 * (one.x_applied + one.R_applied @ r_a + (other.x_applied + other.R_applied @ r_b))
    G_a = point_jacobian(one.R_applied, one.R_applied.T @ (at - one.x_applied))
    G_b = point_jacobian(other.R_applied, other.R_applied.T @ (at - other.x_applied))
    return Contact(a, b, point, normal, axes, gap, r_a, r_b, at, G_a, G_b)


def mean_velocity(contact: Contact, states: Sequence[BodyState]) -> Array:
    """Velocity of b relative to a at a contact, in n [m/s]; (3,). The normal part is negative on approach.

    It is the mean expected over the step, with other forces: this is what a response has to stop.
    """
    v: Array = contact.G_b @ states[contact.b].nu_mean - contact.G_a @ states[contact.a].nu_mean
    return v


def energy_velocities(contacts: Sequence[Contact], states: Sequence[BodyState]) -> list[Array]:
    """The same of every contact, with which energy is reckoned: without what other forces may add; (3,) each."""
    return [c.G_b @ states[c.b].nu_energy - c.G_a @ states[c.a].nu_energy for c in contacts]


def book_impulses(impulses: Sequence[Impulse], states: Sequence[BodyState]) -> list[Booked]:
    """Add the impulses of one instant to the twists and to what is issued. Obstacles take none."""
    contacts = [impulse.contact for impulse in impulses]
    before = energy_velocities(contacts, states)
    taken: dict[int, list[Array]] = {}
    for impulse in impulses:
        if impulse.P.tolist() == NO_IMPULSE:
            continue
        c, P = impulse.contact, impulse.P
        taken.setdefault(c.a, []).append(-P @ c.G_a)
        taken.setdefault(c.b, []).append(P @ c.G_b)
    for body, J in taken.items():
        if not states[body].fixed:
            states[body].book(J)
    after = energy_velocities(contacts, states)
    return [
        Booked(i, v, w, -0.5 * float(i.P @ (v + w))) for i, v, w in zip(impulses, before, after, strict=True)
    ]  # fmt: skip
