"""Where bodies have touched, as a page that is opened later hears of it."""

from __future__ import annotations

from math import atan2, pi

import pytest

from shipcollision_fmu import load_scenario
from shipcollision_fmu.live.session import touch_log
from shipcollision_fmu.live.session.live_run import LiveRun
from shipcollision_fmu.live.session.snapshot import TouchSnapshot
from shipcollision_fmu.live.session.touch_log import TouchLog
from tests.conftest import Write


def touch(x: float, other: str = "target") -> TouchSnapshot:
    return TouchSnapshot("own", other, (x, 0.0, 0.0), (0.0, x, 0.0), (0.0, 1.0, 0.0))


def keep(body: str, vector: tuple[float, float, float]) -> tuple[float, float, float]:
    return vector


def test_a_place_is_kept_once_with_its_first_time() -> None:
    log = TouchLog()
    log.add(1.0, [touch(0.0), touch(10.0)], keep)
    log.add(2.0, [touch(0.01), touch(10.0), touch(10.0, "quay")], keep)
    log.add(3.0, [touch(5.0)], keep)
    assert [(one.time, one.touch.ship_b, one.touch.a[0]) for one in log.touches] == [
        (1.0, "target", 0.0), (1.0, "target", 10.0), (2.0, "quay", 10.0), (3.0, "target", 5.0),
    ]  # fmt: skip
    log.restore(log.touches[:3])
    assert [one.time for one in log.touches] == [1.0, 1.0, 2.0]
    log.add(4.0, [touch(5.0), touch(0.0)], keep)
    assert [one.time for one in log.touches] == [1.0, 1.0, 2.0, 4.0]


def test_the_latest_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(touch_log, "MOST_TOUCHES", 4)
    log = TouchLog()
    for k in range(10):
        log.add(float(k), [touch(float(k))], keep)
    assert [one.time for one in log.touches] == [6.0, 7.0, 8.0, 9.0]


def test_touches_are_those_of_the_run_and_go_with_what_is_forgotten(scenario_file: Write) -> None:
    run = LiveRun(load_scenario(scenario_file(("duration = 3.0", "duration = 30.0"))))
    run.mark("before")
    seen: set[tuple[float, ...]] = set()
    turned: dict[tuple[float, ...], tuple[float, float]] = {}
    while run.time < 3.0:
        run.advance()
        for one in run.observe_contact().touching:
            seen.add(one.a)
            headings = (run.observe_ships()[ship].eta[5] for ship in (one.ship_a, one.ship_b))
            turned.setdefault((run.time, *one.a), tuple(atan2(one.normal[1], one.normal[0]) - yaw for yaw in headings))
    kept = run.touch_log.touches
    assert kept
    assert {one.touch.a for one in kept} <= seen
    assert all(min(abs(a[0] - one.touch.a[0]) for one in kept) <= touch_log.APART for a in seen)
    for one in kept:  # of a ship that heels little, in plan
        for normal, angle in zip((one.normal_a, one.normal_b), turned[(one.time, *one.touch.a)], strict=True):
            assert abs((atan2(normal[1], normal[0]) - angle + pi) % (2 * pi) - pi) < 0.01
    run.go_back("before")
    assert run.touch_log.touches == ()
    run.close()


def test_going_back_restores_what_the_limit_has_pushed_out(
    scenario_file: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(touch_log, "MOST_TOUCHES", 1)
    run = LiveRun(load_scenario(scenario_file(("duration = 3.0", "duration = 30.0"))))
    while not run.touch_log.touches and run.time < 3.0:
        run.advance()
    run.mark("full")
    kept = run.touch_log.touches
    while kept == run.touch_log.touches and run.time < 3.0:
        run.advance()
    assert run.touch_log.touches[0].time > kept[0].time
    run.go_back("full")
    assert run.touch_log.touches == kept
    run.close()
