"""Whose impulse is where: issued by the collision model, applied by the ship, or pending between the two.

All are cumulative, 6 numbers in b about CO [N s, N m s]. What is issued and not yet applied is pending; it corrects a
received velocity before contact is looked for, so that no approach is charged twice, whatever the master's order.

How a ship's answer is known depends on `feedback`:

    ledger   the ship echoes impulse_applied
    force    the ship takes the mean force: seen in the velocity it sends back
    state    the ship adopts the post-impact state: seen in the velocity it sends back
    none     the ship ignores contact: nothing is ever applied, nothing is pending

A number in b means an impulse in n only together with a pose. A sequential master applies an impulse at the pose for
which it was solved; a parallel one a step later, when the ship has turned and moved on. So the books are kept in n as
well, as wrenches (linear, and angular about n's origin):

    issued_n    what contact gave, at the poses for which it was solved
    applied_n   what the ship took, at the poses at which it applied it
    deficit     = issued_n - applied_n - (pending, at the pose received now)

The deficit goes out with the next impulse. After a ship was found to apply impulses one step later, they are solved and
booked for the pose that it will have by then (body_state.py). Linear and angular momentum are kept to rounding under
either master, once all is applied. A body that turns, or moves as a share of its size, by more than FAR in a step (a
log that was run over, a buoy) is an exception. Its deficit is discarded: one step later its direction would no longer
be right, and it could add energy.
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any, NamedTuple

import numpy as np

from ...ship.frames import Array, skew

__all__ = ["FEEDBACKS", "ImpulseLedger", "Reading"]

_NOTHING = np.zeros(6)

ROUNDING = 1e-12
"""Deficit, as a share of all that was ever issued, that is rounding."""


FAR = 0.1
"""Turning in a step [rad], plus way in it as a share of the hull's reach, beyond which nothing is carried over."""


class Reading(NamedTuple):
    """A ship's ledger at the start of a step of H [s]. nu: twist (6,) with what is pending in it; pending: impulse (6,)
    in b that the ship will still apply, or that its velocity does not show; deficit (6,) in b: what is missing of
    what was issued; one_step_delay: whether the ship applies an impulse after it has moved on, None
    where not known yet; out_of_range: the ship moves too far in a step."""

    x: Array
    R: Array
    nu: Array
    applied: Array
    applied_n: Array
    pending: Array
    deficit: Array
    one_step_delay: bool | None
    out_of_range: bool


