"""The collision model: ship states in, impulses and post-impact states out.

A communication step [t, t + H]:

    read          check what came in; the ledgers say what is pending (impulse_ledger.py); states of the ships
    find near     pairs whose hulls could touch within the step (proximity.py); far pairs are never looked at
    for each substep of fixed length h:
        press     fenders that are compressed (fender_ledger.py), booked one by one
        advance   the predicted poses of the states that are near another
        respond   contacts there, answered by one of the rival responses
        book      impulses into twists and ledger, energy lost, contact points, collisions
    publish       poses, twists, impulses, mean forces, contacts, events

Bodies are the ships in the order of the build, then the obstacles (obstacles.py), which are bodies with zero inverse
mass and a fixed pose: wherever a ship has an index, so has an obstacle, beyond the ships.

Impulses are solved and booked with the ships at the poses at which they will be applied: those received under a
sequential master, those of a step later under a parallel one. Linear and angular momentum then balance to rounding, and
the kinetic energy lost is that of the real ships. The predicted poses decide only whether, where and with which normal
the hulls touch.

State before a step that fails stays as it was. The model knows nothing of FMI.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import StepError
from ..ship.coasting import coast
from ..ship.frames import attitude_from_rotation, attitude_unwrapped
from .bodies import Body, prepare_bodies
from .checks import check_parameters, check_states, check_step
from .collisions import Collisions
from .contact_points import ContactPoint, fit_contact_points, merge_contact_point
from .dynamics.body_state import BodyState
from .dynamics.contact import Impulse, actual_velocity, book
from .dynamics.energy import energy_lost
from .dynamics.impulse_ledger import ImpulseLedger, Reading
from .dynamics.other_forces import ReceivedState, drift
from .dynamics.passivity import enforce_passivity
from .fender import Fender, combine_in_series
from .fender_ledger import FenderLedger
from .geometry.detection import Detector, LastNormals
from .interface import (
    CollisionInputs,
    CollisionOutputs,
    CollisionParameters,
    ShipParameters,
    ShipPost,
    ShipState,
)
from .proximity import Pair, Proximity, room
from .responses import RESPONSES, ContactProblem
from .solvers.warm_start import WarmStarts

__all__ = ["ShipCollision"]

CONVERGED = 1e-9
"""Residual of the solver, as a share of the approach, above which an answer counts as not converged."""

MAXIMUM_SUBSTEPS = 10_000
"""Of one communication step in which hulls are near each other: 100 s at 0.01 s. More is a mistake in a unit."""

_NO_FORCE = (0.0,) * 6
_ABSENT = BodyState.wall(np.zeros(3), 0.0)  # stands for a ship that is far from all others


class ShipCollision:
    """Collision of two or more ships. Names of ships are those of the FMU's variables."""

    def __init__(self, ships: Sequence[str] = ("own", "target")) -> None:
        self.names = tuple(ships)
        self.directory: Path | None = None  # where ship files are looked for before the current folder
        self.parameters = CollisionParameters([ShipParameters() for _ in ships])
        self.inputs = CollisionInputs([ShipState() for _ in ships])
        self.outputs = CollisionOutputs([ShipPost() for _ in ships])
        self.warning = ""  # what was not as it should be in the last step
        self._detector: Detector | None = None
        self._bodies: list[Body] = []

    # -- set-up -------------------------------------------------------------------------------------

    def initialise(self) -> None:
        """Read the parameters, load ships and obstacles, set the outputs of the start. Raises InputError on a bad
        parameter, StepError on a state that is not finite or absurd."""
        check_parameters(self.parameters)
        bodies = prepare_bodies(self.names, self.parameters, self.directory)
        check_states(0.0, bodies, self.inputs.ships)
        self.close()
        self._detector = Detector([body.hull for body in bodies])
        self._bodies, n = bodies, len(self.names)
        self._proximity = Proximity(bodies, n, self._detector, self.parameters.clearance_range)
        self._bullets = [body.bullet for body in bodies]
        self._centres = [body.bullet.r_bg.tolist() for body in bodies]
        self._walls = [body.wall for body in bodies if body.wall is not None]
        for i, wall in enumerate(self._walls, start=n):
            self._detector.place(i, wall)
        self._ledgers = [ImpulseLedger() for _ in range(n)]
        self._last_received: list[ReceivedState | None] = [None] * n
        self._energy = np.zeros(3)
        self._fenders = FenderLedger()
        self._last_normals: LastNormals = {}
        self._warm: WarmStarts = {}
        self._collisions = Collisions(self.parameters.minimum_separation_time)
        self._unconverged = self._scaled = 0
        self._residual, self._sweeps = 0.0, 0
        self._readings: dict[int, Reading] = {}
        self._one_step_delay = False  # of any ship: assumed of those that were never hit
        states = [self._received(i, 0.0, 0.0) for i in range(n)] + self._walls
        candidates = self._proximity.candidates(states, self.inputs.ships, 0.0)
        self._publish(0.0, 0.0, states, [], candidates)

    @property
    def obstacles(self) -> tuple[str, ...]:
        """Names of the obstacles, in the order of their numbers."""
        return tuple(body.name for body in self._bodies[len(self.names) :])

    def close(self) -> None:
        """Leave the Bullet world."""
        if self._detector is not None:
            self._detector.bullet.close()
            self._detector = None

    # -- a step -------------------------------------------------------------------------------------

    def step(self, t: float, H: float) -> None:
        """Advance from t by H [s]. Raises StepError on an input that is not finite or absurd; nothing changes then."""
        self._ready()
        check_step(t, H, self._bodies, self.inputs.ships)
        self.warning = ""
        self._readings.clear()
        states, candidates = self._read(t, H)
        near = self._proximity.near(candidates, states, H)
        self._residual, self._sweeps = 0.0, 0
        if not near:
            self._collisions.close_old(t)
            self._advance(states, H)
            self._publish(t + H, H, states, [], candidates)
            return
        before = self.get_state()
        try:
            points = self._collide(t, H, near, states)
        except Exception:
            self.set_state(before)
            raise
        if (missed := self._unconverged - self.outputs.solver.unconverged) > 0:
            self.warning = (
                f"contact was not solved to {CONVERGED:g} of the approach {missed} times in the step from t = {t:g} s "
                f"by {H:g} s, at worst to {self._residual:.2g}: its impulses are less exact (solver.residual)"
            )
        self._publish(t + H, H, states, points, candidates)

    def _read(self, t: float, H: float) -> tuple[list[BodyState], list[Pair]]:
        """Shadows of the bodies, of a ship that is quiet and far from all others a mere placeholder; candidates."""
        ships, feedback = self.inputs.ships, self.parameters.feedback
        self._one_step_delay = any(ledger.one_step_delay for ledger in self._ledgers)
        known = [
            None
            if self._last_received[i] is None and self._ledgers[i].is_quiet(feedback, received.impulse_applied)
            else self._received(i, t, H)
            for i, received in enumerate(ships)
        ]
        candidates = self._proximity.candidates(known, ships, H)
        met = {i for pair in candidates for i in pair}
        states = [
            state if state is not None else self._received(i, t, H) if i in met else _ABSENT
            for i, state in enumerate(known)
        ]
        return states + self._walls, candidates

    def _received(self, i: int, t: float, H: float) -> BodyState:
        """State of a ship as received, with what is pending, and expected of other forces, in its twist; placed where
        it will take impulses."""
        received, body, feedback = self.inputs.ships[i], self._bodies[i], self.parameters.feedback
        nu, x = np.array(received.velocity + received.rate), np.array(received.position)
        M_inverse = body.inverse_at(received.attitude)
        state = BodyState.at(x, np.array(received.attitude), nu, M_inverse, body.bullet.r_bg)
        applied = np.array(received.impulse_applied)
        reading = self._ledgers[i].read(feedback, x, state.R, nu, applied, M_inverse, body.reach, H)
        state.nu = reading.nu + M_inverse @ reading.deficit if reading.deficit.any() else reading.nu
        if (before := self._last_received[i]) is not None and feedback == "ledger":
            found = drift(
                before, _as_received(t, 0.0, received), body.inverse_at(before.attitude), body.bullet.r_bg, body.reach
            )
            if found is not None:
                state.drift, state.scheme_error = found.mean, found.scheme_error
                if reading.pending.any():  # a parallel master: what is issued now is applied to a ship that has gone on
                    state.nu = state.nu + found.gain
        if self._one_step_delay if reading.one_step_delay is None else reading.one_step_delay:
            x_then, R_then = state.coast(reading.nu, H)
            state.apply_at(x_then, R_then, body.inverse_at(attitude_from_rotation(R_then).tolist()))
        state.nu_received = state.nu
        self._readings[i] = reading
        return state

    def _advance(self, states: Sequence[BodyState], H: float, but: Container[int] = ()) -> None:
        """Move on by H [s] the states that there are, but for some."""
        for i, state in enumerate(states):
            if not state.fixed and i not in but:
                state.advance(H)

    def _collide(self, t: float, H: float, near: dict[Pair, float], states: list[BodyState]) -> list[ContactPoint]:
        """Take the states through the step; the contact points they went through.

        near: pairs and their gaps. A gap lasts some substeps at the speeds that the hulls have: a pair is looked at
        again when it could have closed.
        """
        self._collisions.close_old(t)
        moving = {i for pair in near for i in pair if not states[i].fixed}
        self._advance(states, H, moving)
        fenders = {pair: fender for pair in near if (fender := self._fender(pair)) is not None}
        points = list[ContactPoint]()
        n, h = _substeps(H, self.parameters.substep)
        due = {pair: 0 if pair in fenders else self._lasts(pair, gap, h, states) for pair, gap in near.items()}
        pending_substeps = 0  # by which the predicted poses lag
        for j in range(n):
            now = [pair for pair in near if due[pair] <= j]
            pending_substeps += 1
            if not now:
                continue
            for pair, fender in fenders.items():
                points = self._press(pair, fender, h, states, points)
            for i in moving:
                for _ in range(pending_substeps):
                    states[i].advance(h)
                self._ready().place(i, states[i])
            pending_substeps = 0
            impulses = self._respond(t + (j + 1) * h, h, now, states)
            points = self._book(impulses, states, points)
            if impulses:
                due = dict.fromkeys(near, j + 1)
            elif not fenders:
                left = (n - 1 - j) * h
                for pair in now:
                    gap = self._ready().clearance(*pair, self._approach(pair, left, states))
                    due[pair] = j + 1 + self._lasts(pair, gap, h, states)
        for i in moving:
            if pending_substeps == n:
                states[i].advance(H)
            else:
                for _ in range(pending_substeps):
                    states[i].advance(h)
        return points

    def _lasts(self, pair: Pair, gap: float, h: float, states: Sequence[BodyState]) -> int:
        """Substeps of h [s] in which a gap [m] cannot close."""
        if gap <= 0.0:
            return 0
        self._last_normals.pop(pair, None)
        approach = self._approach(pair, h, states)
        return int(min(gap / approach, 1e9)) if approach > 0.0 else 10**9

    def _approach(self, pair: Pair, h: float, states: Sequence[BodyState]) -> float:
        """How much nearer two hulls may come in h [s], at most [m]."""
        return sum(room(self._bodies[i], states[i], h) - self._bodies[i].around for i in pair)

    def _ready(self) -> Detector:
        if self._detector is None:
            raise StepError("ShipCollision is not initialised: call initialise() before the first step")
        return self._detector

    # -- contact --------------------------------------------------------------------------------------

    def _fender(self, pair: Pair) -> Fender | None:
        return combine_in_series(self._bodies[pair[0]].fender, self._bodies[pair[1]].fender)

    def _press(
        self, pair: Pair, fender: Fender, h: float, states: list[BodyState], points: list[ContactPoint]
    ) -> list[ContactPoint]:
        """One substep of the fender between two bodies."""
        contact = self._ready().facing(*pair, fender.thickness, states, self._last_normals)
        if contact is None:
            self._fenders.release(pair)
            return points
        pressed = self._fenders.press(fender, contact, states, self.parameters.friction, h)
        return points if pressed is None else merge_contact_point(points, pressed)

    def _respond(self, t: float, h: float, near: list[Pair], states: list[BodyState]) -> list[Impulse]:
        """Contacts at the predicted poses and their impulses; collisions and scratches are opened here."""
        detector, parameters = self._ready(), self.parameters
        answered = near
        if parameters.feedback == "none":  # one impact per collision: what follows is watched, not answered
            answered = [pair for pair in near if not self._collisions.is_open(*pair)]
            for a, b in set(near) - set(answered):
                if watched := detector.contacts(a, b, states, self._last_normals):
                    self._collisions.touch(t, watched, states)
        answer = RESPONSES[parameters.response](
            ContactProblem(
                answered, states, detector, self._last_normals, self._warm, self._bullets, parameters.friction,
                parameters.restitution, h,
            )
        )  # fmt: skip
        for pair in answered:
            contacts = [i.contact for i in answer.impulses if (i.contact.a, i.contact.b) == pair]
            if contacts:
                self._collisions.touch(t, contacts, states)
        self._residual, self._sweeps = max(self._residual, answer.residual), max(self._sweeps, answer.sweeps)
        self._unconverged += answer.residual > CONVERGED
        impulses, scaled = enforce_passivity(answer.impulses, states)
        self._scaled += scaled
        return impulses

    def _book(self, impulses: list[Impulse], states: list[BodyState], points: list[ContactPoint]) -> list[ContactPoint]:
        """Impulses into both ships' twists and ledgers, the energy they cost, and the contact points of the step."""
        before = [actual_velocity(i.contact, states) for i in impulses]
        for impulse in impulses:
            book(impulse, states)
        for impulse, v_before in zip(impulses, before, strict=True):
            c = impulse.contact
            along, across = energy_lost(impulse.P, c.normal, v_before, actual_velocity(c, states))
            self._energy = self._energy + [along + across, along, across]
            collision, scratch = self._collisions.numbers(c.a, c.b)
            points = merge_contact_point(points, ContactPoint.of(c, impulse.P, along + across, collision, scratch))
        return points

    # -- outputs ------------------------------------------------------------------------------------

    def _publish(
        self, t: float, H: float, states: list[BodyState], points: list[ContactPoint], candidates: Sequence[Pair]
    ) -> None:
        colliding = self._collisions.open_ships()
        for i, state in enumerate(states[: len(self.names)]):
            post, received = self.outputs.ships[i], self.inputs.ships[i]
            if state is _ABSENT:
                post.position[:], post.attitude[:], post.velocity[:] = coast(
                    received.position, received.attitude, received.velocity, received.rate, self._centres[i], H
                )
                post.rate[:] = received.rate
                post.force[:] = _NO_FORCE
                continue
            ledger, reading = self._ledgers[i], self._readings[i]
            ledger.close(reading, state.issued, state.nu_received, state.x_applied, state.R_applied)
            post.impulse[:] = ledger.issued.tolist()
            post.force[:] = (state.issued / H).tolist() if state.issued.any() else _NO_FORCE
            self._last_received[i] = _as_received(t - H, H, received) if i in colliding else None
            nu = state.predicted_twist.tolist()
            post.position[:] = state.x.tolist()
            post.attitude[:] = attitude_unwrapped(attitude_from_rotation(state.R), received.attitude[2]).tolist()
            post.velocity[:], post.rate[:] = nu[:3], nu[3:]
        self._publish_contacts(t, points)
        out = self.outputs
        out.energy.dissipated, out.energy.normal, out.energy.tangential = self._energy.tolist()
        out.fender.stored, out.fender.dissipated = self._fenders.energy
        out.clearance, (out.nearest_ship_a, out.nearest_ship_b) = self._proximity.clearance(candidates, states)
        out.solver.residual, out.solver.sweeps = self._residual, self._sweeps
        out.solver.unconverged, out.solver.scaled = self._unconverged, self._scaled

    def _publish_contacts(self, t: float, points: list[ContactPoint]) -> None:
        out, latest = self.outputs, self._collisions.latest
        if not points and not out.contact_count and out.collision_count == self._collisions.impacts:
            return  # nothing to show, and nothing shown: most steps
        points = fit_contact_points(points, len(out.contacts))
        for k, place in enumerate(out.contacts):
            if k < len(points):
                points[k].fill(place)
            elif place.ship_a:
                ContactPoint.unused().fill(place)
        out.contact_active, out.contact_count = any(s.impact for s in points), len(points)
        out.scratch_id = max((s.scratch for s in points), default=0)
        out.collision_count, out.impact.ship_a, out.impact.ship_b = (
            self._collisions.impacts, latest.ship_a, latest.ship_b,
        )  # fmt: skip
        out.impact.time, out.impact.closing_speed, out.impact.angle = latest.time, latest.closing_speed, latest.angle
        out.impact.point[:] = latest.point

    # -- state --------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """What the outputs do not show: the ships' ledger, energy in fenders, last normals, warm starts, collisions.
        Empty before initialise()."""
        if self._detector is None:
            return {}
        return {
            "ledgers": [ledger.get_state() for ledger in self._ledgers],
            "energy": self._energy.tolist(),
            "last_received": [None if s is None else list(s) for s in self._last_received],
            "fenders": self._fenders.get_state(),
            "last_normals": [[a, b, carrier, list(normal)] for (a, b), (carrier, normal) in self._last_normals.items()],
            "warm_starts": [[a, b, [[*row] for row in rows]] for (a, b), rows in self._warm.items()],
            "solver": [self._unconverged, self._scaled],
            "collisions": self._collisions.get_state(),
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        if not state:
            self.close()
            return
        for ledger, saved in zip(self._ledgers, state["ledgers"], strict=True):
            ledger.set_state(saved)
        self._energy = np.array(state["energy"])
        self._last_received = [None if s is None else ReceivedState(*s) for s in state["last_received"]]
        self._fenders.set_state(state["fenders"])
        self._last_normals = {(a, b): (carrier, list(normal)) for a, b, carrier, normal in state["last_normals"]}
        self._warm = {(a, b): [(place, impulse) for place, impulse in rows] for a, b, rows in state["warm_starts"]}
        self._unconverged, self._scaled = state["solver"]
        self._collisions.set_state(state["collisions"])


def _substeps(H: float, substep: float) -> tuple[int, float]:
    """Number and length of the substeps of H [s]: of `substep` exactly where H is a multiple of it, else of H / n.

    A master's step has jitter in its last bits; it must not reach the contact solver. Raises StepError for too many.
    """
    if not H / substep <= MAXIMUM_SUBSTEPS:
        raise StepError(
            f"a step of {H:g} s takes {H / substep:.3g} substeps of {substep:g} s, at most {MAXIMUM_SUBSTEPS} where "
            "hulls are near: take shorter steps, or a longer substep"
        )
    n = max(1, round(H / substep))
    if abs(H - n * substep) <= 1e-6 * substep:
        return n, substep
    n = ceil(H / substep)
    return n, H / n


def _as_received(t: float, H: float, state: ShipState) -> ReceivedState:
    return ReceivedState(
        t, H, list(state.position), list(state.attitude), state.velocity + state.rate, list(state.impulse_applied)
    )
