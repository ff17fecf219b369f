"""Wrong wiring: what the collision model receives is compared with itself and with what it issued.

    first step    hulls that overlap
    third step    ships of whose state nothing was ever set
    motion        position against velocity and heading against rate (motion_check.py)
    answer        velocity after an impulse against the one predicted, and impulse_applied against what was issued

Nothing is changed but the outputs `diagnosis.*`, and a warning is said. A ship is watched until its state was seen to
agree, or until something was found about it: one finding per ship, beside an overlap at the start. Between the windows
in which a ship is watched are pauses, so that ships that lie still or sail north cost little.

A ship answers an impulse J by M^-1 J. Its share of that, over the steps since the first impulse:

    share = J^T (change of nu) / J^T M^-1 J

J is impulse_applied of a ship with feedback "ledger", and the impulse issued of others. A share is counted only while
M^-1 J exceeds what other forces could do in the time. A false alarm is worse than a finding that is missed.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot, inf, pi
from typing import Any

from .bodies import Body
from .dynamics.impulse_ledger import ImpulseLedger
from .findings import FINDINGS
from .geometry.broad_phase import Pair
from .interface import DiagnosisOutput, ShipState
from .motion_check import Motion, judge_motion
from .proximity import NearPair

__all__ = ["Diagnosis"]

CONNECTED_BY = 3
"""Step at which a ship without a state is not connected: a host may set the first inputs after its first step."""

OVERLAP = 0.5
"""Overlap [m] in the first step that is a finding. Ships that lie alongside may overlap by a little."""

CHANGES, LEAST_CHANGES, DURATION = 8, 3, 1.0
"""A window ends after so many changes of the position, or after fewer and so many seconds. With fewer, a ship model
whose step is slightly longer than the collision model's would be suspected; in longer ones a ship surges in waves."""

PATIENCE = 32
"""Steps without a change of the position after which a window is given up."""

PAUSE, LONGEST_PAUSE, LONGEST_STRIDE = 128, 512, 64
"""Steps between windows, twice as many after each, and most steps between looks at a ship at rest. A window costs 5 %
of a far step per ship and step."""

WINDOWS = 2
"""Windows in a row with the same finding before it is said: a host may move a ship once."""

DEADLINE_STEPS, DEADLINE = 10, 1.0
"""Steps and seconds within which an impulse is answered: ship models may take steps ten times as long."""

LONGEST_WATCH = 3.0
"""Seconds after which the answer to small impulses is no longer waited for: other forces have changed the motion."""

LEAST_CHANGE, OTHER_ACCELERATION = 0.05, 0.5
"""An impulse counts from a change of the velocity of so many m/s, and so many m/s2 times the time. With less, a ship
that its propeller presses to a quay, and that rightly stays there, would be suspected."""

LIGHTEST, HEAVIEST, CERTAIN, NO_ANSWER = 3.0, 1.0 / 3.0, 30.0, 0.1
"""Shares beyond which the mass differs, at the second look or at once, and below which there is no answer. A ship model
without added mass has a share of 2."""


_ANSWERING = ("ledger", "force", "state")
"""Feedbacks of ships that answer."""

_NOTHING: Mapping[str, float | str] = {}


@dataclass
class _Motion:
    """Watch over the state of a ship. next: time [s] of the next look; stride, pause: in
    steps; start: of the window; position: last
    received; changes: of it in the window, -2 before the first is received; idle: steps without one."""

    next: float = -inf
    stride: int = 1
    pause: int = PAUSE
    start: list[Any] | None = None
    position: list[float] = field(default_factory=list)
    changes: int = -2
    idle: int = 0
    suspicion: str = ""
    windows: int = 0
    speed: bool = False  # seen to be right
    rate: bool = False
    done: bool = False

    def rest(self, t: float, H: float, steps: int) -> None:
        """Leave the window, and look again after so many steps of H [s]; half a step less for rounding."""
        self.start, self.position, self.changes, self.idle = None, [], -2, 0
        self.next = t + (steps - 0.5) * H


