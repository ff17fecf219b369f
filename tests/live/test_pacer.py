"""The pace of a live run, and the session's loop on a clock of the test."""

from __future__ import annotations

import queue
import random
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest

from shipcollision_fmu import load_scenario
from shipcollision_fmu.errors import HostError, InputError
from shipcollision_fmu.live.session import session as module
from shipcollision_fmu.live.session.commands import Back, End, Horn, Leave, Mark, Order, Pause, Rate, Step, TakeCommand
from shipcollision_fmu.live.session.pacer import MOST_LAG, WINDOW, Pacer
from shipcollision_fmu.live.session.session import Session
from shipcollision_fmu.scenario.scenario import Scenario
from tests.conftest import Write
from tests.live.live_server import PATIENCE

H = 0.05


def paced(pacer: Pacer, seconds: float, cost: Any, oversleep: Any) -> tuple[float, float, int]:
    """Wall time, simulated time and steps of a loop that sleeps until each step is due, and oversleeps."""
    now, k = 0.0, 0
    while now < seconds:
        now = max(now, pacer.due((k + 1) * H)) + oversleep()
        now += cost()
        k += 1
        pacer.note(now, k * H)
    return now, k * H, k


@pytest.mark.parametrize("rate", [0.25, 1.0, 20.0])
def test_sleeps_that_are_too_long_do_not_add_up(rate: float) -> None:
    """Each sleep is up to 2 ms too long: at rate 20 that is 80 % of a step. A sum of them would be 40 s in ten
    minutes at rate 1."""
    rng = random.Random(1)
    pacer = Pacer(rate, 0.0, 0.0)
    wall, simulated, _ = paced(pacer, 600.0, lambda: 0.0003, lambda: rng.uniform(0.0, 0.002))
    assert abs(simulated - rate * wall) <= 1.5 * H + 0.003 * rate
    assert pacer.is_paced(wall)
    assert pacer.measure(wall, simulated) == pytest.approx(rate, rel=0.05)


def test_a_machine_that_is_too_slow_says_so_and_does_not_catch_up_later() -> None:
    """Steps cost 8 ms where 2.5 are due: the rate is 6.25 instead of 20. Afterwards steps are free, and the rate is 20
    again, not more."""
    pacer = Pacer(20.0, 0.0, 0.0)
    wall, simulated, k = paced(pacer, 10.0, lambda: 0.008, lambda: 0.0)
    assert not pacer.is_paced(wall)
    assert pacer.measure(wall, simulated) == pytest.approx(6.25, rel=0.02)
    now = wall
    while now < wall + 10.0:
        now = max(now, pacer.due((k + 1) * H))
        k += 1
        pacer.note(now, k * H)
    assert pacer.is_paced(now)
    assert k * H - simulated <= 20.0 * (now - wall + MOST_LAG) + H


def test_a_short_lag_is_made_up_for() -> None:
    """A step that takes 2 s: the lag is told, and the simulated time is where it should be again afterwards."""
    costs = iter([2.0] + [0.0] * 1000)
    pacer = Pacer(1.0, 0.0, 0.0)
    wall, simulated, k = paced(pacer, 2.0, lambda: next(costs), lambda: 0.0)
    assert (simulated, pacer.is_paced(wall)) == (H, False)
    while wall < 10.0:
        wall = max(wall, pacer.due((k + 1) * H))
        k += 1
        pacer.note(wall, k * H)
    assert abs(k * H - wall) <= H
    assert pacer.is_paced(wall)


def test_a_new_rate_counts_from_its_own_moment() -> None:
    pacer = Pacer(1.0, 100.0, 7.0)
    assert pacer.due(8.0) == 101.0
    pacer.restart(103.0, 10.0, 4.0)
    assert pacer.due(12.0) == 103.5
    assert WINDOW > 1.0


