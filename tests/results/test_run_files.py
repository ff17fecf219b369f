"""Texts of a run's files give back their values."""

from __future__ import annotations

import json

from shipcollision_fmu.results.run_text import json_text


def test_json_keeps_its_values_when_lists_go_on_one_line() -> None:
    nested = [["x, y [ z ]", "p\nq"], [], [[1.0, 2.0]], {"d": [None, True]}]
    data = {"a [ b": [1.5, -0.1, 3], "c": nested, "e": "[\n1,\n 2 ]"}
    text = json_text(data)
    assert json.loads(text) == data
    assert "[1.5, -0.1, 3]" in text
    assert "[null, true]" in text
