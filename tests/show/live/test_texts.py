"""The table of texts: complete in each language, and every text is used."""

from __future__ import annotations

import re
from typing import Any

import pytest

from .javascript import SOURCES, run_javascript

MADE = {"telegraph", "alarm", "camera", "fail", "log", "key", "sky"}
"""Beginnings of keys that the sources put together from a name."""


@pytest.fixture(scope="module")
def texts() -> dict[str, list[str]]:
    """What the live pages say, and what all pages say."""
    found: dict[str, list[str]] = run_javascript("texts.js", "TEXTS", "return TEXTS;")
    return found


@pytest.fixture(scope="module")
def replay() -> dict[str, list[str]]:
    """What the replay page alone says."""
    found: dict[str, list[str]] = run_javascript("texts_replay.js", "REPLAY", "return REPLAY;")
    return found


def test_every_text_is_there_in_four_languages_with_the_same_places(
    texts: dict[str, list[str]], replay: dict[str, list[str]]
) -> None:
    assert len(texts) > 100
    assert len(replay) > 40
    assert set(texts) & set(replay) == set()
    for key, languages in [*texts.items(), *replay.items()]:
        assert len(languages) == 4, key
        assert all(languages), key
        assert len({tuple(sorted(re.findall(r"\{(\w+)\}", text))) for text in languages}) == 1, key


def test_texts_and_sources_name_each_other(texts: dict[str, list[str]]) -> None:
    source = "\n".join(path.read_text(encoding="utf-8") for path in (SOURCES / "live").glob("*.js"))
    shared = "\n".join(path.read_text(encoding="utf-8") for path in SOURCES.glob("*.js") if "texts" not in path.name)
    quoted = set(re.findall(r'["`]([a-z_0-9]+)["`]', source + shared))
    unused = {key for key in texts if key not in quoted and key.partition("_")[0] not in MADE}
    assert unused == set()
    asked = set(re.findall(r'(?:say|textButton|labelled)\("(\w+)"', source))
    asked |= set(re.findall(r'(?:text|title|placeholder|"aria-label"): "(\w+)"', source))
    assert asked - set(texts) == set()


def test_the_replay_page_and_its_texts_name_each_other(
    texts: dict[str, list[str]], replay: dict[str, list[str]]
) -> None:
    source = "\n".join(path.read_text(encoding="utf-8") for path in SOURCES.glob("*.js") if "texts" not in path.name)
    quoted = set(re.findall(r'"([a-z_0-9]+)"', source))
    assert set(replay) - quoted == set()
    asked = set(re.findall(r'(?:say|button|section)\("(\w+)"', source))
    asked |= set(re.findall(r'(?:text|title|"aria-label"): "(\w{2,})"', source))
    assert asked - set(texts) - set(replay) == set()


def test_terms_are_those_of_mariners(texts: dict[str, list[str]], replay: dict[str, list[str]]) -> None:
    """Heading and course are two things, and so are a chart that is head up and one that is course up; a ship goes
    astern, it is not aft; 前进四 to 前进一 and the like stand on telegraphs."""
    assert texts["head_up"] == ["Head up", "Voraus oben", "Forut opp", "艏向上"]
    assert [replay["heading"][3], texts["heading_short"][3], texts["cog"][3]] == ["艏向", "艏向", "对地航向"]
    for position, chinese in zip(range(1, 5), "一二三四", strict=True):
        assert texts[f"telegraph_{position}"][3] == f"前进{chinese}"
        assert texts[f"telegraph_-{position}"][3] == f"后退{chinese}"
        assert texts[f"telegraph_{position}"][2].endswith(" forover")
        assert texts[f"telegraph_-{position}"][2].endswith(" akterover")
    for side, words in (("port", ("Backbord", "Babord")), ("starboard", ("Steuerbord", "Styrbord"))):
        assert texts[f"{side}_value"][1:3] == [f"{word} {{value}}°" for word in words]


@pytest.mark.parametrize(("language", "said"), [("en", "Stop"), ("de", "Stopp"), ("nb", "Stopp"), ("zh", "停车")])
def test_a_language_is_chosen(language: str, said: str) -> None:
    body = "globalThis.document = { documentElement: {} }; setLanguage(data); return [say('telegraph_0'), language()];"
    assert run_javascript("texts.js", "say, setLanguage, language", body, language) == [said, language]


def test_values_come_into_their_places() -> None:
    found: Any = run_javascript("texts.js", "say", "return say('go_back', { name: 'A', time: '1:00' });")
    assert found == "Go back to A, 1:00"
