"""What a live page knows of a run, and forgets when the run goes back."""

from __future__ import annotations

from typing import Any

from .javascript import run_javascript

PAGE = """
    Object.assign(globalThis, {
      location: { protocol: "http:", host: "here", search: "?token=t" }, window: { addEventListener() {} },
      WebSocket: class { close() {} }, setInterval: () => 0, requestAnimationFrame: () => 0,
    });
    let now = 0;
    Object.defineProperty(globalThis, "performance", { value: { now: () => (now += 50) } });
    const machines = { rudder: 0, rev_per_s: 0, failures: [], horn: false };
    const ship = (x) => ({ eta: [x, 0, 0, 0, 0, 0], nu: [10, 0, 0, 0, 0, 0], ...machines });
    const begun = (time) => ({ id: 1, time, ship_a: "own", ship_b: "quay" });
    const stateOf = ({ time, collisions, points }) => ({
      time, rate: 20, real_rate: 20, paced: true, paused: false, ships: { own: ship(10 * time) },
      contact: { points, collisions: collisions.map(begun) },
    });
    const heard = [];
    const session = new Session("bridge", (type, message) => heard.push([type, message.time ?? null]));
    return data.map((step) => {
      heard.length = 0;
      if (step.hello) session.listen("hello", { ships: [{ name: "own" }], own: "own", touches: [] });
      else if (step.back !== undefined) session.listen("event", { kind: "back", time: step.back });
      else if (step.begins) session.listen("event", { kind: "collision begins", ...begun(0), start: step.begins });
      else if (step.touches) session.listen("touches", { touches: step.touches.map((time) => ({ time })) });
      else session.listen("state", stateOf(step));
      const shown = session.present(now);
      return {
        alarms: session.alarms.sorted.map(({ key, state, words }) => words() && `${key} ${state}`),
        touches: session.touches.map(({ time }) => time),
        backs: heard.filter(([type]) => type === "back").map(([, time]) => time),
        shown: shown && [shown.time, shown.ships.own.eta[0]],
      };
    });
"""
HELLO = {"hello": True}


def play(*steps: dict[str, Any]) -> list[Any]:
    found: list[Any] = run_javascript("live/session.js", "Session", PAGE, [HELLO, *steps])
    return found[1:]


def state(time: float, *collisions: float, points: int = 0) -> dict[str, Any]:
    return {"time": time, "collisions": collisions, "points": points}


def test_a_short_step_back_undoes_what_was_later_though_the_next_state_is_later_still() -> None:
    """20 times as fast as time, back from 10.5 s to 10 s: the next state is that of 11 s, without the collision."""
    _, met, _, back, after = play(
        state(9.5), state(10.5, 10.25, points=2), {"touches": [9.0, 10.25]}, {"back": 10.0}, state(11.0)
    )
    assert met["alarms"] == ["contact raised"]
    assert back == {"alarms": [], "touches": [9.0], "backs": [10.0], "shown": None}
    assert after["alarms"] == []
    assert after["backs"] == []
    assert after["shown"] == [11.0, 110.0]


def test_the_same_collision_is_news_again_after_going_back() -> None:
    """And one from before the mark is none."""
    met, _, again = play(state(10.5, 10.25, points=2), {"back": 10.0}, state(11.0, 10.25))
    assert met["alarms"] == again["alarms"] == ["contact raised"]
    *_, old = play(state(10.0, 9.0, points=1), state(10.5, 9.0), {"back": 10.25}, state(11.0, 9.0))
    assert old["alarms"] == []


def test_a_collision_is_told_of_before_there_is_a_state_with_it() -> None:
    """The alarm stays, and has its words, though the next state was made before."""
    found = play(state(10.0), {"begins": 10.25}, state(10.0), state(10.5, 10.25, points=1))
    assert [step["alarms"] for step in found] == [[], *[["contact raised"]] * 3]


def test_a_step_back_that_was_not_heard_is_seen() -> None:
    """The connection was lost meanwhile."""
    *_, back = play(state(20.0, 19.0, points=1), {"touches": [5.0, 19.0]}, state(10.0))
    assert back == {"alarms": [], "touches": [5.0], "backs": [10.0], "shown": [10.0, 100.0]}


def test_a_step_back_that_was_heard_is_not_undone_twice() -> None:
    *_, after = play(state(20.0), {"back": 10.0}, state(10.1))
    assert after["backs"] == []


def test_the_latest_touches_are_kept() -> None:
    *_, after = play({"touches": list(range(400))}, {"touches": list(range(400, 700))})
    assert after["touches"] == list(range(200, 700))
