"""The guide lists the keys that the page's own card lists."""

from __future__ import annotations

import re
from pathlib import Path

from .javascript import run_javascript

GUIDE = Path(__file__).parents[3] / "docs" / "guide" / "bridge.md"


def test_the_guide_has_the_keys_of_the_card() -> None:
    card = run_javascript("live/live_keys.js", "CARD", "return CARD;")
    texts = run_javascript("texts.js", "TEXTS", "return TEXTS;")
    listed = GUIDE.read_text(encoding="utf-8").split("| key | meaning |\n|---|---|\n")[1].split("\n\n")[0]
    rows = re.findall(r"^\| (.+?) \| (.+?) \|$", listed, re.M)
    assert rows == [(keys, texts[what][0]) for keys, what in card]
