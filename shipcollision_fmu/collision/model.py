"""The collision model: ship states in, impulses and post-impact states out.

A communication step [t, t + H]:

    receive       check what came in; shadows of the ships at the received poses, pending impulses taken in
    find near     pairs whose hulls could touch within the step (broad_phase.py); far pairs are never looked at
    for each substep of fixed length h:
        press     fenders that are compressed (fenders.py), booked one by one
        advance   the predicted poses of the shadows that are near another
        respond   contacts there, answered by one of the rival responses
        book      impulses into twists and ledger, energy lost, contact points, episodes
    publish       poses, twists, impulses, mean forces, contacts, events

Bodies are the ships in the order of the build, then the obstacles (obstacles.py), which are bodies with zero inverse
mass and a fixed pose: wherever a ship has an index, so has an obstacle, beyond the ships.

Impulses are solved and booked with the ships at their *received* poses, which is where a sequential master applies
them: linear and angular momentum then balance to rounding, and the kinetic energy lost is that of the real ships. The
predicted poses decide only whether, where and with which normal the hulls touch.

State before a step that fails stays as it was. The model knows nothing of FMI.
"""

from __future__ import annotations

from collections.abc import Container, Sequence
from math import ceil, hypot, isfinite
from typing import Any

import numpy as np

from ..errors import InputError, StepError
from ..ship.frames import Array, attitude_from_rotation, attitude_unwrapped
from .ahead import pose_ahead
from .axes import contact_axes
from .bodies import Body, apart, prepared
from .broad_phase import Rectangle, near_pairs
from .contact import Contact, Impulse, actual_velocity
from .detection import Detector, KeptNormals
from .drift import Seen, drift
from .energy import energy_lost
from .episodes import Episodes
from .fenders import Fender, friction_impulse, in_series, squeezed
from .ledger import FEEDBACKS, Account, pending_impulse
from .passive import passive
from .ports import SLOTS, CollisionInputs, CollisionOutputs, CollisionParameters, ShipParameters, ShipPost, ShipState
from .responses import RESPONSES, Encounter
from .shadow import Shadow
from .slots import Slot, merged

__all__ = ["ShipCollision"]

REACH_MARGIN = 0.1
"""Gap [m] within which a pair at rest still counts as near."""

ABSURD_SPEED = 1e3
"""Speeds [m/s] from here on are refused: a broken signal, not a ship."""

ABSURD_PLACE = 1e9
"""Distances from the origin [m] from here on are refused: the Earth is not that large."""

Pair = tuple[int, int]

_NO_FORCE = (0.0,) * 6


