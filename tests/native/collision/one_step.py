"""OneStep: each step of a Python model again by the native one, from the same state and inputs.

Where the two differ, the Python model is asked again with inputs that are changed in their last bits: rounding chooses
among equal features, and the normals of Bullet depend on that choice.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass, field
from itertools import zip_longest
from math import floor, log10
from typing import Any, NamedTuple

import numpy as np

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.collision.totals import CONVERGED
from shipcollision_fmu.ship.frames import Array
from tests.native.collision.kernels import load_kernels
from tests.native.collision.model_state import list_state
from tests.native.native_collision import STATE, NativeCollision

__all__ = ["CLOSE", "OneStep", "Tally"]

CLOSE = 1e-9
"""Largest difference of one step, of its impulse's or the state's scale."""
FEW, TRIALS = 60, 600
"""Changed inputs: after the first number the spread of the answers is enough, if it is as large as the difference."""
LEAST_NUDGE, MOST_NUDGE = -16.0, -12.0
"""Decimal logarithms of the change of the received numbers, as a share of each."""
REPEATED, SPREAD = 0.01, 0.3
"""Shares of the difference. Within the first, a changed input gives the native answer. From the second on, the Python
model's own answers lie as far from each other."""
ROUNDING = 1e-7
"""Of the momentum and of the energy of the ships: a lesser impulse or energy is judged by these."""

FAR = 5.0
"""Clearance [m] from which on a step is far, if nothing is pending."""


@dataclass(frozen=True)
class Answer:
    """What a step gave. J (n, 6): impulses [N s, N m s]; motion (n, 12): at its end; pairs: by pair of bodies the
    resultant of its contacts, linear and about the origin of n; energy (5,): lost [J]; words: whole numbers, texts."""

    J: Array
    motion: Array
    pairs: dict[tuple[int, int], Array]
    energy: Array
    clearance: float
    residual: float
    words: tuple[Any, ...]


@dataclass(frozen=True)
class Scale:
    """Of the ships at the start of a step: largest momentum [N s], reach [m], kinetic energy [J], and distance from the
    origin [m]."""

    momentum: float
    reach: float
    energy: float
    distance: float


def list_energies(model: Any) -> Array:
    """Energies lost so far [J]: all, along the normal, by friction; stored and dissipated in fenders."""
    energy, fender = model.outputs.energy, model.outputs.fender
    return np.array([energy.dissipated, energy.normal, energy.tangential, fender.stored, fender.dissipated])


def read_answer(model: Any, issued: Array, lost: Array) -> Answer:
    """What the last step of a model gave. issued (n, 6), lost (5,): sums before it."""
    out = model.outputs
    pairs: dict[tuple[int, int], Array] = {}
    for contact in out.contacts[: out.contact_count]:
        impulse = np.array(contact.impulse)
        moment = np.array(contact.couple) + np.cross(np.array(contact.point), impulse)
        key = contact.ship_a, contact.ship_b
        pairs[key] = pairs.get(key, np.zeros(6)) + np.concatenate([impulse, moment])
    words = (
        out.contact_active, out.contact_count, out.collision_count, out.scratch_id, out.nearest_ship_a,
        out.nearest_ship_b, out.impact.ship_a, out.impact.ship_b, out.solver.unconverged, out.solver.scaled,
        model.warning, *model.events,
    )  # fmt: skip
    motion = np.array([[*ship.position, *ship.attitude, *ship.velocity, *ship.rate] for ship in out.ships])
    J = np.array([ship.impulse for ship in out.ships]) - issued
    return Answer(J, motion, pairs, list_energies(model) - lost, out.clearance, out.solver.residual, words)


def find_largest(*values: Any) -> float:
    return max((float(np.abs(each).max()) for each in values if np.size(each)), default=0.0)


