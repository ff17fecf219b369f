"""What is known of one contact point.

The normal points from ship a to ship b; `gap` is negative in overlap; P acts on b and -P on a. Geometry is that of the
instant of contact; `at` is the one point in n at which both ships book the impulse, midway between where their two
material points are at the received poses, so that the two moments balance about any fixed point.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..ship.frames import Array

__all__ = ["Contact", "Impulse"]


@dataclass(frozen=True)
class Contact:
    """A point at which two hulls touch.

    a, b: indices of the ships; point, normal (3,) in n [m, 1]; gap [m]; r_a, r_b (3,): the point in b of either ship
    [m]; at (3,): where the impulse is booked, in n [m].
    """

    a: int
    b: int
    point: Array
    normal: Array
    gap: float
    r_a: Array
    r_b: Array
    at: Array


@dataclass(frozen=True)
class Impulse:
    """The impulse P (3,) [N s], in n, that ship b takes at a contact; ship a takes -P."""

    contact: Contact
    P: Array
