"""The collision model: ship states in, impulses and post-impact states out.

A communication step [t, t + H]:

    read          check what came in; the books say what is pending (impulse_ledger.py); shadows of the ships
    find near     pairs whose hulls could touch within the step (proximity.py); far pairs are never looked at
    for each substep of fixed length h:
        press     fenders that are compressed (fender_ledger.py), booked one by one
        advance   the predicted poses of the shadows that are near another
        respond   contacts there, answered by one of the rival responses
        book      impulses into twists and ledger, energy lost, contact points, episodes
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
from .bodies import Body, prepared
from .checks import check_parameters, check_states, check_step
from .collisions import Episodes
from .contact_points import Slot, fitted, merged
from .dynamics.body_state import Shadow
from .dynamics.contact import Impulse, actual_velocity, book
from .dynamics.energy import energy_lost
from .dynamics.impulse_ledger import Books, Reading
from .dynamics.other_forces import Seen, drift
from .dynamics.passivity import passive
from .fender import Fender, in_series
from .fender_ledger import FenderBooks
from .geometry.detection import Detector, KeptNormals
from .interface import (
    CollisionInputs,
    CollisionOutputs,
    CollisionParameters,
    ShipParameters,
    ShipPost,
    ShipState,
)
from .proximity import Neighbours, Pair, room
from .responses import RESPONSES, Encounter
from .solvers.warm_start import WarmStarts

__all__ = ["ShipCollision"]

CONVERGED = 1e-9
"""Residual of the solver, as a share of the approach, above which an answer counts as not converged."""

MAXIMUM_SUBSTEPS = 10_000
"""Of one communication step in which hulls are near each other: 100 s at 0.01 s. More is a mistake in a unit."""

_NO_FORCE = (0.0,) * 6
_ABSENT = Shadow.wall(np.zeros(3), 0.0)  # stands for a ship that is far from all others


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
        bodies = prepared(self.names, self.parameters, self.directory)
        check_states(0.0, bodies, self.inputs.ships)
        self.close()
        self._detector = Detector([body.hull for body in bodies])
        self._bodies, n = bodies, len(self.names)
        self._neighbours = Neighbours(bodies, n, self._detector, self.parameters.clearance_range)
        self._bullets = [body.bullet for body in bodies]
        self._centres = [body.bullet.r_bg.tolist() for body in bodies]
        self._walls = [body.wall for body in bodies if body.wall is not None]
        for i, wall in enumerate(self._walls, start=n):
            self._detector.place(i, wall)
        self._books = [Books() for _ in range(n)]
        self._seen: list[Seen | None] = [None] * n
        self._energy = np.zeros(3)
        self._fenders = FenderBooks()
        self._kept: KeptNormals = {}
        self._warm: WarmStarts = {}
        self._episodes = Episodes(self.parameters.minimum_separation_time)
        self._unconverged = self._scaled = 0
        self._residual, self._sweeps = 0.0, 0
        self._readings: dict[int, Reading] = {}
        self._late = False  # whether ships apply impulses late, as far as is known: one that was never hit may, too
        shadows = [self._received(i, 0.0, 0.0) for i in range(n)] + self._walls
        candidates = self._neighbours.candidates(shadows, self.inputs.ships, 0.0)
        self._publish(0.0, 0.0, shadows, [], candidates)

    @property
    def obstacles(self) -> tuple[str, ...]:
        """Names of the obstacles, in the order of their numbers."""
        return tuple(body.name for body in self._bodies[len(self.names) :])

    def close(self) -> None:
        """Leave the Bullet world."""
        if self._detector is not None:
            self._detector.engine.close()
            self._detector = None

    # -- a step -------------------------------------------------------------------------------------

    def step(self, t: float, H: float) -> None:
        """Advance from t by H [s]. Raises StepError on an input that is not finite or absurd; nothing changes then."""
        self._ready()
        check_step(t, H, self._bodies, self.inputs.ships)
        self.warning = ""
        self._readings.clear()
        shadows, candidates = self._read(t, H)
        near = self._neighbours.near(candidates, shadows, H)
        self._residual, self._sweeps = 0.0, 0
        if not near:
            self._episodes.close_old(t)
            self._advance(shadows, H)
            self._publish(t + H, H, shadows, [], candidates)
            return
        before = self.get_state()
        try:
            slots = self._collide(t, H, near, shadows)
        except Exception:
            self.set_state(before)
            raise
        if (missed := self._unconverged - self.outputs.solver_unconverged) > 0:
            self.warning = (
                f"contact was not solved to {CONVERGED:g} of the approach {missed} times in the step from t = {t:g} s "
                f"by {H:g} s, at worst to {self._residual:.2g}: its impulses are less exact (solver.residual)"
            )
        self._publish(t + H, H, shadows, slots, candidates)

    def _read(self, t: float, H: float) -> tuple[list[Shadow], list[Pair]]:
        """Shadows of the bodies, of a ship that is quiet and far from all others a mere placeholder; candidates."""
        ships, feedback = self.inputs.ships, self.parameters.feedback
        self._late = any(books.late for books in self._books)
        known = [
            None
            if self._seen[i] is None and self._books[i].is_quiet(feedback, state.impulse_applied)
            else self._received(i, t, H)
            for i, state in enumerate(ships)
        ]
        candidates = self._neighbours.candidates(known, ships, H)
        met = {i for pair in candidates for i in pair}
        shadows = [
            shadow if shadow is not None else self._received(i, t, H) if i in met else _ABSENT
            for i, shadow in enumerate(known)
        ]
        return shadows + self._walls, candidates

    def _received(self, i: int, t: float, H: float) -> Shadow:
        """Shadow of a ship as received, with what is pending, and expected of other forces, in its twist; booked where
        she will take impulses."""
        state, body, feedback = self.inputs.ships[i], self._bodies[i], self.parameters.feedback
        nu, x = np.array(state.velocity + state.rate), np.array(state.position)
        M_inverse = body.inverse_at(state.attitude)
        shadow = Shadow.at(x, np.array(state.attitude), nu, M_inverse, body.bullet.r_bg)
        applied = np.array(state.impulse_applied)
        reading = self._books[i].read(feedback, x, shadow.R, nu, applied, M_inverse, body.reach, H)
        shadow.nu = reading.nu + M_inverse @ reading.owed if reading.owed.any() else reading.nu
        if (before := self._seen[i]) is not None and feedback == "ledger":
            found = drift(before, _seen(t, 0.0, state), body.inverse_at(before.attitude), body.bullet.r_bg, body.reach)
            if found is not None:
                shadow.drift, shadow.off_centre = found.mean, found.off_centre
                if reading.pending.any():  # a parallel master: what is issued now is applied to a ship that has gone on
                    shadow.nu = shadow.nu + found.gain
        if self._late if reading.late is None else reading.late:
            x_then, R_then = shadow.ahead(reading.nu, H)
            shadow.apply_at(x_then, R_then, body.inverse_at(attitude_from_rotation(R_then).tolist()))
        shadow.nu_received = shadow.nu
        self._readings[i] = reading
        return shadow

    def _advance(self, shadows: Sequence[Shadow], H: float, but: Container[int] = ()) -> None:
        """Move on by H [s] the shadows that there are, but for some."""
        for i, shadow in enumerate(shadows):
            if not shadow.fixed and i not in but:
                shadow.advance(H)

    def _collide(self, t: float, H: float, near: dict[Pair, float], shadows: list[Shadow]) -> list[Slot]:
        """Take the shadows through the step; the contact points they went through.

        near: pairs and their gaps. A gap lasts some substeps at the speeds that the hulls have: a pair is looked at
        again when it could have closed.
        """
        self._episodes.close_old(t)
        moving = {i for pair in near for i in pair if not shadows[i].fixed}
        self._advance(shadows, H, moving)
        fenders = {pair: fender for pair in near if (fender := self._fender(pair)) is not None}
        slots = list[Slot]()
        n, h = _substeps(H, self.parameters.substep)
        due = {pair: 0 if pair in fenders else self._lasts(pair, gap, h, shadows) for pair, gap in near.items()}
        late = 0  # substeps that the poses are behind
        for j in range(n):
            now = [pair for pair in near if due[pair] <= j]
            late += 1
            if not now:
                continue
            for pair, fender in fenders.items():
                slots = self._press(pair, fender, h, shadows, slots)
            for i in moving:
                for _ in range(late):
                    shadows[i].advance(h)
                self._ready().place(i, shadows[i])
            late = 0
            impulses = self._respond(t + (j + 1) * h, h, now, shadows)
            slots = self._book(impulses, shadows, slots)
            if impulses:
                due = dict.fromkeys(near, j + 1)
            elif not fenders:
                left = (n - 1 - j) * h
                for pair in now:
                    gap = self._ready().clearance(*pair, self._approach(pair, left, shadows))
                    due[pair] = j + 1 + self._lasts(pair, gap, h, shadows)
        for i in moving:
            if late == n:
                shadows[i].advance(H)
            else:
                for _ in range(late):
                    shadows[i].advance(h)
        return slots

    def _lasts(self, pair: Pair, gap: float, h: float, shadows: Sequence[Shadow]) -> int:
        """Substeps of h [s] in which a gap [m] cannot close."""
        if gap <= 0.0:
            return 0
        self._kept.pop(pair, None)
        approach = self._approach(pair, h, shadows)
        return int(min(gap / approach, 1e9)) if approach > 0.0 else 10**9

    def _approach(self, pair: Pair, h: float, shadows: Sequence[Shadow]) -> float:
        """How much nearer two hulls may come in h [s], at most [m]."""
        return sum(room(self._bodies[i], shadows[i], h) - self._bodies[i].around for i in pair)

    def _ready(self) -> Detector:
        if self._detector is None:
            raise StepError("ShipCollision is not initialised: call initialise() before the first step")
        return self._detector

    # -- contact --------------------------------------------------------------------------------------

    def _fender(self, pair: Pair) -> Fender | None:
        return in_series(self._bodies[pair[0]].fender, self._bodies[pair[1]].fender)

    def _press(self, pair: Pair, fender: Fender, h: float, shadows: list[Shadow], slots: list[Slot]) -> list[Slot]:
        """One substep of the fender between two bodies."""
        contact = self._ready().facing(*pair, fender.thickness, shadows, self._kept)
        if contact is None:
            self._fenders.release(pair)
            return slots
        pressed = self._fenders.press(fender, contact, shadows, self.parameters.friction, h)
        return slots if pressed is None else merged(slots, pressed)

    def _respond(self, t: float, h: float, near: list[Pair], shadows: list[Shadow]) -> list[Impulse]:
        """Contacts at the predicted poses and their impulses; collisions and scratches are opened here."""
        detector, parameters = self._ready(), self.parameters
        answered = near
        if parameters.feedback == "none":  # one impact per collision: what follows is watched, not answered
            answered = [pair for pair in near if not self._episodes.is_open(*pair)]
            for a, b in set(near) - set(answered):
                if watched := detector.contacts(a, b, shadows, self._kept):
                    self._episodes.touch(t, watched, shadows)
        answer = RESPONSES[parameters.response](
            Encounter(
                answered, shadows, detector, self._kept, self._warm, self._bullets, parameters.friction,
                parameters.restitution, h,
            )
        )  # fmt: skip
        for pair in answered:
            contacts = [i.contact for i in answer.impulses if (i.contact.a, i.contact.b) == pair]
            if contacts:
                self._episodes.touch(t, contacts, shadows)
        self._residual, self._sweeps = max(self._residual, answer.residual), max(self._sweeps, answer.sweeps)
        self._unconverged += answer.residual > CONVERGED
        impulses, scaled = passive(answer.impulses, shadows)
        self._scaled += scaled
        return impulses

    def _book(self, impulses: list[Impulse], shadows: list[Shadow], slots: list[Slot]) -> list[Slot]:
        """Impulses into both ships' twists and ledgers, the energy they cost, and the contact slots of the step."""
        before = [actual_velocity(i.contact, shadows) for i in impulses]
        for impulse in impulses:
            book(impulse, shadows)
        for impulse, v_before in zip(impulses, before, strict=True):
            c = impulse.contact
            along, across = energy_lost(impulse.P, c.normal, v_before, actual_velocity(c, shadows))
            self._energy = self._energy + [along + across, along, across]
            collision, scratch = self._episodes.numbers(c.a, c.b)
            slots = merged(slots, Slot.of(c, impulse.P, along + across, collision, scratch))
        return slots

    # -- outputs ------------------------------------------------------------------------------------

    def _publish(
        self, t: float, H: float, shadows: list[Shadow], slots: list[Slot], candidates: Sequence[Pair]
    ) -> None:
        colliding = self._episodes.open_ships()
        for i, shadow in enumerate(shadows[: len(self.names)]):
            out, state = self.outputs.ships[i], self.inputs.ships[i]
            if shadow is _ABSENT:
                out.position[:], out.attitude[:], out.velocity[:] = coast(
                    state.position, state.attitude, state.velocity, state.rate, self._centres[i], H
                )
                out.rate[:] = state.rate
                out.force[:] = _NO_FORCE
                continue
            books, reading = self._books[i], self._readings[i]
            books.close(reading, shadow.issued, shadow.nu_received, shadow.x_applied, shadow.R_applied)
            out.impulse[:] = books.issued.tolist()
            out.force[:] = (shadow.issued / H).tolist() if shadow.issued.any() else _NO_FORCE
            self._seen[i] = _seen(t - H, H, state) if i in colliding else None
            nu = shadow.nu_predicted.tolist()
            out.position[:] = shadow.x.tolist()
            out.attitude[:] = attitude_unwrapped(attitude_from_rotation(shadow.R), state.attitude[2]).tolist()
            out.velocity[:], out.rate[:] = nu[:3], nu[3:]
        self._publish_contacts(t, slots)
        self.outputs.energy[:] = self._energy.tolist()
        self.outputs.fender[:] = self._fenders.energy
        self.outputs.clearance[0], nearest = self._neighbours.clearance(candidates, shadows)
        self.outputs.nearest_ship_a, self.outputs.nearest_ship_b = nearest
        self.outputs.solver[0], self.outputs.solver_sweeps = self._residual, self._sweeps
        self.outputs.solver_unconverged, self.outputs.solver_scaled = self._unconverged, self._scaled

    def _publish_contacts(self, t: float, slots: list[Slot]) -> None:
        out, latest = self.outputs, self._episodes.latest
        if not slots and not out.contact_count and out.impact_count == self._episodes.impacts:
            return  # nothing to show, and nothing shown: most steps
        slots = fitted(slots, len(out.contacts))
        for k, place in enumerate(out.contacts):
            if k < len(slots):
                slots[k].fill(place)
            elif place.ship_a:
                Slot.unused().fill(place)
        out.contact_active, out.contact_count = any(s.impact for s in slots), len(slots)
        out.scratch_id = max((s.scratch for s in slots), default=0)
        out.impact_count, out.impact_ship_a, out.impact_ship_b = self._episodes.impacts, latest.ship_a, latest.ship_b
        out.impact[:] = [latest.time, latest.closing_speed, latest.angle]
        out.impact_point[:] = latest.point

    # -- state --------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """What the outputs do not show: the ships' books, energy in fenders, kept normals, warm starts, episodes. Empty
        before initialise()."""
        if self._detector is None:
            return {}
        return {
            "books": [books.get_state() for books in self._books],
            "energy": self._energy.tolist(),
            "seen": [None if s is None else list(s) for s in self._seen],
            "fenders": self._fenders.get_state(),
            "kept": [[a, b, carrier, list(normal)] for (a, b), (carrier, normal) in self._kept.items()],
            "warm": [[a, b, [[*row] for row in rows]] for (a, b), rows in self._warm.items()],
            "solver": [self._unconverged, self._scaled],
            "episodes": self._episodes.get_state(),
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        if not state:
            self.close()
            return
        for books, saved in zip(self._books, state["books"], strict=True):
            books.set_state(saved)
        self._energy = np.array(state["energy"])
        self._seen = [None if s is None else Seen(*s) for s in state["seen"]]
        self._fenders.set_state(state["fenders"])
        self._kept = {(a, b): (carrier, list(normal)) for a, b, carrier, normal in state["kept"]}
        self._warm = {(a, b): [(place, impulse) for place, impulse in rows] for a, b, rows in state["warm"]}
        self._unconverged, self._scaled = state["solver"]
        self._episodes.set_state(state["episodes"])


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


def _seen(t: float, H: float, state: ShipState) -> Seen:
    return Seen(
        t, H, list(state.position), list(state.attitude), state.velocity + state.rate, list(state.impulse_applied)
    )