class FakeClock:
    """A clock that stands still but for waits; `script` are commands by the time at which they come."""

    def __init__(self, script: list[tuple[float, Any]]) -> None:
        self.time, self.script, self.session = 0.0, sorted(script, key=lambda item: item[0]), None
        self.answers: list[Any] = []

    def now(self) -> float:
        return self.time

    def wait(self, waiting: queue.Queue[Any], timeout: float) -> Any:
        while self.script and self.script[0][0] <= self.time:
            assert self.session is not None
            self.answers.append(self.session.submit(self.script.pop(0)[1]))
        try:
            return waiting.get_nowait()
        except queue.Empty:
            reached = self.script[0][0] if self.script and timeout > 0.0 else self.time + timeout
            self.time = min(self.time + timeout, reached)
            return None


def played(
    script: list[tuple[float, Any]], scenario: Scenario | None = None, **options: Any
) -> tuple[Session, list[dict[str, Any]], FakeClock]:
    """A session that has played a script on its clock, its events, and the clock."""
    clock, events = FakeClock(script), list[dict[str, Any]]()
    session = Session(scenario or load_scenario("kvlcc2_crossing"), clock=clock, **options)
    clock.session = session
    session.listen(events.append)
    session.start()
    assert session.join(PATIENCE)
    assert session.error is None
    return session, events, clock


def test_simulated_time_follows_rate_pause_and_single_steps() -> None:
    script = [(2.0, Rate(4.0)), (3.0, Pause(True)), (5.0, Step()), (5.5, Step()), (6.0, Pause(False)), (8.0, End())]
    session, _, _ = played(script)
    expected = 2.0 + 4.0 * 1.0 + 2 * H + 4.0 * 2.0
    assert session.snapshot.time == pytest.approx(expected, abs=0.3)
    assert not session.snapshot.running


FLOOD = [n / 45.0 for n in range(90)]
"""When the commands of a hand that never rests come, in two seconds."""


@pytest.mark.parametrize(
    ("commands", "seconds"),
    [
        ([Rate(1.0)], 2.0),  # unchanged
        ([Rate(1.0), Rate(1.01)], 2.01),
        ([Pause(False)], 2.0),
        ([Pause(True), Pause(False)], 1.0),
        ([Pause(True), Rate(4.0), Pause(False), Rate(2.0)], 22 * (4.0 + 2.0) / 45.0),
    ],
)
def test_who_sets_the_pace_again_and_again_does_not_stop_time(commands: list[Any], seconds: float) -> None:
    """The next command comes before the next step is due, each time."""
    script = [(at, commands[n % len(commands)]) for n, at in enumerate(FLOOD)]
    session, _, _ = played([*script, (2.0, End())])
    assert session.snapshot.time == pytest.approx(H + seconds, abs=1.5 * H)


def test_a_pace_that_is_as_it_was_is_no_news() -> None:
    script = [(1.0, Rate(1.0)), (1.0, Pause(False)), (2.0, Pause(True)), (2.5, Pause(True)), (3.0, End())]
    _, events, clock = played(script)
    assert [event["kind"] for event in events] == ["pause", "end"]
    assert all(answer.result(0.0) is None for answer in clock.answers)


def test_a_pause_at_any_moment_of_a_step_takes_none_of_it() -> None:
    """Two steps of 50 ms, in the second of which there is a pause of 1 s."""
    session, _, _ = played([(0.09, Pause(True)), (1.09, Pause(False)), (1.11, Pause(True)), (1.2, End())])
    assert session.snapshot.step_count == 1 + 2


@pytest.mark.parametrize(
    "loses", [Leave("a"), TakeCommand("a", "own", take=False), TakeCommand("teacher", "own", force=True)]
)
def test_a_horn_is_silent_once_who_sounded_it_has_lost_command(loses: Any) -> None:
    script = [(1.0, TakeCommand("a", "own")), (1.5, Horn("a", "own", True)), (2.0, loses), (3.0, End())]
    session, events, _ = played(script)
    assert not session.snapshot.ships["own"].horn
    assert [(event["time"], event["on"]) for event in events if event["kind"] == "horn"] == [
        (pytest.approx(1.5, abs=0.1), True), (pytest.approx(2.0, abs=0.1), False),
    ]  # fmt: skip