@dataclass
class _Answer:
    """Watch over the answer of a ship since t [s], steps ago. nu, applied, issued: (6) before the impulse."""

    t: float | None = None
    steps: int = 0
    nu: list[float] = field(default_factory=list)
    applied: list[float] = field(default_factory=list)
    issued: list[float] = field(default_factory=list)
    share: float = 0.0  # largest since
    counts: bool = False  # a share was large enough to count
    doubts: int = 0
    done: bool = False


class Diagnosis:
    """The watches over the ships. bodies, ledgers, inputs: of the model; feedbacks: by ship; out: filled."""

    def __init__(
        self, bodies: Sequence[Body], feedbacks: Sequence[str], ledgers: Sequence[ImpulseLedger],
        inputs: Sequence[ShipState], out: DiagnosisOutput,
    ) -> None:  # fmt: skip
        self._bodies, self._feedbacks, self._ledgers, self._inputs, self._out = bodies, feedbacks, ledgers, inputs, out
        self._step = 0
        self.due = -inf  # time [s] of the next look, if contact gives no impulse before
        self._issuing = False
        self._motions = [_Motion() for _ in inputs]
        self._answers = [_Answer(done=feedback not in _ANSWERING) for feedback in feedbacks]
        self._issued = [[0.0] * 6 for _ in inputs]  # until the last step that was looked at
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
                    said += self._watch_motion(i, motion, t, H)
                due = min(due, motion.next)
        if touched or self._issuing:
            self._issuing = False
            for i, answer in enumerate(self._answers):
                if not answer.done:
                    said += self._watch_answer(i, answer, t)
        self.due = -inf if self._issuing or self._step < CONNECTED_BY else due
        return "; ".join(said)

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

    # -- motion ---------------------------------------------------------------------------------------

    def _watch_motion(self, i: int, motion: _Motion, t: float, H: float) -> list[str]:
        """Look whether a ship moves; if it does, begin a window, go on with it, and judge it at its end."""
        ship = self._inputs[i]
        if not self._ledgers[i].is_settled:  # an impulse changes the velocity within a step
            motion.rest(t, H, motion.pause)
        elif ship.position == motion.position:
            motion.idle += 1
            if motion.changes < 0 or motion.idle > PATIENCE:
                motion.rest(t, H, motion.stride)
                motion.position, motion.stride = list(ship.position), min(2 * motion.stride, LONGEST_STRIDE)
        else:
            motion.idle, motion.position, motion.next = 0, list(ship.position), t
            motion.changes += 1
            now = Motion(t, motion.position, list(ship.attitude), list(ship.velocity), list(ship.rate))
            if motion.changes == 0:
                motion.start = list(now)
            elif motion.start is not None:
                T = t - motion.start[0]
                if motion.changes >= CHANGES or (motion.changes >= LEAST_CHANGES and T >= DURATION):
                    return self._judge(i, motion, Motion(*motion.start), now, H)
        return []

    def _judge(self, i: int, motion: _Motion, start: Motion, now: Motion, H: float) -> list[str]:
        verdict = judge_motion(start, now)
        motion.speed, motion.rate = motion.speed or verdict.speed, motion.rate or verdict.rate
        motion.done = motion.speed and motion.rate
        motion.windows = motion.windows + 1 if verdict.finding == motion.suspicion else 1
        motion.suspicion = verdict.finding
        if verdict.finding and motion.windows >= WINDOWS:
            return [self._say(verdict.finding, i, verdict.measured)]
        if verdict.finding:
            motion.start, motion.changes = list(now), 0  # the next window begins at once
        else:
            motion.rest(now.t, H, motion.pause)
            motion.pause = min(2 * motion.pause, LONGEST_PAUSE)
        return []

    # -- answer ---------------------------------------------------------------------------------------

    def _watch_answer(self, i: int, answer: _Answer, t: float) -> list[str]:
        """Begin to watch a ship with the step that issues an impulse to it, and judge in the steps after."""
        before, ship = self._issued[i], self._inputs[i]
        if (issued := self._ledgers[i].issued.tolist()) != before:
            self._issued[i] = issued
            if answer.t is None:
                answer.t, answer.steps, answer.share, answer.counts, answer.doubts = t, 0, 0.0, False, 0
                answer.nu, answer.applied, answer.issued = (
                    ship.velocity + ship.rate, list(ship.impulse_applied), before,
                )  # fmt: skip
                self._issuing = True
                return []
        if answer.t is None:
            return []
        answer.steps += 1
        said = self._judge_answer(i, answer, t - answer.t, before)
        if answer.done:
            answer.t = None
        self._issuing = self._issuing or answer.t is not None
        return said

    def _judge_answer(self, i: int, answer: _Answer, T: float, issued: list[float]) -> list[str]:
        """What T [s] after the first impulse shows. issued (6): all that the ship can have received."""
        ship, by_ledger = self._inputs[i], self._feedbacks[i] == "ledger"
        applied = by_ledger and ship.impulse_applied != answer.applied
        ends = (ship.impulse_applied, answer.applied) if applied else (issued, answer.issued)
        share, counts = self._measure_share(i, [a - b for a, b in zip(*ends, strict=True)], answer.nu, T)
        if counts:
            answer.share, answer.counts = max(share, answer.share), True
            if (applied or not by_ledger) and HEAVIEST <= share <= LIGHTEST:
                answer.done = True
                return []
            answer.doubts = answer.doubts + 1 if applied or share > LIGHTEST else 0
            if (answer.doubts >= WINDOWS or share > CERTAIN) and (applied or not by_ledger):
                return [self._say("other mass", i, {"share": share, "mass": 1.0 / share if share > 0.0 else inf})]
        overdue = answer.steps >= DEADLINE_STEPS and T >= DEADLINE
        if overdue and by_ledger and not applied:
            key = "impulse_applied not returned" if answer.share > HEAVIEST else "impulse not applied"
            return [self._say(key, i, {"duration": T})]
        if overdue and counts and not by_ledger:
            if answer.share < NO_ANSWER:
                return [self._say("force without effect", i, {"duration": T, "share": share})]
            return [self._say("other mass", i, {"share": share, "mass": 1.0 / share if share > 0.0 else inf})]
        if overdue and T >= LONGEST_WATCH:
            answer.t = None
        return []

    def _measure_share(self, i: int, J: list[float], nu: list[float], T: float) -> tuple[float, bool]:
        """The share of M^-1 J that the ship shows since nu (6), and whether it is large enough to count."""
        ship = self._inputs[i]
        predicted = (self._bodies[i].inverse_at(ship.attitude) @ J).tolist()
        change = [now - then for now, then in zip(ship.velocity + ship.rate, nu, strict=True)]
        whole = sum(a * b for a, b in zip(J, predicted, strict=True))
        if whole <= 0.0 or hypot(*predicted[:3]) < LEAST_CHANGE + OTHER_ACCELERATION * T:
            return 0.0, False
        return sum(a * b for a, b in zip(J, change, strict=True)) / whole, True

    # -- findings -------------------------------------------------------------------------------------

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
        return [
            self._step, self.due, self._issuing, [list(issued) for issued in self._issued],
            [list(vars(motion).values()) for motion in self._motions],
            [list(vars(answer).values()) for answer in self._answers],
        ]  # fmt: skip

    def set_state(self, state: list[Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self._step, self.due, self._issuing, issued, motions, answers = state
        self._issued = [list(each) for each in issued]
        self._motions = [_Motion(*values) for values in motions]
        self._answers = [_Answer(*values) for values in answers]
