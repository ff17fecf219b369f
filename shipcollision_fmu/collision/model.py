"""The collision model: ship states in, impulses and post-impact states out.

A communication step [t, t + H]:

    receive       check the inputs; states of the ships, corrected by pending impulses (exchange.py)
    find pairs    whose hulls could touch within the step (proximity.py)
    take substeps of fixed length h, each at which a pair is due (conservative_advancement.py):
        press     compressed fenders, booked one by one (fender_ledger.py)
        advance   the predicted poses of the near bodies, to the first touch of fast pairs or the end of the substep
        respond   to the contacts there, by one of the rival responses (responses.py)
        book      impulses into twists and ledgers, energy lost, contact points
    find ends     poses and twists of the ships at the end of the step; from here on nothing can be refused
    publish       them, impulses, mean forces, contacts, collisions
    diagnose      what was received: is a ship wired wrongly? (diagnosis.py)

Bodies are the ships in the order of the build, then the obstacles (obstacles.py). An obstacle is a body with zero
inverse mass and a fixed pose: wherever a ship has an index, an obstacle has one, beyond the ships.

Impulses are solved and booked at the poses at which they will be applied (body_state.py). Linear and angular momentum
then balance to rounding, and the kinetic energy lost is that of the real ships. The predicted poses decide only
whether, where and with which normal the hulls touch.

A step that fails leaves the state as it was. The model is independent of FMI.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Sequence
from pathlib import Path
from typing import Any
from zlib import crc32

from ..errors import StepError
from ..ship.coasting_law import Motion
from .bodies import Body, prepare_bodies
from .checks import check_parameters, check_states, check_step
from .collisions import Collisions, Numbers
from .conservative_advancement import ConservativeAdvancement
from .contact_points import ContactPoint, fill_contacts, fit_contact_points, merge_impulses
from .contact_problem import ContactCaches, ContactProblem, ContactSolution
from .delayed_impulses import describe_delayed_impulses
from .diagnosis import Diagnosis
from .dynamics.body_state import BodyState
from .dynamics.contact import book_impulses
from .dynamics.passivity import enforce_passivity
from .dynamics.self_stress import remove_self_stress
from .exchange import ShipExchange
from .feedback import PRESCRIBED
from .fender_ledger import FenderLedger, select_fenders
from .geometry.broad_phase import Pair
from .geometry.detection import Detector
from .interface import CollisionInputs, CollisionOutputs, CollisionParameters, ShipParameters, ShipPost, ShipState
from .proximity import NearPair, Proximity
from .responses import ADAPTERS, RESPONSES
from .ship_names import check_ship_names
from .solvers.energy_split import split_losses
from .totals import Totals

__all__ = ["ShipCollision"]

_STATE = ("exchange", "fenders", "caches", "collisions", "totals", "diagnosis")
"""Parts of a saved state."""

_SHIP_STATE = ("position", "attitude", "velocity", "rate")


class ShipCollision:
    """Collision of ships with each other and with obstacles. Names of ships are those of the FMU's variables.

    Raises InputError for names that ships cannot have (ship_names.py).
    """

    def __init__(self, ships: Sequence[str] = ("own", "target")) -> None:
        self.names = check_ship_names(ships)
        self.directory: Path | None = None  # where ship files are looked for before the current folder
        self.parameters = CollisionParameters([ShipParameters() for _ in ships])
        self.inputs = CollisionInputs([ShipState() for _ in ships])
        self.outputs = CollisionOutputs([ShipPost() for _ in ships])
        self.warning = ""  # what was not as it should be in the last step
        self._absent: frozenset[int] = frozenset()
        self._detector: Detector | None = None
        self._bodies: list[Body] = []

    def note_inputs_set(self, paths: Collection[str]) -> None:
        """Take in which inputs were ever set, by their places in the model ("inputs.ships.0.position"). A ship of whose
        state none was set is absent. Without a call all ships are there."""
        self._absent = frozenset(
            i for i in range(len(self.names)) if not any(f"inputs.ships.{i}.{part}" in paths for part in _SHIP_STATE)
        )

    # -- set-up -------------------------------------------------------------------------------------

    def initialise(self) -> None:
        """Read the parameters, load ships and obstacles, set the outputs of the start. Raises InputError on a bad
        parameter, StepError on a state that is not finite or absurd."""
        parameters, n = self.parameters, len(self.names)
        check_parameters(parameters)
        bodies = prepare_bodies(self.names, parameters, self.directory)
        check_states(0.0, bodies, self.inputs.ships)
        self.close()
        self._bodies = bodies
        feedbacks = [body.feedback for body in bodies[:n]]
        self._detector = Detector([body.hull for body in bodies], ADAPTERS.get(parameters.response))
        self._exchange = ShipExchange(bodies, feedbacks, self.inputs.ships, self.outputs.ships)
        self._proximity = Proximity(bodies, n, self._detector, parameters.clearance_range)
        self._collisions = Collisions(
            parameters.minimum_separation_time,
            {i for i in range(n) if feedbacks[i] == "none"},
            {i for i, body in enumerate(bodies) if body.feedback == PRESCRIBED} if PRESCRIBED in feedbacks else (),
        )
        self._has_fenders = any(body.fender for body in bodies)
        self._fenders, self._caches, self._totals = FenderLedger(), ContactCaches(), Totals()
        self._diagnosis = Diagnosis(
            bodies, feedbacks, self._exchange.ledgers, self.inputs.ships, self.outputs.diagnosis
        )
        self._bullet_bodies = [body.bullet for body in bodies]
        self._walls = [body.wall for body in bodies if body.wall is not None]
        active = self._exchange.receive_active(0.0, 0.0)
        states = self._exchange.receive_others(0.0, 0.0, active, range(n)) + self._walls
        candidates = self._proximity.find_candidates(states, self.inputs.ships, 0.0, self._absent)
        self._publish(0.0, 0.0, states, self._exchange.find_ends(0.0, states), [], candidates)

    @property
    def obstacles(self) -> tuple[str, ...]:
        """Names of the obstacles, in the order of their numbers."""
        return tuple(body.name for body in self._bodies[len(self.names) :])

    @property
    def events(self) -> list[str]:
        """A line about each collision that began in the last step."""
        if self._detector is None or not self._collisions.opened:
            return []
        return self._collisions.describe_opened([body.name for body in self._bodies])

    def close(self) -> None:
        """Leave the Bullet world."""
        if self._detector is not None:
            self._detector.narrow_phase.close()
            self._detector = None

    # -- a step -------------------------------------------------------------------------------------

    def step(self, t: float, H: float) -> None:
        """Advance from t by H [s]. Raises StepError on an input that is not finite or absurd; nothing changes then."""
        detector = self._ready()
        check_step(t, H, self._bodies, self.inputs.ships)
        self.warning = ""
        self._collisions.opened.clear()
        states, candidates = self._receive(t, H)
        near = self._proximity.find_near(candidates, states, H)
        if near:
            saved = self._get_mechanics()
            try:
                points = self._take_substeps(t, H, near, states, detector)
                ends = self._exchange.find_ends(H, states)
            except Exception:
                self._set_mechanics(saved)
                self.warning = ""
                raise
            self.warning = "; ".join(filter(None, (self.warning, self._totals.describe_unconverged(t, H))))
        else:
            points = []
            self._advance_others(H, states, ())
            ends = self._exchange.find_ends(H, states)
            self._collisions.close_old(t)
            self._caches.forget_parted(())
        if self._exchange.delayed_speeds:
            self._warn_of_delay(t, H, detector)
        self._publish(t, H, states, ends, points, candidates)
        if t >= self._diagnosis.due or points:
            found = self._diagnosis.examine(t, H, self._absent, near, bool(points))
            self.warning = "; ".join(filter(None, (self.warning, found)))

    def _receive(self, t: float, H: float) -> tuple[list[BodyState], list[Pair]]:
        """States of all bodies, and the pairs that may come near each other."""
        active = self._exchange.receive_active(t, H)
        candidates = self._proximity.find_candidates(active, self.inputs.ships, H, self._absent)
        met = {i for pair in candidates for i in pair}
        return self._exchange.receive_others(t, H, active, met) + self._walls, candidates

    def _take_substeps(
        self, t: float, H: float, near: dict[Pair, NearPair], states: list[BodyState], detector: Detector
    ) -> list[ContactPoint]:
        """Take the states through the step; the contact points of it. near: the pairs."""
        self._collisions.close_old(t)
        self._caches.forget_parted(near)
        met = {i for pair in near for i in pair}
        self._caches.work.renew(sum(not states[i].fixed for i in met), H)
        self._advance_others(H, states, met)
        fenders = select_fenders(self._bodies, list(near)) if self._has_fenders else {}
        schedule = ConservativeAdvancement(
            H, self.parameters.substep, self._bodies, states, detector, self._caches, near, fenders
        )
        h, points = schedule.h, list[ContactPoint]()
        for substep in range(schedule.count):
            pairs = schedule.pairs_due(substep)
            if not pairs:
                continue
            if fenders:
                points = self._fenders.press(
                    fenders, detector, self._caches, states, self.parameters.friction, h, points
                )
            for moment, examined in schedule.advance(substep, pairs):
                solution, numbers = self._respond(t + moment, h, examined, states, detector)
                if solution.impulses:
                    points, schedule.touched = self._book(solution, numbers, states, points), True
        schedule.finish()
        limited = schedule.describe_limited(t) if schedule.is_limited else ""
        exhausted = "" if schedule.touches_left else schedule.describe_exhausted(t)
        self.warning = "; ".join(filter(None, (limited, exhausted)))
        return points

    def _warn_of_delay(self, t: float, H: float, detector: Detector) -> None:
        """Say where a ship may have passed what it hit, since its master applied the impulse one step late."""
        delayed, names = self._exchange.delayed_speeds, [body.name for body in self._bodies]
        said = describe_delayed_impulses(t, H, delayed, self._collisions.open_pairs(), names, detector.thickness)
        self.warning = "; ".join(filter(None, (self.warning, said)))

    def _respond(
        self, t: float, h: float, pairs: list[Pair], states: list[BodyState], detector: Detector
    ) -> tuple[ContactSolution, Numbers]:
        """Impulses at the contacts of the predicted poses, and the numbers of the collisions that they belong to."""
        parameters, caches = self.parameters, self._caches
        answered, recorded = self._collisions.split_by_answer(pairs)
        problem = ContactProblem(
            answered, states, detector, self._bullet_bodies, parameters.friction, parameters.restitution, h
        )
        contacts = [c for a, b in recorded for c in detector.contacts(a, b, states, caches.last_normals)]
        solution = RESPONSES[parameters.response](problem, caches)
        contacts += [impulse.contact for impulse in solution.impulses]
        return solution, self._collisions.register(t, contacts, states) if contacts else {}

    def _book(
        self, solution: ContactSolution, numbers: Numbers, states: list[BodyState], points: list[ContactPoint]
    ) -> list[ContactPoint]:
        """Book the impulses, scaled to passivity, and the energy that they cost. Returns the contact points with those
        of the impulses."""
        if solution.moves_nothing:
            idle = solution.impulses
            return merge_impulses(points, idle, [(0.0, 0.0)] * len(idle), numbers)
        impulses, taken_off = enforce_passivity(solution.impulses, states)
        booked, parameters = book_impulses(impulses, states), self.parameters
        energies = split_losses(booked, states, parameters.friction, parameters.restitution)
        self._totals.add(solution, taken_off, energies)
        shown = remove_self_stress(impulses, states, parameters.friction)
        return merge_impulses(points, shown, energies, numbers)

    def _advance_others(self, H: float, states: Sequence[BodyState], near: Container[int]) -> None:
        """Move the ships that are not near another on by H [s]."""
        for i, state in enumerate(states):
            if not state.fixed and i not in near:
                state.advance(H)

    def _ready(self) -> Detector:
        if self._detector is None:
            raise StepError("ShipCollision is not initialised: call initialise() before the first step")
        return self._detector

    # -- outputs ------------------------------------------------------------------------------------

    def _publish(
        self, t: float, H: float, states: list[BodyState], ends: Sequence[Motion], points: list[ContactPoint],
        candidates: Sequence[Pair],
    ) -> None:  # fmt: skip
        """Fill the outputs of the step of H [s] that began at t [s]. ends: of the ships."""
        out = self.outputs
        self._exchange.publish(t, H, states, ends, self._collisions.bodies_in_collision())
        if points or out.contact_count or out.collision_count != self._collisions.count:
            self._publish_contacts(points)
        self._totals.fill(out)
        out.fender.stored, out.fender.dissipated = self._fenders.energy
        out.clearance, (out.nearest_ship_a, out.nearest_ship_b) = self._proximity.measure_clearance(candidates, states)

    def _publish_contacts(self, points: list[ContactPoint]) -> None:
        out, latest = self.outputs, self._collisions.latest
        points = fit_contact_points(points, len(out.contacts))
        fill_contacts(points, out.contacts)
        out.contact_active, out.contact_count = any(point.collision for point in points), len(points)
        out.scratch_id = max((point.scratch for point in points), default=0)
        out.collision_count = self._collisions.count
        out.impact.time, out.impact.point[:], out.impact.closing_speed = latest.time, latest.point, latest.closing_speed
        out.impact.angle, out.impact.ship_a, out.impact.ship_b = latest.angle, latest.ship_a, latest.ship_b

    # -- state --------------------------------------------------------------------------------------

    def get_state(self) -> dict[str, Any]:
        """What the outputs do not show, as plain data. Empty before initialise()."""
        if self._detector is None:
            return {}
        return self._get_mechanics() | {"diagnosis": self._diagnosis.get_state()}

    def list_files(self) -> dict[str, int]:
        """Checksums of what was read, by the parameter that names its file; empty before initialise()."""
        if self._detector is None:
            return {}
        ships, walls = self._bodies[: len(self.names)], self._bodies[len(self.names) :]
        obstacles = crc32(repr([wall.checksum for wall in walls]).encode())
        return {**{f"{ship.name}.ship": ship.checksum for ship in ships}, "obstacles": obstacles}

    def _get_mechanics(self) -> dict[str, Any]:
        """The part of the state that a step changes before it can fail."""
        return {
            "exchange": self._exchange.get_state(),
            "fenders": self._fenders.get_state(),
            "caches": self._caches.get_state(),
            "collisions": self._collisions.get_state(),
            "totals": self._totals.get_state(),
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit.

        Raises StepError before initialise(), and for another dict.
        """
        if not state:
            self.close()
            return
        if self._detector is None:
            raise StepError("ShipCollision is not initialised: call initialise() before set_state()")
        missing = [part for part in _STATE if part not in state]
        if missing:
            raise StepError(f"the state has no {missing[0]!r}: give what get_state() returned")
        if any(b >= len(self._bodies) for _, b, *_ in state["collisions"]["pairs"]):  # saved with more obstacles
            raise StepError("the state is not of ShipCollision: give what get_state() returned")
        self._set_mechanics(state)
        self._diagnosis.set_state(state["diagnosis"])

    def _set_mechanics(self, state: dict[str, Any]) -> None:
        self._exchange.set_state(state["exchange"])
        self._fenders.set_state(state["fenders"])
        self._caches.set_state(state["caches"])
        self._collisions.set_state(state["collisions"])
        self._totals.set_state(state["totals"])
