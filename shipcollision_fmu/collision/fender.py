"""The law of a fender: a spring and a damper that act before hull and wall touch.

    delta   = thickness - gap                       compression, from 0 on                     [m]
    F       = k delta + c d(delta)/dt >= 0          along the normal, at the middle of what is compressed
    F_t    <= mu F, against the slip                friction of the pair

It is integrated within the substeps of the collision model and booked as impulses, like any contact:

    P  = h (k delta + c rate+)                      rate+ = rate - W_nn P: damper implicit, at any c
    k <= 1/(W_nn h^2)                               a stiffer spring cannot be resolved by a substep, and acts as this

The impulse acts at the old place, and the ships move with the new speed: the leapfrog scheme. It conserves
1/2 v^2 + 1/2 W_nn k delta_j delta_{j+1} to rounding. A mass on a spring returns with its speed, except for (omega h)^2.
A communication step H longer than the substep h adds damping. The ship applies the impulse of a whole step at its
start, and returns with exp(-pi omega (H - h)/4) of its speed.

No energy is gained, whatever the step, the delay or other forces. The energy that the ships have put into the spring is
kept per pair (fender_ledger.py). The fender never returns more, and never holds more than 1/2 k delta^2. Energy that is
taken and not stored is dissipated.

Two fenders that face each other are in series. A fender is one force; a row of fenders along a quay is a row of
obstacles. PIANC, BS 6349: the energy to absorb is 1/2 M v^2 C_M C_E C_S C_C, of which C_M and C_E are in W_nn here.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sqrt

import numpy as np

from ..errors import InputError
from ..ship.frames import Array

__all__ = ["Compression", "Fender", "build_fender", "combine_in_series", "compress_fender", "solve_friction"]


@dataclass(frozen=True)
class Fender:
    """stiffness [N/m], damping [N s/m], thickness [m]."""

    stiffness: float
    damping: float
    thickness: float


@dataclass(frozen=True)
class Compression:
    """A fender over one substep: normal impulse P [N s], energy stored after it [J], energy dissipated in it [J]."""

    P: float
    stored: float
    dissipated: float


def build_fender(name: str, stiffness: float, damping: float, thickness: float) -> Fender | None:
    """The fender of these values [N/m], [N s/m], [m], None for all zero. Raises InputError on values of no fender."""
    values = (stiffness, damping, thickness)
    if not any(values):
        return None
    if not (all(map(isfinite, values)) and stiffness > 0.0 and damping >= 0.0 and thickness > 0.0):
        raise InputError(
            f"{name}: stiffness = {stiffness} N/m, damping = {damping} N s/m, thickness = {thickness} m is no fender: "
            "stiffness and thickness must be positive, damping not negative; all 0 for none"
        )
    return Fender(stiffness, damping, thickness)


def combine_in_series(one: Fender | None, other: Fender | None) -> Fender | None:
    """The fender between two bodies that may have one each."""
    if one is None or other is None:
        return one or other
    share = other.stiffness / (one.stiffness + other.stiffness)
    damping = one.damping + other.damping
    return Fender(
        one.stiffness * share,
        one.damping * other.damping / damping if damping > 0.0 else 0.0,
        one.thickness + other.thickness,
    )


def compress_fender(
    fender: Fender, compression: float, rate: float, W_nn: float, stored: float, h: float
) -> Compression:
    """One substep of h [s] of a fender compressed by `compression` [m] at `rate` [m/s].

    W_nn [1/kg] is what a unit of impulse does to the rate; stored [J] what the ships have put into the spring so far.
    """
    if W_nn <= 0.0:
        return Compression(0.0, stored, 0.0)
    k, c = min(fender.stiffness, 1.0 / (W_nn * h * h)), fender.damping
    P = max(0.0, h * (k * compression + c * rate) / (1.0 + W_nn * h * c))
    after = rate - W_nn * P
    taken = P * (rate - 0.5 * W_nn * P)
    damped = max(0.0, min(P, h * c * after) * 0.5 * (rate + after))
    if stored + taken - damped < 0.0:  # more than was put into the spring: it returns what it has
        root = sqrt(rate * rate + 2.0 * W_nn * stored)
        P = 2.0 * stored / (root - rate) if rate < 0.0 else (root + rate) / W_nn
        after = rate - W_nn * P
        taken, damped = P * (rate - 0.5 * W_nn * P), 0.0
    kept = max(0.0, min(stored + taken - damped, 0.5 * k * compression * max(0.0, compression + h * after)))
    return Compression(P, kept, stored + taken - kept)


def solve_friction(W: Array, slip: Array, mu: float, P_n: float) -> Array:
    """Tangential impulse (2,) [N s] that takes the slip (2,) [m/s], or as much of it as mu P_n allows.

    W (2, 2) [1/kg] in the tangents' axes. Never adds energy: the loss is s (1 - s/2) slip' W^-1 slip, 0 <= s <= 1.
    """
    stick: Array = -np.linalg.pinv(W, 1e-9, hermitian=True) @ slip
    size = float(np.hypot(stick[0], stick[1]))
    return stick if size <= mu * P_n else stick * (mu * P_n / size)