class ShipCollision:
    """Collision of two or more ships. Names of ships are those of the FMU's variables."""

    def __init__(self, ships: Sequence[str] = ("own", "target")) -> None:
        self.names = tuple(ships)
        self.parameters = CollisionParameters([ShipParameters() for _ in ships])
        self.inputs = CollisionInputs([ShipState() for _ in ships])
        self.outputs = CollisionOutputs([ShipPost() for _ in ships])
        self._detector: Detector | None = None
        self._bodies: list[Body] = []
        self._circles: list[tuple[float, float]] = []

    # -- set-up -------------------------------------------------------------------------------------

    def initialise(self) -> None:
        """Read the parameters, load ships and obstacles, set the outputs of the start. Raises InputError on a bad
        parameter."""
        _check(self.parameters)
        bodies = prepared(self.names, self.parameters)
        self.close()
        self._detector = Detector([body.hull for body in bodies])
        self._bodies = bodies
        self._bullets = [body.bullet for body in bodies]
        self._absent = Shadow.wall(np.zeros(3), 0.0)  # stands for a ship that is far from all others
        self._walls = [body.wall for body in bodies if body.wall is not None]
        n = len(self.names)
        for i, wall in enumerate(self._walls, start=n):
            self._detector.place(i, wall)
        self._issued = [np.zeros(6) for _ in range(n)]
        self._last = [np.zeros(6) for _ in range(n)]
        self._echo = [[0.0] * 6 for _ in range(n)]  # what a ship that has applied everything sends back
        self._busy = [False] * n  # had an impulse in the last step
        self._nu_sent = [np.zeros(6) for _ in range(n)]
        self._seen: list[Seen | None] = [None] * n
        self._energy = np.zeros(3)
        self._fenders: dict[Pair, float] = {}
        self._fender_dissipated = 0.0
        self._kept: KeptNormals = {}
        self._episodes = Episodes(self.parameters.minimum_separation_time)
        shadows = [
            Shadow.at(np.array(s.position), np.array(s.attitude), np.array(s.velocity + s.rate), body.M_inverse)
            for s, body in zip(self.inputs.ships, bodies, strict=False)
        ] + self._walls
        self._publish(0.0, 0.0, shadows, [], self._candidates(shadows, 0.0))

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
        self._check_inputs(t, H)
        shadows = [
            self._absent if self._is_quiet(i, state) else self._received(i, t)
            for i, state in enumerate(self.inputs.ships)
        ] + self._walls
        candidates = self._candidates(shadows, H)
        for i in {i for pair in candidates for i in pair}:
            if shadows[i] is self._absent:
                shadows[i] = self._received(i, t)
        near = self._near(candidates, shadows, H)
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
        self._publish(t + H, H, shadows, slots, candidates)

    def _is_quiet(self, i: int, state: ShipState) -> bool:
        """Whether nothing of an earlier contact is left for a ship: it needs no shadow until another comes near."""
        applied = self.parameters.feedback != "ledger" or state.impulse_applied == self._echo[i]
        return applied and not self._busy[i] and self._seen[i] is None

    def _advance(self, shadows: Sequence[Shadow], H: float, but: Container[int] = ()) -> None:
        """Move on by H [s] the shadows that there are, but for some."""
        for i, shadow in enumerate(shadows):
            if not shadow.fixed and i not in but:
                shadow.advance(H)

    def _widened(self, body: Body) -> Rectangle:
        """Where an obstacle stands, and half the range of the clearance around it."""
        d = 0.5 * self.parameters.clearance_range + body.around
        n_0, n_1, e_0, e_1 = body.rectangle
        return n_0 - d, n_1 + d, e_0 - d, e_1 + d

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
        return sum(self._room(self._bodies[i], shadows[i], h) - self._bodies[i].around for i in pair)

    def _received(self, i: int, t: float) -> Shadow:
        """Shadow of a ship at the received pose, with what is pending, and expected of other forces, in its twist."""
        state, body, feedback = self.inputs.ships[i], self._bodies[i], self.parameters.feedback
        nu = np.array(state.velocity + state.rate)
        applied = np.array(state.impulse_applied)
        account = Account(self._issued[i], self._last[i], applied, self._nu_sent[i], nu, body.M)
        pending, before = pending_impulse(feedback, account), self._seen[i]
        if pending.any():
            nu = nu + body.M_inverse @ pending
        shadow = Shadow.at(np.array(state.position), np.array(state.attitude), nu, body.M_inverse)
        if before is not None and feedback == "ledger":
            found = drift(before, _seen(t, 0.0, state), body.M_inverse, body.bullet.r_bg, body.reach)
            if found is not None:
                shadow.drift = found.mean
                if pending.any():  # a parallel master: what is issued now is applied to a ship that has gone on
                    shadow.nu = shadow.nu + found.gain
        return shadow

    # -- who is near whom -----------------------------------------------------------------------------

    def _candidates(self, shadows: Sequence[Shadow], H: float) -> list[Pair]:
        """Pairs that could come within clearance_range, or touch, in H [s]; all others are out of this step."""
        half = 0.5 * self.parameters.clearance_range
        rectangles: list[Rectangle] = []
        for i, (body, shadow) in enumerate(zip(self._bodies, shadows, strict=True)):
            if body.wall is not None:
                rectangles.append(self._widened(body))
                continue
            if shadow is self._absent:
                state = self.inputs.ships[i]
                n, e, _ = state.position
                room = body.around + H * (hypot(*state.velocity) + hypot(*state.rate) * body.reach)
            else:
                n, e, _ = shadow.x.tolist()
                room = self._room(body, shadow, H)
            d = half + room + body.reach
            rectangles.append((n - d, n + d, e - d, e + d))
        return near_pairs(rectangles, len(self.names))

    def _near(self, candidates: Sequence[Pair], shadows: Sequence[Shadow], H: float) -> dict[Pair, float]:
        """Pairs of them whose hulls, or fenders, could touch within H [s], and their gaps [m]."""
        near = {}
        for a, b in candidates:
            room = (
                REACH_MARGIN + self._room(self._bodies[a], shadows[a], H) + self._room(self._bodies[b], shadows[b], H)
            )
            if self._bounds_apart(a, b, shadows) <= room and (gap := self._gap(a, b, shadows, room)) < room:
                near[a, b] = gap
        return near

    def _room(self, body: Body, shadow: Shadow, H: float) -> float:
        """How far any point of the hull may get in H [s], and the fender before it [m]."""
        if shadow.fixed:
            return body.around
        u, v, w, p, q, r = shadow.expected.tolist()
        return body.around + H * (hypot(u, v, w) + hypot(p, q, r) * body.reach)

    def _bounds_apart(self, a: int, b: int, shadows: Sequence[Shadow]) -> float:
        """Horizontal distance [m] of the bounds of two hulls, circles or an obstacle's rectangle; not more than the
        hulls'."""
        n, e, _ = shadows[a].x.tolist()
        one, other = self._bodies[a], self._bodies[b]
        if shadows[b].fixed:
            return apart((n, e), one.reach, other.rectangle)
        n_b, e_b, _ = shadows[b].x.tolist()
        return hypot(n_b - n, e_b - e) - one.reach - other.reach

    def _gap(self, a: int, b: int, shadows: Sequence[Shadow], cap: float) -> float:
        detector = self._ready()
        detector.place(a, shadows[a])
        if not shadows[b].fixed:
            detector.place(b, shadows[b])
        return detector.clearance(a, b, cap)

    def _ready(self) -> Detector:
        if self._detector is None:
            raise StepError("ShipCollision is not initialised: call initialise() before the first step")
        return self._detector

    # -- contact --------------------------------------------------------------------------------------

    def _fender(self, pair: Pair) -> Fender | None:
        return in_series(self._bodies[pair[0]].fender, self._bodies[pair[1]].fender)

    def _press(self, pair: Pair, fender: Fender, h: float, shadows: list[Shadow], slots: list[Slot]) -> list[Slot]:
        """One substep of the fender between two bodies: its impulse booked, its energy kept."""
        contact = self._ready().facing(*pair, fender.thickness, shadows, self._kept)
        stored = self._fenders.get(pair, 0.0)
        compression = 0.0 if contact is None else fender.thickness - contact.gap
        if contact is None or compression <= 0.0:
            self._fender_dissipated += self._fenders.pop(pair, 0.0)  # what a released spring still holds is lost
            return slots
        axes = contact_axes(contact.normal)
        W = axes @ _mobility(contact, shadows) @ axes.T
        v = axes @ actual_velocity(contact, shadows)
        squeeze = squeezed(fender, compression, -float(v[0]), float(W[0, 0]), stored, h)
        P = squeeze.P * contact.normal
        rubbed = friction_impulse(W[1:, 1:], v[1:] + squeeze.P * W[1:, 0], self.parameters.friction, squeeze.P)
        P = P + rubbed @ axes[1:]
        lost = self._apply(Impulse(contact, P), shadows)
        self._fenders[pair] = squeeze.stored
        self._fender_dissipated += lost - (squeeze.stored - stored)
        return merged(slots, Slot(contact, P, lost, 0, 0))

    def _apply(self, impulse: Impulse, shadows: list[Shadow]) -> float:
        """Book one impulse; the kinetic energy that it takes [J]."""
        c, before = impulse.contact, actual_velocity(impulse.contact, shadows)
        _take(impulse, shadows)
        return float(-impulse.P @ (before + actual_velocity(c, shadows)) * 0.5)

    def _respond(self, t: float, h: float, near: list[Pair], shadows: list[Shadow]) -> list[Impulse]:
        """Contacts at the predicted poses and their impulses; collisions and scratches are opened here."""
        detector, parameters = self._ready(), self.parameters
        answered = near
        if parameters.feedback == "none":  # one impact per collision: what follows is watched, not answered
            answered = [pair for pair in near if not self._episodes.is_open(*pair)]
            for a, b in set(near) - set(answered):
                if watched := detector.contacts(a, b, shadows, self._kept):
                    self._episodes.touch(t, watched, shadows)
        impulses = RESPONSES[parameters.response](
            Encounter(
                answered, shadows, detector, self._kept, self._bullets, parameters.friction, parameters.restitution, h
            )
        )
        for pair in answered:
            contacts = [i.contact for i in impulses if (i.contact.a, i.contact.b) == pair]
            if contacts:
                self._episodes.touch(t, contacts, shadows)
        return passive(impulses, shadows) if impulses else impulses

    def _book(self, impulses: list[Impulse], shadows: list[Shadow], slots: list[Slot]) -> list[Slot]:
        """Impulses into both ships' twists and ledgers, the energy they cost, and the contact slots of the step."""
        before = [actual_velocity(i.contact, shadows) for i in impulses]
        for impulse in impulses:
            _take(impulse, shadows)
        for impulse, v_before in zip(impulses, before, strict=True):
            c = impulse.contact
            along, across = energy_lost(impulse.P, c.normal, v_before, actual_velocity(c, shadows))
            self._energy = self._energy + [along + across, along, across]
            collision, scratch = self._episodes.numbers(c.a, c.b)
            slots = merged(slots, Slot(c, impulse.P, along + across, collision, scratch))
        return slots

    # -- outputs ------------------------------------------------------------------------------------

    def _publish(
        self, t: float, H: float, shadows: list[Shadow], slots: list[Slot], candidates: Sequence[Pair]
    ) -> None:
        colliding = self._episodes.open_ships()
        for i, shadow in enumerate(shadows[: len(self.names)]):
            out, state = self.outputs.ships[i], self.inputs.ships[i]
            if shadow is self._absent:
                place, attitude = pose_ahead(state.position, state.attitude, state.velocity, state.rate, H)
                out.position[:], out.attitude[:] = place, attitude
                out.velocity[:], out.rate[:] = state.velocity, state.rate
                out.force[:] = _NO_FORCE
                continue
            self._last[i] = shadow.issued
            self._nu_sent[i] = shadow.nu_received
            self._busy[i] = bool(shadow.issued.any())
            if self._busy[i]:
                self._issued[i] = self._issued[i] + shadow.issued
                out.force[:] = (shadow.issued / H).tolist()
            else:
                out.force[:] = _NO_FORCE
            self._seen[i] = _seen(t - H, H, state) if i in colliding else None
            nu = shadow.nu.tolist()
            out.position[:] = shadow.x.tolist()
            out.attitude[:] = attitude_unwrapped(attitude_from_rotation(shadow.R), state.attitude[2]).tolist()
            out.velocity[:], out.rate[:] = nu[:3], nu[3:]
            out.impulse[:] = self._issued[i].tolist()
            self._echo[i] = list(out.impulse)
        self._publish_contacts(t, slots)
        self.outputs.energy[:] = self._energy.tolist()
        self.outputs.fender[:] = [sum(self._fenders.values()), self._fender_dissipated]
        self.outputs.clearance[0] = self._clearance(candidates, shadows)

    def _publish_contacts(self, t: float, slots: list[Slot]) -> None:
        out, latest = self.outputs, self._episodes.latest
        slots = sorted(slots, key=lambda s: -float(np.linalg.norm(s.P)))[:SLOTS] if len(slots) > SLOTS else slots
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

    def _clearance(self, candidates: Sequence[Pair], shadows: Sequence[Shadow]) -> float:
        """Least distance between hulls [m], capped. The nearest bounds first: they soon rule out the others."""
        least = self.parameters.clearance_range
        bounds = [(self._bounds_apart(a, b, shadows), a, b) for a, b in candidates]
        for bound, a, b in sorted(bounds) if len(bounds) > 1 else bounds:
            if bound >= least:
                break
            least = min(least, self._gap(a, b, shadows, least))
        return least

    # -- state --------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """What the outputs do not show: ledger of the last step, energy in fenders, kept normals, episodes."""
        return {
            "issued": [v.tolist() for v in self._issued],
            "last": [v.tolist() for v in self._last],
            "nu_sent": [v.tolist() for v in self._nu_sent],
            "energy": self._energy.tolist(),
            "seen": [None if s is None else list(s) for s in self._seen],
            "fenders": [[a, b, stored] for (a, b), stored in self._fenders.items()],
            "fender_dissipated": self._fender_dissipated,
            "kept": [[a, b, carrier, list(normal)] for (a, b), (carrier, normal) in self._kept.items()],
            "episodes": self._episodes.get_state(),
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self._issued = [np.array(v) for v in state["issued"]]
        self._echo = [list(v) for v in state["issued"]]
        self._last = [np.array(v) for v in state["last"]]
        self._busy = [bool(last.any()) for last in self._last]
        self._nu_sent = [np.array(v) for v in state["nu_sent"]]
        self._energy = np.array(state["energy"])
        self._seen = [None if s is None else Seen(*s) for s in state["seen"]]
        self._fenders = {(a, b): stored for a, b, stored in state["fenders"]}
        self._fender_dissipated = state["fender_dissipated"]
        self._kept = {(a, b): (carrier, list(normal)) for a, b, carrier, normal in state["kept"]}
        self._episodes.set_state(state["episodes"])

    # -- refusals -----------------------------------------------------------------------------------

    def _check_inputs(self, t: float, H: float) -> None:
        if not (isfinite(t) and isfinite(H) and H > 0.0):
            raise StepError(f"a step from t = {t} s by {H} s cannot be made: both must be finite and the step positive")
        for body, state in zip(self._bodies, self.inputs.ships, strict=False):
            if not isfinite(
                sum(state.position) + sum(state.attitude) + sum(state.velocity) + sum(state.rate)
                + sum(state.impulse_applied)
            ):  # fmt: skip
                _refuse_not_finite(body.name, state, t)
            speed, tip, place = hypot(*state.velocity), hypot(*state.rate) * body.reach, hypot(*state.position)
            if speed > ABSURD_SPEED or tip > ABSURD_SPEED or place > ABSURD_PLACE:
                quantity, value, unit, limit = (
                    ("velocity", speed, "m/s", ABSURD_SPEED) if speed > ABSURD_SPEED
                    else ("rate", tip, "m/s at the ship's ends", ABSURD_SPEED) if tip > ABSURD_SPEED
                    else ("position", place, "m from the origin", ABSURD_PLACE)
                )  # fmt: skip
                raise StepError(
                    f"{body.name}.{quantity} is {value:g} {unit} at t = {t} s, above {limit:g} {unit}: check the "
                    "signal and its unit"
                )


def _substeps(H: float, substep: float) -> tuple[int, float]:
    """Number and length of the substeps of H [s]: of `substep` exactly where H is a multiple of it, else of H / n.

    A master's step has jitter in its last bits; it must not reach the contact solver.
    """
    n = max(1, round(H / substep))
    if abs(H - n * substep) <= 1e-6 * substep:
        return n, substep
    n = ceil(H / substep)
    return n, H / n


def _refuse_not_finite(name: str, state: ShipState, t: float) -> None:
    for quantity in ("position", "attitude", "velocity", "rate", "impulse_applied"):
        values = getattr(state, quantity)
        if not all(map(isfinite, values)):
            raise StepError(f"{name}.{quantity} = {values} at t = {t} s is not finite: check the ship model's output")


def _seen(t: float, H: float, state: ShipState) -> Seen:
    return Seen(
        t, H, list(state.position), list(state.attitude), state.velocity + state.rate, list(state.impulse_applied)
    )


def _take(impulse: Impulse, shadows: Sequence[Shadow]) -> None:
    """The impulse into the twists and ledgers of both bodies; an obstacle has neither."""
    c, P = impulse.contact, impulse.P
    for i, G, sign in ((c.a, c.G_a, -1.0), (c.b, c.G_b, 1.0)):
        if not shadows[i].fixed:
            shadows[i].book(sign * P @ G)


def _mobility(c: Contact, shadows: Sequence[Shadow]) -> Array:
    """What a unit impulse at a contact does to its relative velocity, in n; (3, 3) [1/kg]."""
    W: Array = c.G_a @ shadows[c.a].M_inverse @ c.G_a.T + c.G_b @ shadows[c.b].M_inverse @ c.G_b.T
    return W


def _check(p: CollisionParameters) -> None:
    """Raises InputError on a parameter out of its range."""
    bounds = (("friction", p.friction, 0.0, 10.0), ("restitution", p.restitution, 0.0, 1.0))
    for name, value, low, high in bounds:
        if not low <= value <= high:
            raise InputError(f"{name} = {value} is outside {low:g} to {high:g}")
    for name, value in (("substep", p.substep), ("minimum_separation_time", p.minimum_separation_time),
                        ("clearance_range", p.clearance_range)):  # fmt: skip
        if not (isfinite(value) and value > 0.0):
            raise InputError(f"{name} = {value} must be a positive number")
    if p.response not in RESPONSES:
        raise InputError(f"response = {p.response!r} is not known: choose one of {', '.join(RESPONSES)}")
    if p.feedback not in FEEDBACKS:
        raise InputError(f"feedback = {p.feedback!r} is not known: choose one of {', '.join(FEEDBACKS)}")
