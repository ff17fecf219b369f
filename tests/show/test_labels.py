"""Names on the page: titles that people read, labels that do not overlap, and a slider that stays where it is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.ship.frames import rotation_from_quaternion
from shipcollision_fmu.show.page import write_page
from shipcollision_fmu.show.scene.scene import load_scene

from .browser import Page
from .live.javascript import run_javascript

ROOM = {"left": 0.0, "top": 0.0, "right": 400.0, "bottom": 300.0}


@pytest.mark.parametrize(
    ("name", "title"),
    [
        ("t_bone_90", "T-bone 90"),
        ("kvlcc2_crossing", "KVLCC2 crossing"),
        ("guan2014", "Guan 2014"),
        ("head_on", "Head on"),
        ("Rotterdam, 3 May", "Rotterdam, 3 May"),
        ("<b>_x", "<b>_x"),
    ],
)
def test_a_name_becomes_a_title(name: str, title: str) -> None:
    assert run_javascript("readable.js", "readTitle", "return readTitle(data);", name) == title


@pytest.mark.parametrize(
    ("model", "kind", "said"),
    [
        ("Ferry", "ferry", "Ferry"),
        ("Container", "container ship", "Container ship"),
        ("Bulker", "bulk carrier", "Bulk carrier"),
        ("Frigate", "naval ship", "Frigate, naval ship"),
        ("KVLCC2 tanker", "tanker", "KVLCC2 tanker"),
        ("", "barge", "Barge"),
    ],
)
def test_no_word_is_said_twice(model: str, kind: str, said: str) -> None:
    assert run_javascript("readable.js", "readKind", "return readKind(...data);", [model, kind]) == said


def place_labels(*labels: tuple[float, float, float]) -> list[list[float]]:
    """Places of labels of 20 px height, from their x, y and width."""
    given = [{"place": [x, y], "size": [width, 20.0]} for x, y, width in labels]
    found: list[list[float]] = run_javascript(
        "move_apart.js", "moveApart", "return moveApart(data.labels, data.room);", {"labels": given, "room": ROOM}
    )
    return found


def test_labels_that_overlap_move_apart_by_the_same() -> None:
    (a, _), (b, _) = place_labels((200.0, 100.0, 60.0), (210.0, 105.0, 80.0))
    assert b - a >= 70.0
    assert (a + b) / 2 == pytest.approx(205.0, abs=4.0)


def test_labels_apart_stay_where_they_are() -> None:
    assert place_labels((100.0, 100.0, 60.0), (200.0, 100.0, 60.0)) == [[100.0, 100.0], [200.0, 100.0]]
    assert place_labels((100.0, 100.0, 60.0), (100.0, 150.0, 60.0)) == [[100.0, 100.0], [100.0, 150.0]]


def test_labels_stay_in_the_room_and_apart() -> None:
    (a, y), (b, _) = place_labels((395.0, 5.0, 60.0), (398.0, 5.0, 60.0))
    assert b <= 370.0
    assert b - a >= 60.0
    assert y >= 20.0


@pytest.mark.parametrize("size", [(1280, 720), (500, 900)], ids=["desktop", "upright"])
def test_the_slider_stays_where_it_is_in_slow_motion(browser: Chrome, guan2014: Path, size: tuple[int, int]) -> None:
    write_page(guan2014)
    scene = load_scene(guan2014)
    browser.get("about:blank")
    page = Page(browser, guan2014 / "replay.html", "", size)
    where = """
        const boxes = ["time", "now", "camera"].map((id) => document.getElementById(id).getBoundingClientRect());
        return boxes.flatMap(({ left, top, width, height }) => [left, top, width, height]);
    """

    def seen(at: float) -> tuple[Any, bool]:
        page.slide(at)
        return page.run(where), page.run("return document.querySelector('.rate').textContent") != ""

    page.run("replay.slow(false)")
    usual, has_rate = seen(scene.events[0].time)
    assert not has_rate
    page.run("replay.slow(true)")
    slow, has_rate = seen(scene.events[0].time)
    assert has_rate
    assert slow == usual


def test_every_ship_in_the_picture_has_its_name_over_it(browser: Chrome, guan2014: Path) -> None:
    """Between where its ends are in the picture, or beside another label."""
    write_page(guan2014)
    scene = load_scene(guan2014)
    browser.get("about:blank")
    page = Page(browser, guan2014 / "replay.html", "camera=all", (1280, 720))
    poses = page.slide(0.0)["poses"]
    labels = page.run("""
        return [...document.querySelectorAll(".label")].map((label) => {
          const { left, right, bottom } = label.getBoundingClientRect();
          return { hidden: label.hidden, name: label.textContent, x: (left + right) / 2, width: right - left, bottom };
        });
    """)
    assert [(label["name"], label["hidden"]) for label in labels] == [(ship.name, False) for ship in scene.ships]
    for ship, label in zip(scene.ships, labels, strict=True):
        R = rotation_from_quaternion(poses[ship.name]["quaternion"])
        ends = [poses[ship.name]["position"] + R @ [along * ship.L_oa, 0.0, 0.0] for along in (-0.5, 0.5)]
        (a, y), (b, _) = (page.run("return replay.project(arguments[0])", end.tolist()) for end in ends)
        assert min(a, b) - label["width"] < label["x"] < max(a, b) + label["width"]
        assert abs(label["x"] - (a + b) / 2) < 0.3 * abs(a - b) + label["width"]
        assert label["bottom"] < y
