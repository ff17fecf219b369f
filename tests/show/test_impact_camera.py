"""The view of an impact: its place lies where nothing covers the picture, and no hull stands before it."""

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

OVER = """
    const [x, y] = replay.project(arguments[0]);
    const at = document.getElementById("picture").getBoundingClientRect();
    return document.elementFromPoint(x + at.left, y + at.top)?.id ?? null;
"""


def find_free(width: float, height: float, *covers: tuple[float, float, float, float]) -> tuple[float, ...]:
    given = [dict(zip(("left", "top", "right", "bottom"), cover, strict=True)) for cover in covers]
    found: dict[str, float] = run_javascript(
        "free_rectangle.js", "findFreeRectangle", "return findFreeRectangle(data.width, data.height, data.covers);",
        {"width": width, "height": height, "covers": given},
    )  # fmt: skip
    return (found["left"], found["top"], found["right"], found["bottom"])


@pytest.mark.parametrize(
    ("covers", "free"),
    [
        ((), (0, 0, 800, 600)),
        (((0, 0, 300, 100), (0, 500, 800, 600)), (0, 100, 800, 500)),  # card and bar: what is between them
        (((0, 0, 200, 400), (0, 500, 800, 600)), (200, 0, 800, 500)),  # a high card: what is beside it
        (((0, -60, 800, -8), (0, 608, 800, 700)), (0, 0, 800, 600)),  # nothing over the picture, as on a phone
        (((-8, -8, 808, 608),), (0, 0, 800, 600)),  # all covered: the picture
    ],
)
def test_the_free_part_is_the_largest_rectangle_that_nothing_touches(
    covers: tuple[tuple[float, float, float, float], ...], free: tuple[float, ...]
) -> None:
    assert find_free(800, 600, *covers) == free


@pytest.mark.parametrize(
    ("size", "wishes"),
    [
        pytest.param((1280, 720), "", id="desktop"),
        pytest.param((500, 900), "", id="upright"),
        pytest.param((1280, 600), "bare", id="bare"),
        pytest.param((1280, 480), "", id="low", marks=pytest.mark.slow),
        pytest.param((920, 560), "", id="small", marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("later", [0.0, 1.5])
def test_the_place_of_an_impact_is_not_covered(
    browser: Chrome, guan2014: Path, size: tuple[int, int], wishes: str, later: float
) -> None:
    write_page(guan2014)
    scene = load_scene(guan2014)
    effect = next(effect for effect in scene.effects if effect.kind == "dust")
    browser.get("about:blank")
    page = Page(browser, guan2014 / "replay.html", wishes, size)
    drawn: dict[str, Any] = page.slide(effect.time + later)
    page.run("replay.camera('impact')")
    drawn = page.run("return replay.drawn()")
    pose = drawn["poses"][effect.ship]
    place = pose["position"] + rotation_from_quaternion(pose["quaternion"]) @ effect.point
    height = -float(scene.ship(effect.ship).hull.vertices[:, 2].min())
    for up in (0.1, 0.5, 1.0):  # from the water to the deck
        assert page.run(OVER, [float(place[0]), float(place[1]), -up * height]) == "picture"
    assert drawn["hidden"] == 0
    eye = drawn["eye"]
    assert 2.0 <= -eye[2] <= 0.5 * float(((place - eye)[:2] ** 2).sum() ** 0.5)  # low, above the water


def test_the_camera_comes_to_the_wound_once_the_impact_is_over(browser: Chrome, kvlcc2_crossing: Path) -> None:
    """By itself while time goes on, 6 s after: the opening takes up a sixth of the picture, and no hull hides it."""
    scene = load_scene(kvlcc2_crossing)
    opening = next(dent for dent in scene.dents if dent.kind == "side")
    page = Page(browser, write_page(kvlcc2_crossing), "plain=yes&bare", (900, 560))
    page.slide(opening.time + 0.5)
    page.run("replay.camera('impact')")
    widths = []
    for later in (5.5, 6.5):
        drawn = page.slide(opening.time + later)
        pose = drawn["poses"][opening.ship]
        R = rotation_from_quaternion(pose["quaternion"])
        ends = [[opening.point[0] + side * opening.half_width, opening.point[1], 0.0] for side in (-1, 1)]
        x = [page.run("return replay.project(arguments[0])", (pose["position"] + R @ end).tolist())[0] for end in ends]
        widths.append(abs(x[1] - x[0]) / 900)
        assert drawn["hidden"] == 0
    assert widths[1] > max(1 / 6, 1.3 * widths[0])
