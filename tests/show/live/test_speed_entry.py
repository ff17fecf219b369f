"""Wind and current as an instructor types them."""

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
    found = run_javascript("live/speed_entry.js", "parseSpeed", "return parseSpeed(...data);", [text, unit])
    assert found == pytest.approx(speed, rel=1e-12)


@pytest.mark.parametrize("text", ["", "  ", "strong", "12 km/h", "kn", "-3", "12 kn 5", "1e9x", "NaN", "1.2.3"])
def test_what_is_no_speed(text: str) -> None:
    assert run_javascript("live/speed_entry.js", "parseSpeed", "return parseSpeed(...data);", [text, "kn"]) is None


@pytest.mark.parametrize(
    ("text", "direction"),
    [("270", 270), ("007", 7), ("360°", 360), ("12,5", 12.5), ("", None), ("-1", None), ("361", None), ("west", None)],
)
def test_directions(text: str, direction: float | None) -> None:
    assert run_javascript("live/speed_entry.js", "parseDirection", "return parseDirection(data);", text) == direction