def test_a_horn_sounds_on_for_who_takes_command_again() -> None:
    take = TakeCommand("a", "own")
    session, _, _ = played([(1.0, take), (1.5, Horn("a", "own", True)), (2.0, take), (3.0, End())])
    assert session.snapshot.ships["own"].horn


def test_a_horn_of_the_past_does_not_sound_again() -> None:
    """Nobody has a hand on it any more."""
    script = [(1.0, TakeCommand("a", "own")), (1.5, Horn("a", "own", True)), (2.0, Mark("here")), (3.0, Leave("a")),
              (4.0, Back("here")), (5.0, End())]  # fmt: skip
    session, _, _ = played(script)
    assert not session.snapshot.ships["own"].horn


def test_a_duration_ends_the_run() -> None:
    session, events, _ = played([], duration=12.0)
    assert session.snapshot.time == pytest.approx(12.0)
    assert events[-1] == {"kind": "end", "time": 12.0, "folder": None, "message": "the duration is over", "error": None}


def test_back_to_a_mark_goes_on_at_the_same_pace() -> None:
    session, events, _ = played([(2.0, Mark("here")), (5.0, Back("here")), (7.0, End())], rate=2.0)
    assert session.snapshot.time == pytest.approx(2.0 * 2.0 + 2.0 * 2.0, abs=0.2)
    assert [event["kind"] for event in events] == ["mark", "back", "end"]


def test_a_collision_is_told_once_at_its_beginning_and_once_at_its_end(scenario_file: Write) -> None:
    apart = "friction = 0.3\nrestitution = 0.5\nminimum_separation_time = 0.5"
    _, events, _ = played([], scenario=load_scenario(scenario_file(("friction = 0.3", apart))), duration=6.0)
    told = [(event["kind"], event["id"]) for event in events if event["kind"].startswith("collision")]
    assert told[0] == ("collision begins", 1)
    assert len(told) == len(set(told))
    (begins, ends) = (
        next(event for event in events if event["kind"] == f"collision {kind}") for kind in ("begins", "ends")
    )
    assert begins["time"] - begins["start"] <= H + 1e-9
    assert ends["energy"] >= begins["energy"] > 0.0
    assert ends["time"] - begins["time"] >= 0.5


@pytest.mark.parametrize(
    ("command", "message"),
    [
        (Rate(30.0), "rate = 30.0 must be from 0.25 to 20: give one such as 1"),
        (Rate(float("nan")), "rate = nan must be from 0.25 to 20: give one such as 1"),
        (Step(), "a single step needs a pause: pause first"),
        (Back("there"), "there is no mark 'there': the marks are start"),
        (Mark("start"), "mark 'start' is the beginning of the run: take another name"),
        (Mark(""), "mark '': give a name of 1 to 60 printable characters"),
        (Order("a", "own", rudder_deg=1.0), "nobody is in command of own: take command first"),
        (Order("a", "tug", rudder_deg=1.0), "there is no ship 'tug': the ships are own, target"),
        (TakeCommand("a", "tug"), "there is no ship 'tug': the ships are own, target"),
    ],
)
def test_what_is_refused_says_why(command: Any, message: str) -> None:
    _, _, clock = played([(1.0, command), (2.0, End())])
    with pytest.raises(InputError) as refused:
        clock.answers[0].result(0.0)
    assert str(refused.value) == message


def test_after_the_end_commands_are_refused_and_those_that_wait_too() -> None:
    session, _, clock = played([(1.0, End()), (1.0, Mark("late"))])
    for answer in (clock.answers[1], session.submit(Mark("later"))):
        with pytest.raises(InputError, match="the run has ended: start another one"):
            answer.result(0.0)


