"""A picture that is drawn too slowly while the run plays gets fewer pixels, and more again once there is time."""

from __future__ import annotations

import pytest

from .live.javascript import run_javascript

LEAST = 0.35


def shares(took: list[float], is_playing: bool = True) -> list[float]:
    """Shares of the pixels in each direction after pictures that took so long [ms]."""
    body = """const pace = makePace();
        let now = 0;
        pace.setPlaying(data.isPlaying);
        pace.next(now);
        return data.took.map((ms) => (pace.next(now += ms), pace.share));"""
    found: list[float] = run_javascript("pace.js", "makePace", body, {"took": took, "isPlaying": is_playing})
    return found


def test_slow_pictures_get_fewer_pixels_while_the_run_plays_and_all_at_rest() -> None:
    assert shares([20.0] * 50) == [1.0] * 50
    assert shares([20.0, 60.0, 60.0] * 20) == [1.0] * 60  # never three slow ones together
    slow = shares([60.0] * 30)
    assert slow[:2] == [1.0, 1.0]
    assert slow[2] < 0.75  # twice as slow as wanted: half of the pixels
    assert sorted(slow, reverse=True) == slow
    assert slow[-1] == pytest.approx(LEAST)
    assert shares([60.0] * 30, is_playing=False) == [1.0] * 30


@pytest.mark.parametrize("took", [200.0, 1200.0, 2000.0, 5000.0])
def test_pictures_of_seconds_are_no_pauses_and_get_fewer_pixels_at_once(took: float) -> None:
    """Ten pictures at most, as nobody waits for more, and fewer pixels from the second on."""
    found = shares([took] * 10)
    assert found[1] == pytest.approx(0.5)
    assert found[3] == pytest.approx(LEAST)


@pytest.mark.parametrize("pause", [300.0, 2000.0, 3.6e6])
def test_one_long_picture_is_an_accident(pause: float) -> None:
    """The page was hidden, or the machine asleep."""
    assert shares([17.0] * 20 + [pause] + [17.0] * 20) == [1.0] * 41
    assert shares([17.0, pause, 40.0, 17.0] * 5) == [1.0] * 20  # what comes after a pause is a little slow, too


def test_quick_pictures_get_their_pixels_back() -> None:
    found = shares([60.0] * 30 + [17.0] * 600)
    assert found[29] == pytest.approx(LEAST)
    assert sorted(found[30:]) == found[30:]
    assert found[-1] == 1.0


def test_pictures_in_time_with_none_to_spare_keep_their_pixels() -> None:
    found = shares([60.0] * 3 + [30.0] * 500)
    assert len(set(found[2:])) == 1
    assert found[2] < 1.0


def test_pixels_for_which_there_is_no_time_are_tried_ever_more_rarely() -> None:
    """A machine for which 0.6 of the pixels are quick and more are slow: how often it is asked for more."""
    body = """const pace = makePace();
        pace.setPlaying(true);
        let now = 0, before = 1;
        const raised = [];
        for (let i = 0; i < 6000; i++) {
            pace.next(now += pace.share > 0.6 ? 60 : 17);
            if (pace.share > before) raised.push(i);
            before = pace.share;
        }
        return raised;"""
    raised = run_javascript("pace.js", "makePace", body, {})
    first, second = (sum(start <= i < start + 3000 for i in raised) for start in (0, 3000))
    assert 0 < second < 0.5 * first


def test_at_rest_the_picture_is_sharp_again() -> None:
    body = """const pace = makePace();
        pace.setPlaying(true);
        for (let i = 0; i < 30; i++) pace.next(60 * i);
        const played = pace.share;
        return [played, pace.setPlaying(false), pace.share, pace.setPlaying(false)];"""
    assert run_javascript("pace.js", "makePace", body, {}) == [pytest.approx(LEAST), True, 1.0, False]


def test_the_time_at_rest_is_no_slow_picture() -> None:
    body = """const pace = makePace();
        let now = 0;
        const shares = [];
        for (let i = 0; i < 10; i++) {
            pace.setPlaying(true);
            pace.next(now += 17);
            pace.setPlaying(false);
            pace.next(now += 5000);
            shares.push(pace.share);
        }
        return shares;"""
    assert run_javascript("pace.js", "makePace", body, {}) == [1.0] * 10
