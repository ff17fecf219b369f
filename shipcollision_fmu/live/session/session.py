"""Session: a live run in a thread of its own, which alone touches the models.

    submit      a command goes in; its answer is a Future: a result, or the InputError of the refusal
    snapshot    the latest Snapshot; readers take it at their own rates, and none is kept for them
    listen      a function that is given every event (news.py), in the session's thread: it must return at once

    thread:  take commands -> step when due (pacer.py) -> publish a snapshot -> ...  -> write the run's folder

A command is done between two steps. Orders take effect at the next communication point.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...errors import HostError, InputError, ShipCollisionError
from ...scenario.scenario import Scenario
from ...show.page import PAGE
from .actions import START, Actions
from .clock import Clock, Waiting, WallClock
from .collision_news import CollisionNews
from .commands import (
    Arm,
    Back,
    ChangeEnvironment,
    Command,
    Disarm,
    End,
    Fail,
    Horn,
    Leave,
    Mark,
    Order,
    Pause,
    Rate,
    Step,
    TakeCommand,
)
from .in_command import InCommand
from .kept_scenario import KeptScenario
from .live_run import LiveRun
from .news import Event, News
from .pacer import FASTEST, SLOWEST, Pacer
from .run_folder import write_run
from .snapshot import Snapshot
from .touch_log import LoggedTouch

__all__ = ["MOST_WAITING", "Session"]

MOST_WAITING = 1000
"""Commands that wait at a time; more are refused. The thread takes thousands in a second."""
IN_A_ROW = 50
"""Commands that are done before the next step; more wait, so that a flood does not stop the simulation."""
PUBLISHED = 0.01
"""[s] of wall time between two snapshots at least. Pages ask twenty times a second, protocols less."""
LONGEST_WAIT = 0.25
"""[s] without a command after which a paused session publishes again."""


class Session:
    """A live run of a scenario; start() it. It ends with End, at `duration` [s] of simulated time, or by an error of a
    model, and then writes its run into the folder `out` (None: nowhere).

    Raises ScenarioError for ships that cannot be loaded.
    """

    def __init__(
        self, scenario: Scenario, *, out: Path | None = None, spool: Path | None = None, rate: float = 1.0,
        duration: float | None = None, paused: bool = False, clock: Clock | None = None,
    ) -> None:  # fmt: skip
        self._run = LiveRun(scenario, spool)
        self._run.mark(START)
        ends = [end for end in (duration, self._run.latest_end) if end is not None]
        self._out, self._duration, self._clock = out, min(ends, default=None), clock or WallClock()
        self._waiting: queue.Queue[Waiting] = queue.Queue(MOST_WAITING)
        self._kept = None if out is None else KeptScenario(self._run, out, self._clock.now())
        self._pacer = Pacer(check_rate(rate), self._clock.now(), self._run.time)
        self._paused, self._reason, self._begun = paused, "", 0.0
        self._news = News(lambda: self._run.time)
        self._collisions = CollisionNews(self._run, self._news.tell)
        self._command = InCommand(self._run.bridges, self._news.tell)
        self._on_run = Actions(self._run, self._command, self._news.tell)
        self._actions: dict[type[Command], Callable[[Any], None]] = {
            TakeCommand: self._command.take, Leave: self._command.leave, Horn: self._command.sound,
            Order: self._on_run.order, Fail: self._on_run.fail, Arm: self._on_run.arm, Disarm: self._on_run.disarm,
            ChangeEnvironment: self._on_run.change, Mark: self._on_run.mark,
            Back: self._go_back, Rate: self._set_rate, Pause: self._pause, Step: self._step, End: self._end,
        }  # fmt: skip
        self._refused, self._counting, self._entering = 0, threading.Lock(), threading.Lock()
        self._failed: ShipCollisionError | None = None
        self._folder: Path | None = None
        self._thread = threading.Thread(target=self._work, name="live session", daemon=True)
        self._published = -PUBLISHED
        self._snapshot = self._observe()

    # -- for other threads --------------------------------------------------------------------------------------------

    @property
    def scenario(self) -> Scenario:
        """The scenario."""
        return self._run.scenario

    @property
    def run(self) -> LiveRun:
        """The run. Other threads read from it only what does not change: ships and limits."""
        return self._run

    @property
    def snapshot(self) -> Snapshot:
        """The latest snapshot."""
        return self._snapshot

    @property
    def marks(self) -> dict[str, float]:
        """Times [s] of the marks by name."""
        return self._run.marks

    @property
    def notes(self) -> dict[str, str]:
        """Notes on the marks by name."""
        return self._run.notes

    @property
    def armed(self) -> list[dict[str, Any]]:
        """The failures that are armed, as in the event."""
        return self._run.armed.as_dicts()

    @property
    def touches(self) -> tuple[LoggedTouch, ...]:
        """Where bodies have touched so far: the latest places, thinned."""
        return self._run.touch_log.touches

    @property
    def folder(self) -> Path | None:
        """The folder of the run's files, once they are written; None before, and where none are."""
        return self._folder

    @property
    def page(self) -> Path | None:
        """The run's replay, once it is written; None before, and where there is none."""
        return None if self._folder is None or not (self._folder / PAGE).is_file() else self._folder / PAGE

    @property
    def error(self) -> ShipCollisionError | None:
        """What ended the run against the will of all; None otherwise."""
        return self._failed

    def start(self) -> None:
        """Begin."""
        self._restart()
        self._thread.start()

    def join(self, timeout: float | None = None) -> bool:
        """Wait for the end, files written, at most `timeout` [s]; whether it has come."""
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def submit(self, command: Command) -> Future[Any]:
        """Hand in a command. The Future has None when it is done, or the InputError that refuses it."""
        answer: Future[Any] = Future()
        with self._entering:  # none comes in after those that wait were refused
            if not self._snapshot.running:
                answer.set_exception(InputError("the run has ended: start another one"))
                return answer
            try:
                self._waiting.put_nowait((command, answer))
            except queue.Full:
                answer.set_exception(InputError(f"{MOST_WAITING} commands wait already: send fewer"))
        return answer

    def listen(self, listener: Callable[[Event], None]) -> Callable[[], None]:
        """Give every event to `listener` from now on; the function that stops this."""
        return self._news.listen(listener)

    def count_refused(self) -> None:
        """Count a malformed message of a client."""
        with self._counting:
            self._refused += 1

    # -- the thread ---------------------------------------------------------------------------------------------------

    def _work(self) -> None:
        try:
            while not self._reason:
                self._obey()
                if not self._reason and self._is_due():
                    self._advance()
                    self._keep()
        except BaseException as error:  # a model's, or a fault of ours; people are to hear of it
            self._failed = _describe_fault("the live session failed", error)
            self._reason = str(self._failed)
        self._finish()

    def _obey(self) -> None:
        """Do the commands that wait, or wait for one until the next step is due."""
        for i in range(IN_A_ROW):
            found = self._clock.wait(self._waiting, self._time_to_wait() if i == 0 else 0.0)
            if found is None:
                break
            self._do(*found)
            if self._reason:  # what still waits is refused
                return
        if self._clock.now() - self._published >= LONGEST_WAIT:
            self._publish()

    def _time_to_wait(self) -> float:
        if self._paused:
            return LONGEST_WAIT
        return min(LONGEST_WAIT, max(0.0, self._pacer.due(self._run.time + self._run.step) - self._clock.now()))

    def _is_due(self) -> bool:
        return not self._paused and self._clock.now() >= self._pacer.due(self._run.time + self._run.step)

    def _advance(self) -> None:
        armed = self._run.armed.listed
        self._run.advance()
        for begun in self._run.triggered:
            self._news.tell("failure", ship=begun.ship, what=begun.what, on=True)
        if self._run.armed.listed is not armed:
            self._on_run.tell_of_armed()
        self._pacer.note(self._clock.now(), self._run.time)
        if self._run.k == self._run.recorded + 1:
            full = f"the record is full, with {self._run.recorded} steps; the run goes on without it"
            self._news.tell("log", message=full)
        if self._collisions.look():
            self._publish()
        if self._duration is not None and self._run.time >= self._duration - 1e-9:
            self._reason = "the duration is over"
        if self._clock.now() - self._published >= PUBLISHED:
            self._publish()

    def _keep(self) -> None:
        try:
            if self._kept is not None:
                self._kept.keep(self._clock.now())
        except HostError as error:
            self._news.tell("log", message=f"should the process be killed, the run is lost: {error}")

    def _do(self, command: Command, answer: Future[Any]) -> None:
        if not answer.set_running_or_notify_cancel():
            return
        try:
            self._actions[type(command)](command)
            self._publish()
        except InputError as error:
            answer.set_exception(error)
        except Exception as error:
            fault = _describe_fault(f"{type(command).__name__} failed", error)
            answer.set_exception(fault)
            if isinstance(command, Step | Back):  # the models may be in the midst of it
                raise
            self._news.tell("log", message=str(fault))
        else:
            answer.set_result(None)

    def _set_rate(self, command: Rate) -> None:
        rate = check_rate(command.rate)
        if rate != self._pacer.rate:
            self._pacer.restart(self._clock.now(), self._run.time, rate, self._read_begun())
            self._news.tell("rate", rate=rate)

    def _pause(self, command: Pause) -> None:
        if command.paused != self._paused:
            begun, self._paused = self._read_begun(), command.paused
            self._restart(begun)
            self._news.tell("pause", paused=command.paused)

    def _end(self, command: End) -> None:
        self._reason = command.reason

    def _restart(self, begun: float = 0.0) -> None:
        """Begin the pace anew from here; `begun` [s] of the step to come has passed."""
        self._begun = begun
        self._pacer.restart(self._clock.now(), self._run.time, begun=begun)

    def _read_begun(self) -> float:
        """How much of the step to come has passed [s]; nothing does in a pause."""
        if self._paused:
            return self._begun
        return self._pacer.read_begun(self._clock.now(), self._run.time, self._run.step)

    def _go_back(self, command: Back) -> None:
        armed = self._run.armed.listed
        self._run.go_back(command.name)
        self._restart()
        self._collisions.forget()
        self._news.tell("back", name=command.name)
        if self._run.armed.listed != armed:
            self._on_run.tell_of_armed()

    def _step(self, command: Step) -> None:
        if not self._paused:
            raise InputError("a single step needs a pause: pause first")
        self._advance()
        self._restart()

    # -- what is told -------------------------------------------------------------------------------------------------

    def _observe(self) -> Snapshot:
        now, run = self._clock.now(), self._run
        return Snapshot(
            time=run.time, step_count=run.k, rate=self._pacer.rate, paced=self._pacer.is_paced(now),
            real_rate=0.0 if self._paused else self._pacer.measure(now, run.time), paused=self._paused,
            running=True, ships=run.observe_ships(), environment=run.observe_environment(),
            contact=run.observe_contact(), command=self._command.clients, refused=self._refused,
        )  # fmt: skip

    def _publish(self) -> None:
        self._snapshot = self._observe()
        self._published = self._clock.now()

    def _finish(self) -> None:
        """Write the run, tell of the end, refuse what still waits."""
        error = None if self._failed is None else str(self._failed)
        try:
            if self._out is not None:
                self._news.tell("log", message="writing the run")
                lines = write_run(self._run, self._out)
                self._folder = self._out
                if self._kept is not None:
                    self._kept.remove()
                for line in lines:
                    self._news.tell("log", message=line)
        except Exception as fault:  # a full disk, say; the pages are to hear of it
            self._failed = (
                fault if isinstance(fault, ShipCollisionError) else HostError(f"cannot write the run: {fault}")
            )
            error = str(self._failed)
        with suppress(Exception):  # what cannot be seen any more stays as it was last
            self._publish()
        with self._entering:
            self._snapshot = replace(self._snapshot, running=False)
        folder = None if self._folder is None else str(self._folder)
        self._news.tell("end", folder=folder, message=self._reason, error=error)
        while (left := WallClock().wait(self._waiting, 0.0)) is not None:
            if left[1].set_running_or_notify_cancel():
                left[1].set_exception(InputError("the run has ended: start another one"))
        self._run.close()


def _describe_fault(what: str, error: BaseException) -> ShipCollisionError:
    """The error as people read it: as it is where it has a line of ours, else with its kind."""
    return error if isinstance(error, ShipCollisionError) else HostError(f"{what}: {type(error).__name__}: {error}")


def check_rate(rate: float) -> float:
    """The rate. Raises InputError outside its limits."""
    if isinstance(rate, bool) or not isinstance(rate, int | float) or not SLOWEST <= rate <= FASTEST:
        raise InputError(f"rate = {rate!r} must be from {SLOWEST:g} to {FASTEST:g}: give one such as 1")
    return float(rate)
