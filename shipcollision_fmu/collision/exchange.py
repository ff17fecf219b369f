"""The exchange with the ship models: states received, impulses and post-impact states returned.

    receive    the received velocity is corrected by the pending impulses (impulse_ledger.py); what other forces will
               add is estimated (other_forces.py)
    find ends  pose and twist at the end of the step; here the law of a ship may refuse its motion
    publish    the impulse of the step is entered in the ledger, and the outputs are filled

Most ships in most steps are *quiet*: nothing pending, no open collision. A quiet ship far from all others gets no state
(ABSENT stands for it) and merely coasts (ship/coasting_law.py).
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from typing import Any

import numpy as np

from ..ship.coasting import coast
from ..ship.coasting_law import CoastingLaw, Motion
from ..ship.frames import Array, attitude_from_rotation, unwrap_attitude
from .bodies import Body
from .checks import check_pending
from .dynamics.body_state import NOTHING, BodyState
from .dynamics.impulse_ledger import ImpulseLedger, Reading
from .dynamics.other_forces import ReceivedState, estimate_other_forces
from .interface import ShipPost, ShipState

__all__ = ["ABSENT", "ShipExchange"]

ABSENT = BodyState.wall(np.zeros(3), 0.0)
"""Stands for the state of a quiet ship that is far from all others."""

_NO_FORCE = (0.0,) * 6
_NO_TURN, _NO_TILT = [0.0] * 3, [0.0] * 2


class ShipExchange:
    """Ledgers and last received states of the ships. inputs, outputs: of the model, one each per ship."""

    def __init__(
        self, bodies: Sequence[Body], feedbacks: Sequence[str], inputs: Sequence[ShipState], outputs: Sequence[ShipPost]
    ) -> None:
        self._bodies, self._feedbacks, self._inputs, self._outputs = bodies, feedbacks, inputs, outputs
        self._centres = [body.bullet.r_bg.tolist() for body in bodies[: len(inputs)]]
        self._laws = [body.coasting for body in bodies[: len(inputs)]]
        self.ledgers = [ImpulseLedger() for _ in inputs]
        self._last_received: list[ReceivedState | None] = [None] * len(inputs)  # of ships in an open collision
        self._readings: dict[int, Reading] = {}
        self.delayed_speeds: dict[int, float] = {}  # by ship, what an impulse takes that a parallel master applies now

    # -- receive --------------------------------------------------------------------------------------

    def receive_active(self, t: float, H: float) -> list[BodyState | None]:
        """States at the start t of a step of H [s]; None for quiet ships. Raises StepError where the law of a ship
        refuses its motion, here and below, and where an impulse pending is absurd."""
        self._readings.clear()
        self.delayed_speeds.clear()
        self._delay = any(ledger.one_step_delay for ledger in self.ledgers)
        return [
            None
            if self._last_received[i] is None
            and self.ledgers[i].is_quiet(self._feedbacks[i], self._inputs[i].impulse_applied)
            else self._receive(i, t, H)
            for i in range(len(self._inputs))
        ]

    def receive_others(
        self, t: float, H: float, active: Sequence[BodyState | None], included: Container[int]
    ) -> list[BodyState]:
        """States of all ships: the active ones, those of the quiet ships in `included`, ABSENT for the rest."""
        return [
            state if state is not None else self._receive(i, t, H) if i in included else ABSENT
            for i, state in enumerate(active)
        ]

    def _receive(self, i: int, t: float, H: float) -> BodyState:
        """State of a ship, corrected by what is pending and by other forces."""
        received, body, feedback = self._inputs[i], self._bodies[i], self._feedbacks[i]
        nu, x = np.array(received.velocity + received.rate), np.array(received.position)
        M_inverse = body.inverse_at(received.attitude)
        state = BodyState.at(x, received.attitude, nu, M_inverse, body.bullet.r_bg, body.held)
        applied = np.array(received.impulse_applied)
        reading = self.ledgers[i].read(feedback, x, state.R, nu, applied, M_inverse, body.reach, H)
        if feedback == "ledger" and reading.nu is not nu:
            check_pending(t, body, reading.nu, received.impulse_applied)
        if reading.one_step_delay and reading.pending.any():
            self.delayed_speeds[i] = float(np.linalg.norm((reading.nu - nu)[:3]))
        nu = reading.nu + M_inverse @ reading.deficit if reading.deficit is not NOTHING else reading.nu
        if (before := self._last_received[i]) is not None and feedback == "ledger":
            forces = estimate_other_forces(
                before, _as_received(t, 0.0, received), body.inverse_at(before.attitude), body.bullet.r_bg, body.reach,
                body.coasting,
            )  # fmt: skip
            if forces is not None:
                state.expect(forces)
                if reading.pending.any():  # one-step delay: the impulse meets a ship that has gained velocity
                    nu = nu + forces.velocity_gain
        if nu is not state.nu:
            state.set_twist(nu)
        if body.coasting is not None and H > 0.0:
            _follow(body.coasting, state, received, reading.nu, H)
        if self._delay if reading.one_step_delay is None else reading.one_step_delay:
            x_then, R_then = state.pose_after(reading.nu, H)
            state.apply_at(x_then, R_then, body.inverse_at(attitude_from_rotation(R_then).tolist()))
        state.nu_received = state.nu
        self._readings[i] = reading
        return state

    # -- the end of the step --------------------------------------------------------------------------

    def find_ends(self, H: float, states: Sequence[BodyState]) -> list[Motion]:
        """Position [m], attitude [rad], velocity and rate in b of the ships at the end of the step.

        Raises StepError where the law of a ship refuses its motion. Nothing changes.
        """
        return [
            self._coast_absent(i, H) if state is ABSENT else self._find_end(i, state, H)
            for i, state in enumerate(states[: len(self._inputs)])
        ]

    def _coast_absent(self, i: int, H: float) -> Motion:
        received, law = self._inputs[i], self._laws[i]
        if law is None or (  # a course ahead without looking at the law: most ships in most steps
            law.keeps_course and received.rate == _NO_TURN and received.attitude[:2] == _NO_TILT
            and received.velocity[1:] == _NO_TILT and received.position[2] == 0.0
        ):  # fmt: skip
            course = coast(received.position, received.attitude, received.velocity, received.rate, self._centres[i], H)
            return (*course, received.rate)
        return law.coast(received.position, received.attitude, received.velocity, received.rate, H)

    def _find_end(self, i: int, state: BodyState, H: float) -> Motion:
        nu, received = self._twist_at_the_end(i, state, H), self._inputs[i].attitude
        attitude = (
            received if state.R is self._readings[i].R  # it did not turn
            else unwrap_attitude(attitude_from_rotation(state.R), received[2]).tolist()
        )  # fmt: skip
        return state.x.tolist(), attitude, nu[:3], nu[3:]

    def publish(
        self, t: float, H: float, states: Sequence[BodyState], ends: Sequence[Motion], colliding: Container[int]
    ) -> None:
        """Close the ledgers of the step that began at t [s], and fill the outputs.

        ends: of find_ends(). colliding: bodies in an open collision; for these the received state is kept until the
        next step.
        """
        for i, (out, received, end) in enumerate(zip(self._outputs, self._inputs, ends, strict=True)):
            state = states[i]
            out.position[:], out.attitude[:], out.velocity[:], out.rate[:] = end
            if state is ABSENT:
                out.force[:] = _NO_FORCE
                continue
            ledger = self.ledgers[i]
            ledger.close(self._readings[i], state.issued, state.nu_received, state.x_applied, state.R_applied)
            out.impulse[:] = ledger.issued.tolist()
            out.force[:] = (state.issued / H).tolist() if state.issued is not NOTHING else _NO_FORCE
            self._last_received[i] = _as_received(t, H, received) if i in colliding else None

    def _twist_at_the_end(self, i: int, state: BodyState, H: float) -> list[float]:
        """Twist (6,) at the end of the step, in b by then. For a ship that adopts it after an impulse the law is asked
        again: it then has the energy that the impulse left it."""
        law = self._bodies[i].coasting
        if law is None or self._feedbacks[i] != "state" or state.end_gain is None or state.issued is NOTHING:
            return [*state.twist_at_predicted_pose().tolist()]
        received, nu = self._inputs[i], state.nu.tolist()
        _, _, velocity, rate = law.coast(received.position, received.attitude, nu[:3], nu[3:], H)
        return [*velocity, *rate]

    # -- state ----------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        return {
            "ledgers": [ledger.get_state() for ledger in self.ledgers],
            "last_received": [None if s is None else list(s) for s in self._last_received],
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        for ledger, saved in zip(self.ledgers, state["ledgers"], strict=True):
            ledger.set_state(saved)
        self._last_received = [None if s is None else ReceivedState(*s) for s in state["last_received"]]


def _follow(law: CoastingLaw, state: BodyState, received: ShipState, start: Array, H: float) -> None:
    """Let the state follow the law of its ship through the step, from the twist start (6,)."""
    nu = start.tolist()
    if not law.is_straight(received.position, received.attitude, nu[:3], nu[3:]):
        state.follow(law.coast(received.position, received.attitude, nu[:3], nu[3:], H), nu, H)


def _as_received(t: float, H: float, ship: ShipState) -> ReceivedState:
    return ReceivedState(
        t, H, list(ship.position), list(ship.attitude), ship.velocity + ship.rate, list(ship.impulse_applied)
    )
