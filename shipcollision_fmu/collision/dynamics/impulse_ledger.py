"""The impulse ledger of one ship: what the collision model issued, what the ship model applied, what is pending.

All impulses are cumulative, 6 numbers in b about CO [N s, N m s]. An impulse that is issued and not yet applied is
*pending*. The received velocity is corrected by M^-1 pending before contact is detected: no approach is charged twice,
whatever the order in which the master calls the models.

`feedback` says how the ship model shows what it has applied:

    ledger      the ship model returns impulse_applied
    force       the ship model takes the mean force; the velocity that it returns shows the impulse
    state       the ship model adopts the post-impact state; the velocity that it returns shows the impulse
    none        the ship model ignores contact: nothing is ever applied, and nothing is pending
    prescribed  the same, and the mass of the ship is infinite: what is issued is the reaction that its track takes

An impulse in b determines an impulse in n only together with a pose. A sequential master applies it at the pose for
which it was solved. A parallel master applies it one step later, at another pose: the *one-step delay*. The ledger is
therefore kept in n as well, as wrenches (6,), linear and angular about the origin of n:

    issued_n    issued by contact, at the poses for which it was solved
    applied_n   applied by the ship, at the poses at which it was applied
    deficit     = issued_n - applied_n - (pending, at the pose received now)

The deficit is issued with the next impulse. Once a ship has shown a one-step delay, impulses are solved and booked for
the pose that it will have one step later (body_state.py). Linear and angular momentum are then kept to rounding under
either master, when all is applied.

Exception: a body whose motion in a step is *out of range* (a buoy, a log that was run over). For such a body the
deficit is discarded: one step later its direction would no longer be right, and it could add energy.

When nothing is pending and there is no deficit, the ledger is *settled* and the balance is skipped. A far step
then costs a comparison of six numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any, NamedTuple

import numpy as np

from ...ship.frames import Array, skew
from .body_state import NOTHING

__all__ = ["FEEDBACKS", "ImpulseLedger", "Reading"]

ROUNDING = 1e-12
"""Deficit, as a share of all that was ever issued, that is rounding. With zero, no ledger would ever be settled."""

SHOWS = 1e-6
"""Least share of all that was ever issued by which an impulse shows whether it is applied one step late. Hosts that
hand impulses on in single precision round by 6e-8 of them."""

RANGE = 0.1
"""Turning in a step [rad] plus distance in it as a share of the reach of the hull. Beyond it the deficit is discarded.
A larger range adds energy to small bodies; a smaller one loses momentum of fast ships under a parallel master."""


class Reading(NamedTuple):
    """The ledger of a ship at the start of a step, balanced with the state received.

    x, R: pose received; nu: twist (6,) with the pending impulse; applied: impulse_applied as received; applied_n:
    wrench applied so far; pending, deficit: impulses (6,) in b; one_step_delay: None while unknown; out_of_range: the
    ship moves too far in a step to carry a deficit over.
    """

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
    """The ledger of one ship. Impulses (6,) in b about CO; wrenches (6,) in n, linear and about the origin of n."""

    def __init__(self) -> None:
        self.issued = np.zeros(6)
        self.last_issued = np.zeros(6)  # the part of it that the last step issued; zero where rounding lost it
        self.is_settled = True  # nothing pending, no deficit, nothing just issued
        self._echo = [0.0] * 6  # impulse_applied of a ship that has applied everything
        self._nu = np.zeros(6)  # twist at the start of the last step, pending included
        self._applied = np.zeros(6)
        self._x, self._R = np.zeros(3), np.eye(3)
        self._issued_n, self._applied_n = np.zeros(6), np.zeros(6)
        self._size = np.zeros(2)  # of all that was issued: linear, angular
        self.one_step_delay: bool | None = None  # None until an impulse shows it

    def is_quiet(self, feedback: str, applied: list[float]) -> bool:
        """Whether the balance may be skipped. applied: impulse_applied as received."""
        return self.is_settled and (feedback != "ledger" or applied == self._echo)

    def read(
        self, feedback: str, x: Array, R: Array, nu: Array, applied: Array, M_inverse: Array, reach: float, H: float
    ) -> Reading:
        """The balance with the state received at the start of a step of H [s]. The ledger stays as it is.

        x, R, nu (6,): pose and twist received; applied (6,): impulse_applied; reach: of the hull from CO [m].
        """
        if feedback != "ledger":
            pending = FEEDBACKS[feedback](self, nu, M_inverse)
            if pending.any():
                nu = nu + M_inverse @ pending
            return Reading(x, R, nu, applied, self._applied_n, pending, NOTHING, False, False)
        if self.is_quiet(feedback, applied.tolist()):
            out_of_range = _is_out_of_range(nu, reach, H)
            return Reading(x, R, nu, applied, self._applied_n, NOTHING, NOTHING, self.one_step_delay, out_of_range)
        newly_applied, pending = applied - self._applied, self.issued - applied
        is_pending = bool(pending.any())
        if is_pending:
            nu = nu + M_inverse @ pending
        out_of_range = _is_out_of_range(nu, reach, H)
        applied_n, one_step_delay = self._applied_n, self.one_step_delay
        if newly_applied.any():
            applied_n = applied_n + _wrench_in_n(self._x, self._R, newly_applied)
        linear, angular = hypot(*self.last_issued[:3].tolist()), hypot(*self.last_issued[3:].tolist())
        if linear > SHOWS * self._size[0] or angular > SHOWS * self._size[1]:
            whole = float(self.last_issued @ M_inverse @ self.last_issued)
            one_step_delay = float(self.last_issued @ M_inverse @ pending) > 0.5 * whole  # less is rounding of the host
        deficit = self._issued_n - applied_n
        if is_pending:
            deficit = deficit - _wrench_in_n(x, R, pending)
        small = ROUNDING * self._size
        if out_of_range or (np.abs(deficit[:3]).max() <= small[0] and np.abs(deficit[3:]).max() <= small[1]):
            return Reading(x, R, nu, applied, applied_n, pending, NOTHING, one_step_delay, out_of_range)
        return Reading(x, R, nu, applied, applied_n, pending, _wrench_in_b(x, R, deficit), one_step_delay, out_of_range)

    def close(self, reading: Reading, J: Array, nu: Array, x: Array, R: Array) -> None:
        """Enter the impulse J (6,) that contact gave in the step. x, R: pose of application; nu: twist at the start."""
        if reading.out_of_range:
            self._issued_n = reading.applied_n + _wrench_in_n(reading.x, reading.R, reading.pending)
        in_contact, out, last_issued = J is not NOTHING and bool(J.any()), NOTHING, NOTHING
        if in_contact:
            w = _wrench_in_n(x, R, J)
            self._issued_n = self._issued_n + w
            linear = hypot(*w[:3].tolist())
            self._size = self._size + [linear, hypot(*J[3:].tolist()) + hypot(*x.tolist()) * linear]
        if in_contact or reading.deficit is not NOTHING:
            deficit = reading.deficit
            if deficit is not NOTHING and x is not reading.x:
                deficit = _wrench_in_b(x, R, _wrench_in_n(reading.x, reading.R, deficit))
            out = J + deficit
            self.issued, before = self.issued + out, self._echo
            self._echo = self.issued.tolist()
            last_issued = NOTHING if self._echo == before else out
        self.last_issued, self._nu = last_issued, nu
        self.is_settled = out is NOTHING and (reading.pending is NOTHING or not reading.pending.any())
        self._x, self._R, self._applied = reading.x, reading.R, reading.applied
        self._applied_n, self.one_step_delay = reading.applied_n, reading.one_step_delay

    def infer_pending(self, nu: Array, M_inverse: Array) -> Array:
        """The pending impulse (6,) of a ship that does not return impulse_applied: that of the last step, or zero.

        The received velocity nu (6,) decides: zero is pending if the velocity shows more than half of the impulse.
        M_inverse (6, 6): of the free degrees of freedom, since nothing else shows.
        """
        if not self.last_issued.any():
            return self.last_issued
        change = float(self.last_issued @ (nu - self._nu))  # twice the work of the impulse, if applied
        whole = float(self.last_issued @ M_inverse @ self.last_issued)
        return np.zeros(6) if change > 0.5 * whole else self.last_issued

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


_ARRAYS = ("issued", "last_issued", "_nu", "_applied", "_x", "_R", "_issued_n", "_applied_n", "_size")


def _infer_nothing(ledger: ImpulseLedger, nu: Array, M_inverse: Array) -> Array:
    return np.zeros(6)


FEEDBACKS: dict[str, Callable[[ImpulseLedger, Array, Array], Array]] = {
    "ledger": _infer_nothing,
    "force": ImpulseLedger.infer_pending,
    "state": ImpulseLedger.infer_pending,
    "none": _infer_nothing,
    "prescribed": _infer_nothing,
}
"""By name, how the pending impulse (6,) is inferred. With "ledger" it is received, not inferred."""


def _is_out_of_range(nu: Array, reach: float, H: float) -> bool:
    u, v, w, p, q, r = nu.tolist()
    return H * (hypot(p, q, r) + hypot(u, v, w) / reach) > RANGE


def _wrench_in_n(x: Array, R: Array, J: Array) -> Array:
    """J (6,), in b about CO at a pose, as a wrench in n about its origin."""
    linear, w = R @ J[:3], np.empty(6)
    w[:3], w[3:] = linear, R @ J[3:] + skew(x) @ linear
    return w


def _wrench_in_b(x: Array, R: Array, wrench: Array) -> Array:
    """A wrench in n about its origin, in b about CO at a pose; (6,)."""
    linear = wrench[:3]
    return np.concatenate([R.T @ linear, R.T @ (wrench[3:] - skew(x) @ linear)])
