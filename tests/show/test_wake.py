"""The wake along a ship's track: numbers of the page's module, for tracks given by hand."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from .live.javascript import run_javascript

SHIP = {"L": 120.0, "B": 20.0, "aft": -58.0, "fore": 57.0}
STRAIGHT = "[7 * t, 0, 1, 0]"
STOPPED = "[0, 0, 1, 0]"
ASTERN = "[-3 * t, 0, 1, 0]"
SIDEWAYS = "[0, 3 * t, 1, 0]"
STOPS = "[7 * Math.min(t, 60), 0, 1, 0]"
"""At 60 s: at once, as in a collision."""
TURNS = "[350 * Math.sin(0.02 * t), 350 * (1 - Math.cos(0.02 * t)), Math.cos(0.02 * t), Math.sin(0.02 * t)]"
"""7 m/s on a circle of 350 m to starboard."""
TRACKS = (STRAIGHT, STOPPED, ASTERN, SIDEWAYS, STOPS, TURNS)


def wake(track: str, *times: float) -> list[list[dict[str, Any]]]:
    """Sections at some times, newest first, with what is left there; `track`: pose over t [s], in JavaScript."""
    body = f"""
    const poseAt = (t) => {track};
    return data.times.map((time) => followTrack(poseAt, time, data.ship).map((section) => {{
      const [thrown, waves] = thrownAt(section, data.ship);
      return {{ ...section, churned: churnedAt(section, data.ship), thrown, waves }};
    }}));
    """
    found: list[list[dict[str, Any]]] = run_javascript(
        "track_wake.js", "followTrack, churnedAt, thrownAt", body, {"times": times, "ship": SHIP}
    )
    return found


def strengths(section: dict[str, Any]) -> list[float]:
    """How white and green the water abaft the stern, the foam of the bow and its waves are."""
    return [section["churned"]["white"], section["churned"]["green"], *section["thrown"][2:], *section["waves"][2:]]


@pytest.mark.parametrize("track", [STOPPED, ASTERN, SIDEWAYS])
def test_a_ship_that_does_not_go_ahead_leaves_no_wake(track: str) -> None:
    for section in wake(track, 100.0)[0]:
        assert not any(strengths(section))


def test_the_wake_lies_where_the_stern_was_and_nowhere_else() -> None:
    for track, heading in ((STRAIGHT, 0.0), (TURNS, 0.02)):
        for section in wake(track, 150.0)[0]:
            t = 150.0 - section["age"]
            pose = [7.0 * t, 0.0] if not heading else [350 * np.sin(0.02 * t), 350 * (1 - np.cos(0.02 * t))]
            ahead = np.array([np.cos(heading * t), np.sin(heading * t)])
            assert section["ahead"] == pytest.approx(ahead.tolist())
            assert section["stern"] == pytest.approx((pose + SHIP["aft"] * ahead).tolist())
            assert section["bow"] == pytest.approx((pose + SHIP["fore"] * ahead).tolist())


def test_on_a_straight_course_the_wake_widens_and_fades_with_age() -> None:
    sections = wake(STRAIGHT, 300.0)[0]
    ages = [section["age"] for section in sections]
    assert ages[0] == 0.0
    assert ages[-1] >= 240.0
    assert np.all(np.diff(ages) > 0.0)
    for key in ("white", "green"):
        strength = [section["churned"][key] for section in sections]
        assert np.all(np.diff(strength) < 0.0)
        assert strength[0] > 0.8
        assert strength[-1] < 0.01
    assert np.all(np.diff([section["churned"]["half"] for section in sections]) > 0.0)
    for part in ("thrown", "waves"):
        assert np.all(np.diff([section[part][0] for section in sections]) > 0.0)
        white = np.array([section[part][2] for section in sections])
        top = int(white.argmax())
        assert sections[top]["run"] < 0.6 * SHIP["L"]
        assert np.all(np.diff(white[top:]) <= 0.0)
        assert white[0] == 0.0
        assert white[-1] < 0.01
    far = sections[-1]
    assert far["waves"][0] / far["run"] == pytest.approx(np.tan(np.arcsin(1.0 / 3.0)), rel=0.02)  # Kelvin's 19.47 deg


def test_a_faster_ship_leaves_more() -> None:
    by_speed = [wake(f"[{speed} * t, 0, 1, 0]", 100.0)[0] for speed in (0.3, 1.5, 3.0, 5.0, 7.0)]
    fresh = [sections[0]["churned"]["white"] for sections in by_speed]
    assert fresh[0] == 0.0
    assert np.all(np.diff(fresh) > 0.0)
    thrown = [max(section["thrown"][2] for section in sections) for sections in by_speed]
    assert thrown[1] == 0.0
    assert np.all(np.diff(thrown) >= 0.0)
    assert thrown[-1] > 0.2


@pytest.mark.parametrize("track", TRACKS)
def test_the_wake_has_no_gaps_and_no_edges(track: str) -> None:
    """From section to section it goes on by what was sailed, and its strength does not jump, even in a collision."""
    for sections in wake(track, 62.3, 75.0):
        for new, old in pairwise(sections):
            apart = old["age"] - new["age"]
            assert 0.0 < apart <= 14.0
            assert np.hypot(*np.subtract(new["stern"], old["stern"])) <= 9.0 * apart
            assert np.abs(np.subtract(strengths(new)[:2], strengths(old)[:2])).max() <= 0.08 * apart


def test_a_ship_that_has_stopped_has_an_old_wake_which_fades_and_no_new_one() -> None:
    late, later = wake(STOPS, 150.0, 200.0)
    assert not any(strengths(late[0]))
    assert late[0]["stern"] == late[8]["stern"]
    assert max(strengths(later[-1])) < max(s for section in late for s in strengths(section))
    whitest = [max(section["churned"]["white"] for section in sections) for sections in (late, later)]
    assert whitest[0] > 0.05
    assert whitest[1] < 0.5 * whitest[0]


@pytest.mark.parametrize("track", TRACKS)
def test_sections_stay_where_they_were_left_while_time_passes_and_return_when_it_goes_back(track: str) -> None:
    first, later, again = wake(track, 80.2, 83.7, 80.2)
    assert first == again
    places = {round(83.7 - section["age"], 6): section["stern"] for section in later}
    stay = [section for section in first[1:] if round(80.2 - section["age"], 6) in places and section["age"] < 56.0]
    assert len(stay) > 20
    for section in stay:
        assert places[round(80.2 - section["age"], 6)] == section["stern"]


def test_there_is_room_for_all_sections() -> None:
    counts = run_javascript(
        "track_wake.js",
        "sectionTimes, MOST",
        "return [MOST, Math.max(...data.map((t) => sectionTimes(t).length))]",
        np.linspace(-10.0, 400.0, 4001).tolist(),
    )
    assert counts[1] <= counts[0]
