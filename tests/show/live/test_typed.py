"""Speeds, directions, times and distances as an instructor types them."""

from __future__ import annotations

import pytest

from .javascript import run_javascript

KNOT = 1852.0 / 3600.0


@pytest.mark.parametrize(
    ("text", "unit", "speed"),
    [
        ("12", "kn", 12 * KNOT), ("12", "m/s", 12.0), ("12 kn", "m/s", 12 * KNOT), ("6 m/s", "kn", 6.0),
        (" 12,5KN ", "kn", 12.5 * KNOT), ("12 knots", "kn", 12 * KNOT), ("12 Knoten", "kn", 12 * KNOT),
        ("12 kts", "m/s", 12 * KNOT), ("12节", "m/s", 12 * KNOT), (".5", "m/s", 0.5), ("0", "kn", 0.0),
    ],
)  # fmt: skip
def test_speeds(text: str, unit: str, speed: float) -> None:
    found = run_javascript("live/typed.js", "parseSpeed", "return parseSpeed(...data);", [text, unit])
    assert found == pytest.approx(speed, rel=1e-12)


@pytest.mark.parametrize("text", ["", "  ", "strong", "12 km/h", "kn", "-3", "12 kn 5", "1e9x", "NaN", "1.2.3"])
def test_what_is_no_speed(text: str) -> None:
    assert run_javascript("live/typed.js", "parseSpeed", "return parseSpeed(...data);", [text, "kn"]) is None


@pytest.mark.parametrize(
    ("text", "direction"),
    [("270", 270), ("007", 7), ("360°", 360), ("12,5", 12.5), ("", None), ("-1", None), ("361", None), ("west", None)],
)
def test_directions(text: str, direction: float | None) -> None:
    assert run_javascript("live/typed.js", "parseDirection", "return parseDirection(data);", text) == direction


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("12:30", 750), ("0:05", 5), ("1:05:00", 3900), ("90:00", 5400), ("2:30.5", 150.5)]
    + [(text, None) for text in ("", "12", "12:60", "1:75:00", "-1:00", "noon", "12:3")],
)
def test_times(text: str, seconds: float | None) -> None:
    assert run_javascript("live/typed.js", "parseTime", "return parseTime(data);", text) == seconds


@pytest.mark.parametrize(
    ("text", "metres"),
    [("0.5", 926.0), ("0,5 NM", 926.0), ("900 m", 900.0), ("1.2km", 1200.0), ("1 海里", 1852.0)]
    + [(text, None) for text in ("", "near", "0", "-1", "5 ft")],
)
def test_distances(text: str, metres: float | None) -> None:
    assert run_javascript("live/typed.js", "parseRange", "return parseRange(data);", text) == metres
