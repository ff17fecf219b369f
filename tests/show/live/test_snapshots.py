"""What the live page shows between two states, and where a ship's track leads."""

from __future__ import annotations

from typing import Any

import pytest

from .javascript import run_javascript

BODY = """
const snapshots = new Snapshots();
const ship = (x) => ({ eta: [x, 0, 0, 0, 0, 0], nu: [1, 0, 0, 0, 0, 0], rudder: 0, rev_per_s: 0 });
const out = [];
for (const [what, wall, time, x] of data) {
  if (what === "push") out.push(snapshots.push({ time, ships: { own: ship(x) } }, wall));
  else { const s = snapshots.at(wall); out.push(s && [s.time, s.ships.own.eta[0]]); }
}
return out;
"""


def play(*events: tuple[Any, ...]) -> list[Any]:
    found: list[Any] = run_javascript("live/snapshots.js", "Snapshots", BODY, [list(event) for event in events])
    return found


def test_the_picture_is_one_interval_late_and_linear_between() -> None:
    """States every 50 ms of the wall clock: the newest is reached when the next is due, and then held."""
    first, _, at_once, half, due, later = play(
        ("push", 0.0, 10.0, 100.0),
        ("push", 50.0, 10.05, 100.5),
        ("at", 50.0),
        ("at", 75.0),
        ("at", 100.0),
        ("at", 400.0),
    )
    assert first is False
    assert at_once == pytest.approx([10.0, 100.0])
    assert half == pytest.approx([10.025, 100.25])
    assert due == later == pytest.approx([10.05, 100.5])


def test_before_the_first_state_there_is_nothing() -> None:
    assert play(("at", 5.0)) == [None]


@pytest.mark.parametrize("jump", [1.0, 0.0])
def test_faster_and_paused_are_linear_as_well(jump: float) -> None:
    """At 20 times real time a state is a second later; while paused it is the same."""
    *_, half, due = play(("push", 0.0, 10.0, 0.0), ("push", 50.0, 10.0 + jump, 5.0 * jump), ("at", 75.0), ("at", 100.0))
    assert half == pytest.approx([10.0 + 0.5 * jump, 2.5 * jump])
    assert due == pytest.approx([10.0 + jump, 5.0 * jump])


def test_going_back_to_a_mark_is_shown_at_once() -> None:
    *_, is_back, at_once, is_back_again, half = play(
        ("push", 0.0, 99.0, 500.0),
        ("push", 50.0, 10.0, 100.0),
        ("at", 51.0),
        ("push", 100.0, 10.05, 101.0),
        ("at", 125.0),
    )
    assert is_back is True
    assert at_once == pytest.approx([10.0, 100.0])
    assert is_back_again is False
    assert half == pytest.approx([10.025, 100.5])


def test_after_a_gap_ships_do_not_crawl() -> None:
    """A minute without states counts as half a second at most."""
    shown = play(("push", 0.0, 1.0, 0.0), ("push", 60_000.0, 61.0, 60.0), ("at", 60_500.0))[-1]
    assert shown == pytest.approx([61.0, 60.0])


TRACK = """
const history = new History();
for (const [time, x] of data.pushed) {
  if (x === null) history.goBack(time);
  else history.push(time, [x, 0, 0, 0, 0, 0], [2, 0, 0, 0, 0, 0]);
}
return { at: data.times.map((time) => history.at(time)[0]), count: history.places.length };
"""


def test_a_track_is_linear_straight_before_and_forgets_what_was_undone() -> None:
    """A ship at 2 m/s from time 10; seen at 20, then back at 15 and from there at 4 m/s."""
    pushed = [(10.0 + 0.1 * k, 2.0 * 0.1 * k) for k in range(101)] + [(15.0, 10.0), (16.0, 14.0)]
    found = run_javascript(
        "live/history.js", "History", TRACK, {"pushed": pushed, "times": [5.0, 12.25, 15.5, 16.0, 99.0]}
    )
    assert found["at"] == pytest.approx([-10.0, 4.5, 12.0, 14.0, 14.0])
    assert found["count"] < 20


def test_a_track_forgets_what_was_undone_though_the_next_state_is_later() -> None:
    """At 2 m/s from time 10 to 20, back to 15, the next state is that of 21; back to what is to come does nothing."""
    pushed = [*((10.0 + k, 2.0 * k) for k in range(11)), (15.0, None), (21.0, 40.0), (30.0, None)]
    found = run_javascript(
        "live/history.js", "History", TRACK, {"pushed": pushed, "times": [12.5, 15.0, 18.0, 21.0, 99.0]}
    )
    assert found["at"] == pytest.approx([5.0, 10.0, 25.0, 40.0, 40.0])


def test_a_track_of_which_all_was_undone_begins_again() -> None:
    found = run_javascript(
        "live/history.js", "History", TRACK,
        {"pushed": [(10.0, 0.0), (11.0, 2.0), (5.0, None)], "times": [4.0, 5.0, 99.0]},
    )  # fmt: skip
    assert found["at"] == pytest.approx([-12.0, -10.0, -10.0])
    assert found["count"] == 1
