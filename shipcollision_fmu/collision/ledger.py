"""Whose impulse is where: issued by the collision model, applied by the ship, or pending between the two.

All are cumulative, 6 numbers in b about CO [N s, N m s]. What is issued and not yet applied is pending; it corrects a
received velocity before contact is looked for, so that no approach is charged twice, whatever the master's order.

How a ship's answer is known depends on `feedback`:

    ledger   the ship echoes impulse_applied
    force    the ship takes the mean force: seen in the velocity it sends back
    state    the ship adopts the post-impact state: seen in the velocity it sends back
    none     the ship ignores contact: nothing is ever applied, nothing is pending
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..ship.frames import Array

__all__ = ["FEEDBACKS", "Account", "pending_impulse"]


@dataclass(frozen=True)
class Account:
    """A ship's books at the start of a step. Vectors (6,) in b about CO.

    issued, last: all that was issued, and the part of the last step; echoed: the ship's impulse_applied; nu_sent: the
    twist that the last step was computed from (pending included), nu: the twist received now; M (6, 6).
    """

    issued: Array
    last: Array
    echoed: Array
    nu_sent: Array
    nu: Array
    M: Array


def _echoed(account: Account) -> Array:
    return account.issued - account.echoed


def _inferred(account: Account) -> Array:
    """The last step's impulse, unless the received velocity shows it: the nearer of "all" and "nothing" counts."""
    if not account.last.any():
        return account.last
    change = float(account.last @ (account.nu - account.nu_sent))  # twice the work of the impulse, if applied
    whole = float(account.last @ np.linalg.solve(account.M, account.last))
    return np.zeros(6) if change > 0.5 * whole else account.last


def _nothing(account: Account) -> Array:
    return np.zeros_like(account.issued)


FEEDBACKS: dict[str, Callable[[Account], Array]] = {
    "ledger": _echoed,
    "force": _inferred,
    "state": _inferred,
    "none": _nothing,
}


def pending_impulse(feedback: str, account: Account) -> Array:
    """Impulse (6,) issued and not yet in the received velocity."""
    return FEEDBACKS[feedback](account)
