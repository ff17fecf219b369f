"""Wrong wiring: what the collision model receives is compared with itself and with what it issued.

    first step    hulls that overlap
    third step    ships of whose state nothing was ever set
    motion        position against velocity and heading against rate (motion_watch.py)
    answer        velocity after an impulse against the one predicted, and impulse_applied (answer_watch.py)

Nothing is changed but the outputs `diagnosis.*`, and a warning is said. A ship is watched until its state was seen to
agree, or until something was found about it: one finding per ship, beside an overlap at the start.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from math import inf, pi
from typing import Any

from .answer_watch import AnswerWatch
from .bodies import Body
from .dynamics.impulse_ledger import ImpulseLedger
from .findings import FINDINGS, Found
from .geometry.broad_phase import Pair
from .interface import DiagnosisOutput, ShipState
from .motion_watch import MotionWatch
from .proximity import NearPair

__all__ = ["Diagnosis"]

CONNECTED_BY = 3
"""Step at which a ship without a state is not connected: a host may set the first inputs after its first step."""

OVERLAP = 0.5
"""Overlap [m] in the first step that is a finding. Ships that lie alongside may overlap by a little."""

_ANSWERING = ("ledger", "force", "state")
"""Feedbacks of ships that answer."""

_NOTHING: Mapping[str, float | str] = {}


class Diagnosis:
    """The watches over the ships. bodies, ledgers, inputs: of the model; feedbacks: by ship; out: filled."""

    def __init__(
        self, bodies: Sequence[Body], feedbacks: Sequence[str], ledgers: Sequence[ImpulseLedger],
        inputs: Sequence[ShipState], out: DiagnosisOutput,
    ) -> None:  # fmt: skip
        self._bodies, self._ledgers, self._inputs, self._out = bodies, ledgers, inputs, out
        self._step = 0
        self.due = -inf  # time [s] of the next look, if contact gives no impulse before
        self._motions = [MotionWatch() for _ in inputs]
        self._answers = [AnswerWatch(done=feedback not in _ANSWERING) for feedback in feedbacks]
        out.code, out.count, out.ship, out.text = 0, 0, 0, ""

    def examine(self, t: float, H: float, absent: Collection[int], near: Mapping[Pair, NearPair], touched: bool) -> str:
        """Examine the step of H [s] that began at t [s]; the warning of what was found in it first, or nothing.

        Call it when t has come to `due`, or contact gave impulses (touched). absent: ships of whose state nothing was
        ever set; near: pairs.
        """
        self._step += 1
        said: list[str] = []
        if self._step == 1:
            said += self._find_overlaps(near)
        elif self._step == CONNECTED_BY:
            said += [self._say("not connected", i) for i in sorted(absent)]
        due = inf
        for i, motion in enumerate(self._motions):
            if not motion.done:
                if t >= motion.next and self._step >= CONNECTED_BY:
                    said += self._say_found(i, motion.look(self._inputs[i], self._ledgers[i].is_settled, t, H))
                due = min(due, motion.next)
        if touched or self._waits():
            for i, answer in enumerate(self._answers):
                if not answer.done:
                    issued = self._ledgers[i].issued.tolist()
                    said += self._say_found(i, answer.look(self._inputs[i], self._bodies[i], issued, t))
        self.due = -inf if self._waits() or self._step < CONNECTED_BY else due
        return "; ".join(said)

    def _waits(self) -> bool:
        """Whether a ship has an impulse to answer."""
        return any(answer.t is not None and not answer.done for answer in self._answers)

    # -- the start ------------------------------------------------------------------------------------

    def _find_overlaps(self, near: Mapping[Pair, NearPair]) -> list[str]:
        said = []
        for (a, b), pair in near.items():
            if pair.gap < -OVERLAP:
                turned = [i for i in (a, b) if i < len(self._inputs) and abs(self._inputs[i].attitude[2]) > 2.0 * pi]
                if turned:
                    said += [self._say("attitude in degrees", i, {"yaw": self._inputs[i].attitude[2]}) for i in turned]
                else:
                    said.append(
                        self._say(
                            "overlap at the start", a, {"other": self._bodies[b].name, "overlap": -pair.gap}, last=False
                        )
                    )
        return said

    # -- findings -------------------------------------------------------------------------------------

    def _say_found(self, i: int, found: Found | None) -> list[str]:
        return [self._say(found[0], i, found[1])] if found is not None else []

    def _say(self, key: str, i: int, measured: Mapping[str, float | str] = _NOTHING, last: bool = True) -> str:
        """Enter a finding about a ship in the outputs; its text. last: the ship is not watched any more."""
        if last:
            self._motions[i].done = self._answers[i].done = True
        out, (code, finding) = self._out, FINDINGS[key]
        text = finding.describe(ship=self._bodies[i].name, **measured)
        out.count += 1
        if out.count == 1:
            out.code, out.ship, out.text = code, i + 1, text
        return text

    # -- state ----------------------------------------------------------------------------------------

    def get_state(self) -> list[Any]:
        """All of it as plain data; the outputs are saved as outputs."""
        watches = ([list(vars(watch).values()) for watch in group] for group in (self._motions, self._answers))
        return [self._step, self.due, *watches]

    def set_state(self, state: list[Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self._step, self.due, motions, answers = state
        self._motions = [MotionWatch(*values) for values in motions]
        self._answers = [AnswerWatch(*values) for values in answers]