def compare(one: Answer, other: Answer, scale: Scale) -> dict[str, float]:
    """Differences as shares of their scale, by name; of words 1."""
    linear = max(find_largest(other.J[:, :3]), ROUNDING * scale.momentum, 1.0)
    angular = max(find_largest(other.J[:, 3:]), linear * scale.reach)
    found = {
        "impulse": find_largest(one.J[:, :3] - other.J[:, :3]) / linear,
        "moment": find_largest(one.J[:, 3:] - other.J[:, 3:]) / angular,
        "motion": find_largest(one.motion[:, 3:] - other.motion[:, 3:]) / max(1.0, find_largest(other.motion[:, 3:])),
        "place": find_largest(one.motion[:, :3] - other.motion[:, :3]) / max(1.0, scale.distance),
        "energy": find_largest(one.energy - other.energy)
        / max(find_largest(other.energy), ROUNDING * scale.energy, 1.0),
        "clearance": abs(one.clearance - other.clearance) / max(1.0, abs(other.clearance)),
        "words": float(one.words != other.words),
    }
    if one.pairs.keys() == other.pairs.keys():
        away = max(1.0, scale.distance)
        size = max([np.linalg.norm(w[:3]) for w in other.pairs.values()] + [linear])
        turn = max([np.linalg.norm(w[3:]) for w in other.pairs.values()] + [linear * away])
        for key, wrench in one.pairs.items():
            off = wrench - other.pairs[key]
            share = max(find_largest(off[:3]) / size, find_largest(off[3:]) / turn)
            found["pairs"] = max(found.get("pairs", 0.0), float(share))
    return found


class Differing(NamedTuple):
    """A step whose answers differ. kind: "repeated", the Python model gives the native answer for inputs that differ in
    their last bits; "spread", its own answers to such inputs differ as much; "left", neither. share: the largest
    difference, that of `name`; words: whole numbers and texts that differ."""

    kind: str
    label: Any
    t: float
    share: float
    name: str
    words: list[Any]


@dataclass
class Tally:
    """Of many steps: taken, compared, with impulses. worst: by name the largest difference of those that agree;
    residual: largest of the native answers, as a share of the Python model's, or of the limit for a solution."""

    taken: int = 0
    compared: int = 0
    touched: int = 0
    residual: float = 0.0
    worst: dict[str, float] = field(default_factory=dict)
    differ: list[Differing] = field(default_factory=list)

    @property
    def left(self) -> list[Differing]:
        """Steps that nothing explains."""
        return [each for each in self.differ if each.kind == "left"]

    def describe(self) -> str:
        """In a few lines."""
        kinds = Counter(each.kind for each in self.differ)
        sizes = Counter((each.kind, each.name, floor(log10(each.share))) for each in self.differ)
        return (
            f"{self.taken} steps, {self.compared} compared, {self.touched} with impulses, differ: {dict(kinds)}, "
            f"worst of the others: { {name: f'{share:.0e}' for name, share in self.worst.items()} }, "
            f"residual {self.residual:.1e}\n  by kind, what and decade: {sorted(sizes.items())}"
        )