class ImpulseLedger:
    """The ledger of one ship. Impulses (6,) in b about CO; wrenches (6,) in n, linear and about n's origin."""

    def __init__(self) -> None:
        self.issued = np.zeros(6)
        self.last = np.zeros(6)  # the part of it that the last step issued
        self.is_settled = True  # nothing pending, deficit or just issued
        self._echo = [0.0] * 6  # what a ship that has applied everything sends back
        self._nu = np.zeros(6)  # the twist of which the last step knew, pending included
        self._applied = np.zeros(6)
        self._x, self._R = np.zeros(3), np.eye(3)
        self._issued_n, self._applied_n = np.zeros(6), np.zeros(6)
        self._size = np.zeros(2)  # of all that was given: linear, angular
        self.one_step_delay: bool | None = None  # whether the ship was seen to apply impulses a step later

    def is_quiet(self, feedback: str, applied: list[float]) -> bool:
        """Whether there is nothing to be read; `applied` as received."""
        return self.is_settled and (feedback != "ledger" or applied == self._echo)

    def read(
        self, feedback: str, x: Array, R: Array, nu: Array, applied: Array, M_inverse: Array, reach: float, H: float
    ) -> Reading:
        """What the state received says. Changes nothing."""
        if feedback != "ledger":
            pending = FEEDBACKS[feedback](self, nu, M_inverse)
            if pending.any():
                nu = nu + M_inverse @ pending
            return Reading(x, R, nu, applied, self._applied_n, pending, _NOTHING, False, False)
        if self.is_quiet(feedback, applied.tolist()):
            out_of_range = _goes_far(nu, reach, H)
            return Reading(x, R, nu, applied, self._applied_n, _NOTHING, _NOTHING, self.one_step_delay, out_of_range)
        taken, pending = applied - self._applied, self.issued - applied
        waits = bool(pending.any())
        if waits:
            nu = nu + M_inverse @ pending
        out_of_range = _goes_far(nu, reach, H)
        applied_n, one_step_delay = self._applied_n, self.one_step_delay
        if taken.any():
            applied_n = applied_n + _wrench_in_n(self._x, self._R, taken)
        if self.last.any():
            one_step_delay = waits
        deficit = self._issued_n - applied_n
        if waits:
            deficit = deficit - _wrench_in_n(x, R, pending)
        small = ROUNDING * self._size
        if out_of_range or (np.abs(deficit[:3]).max() <= small[0] and np.abs(deficit[3:]).max() <= small[1]):
            return Reading(x, R, nu, applied, applied_n, pending, _NOTHING, one_step_delay, out_of_range)
        return Reading(x, R, nu, applied, applied_n, pending, _wrench_in_b(x, R, deficit), one_step_delay, out_of_range)

    def close(self, reading: Reading, J: Array, nu: Array, x: Array, R: Array) -> None:
        """End a step in which contact gave J (6,), at the pose x, R at which the ship will apply what is issued now.
        nu: twist with which the step began."""
        if reading.out_of_range:
            self._issued_n = reading.applied_n + _wrench_in_n(reading.x, reading.R, reading.pending)
        struck, out = bool(J.any()), _NOTHING
        if struck:
            w = _wrench_in_n(x, R, J)
            self._issued_n = self._issued_n + w
            linear = hypot(*w[:3].tolist())
            self._size = self._size + [linear, hypot(*J[3:].tolist()) + hypot(*x.tolist()) * linear]
        if struck or reading.deficit is not _NOTHING:
            deficit = reading.deficit
            if deficit is not _NOTHING and x is not reading.x:
                deficit = _wrench_in_b(x, R, _wrench_in_n(reading.x, reading.R, deficit))
            out = J + deficit
            self.issued = self.issued + out
            self._echo = self.issued.tolist()
        self.last, self._nu = out, nu
        self.is_settled = out is _NOTHING and (reading.pending is _NOTHING or not reading.pending.any())
        self._x, self._R, self._applied = reading.x, reading.R, reading.applied
        self._applied_n, self.one_step_delay = reading.applied_n, reading.one_step_delay

    # How a ship that does not echo shows what it has taken.

    def inferred(self, nu: Array, M_inverse: Array) -> Array:
        """The last step's impulse, unless the received velocity shows it: the nearer of "all" and "nothing" counts.

        Only what the free degrees of freedom take of it can be seen: M_inverse is that of these.
        """
        if not self.last.any():
            return self.last
        change = float(self.last @ (nu - self._nu))  # twice the work of the impulse, if applied
        whole = float(self.last @ M_inverse @ self.last)
        return np.zeros(6) if change > 0.5 * whole else self.last

    # -- state --------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        return {name: getattr(self, name).tolist() for name in _ARRAYS} | {
            "one_step_delay": self.one_step_delay,
            "is_settled": self.is_settled,
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        for name in _ARRAYS:
            setattr(self, name, np.array(state[name]))
        self.one_step_delay, self.is_settled, self._echo = (
            state["one_step_delay"],
            state["is_settled"],
            list(state["issued"]),
        )


_ARRAYS = ("issued", "last", "_nu", "_applied", "_x", "_R", "_issued_n", "_applied_n", "_size")


def _nothing(ledger: ImpulseLedger, nu: Array, M_inverse: Array) -> Array:
    return np.zeros(6)


FEEDBACKS: dict[str, Callable[[ImpulseLedger, Array, Array], Array]] = {
    "ledger": _nothing,
    "force": ImpulseLedger.inferred,
    "state": ImpulseLedger.inferred,
    "none": _nothing,
}
"""By name, how the pending impulse (6,) of a ship is inferred that does not echo; "ledger" reads it."""


def _goes_far(nu: Array, reach: float, H: float) -> bool:
    u, v, w, p, q, r = nu.tolist()
    return H * (hypot(p, q, r) + hypot(u, v, w) / reach) > FAR


def _wrench_in_n(x: Array, R: Array, J: Array) -> Array:
    """J (6,), in b about CO at a pose, as a wrench in n about its origin."""
    linear, w = R @ J[:3], np.empty(6)
    w[:3], w[3:] = linear, R @ J[3:] + skew(x) @ linear
    return w


def _wrench_in_b(x: Array, R: Array, wrench: Array) -> Array:
    """A wrench in n about its origin, in b about CO at a pose; (6,)."""
    linear = wrench[:3]
    return np.concatenate([R.T @ linear, R.T @ (wrench[3:] - skew(x) @ linear)])
