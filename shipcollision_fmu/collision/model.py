"""The collision model: ship states in, impulses and post-impact states out.

A communication step [t, t + H]:

    receive       check what came in; shadows of the ships at the received poses, pending impulses taken in
    find near     pairs whose hulls could touch within the step; far pairs cost a comparison of two circles
    for each substep of fixed length h:
        advance   the shadows' predicted poses
        respond   contacts there, answered by one of the rival responses
        book      impulses into twists and ledger, energy lost, contact points, episodes
    publish       poses, twists, impulses, mean forces, contacts, events

Impulses are solved and booked with the ships at their *received* poses, which is where a sequential master applies
them: linear and angular momentum then balance to rounding, and the kinetic energy lost is that of the real ships. The
predicted poses decide only whether, where and with which normal the hulls touch.

State before a step that fails stays as it was. The model knows nothing of FMI.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, hypot, isfinite
from typing import Any

import numpy as np

from ..errors import InputError, StepError
from ..ship.frames import Array, attitude_from_rotation, attitude_unwrapped, skew
from ..ship.hull import build_hull
from ..ship.inertia import free_inverse
from ..ship.library import Ship, load_ship
from .contact import Impulse, contact_velocity
from .detection import Detector, KeptNormals
from .energy import energy_lost
from .engine import BulletBody
from .episodes import Episodes
from .ledger import FEEDBACKS, Account, pending_impulse
from .ports import SLOTS, CollisionInputs, CollisionOutputs, CollisionParameters, ShipParameters, ShipPost, ShipState
from .responses import RESPONSES, Encounter
from .shadow import Shadow
from .slots import Slot, merged

__all__ = ["ShipCollision"]

REACH_MARGIN = 0.1
"""Gap [m] within which a pair at rest still counts as near."""

ABSURD_SPEED = 1e3
"""Speeds [m/s] from here on are refused: a broken signal, not a ship."""


class ShipCollision:
    """Collision of two or more ships. Names of ships are those of the FMU's variables."""

    def __init__(self, ships: Sequence[str] = ("own", "target")) -> None:
        self.names = tuple(ships)
        self.parameters = CollisionParameters([ShipParameters() for _ in ships])
        self.inputs = CollisionInputs([ShipState() for _ in ships])
        self.outputs = CollisionOutputs([ShipPost() for _ in ships])
        self._detector: Detector | None = None
        self._ships: list[Ship] = []

    # -- set-up -------------------------------------------------------------------------------------

    def initialise(self) -> None:
        """Read the parameters, load the ships, set the outputs of the start. Raises InputError on a bad parameter."""
        _check(self.parameters)
        ships = [load_ship(p.ship) for p in self.parameters.ships]
        if self.parameters.response == "bullet":
            _refuse_what_bullet_lacks(self.names, ships, self.parameters.ships)
        hulls = [build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for ship in ships]
        self.close()
        self._detector = Detector(hulls)
        self._ships = ships
        self._reach = [hull.reach for hull in hulls]
        self._M_inverse = [
            free_inverse(ship.M, p.degrees_of_freedom) for ship, p in zip(ships, self.parameters.ships, strict=True)
        ]
        self._bodies = [_bullet_body(ship) for ship in ships]
        self._issued = [np.zeros(6) for _ in ships]
        self._last = [np.zeros(6) for _ in ships]
        self._nu_sent = [np.zeros(6) for _ in ships]
        self._energy = np.zeros(3)
        self._kept: KeptNormals = {}
        self._episodes = Episodes(self.parameters.minimum_separation_time)
        shadows = [self._received(i, np.zeros(6)) for i in range(len(ships))]
        self._publish(0.0, 0.0, shadows, [])

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
        shadows = self._receive()
        before = self.get_state()
        try:
            slots = self._collide(t, H, shadows)
        except Exception:
            self.set_state(before)
            raise
        self._publish(t + H, H, shadows, slots)

    def _collide(self, t: float, H: float, shadows: list[Shadow]) -> list[Slot]:
        """Take the shadows through the step; the contact points they went through."""
        self._episodes.close_old(t)
        near, slots = self._near_pairs(shadows, H), list[Slot]()
        if not near:
            _advance(shadows, H)
            return slots
        n, h = _substeps(H, self.parameters.substep)
        for j in range(n):
            _advance(shadows, h)
            impulses = self._respond(t + (j + 1) * h, h, near, shadows)
            slots = self._book(impulses, shadows, slots)
        return slots

    def _receive(self) -> list[Shadow]:
        """Shadows at the received poses, with what is pending in their twists."""
        feedback, shadows = self.parameters.feedback, []
        for i, (state, ship) in enumerate(zip(self.inputs.ships, self._ships, strict=True)):
            nu = np.array(state.velocity + state.rate)
            account = Account(
                self._issued[i], self._last[i], np.array(state.impulse_applied), self._nu_sent[i], nu, ship.M
            )
            shadows.append(self._received(i, pending_impulse(feedback, account)))
        return shadows

    def _received(self, i: int, pending: Array) -> Shadow:
        state = self.inputs.ships[i]
        nu = np.array(state.velocity + state.rate)
        if pending.any():
            nu = nu + self._M_inverse[i] @ pending
        return Shadow.at(np.array(state.position), np.array(state.attitude), nu, self._M_inverse[i])

    def _near_pairs(self, shadows: Sequence[Shadow], H: float) -> list[tuple[int, int]]:
        """Pairs whose hulls could touch within H [s]."""
        near = []
        for a in range(len(shadows)):
            for b in range(a + 1, len(shadows)):
                approach = REACH_MARGIN + H * (self._speed_bound(a, shadows[a]) + self._speed_bound(b, shadows[b]))
                if self._circles_apart(a, b, shadows) <= approach and self._gap(a, b, shadows, approach) < approach:
                    near.append((a, b))
        return near

    def _speed_bound(self, i: int, shadow: Shadow) -> float:
        """No point of the hull moves faster than this [m/s]."""
        u, v, w, p, q, r = shadow.nu.tolist()
        return hypot(u, v, w) + hypot(p, q, r) * self._reach[i]

    def _circles_apart(self, a: int, b: int, shadows: Sequence[Shadow]) -> float:
        """Horizontal distance [m] of the circles about the hulls; roll and pitch only shrink them."""
        (x_a, y_a, _), (x_b, y_b, _) = shadows[a].x.tolist(), shadows[b].x.tolist()
        return hypot(x_b - x_a, y_b - y_a) - self._reach[a] - self._reach[b]

    def _gap(self, a: int, b: int, shadows: Sequence[Shadow], cap: float) -> float:
        detector = self._ready()
        detector.place(a, shadows[a])
        detector.place(b, shadows[b])
        return detector.clearance(a, b, cap)

    def _ready(self) -> Detector:
        if self._detector is None:
            raise StepError("ShipCollision is not initialised: call initialise() before the first step")
        return self._detector

    def _respond(self, t: float, h: float, near: list[tuple[int, int]], shadows: list[Shadow]) -> list[Impulse]:
        """Contacts at the predicted poses and their impulses; collisions and scratches are opened here."""
        detector, parameters = self._ready(), self.parameters
        for ship in {s for pair in near for s in pair}:
            detector.place(ship, shadows[ship])
        answered = near
        if parameters.feedback == "none":  # one impact per collision: what follows is watched, not answered
            answered = [pair for pair in near if not self._episodes.is_open(*pair)]
            for a, b in set(near) - set(answered):
                if watched := detector.contacts(a, b, shadows, self._kept):
                    self._episodes.touch(t, watched, shadows)
        impulses = RESPONSES[parameters.response](
            Encounter(
                answered, shadows, detector, self._kept, self._bodies, parameters.friction, parameters.restitution, h
            )
        )
        for pair in answered:
            contacts = [i.contact for i in impulses if (i.contact.a, i.contact.b) == pair]
            if contacts:
                self._episodes.touch(t, contacts, shadows)
        return impulses

    def _book(self, impulses: list[Impulse], shadows: list[Shadow], slots: list[Slot]) -> list[Slot]:
        """Impulses into both ships' twists and ledgers, the energy they cost, and the contact slots of the step."""
        before = [contact_velocity(i.contact, shadows) for i in impulses]
        for impulse in impulses:
            c = impulse.contact
            shadows[c.a].book(-impulse.P @ c.G_a)
            shadows[c.b].book(impulse.P @ c.G_b)
        for impulse, v_before in zip(impulses, before, strict=True):
            c = impulse.contact
            along, across = energy_lost(impulse.P, c.normal, v_before, contact_velocity(c, shadows))
            self._energy = self._energy + [along + across, along, across]
            collision, scratch = self._episodes.numbers(c.a, c.b)
            slots = merged(slots, Slot(c, impulse.P, along + across, collision, scratch))
        return slots

    # -- outputs ------------------------------------------------------------------------------------

    def _publish(self, t: float, H: float, shadows: list[Shadow], slots: list[Slot]) -> None:
        for i, shadow in enumerate(shadows):
            self._issued[i] = self._issued[i] + shadow.issued
            self._last[i] = shadow.issued
            self._nu_sent[i] = shadow.nu_received
            out, psi = self.outputs.ships[i], self.inputs.ships[i].attitude[2]
            out.position[:] = shadow.x.tolist()
            out.attitude[:] = attitude_unwrapped(attitude_from_rotation(shadow.R), psi).tolist()
            out.velocity[:] = shadow.nu[:3].tolist()
            out.rate[:] = shadow.nu[3:].tolist()
            out.impulse[:] = self._issued[i].tolist()
            out.force[:] = (shadow.issued / H).tolist() if H > 0.0 else [0.0] * 6
        self._publish_contacts(t, slots)
        self.outputs.energy[:] = self._energy.tolist()
        self.outputs.clearance[0] = self._clearance(shadows)

    def _publish_contacts(self, t: float, slots: list[Slot]) -> None:
        out, latest = self.outputs, self._episodes.latest
        slots = sorted(slots, key=lambda s: -float(np.linalg.norm(s.P)))[:SLOTS] if len(slots) > SLOTS else slots
        for k, place in enumerate(out.contacts):
            (slots[k] if k < len(slots) else Slot.unused()).fill(place)
        out.contact_active, out.contact_count = bool(slots), len(slots)
        out.scratch_id = max((s.scratch for s in slots), default=0)
        out.impact_count, out.impact_ship_a, out.impact_ship_b = self._episodes.impacts, latest.ship_a, latest.ship_b
        out.impact[:] = [latest.time, latest.closing_speed, latest.angle]
        out.impact_point[:] = latest.point

    def _clearance(self, shadows: Sequence[Shadow]) -> float:
        cap = self.parameters.clearance_range
        least = cap
        for a in range(len(shadows)):
            for b in range(a + 1, len(shadows)):
                if self._circles_apart(a, b, shadows) < least:
                    least = min(least, self._gap(a, b, shadows, least))
        return least

    # -- state --------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """What the outputs do not show: ledger of the last step, kept normals, episodes."""
        return {
            "issued": [v.tolist() for v in self._issued],
            "last": [v.tolist() for v in self._last],
            "nu_sent": [v.tolist() for v in self._nu_sent],
            "energy": self._energy.tolist(),
            "kept": [[a, b, carrier, list(normal)] for (a, b), (carrier, normal) in self._kept.items()],
            "episodes": self._episodes.get_state(),
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self._issued = [np.array(v) for v in state["issued"]]
        self._last = [np.array(v) for v in state["last"]]
        self._nu_sent = [np.array(v) for v in state["nu_sent"]]
        self._energy = np.array(state["energy"])
        self._kept = {(a, b): (carrier, list(normal)) for a, b, carrier, normal in state["kept"]}
        self._episodes.set_state(state["episodes"])

    # -- refusals -----------------------------------------------------------------------------------

    def _check_inputs(self, t: float, H: float) -> None:
        if not (isfinite(t) and isfinite(H) and H > 0.0):
            raise StepError(f"a step from t = {t} s by {H} s cannot be made: both must be finite and the step positive")
        for name, state in zip(self.names, self.inputs.ships, strict=True):
            for quantity in ("position", "attitude", "velocity", "rate", "impulse_applied"):
                values = getattr(state, quantity)
                if not all(map(isfinite, values)):
                    raise StepError(
                        f"{name}.{quantity} = {values} at t = {t} s is not finite: check the ship model's output"
                    )
            speed = hypot(*state.velocity)
            if speed > ABSURD_SPEED:
                raise StepError(
                    f"{name}.velocity is {speed:g} m/s at t = {t} s, above {ABSURD_SPEED:g} m/s: check the signal and "
                    "its unit"
                )


def _advance(shadows: Sequence[Shadow], h: float) -> None:
    for shadow in shadows:
        shadow.advance(h)


def _substeps(H: float, substep: float) -> tuple[int, float]:
    """Number and length of the substeps of H [s]: of `substep` exactly where H is a multiple of it, else of H / n.

    A master's step has jitter in its last bits; it must not reach the contact solver.
    """
    n = max(1, round(H / substep))
    if abs(H - n * substep) <= 1e-6 * substep:
        return n, substep
    n = ceil(H / substep)
    return n, H / n


def _bullet_body(ship: Ship) -> BulletBody:
    S = skew(ship.r_bg)
    return BulletBody(ship.mass, np.diag(ship.M_RB[3:, 3:] + ship.mass * S @ S).copy(), np.array(ship.r_bg))


def _refuse_what_bullet_lacks(names: Sequence[str], ships: Sequence[Ship], given: Sequence[ShipParameters]) -> None:
    for name, ship, parameters in zip(names, ships, given, strict=True):
        if parameters.degrees_of_freedom != 6:
            raise InputError(
                f"response 'bullet' moves bodies freely, and {name}.degrees_of_freedom = "
                f"{parameters.degrees_of_freedom}: take response 'pgs', or 6 degrees of freedom"
            )
        if ship.M_A.any():
            raise InputError(
                f"response 'bullet' knows a scalar mass only, and {name} = {ship.name!r} has added mass: take response "
                "'pgs', or a ship whose [added_mass] is zero"
            )


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