class OneStep:
    """The native model that answers the steps of a Python model, and what was found."""

    def __init__(self, model: ShipCollision, tally: Tally, label: Any = "", far: int = 1) -> None:
        """far: of steps in which nothing is near, one of so many is compared."""
        self.python, self.tally, self.label, self.far = model, tally, label, far
        self._native = NativeCollision(load_kernels(), model.names)
        self._native.parameters = model.parameters
        self._give_inputs(self._native)
        self._native.initialise()
        self._nudged: ShipCollision | None = None

    def step(self, take: Callable[[float, float], None], t: float, H: float) -> None:
        """The step of both, and what differs. take: that of the Python model."""
        model = self.python
        self.tally.taken += 1
        if self.tally.taken % self.far and self._is_far():
            take(t, H)
            return
        state, lost = model.get_state(), list_energies(model)
        issued = np.array([ledger["issued"] for ledger in state["exchange"]["ledgers"]])
        take(t, H)
        self._step_natively(state, t, H)
        expected, found = read_answer(model, issued, lost), read_answer(self._native, issued, lost)
        scale = self._measure()
        shares = compare(found, expected, scale)
        native_state = bytes.fromhex(self._native.get_state()["bytes"])
        shares["state"] = list_state(model.get_state()).compare(native_state, max(ROUNDING * scale.energy, 1.0))
        self.tally.compared += 1
        self.tally.touched += bool(expected.J.any())
        self.tally.residual = max(self.tally.residual, found.residual / max(expected.residual, CONVERGED))
        name = max(shares, key=lambda name: shares[name])
        if shares[name] <= CLOSE:
            for each, share in shares.items():
                self.tally.worst[each] = max(self.tally.worst.get(each, 0.0), share)
            return
        kind = self._explain(state, (issued, lost), t, H, expected, found, scale)
        words = [pair for pair in zip_longest(found.words, expected.words) if pair[0] != pair[1]]
        self.tally.differ.append(Differing(kind, self.label, t, shares[name], name, words))

    def _is_far(self) -> bool:
        exchange = self.python._exchange
        return self.python.outputs.clearance > FAR and all(ledger.is_settled for ledger in exchange.ledgers)

    def _step_natively(self, state: Any, t: float, H: float) -> None:
        native = self._native
        self._give_inputs(native)
        absent = self.python._absent
        native.note_inputs_set({f"inputs.ships.{i}.position" for i in range(len(native.names)) if i not in absent})
        native.restore(list_state(state).write())
        native.step(t, H)

    def _give_inputs(self, to: Any) -> None:
        for ship, given in zip(to.inputs.ships, self.python.inputs.ships, strict=True):
            for name in STATE:
                getattr(ship, name)[:] = getattr(given, name)

    def _measure(self) -> Scale:
        momentum = reach = energy = distance = 0.0
        for ship, body in zip(self.python.inputs.ships, self.python._bodies, strict=False):
            diagonal = np.diag(body.upright_inverse)
            masses = np.divide(1.0, diagonal, out=np.zeros(6), where=diagonal > 0.0)
            speed, rate = float(np.linalg.norm(ship.velocity)), float(np.linalg.norm(ship.rate))
            mass = max(masses[:3])
            momentum = max(momentum, mass * (speed + rate * body.reach))
            energy = max(energy, 0.5 * mass * (speed + rate * body.reach) ** 2)
            reach = max(reach, body.reach)
            distance = max(distance, float(np.linalg.norm(ship.position)))
        return Scale(momentum, reach, energy, distance)

    def _explain(
        self, state: Any, sums: tuple[Array, Array], t: float, H: float, expected: Answer, found: Answer, scale: Scale
    ) -> str:  # fmt: skip
        """The kind of Differing."""
        if self._nudged is None:
            self._nudged = ShipCollision(self.python.names)
            self._nudged.parameters, self._nudged.directory = deepcopy(self.python.parameters), self.python.directory
            self._give_inputs(self._nudged)
            self._nudged.initialise()
        model, random = self._nudged, np.random.default_rng(0)
        model._absent = self.python._absent
        size, largest = find_most(compare(found, expected, scale)), 0.0
        for k in range(TRIALS):
            self._give_inputs(model)
            nudge = 10.0 ** random.uniform(LEAST_NUDGE, MOST_NUDGE)
            for ship in model.inputs.ships:
                for name in STATE[:4]:
                    values, least = np.array(getattr(ship, name)), 0.03 * (k % 2)  # what is zero stays so, or not
                    values += nudge * random.standard_normal(3) * np.maximum(np.abs(values), least)
                    getattr(ship, name)[:] = values.tolist()
            model.set_state(deepcopy(state))
            model.step(t, H)
            answer = read_answer(model, *sums)
            if find_most(compare(found, answer, scale)) <= max(CLOSE, REPEATED * size):
                return "repeated"
            largest = max(largest, find_most(compare(answer, expected, scale)))
            if k >= FEW and largest >= SPREAD * size:
                return "spread"
        return "left"

    def close(self) -> None:
        """Free what the Python model of the trials holds."""
        if self._nudged is not None:
            self._nudged.close()


def find_most(shares: dict[str, float]) -> float:
    return max(shares.values())