def test_a_fault_of_ours_ends_the_run_with_a_line(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def fail(self: Any) -> None:
        raise ZeroDivisionError("oops")

    session = Session(load_scenario("kvlcc2_crossing"), out=tmp_path / "out", clock=FakeClock([]))
    events: list[dict[str, Any]] = []
    session.listen(events.append)
    monkeypatch.setattr(module.LiveRun, "advance", fail)
    session.start()
    assert session.join(PATIENCE)
    assert str(session.error) == "the live session failed: ZeroDivisionError: oops"
    assert events[-1]["error"] == str(session.error)
    assert (tmp_path / "out" / "states.csv").is_file()


def test_a_fault_in_a_command_is_answered_and_the_run_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(self: Any, name: str) -> None:
        raise MemoryError("no room")

    monkeypatch.setattr(module.LiveRun, "mark", lambda self, name, note="": name == "start" or fail(self, name))
    session, events, clock = played([(1.0, Mark("here")), (2.0, End())])
    assert session.snapshot.time == pytest.approx(2.0, abs=0.1)
    with pytest.raises(HostError, match="Mark failed: MemoryError: no room"):
        clock.answers[0].result(0.0)
    assert [event["message"] for event in events if event["kind"] == "log"] == ["Mark failed: MemoryError: no room"]


def test_a_fault_in_the_midst_of_the_models_is_answered_and_ends_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(self: Any, name: str) -> None:
        raise ZeroDivisionError("oops")

    monkeypatch.setattr(module.LiveRun, "go_back", fail)
    clock, events = FakeClock([(1.0, Back("start"))]), list[dict[str, Any]]()
    clock.session = session = Session(load_scenario("kvlcc2_crossing"), clock=clock)
    session.listen(events.append)
    session.start()
    assert session.join(PATIENCE)
    with pytest.raises(HostError, match="Back failed: ZeroDivisionError: oops"):
        clock.answers[0].result(0.0)
    assert events[-1]["error"] == "the live session failed: ZeroDivisionError: oops"


def test_the_end_is_told_whatever_fails_at_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A model that can no longer be looked at, and a listener that fails."""
    clock, events = FakeClock([]), list[dict[str, Any]]()
    session = Session(load_scenario("kvlcc2_crossing"), clock=clock)

    def fail(*_: Any) -> None:
        raise ZeroDivisionError("oops")

    session.listen(fail)
    session.listen(events.append)
    monkeypatch.setattr(module.LiveRun, "observe_ships", fail)
    session.start()
    assert session.join(PATIENCE)
    assert events[-1]["kind"] == "end"
    assert not session.snapshot.running


def test_no_command_slips_in_behind_the_last_that_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """It comes while the session ends: between the look whether it runs and the queue."""
    session = Session(load_scenario("kvlcc2_crossing"))
    session.start()
    put = session._waiting.put_nowait

    in_vain = 0.5  # [s]: a session does not end while a command comes in

    def put_late(waiting: Any) -> None:
        put((End(), Future()))
        session.join(in_vain)
        put(waiting)

    monkeypatch.setattr(session._waiting, "put_nowait", put_late)
    with pytest.raises(InputError, match="the run has ended: start another one"):
        session.submit(Mark("late")).result(PATIENCE)
    assert session.join(PATIENCE)


def test_marks_may_be_read_while_one_is_set(monkeypatch: pytest.MonkeyPatch) -> None:
    """Another thread lists them for a page that opens; here it is interrupted after the first."""
    run = Session(load_scenario("kvlcc2_crossing")).run
    step, marked = run.step, list[str]()

    def step_and_mark(self: Any) -> float:
        if not marked:
            marked.append("meanwhile")
            monkeypatch.setattr(module.LiveRun, "step", property(lambda self: step))
            run.mark("meanwhile")
        return step

    monkeypatch.setattr(module.LiveRun, "step", property(step_and_mark))
    assert run.marks == {"start": step}
    assert list(run.marks) == ["start", "meanwhile"]
    run.close()
