"""The replay's clock slows down around impacts by itself."""

from __future__ import annotations

from .live.javascript import run_javascript


def rates(cases: list[tuple[float, float, bool]], impacts: list[float]) -> list[float]:
    """Seconds of the run per second, for each time, speed and setting of the switch."""
    body = """return data.cases.map(([time, speed, isSlow]) =>
        Object.assign(new Clock(0, 200, data.impacts), { time, speed, isSlow }).rate);"""
    found: list[float] = run_javascript("clock.js", "Clock", body, {"cases": cases, "impacts": impacts})
    return found


def test_an_impact_passes_at_a_quarter_of_real_time_and_nothing_else_does() -> None:
    assert rates([(50.0, speed, True) for speed in (1.0, 5.0, 50.0)], [50.0]) == [0.25] * 3
    assert rates([(49.1, 1.0, True), (52.4, 1.0, True)], [50.0]) == [0.25] * 2
    assert rates([(40.0, 5.0, True), (60.0, 5.0, True), (50.0, 5.0, False)], [50.0]) == [5.0] * 3
    assert rates([(50.0, 2.0, True)], []) == [2.0]
    assert rates([(50.0, 0.1, True)], [50.0]) == [0.1]  # already slower


def test_the_rate_changes_without_a_jump() -> None:
    times = [45.0 + 0.01 * i for i in range(1500)]
    found = rates([(time, 1.0, True) for time in times], [50.0])
    assert max(abs(a - b) for a, b in zip(found[1:], found[:-1], strict=True)) < 0.05
    assert (min(found), max(found)) == (0.25, 1.0)


def test_a_fast_replay_does_not_pass_an_impact_between_two_pictures() -> None:
    """At 50 times real time a picture in 100 ms covers 5 s of the run, which hold the whole impact."""
    body = """const clock = Object.assign(new Clock(0, 200, [50]), { time: 46, speed: 50 });
        clock.advance(0.1);
        return clock.time;"""
    assert 48.0 < run_javascript("clock.js", "Clock", body, {}) < 50.0
