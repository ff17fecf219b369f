"""replay.html on a phone, by keyboard and screen reader, in four languages; its curves and its track plot."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from math import cos, degrees, hypot, sin
from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.show.page import write_page

from .browser import Page
from .conftest import MakeRun
from .live.javascript import run_javascript

pytestmark = pytest.mark.needs("pybullet")
LANGUAGES = ("en", "de", "nb", "zh")
PHONE = {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True}
SIZE = (920, 400)
"""Of the window [pixels]: drawing takes long without a graphics card."""
TARGET = 44
"""[CSS pixels] Least side of what a finger has to meet: WCAG 2.1, success criterion 2.5.5."""
CONTROLS = "[...document.querySelectorAll('button, select, input, a')].filter((node) => node.offsetParent)"
BEYOND = """
    return [...document.querySelectorAll("body *")].filter((node) => !node.closest(".labels, .sr-only"))
      .filter((node) => node.getBoundingClientRect().right > innerWidth + 0.5)
      .map((node) => node.outerHTML.slice(0, 80));
"""
SMALL = f"""
    return {CONTROLS}.map((node) => [node.outerHTML.slice(0, 80), node.getBoundingClientRect()])
      .filter(([, {{ width, height }}]) => width < {TARGET} || height < {TARGET});
"""
SAID = """
    const said = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
      const { parentElement: node } = walker.currentNode;
      if (!node.closest("script, kbd, #language")) said.push(walker.currentNode.textContent);
    }
    for (const node of document.querySelectorAll("[aria-label], [title]")) {
      said.push(node.getAttribute("aria-label") ?? "", node.getAttribute("title") ?? "");
    }
    return said;
"""
UNITS = {"m", "s", "kn", "min", "MN", "MJ"}


@pytest.fixture(scope="module")
def path(guan2014: Path) -> Path:
    return write_page(guan2014)


@pytest.fixture
def phone(browser: Chrome, path: Path) -> Iterator[Page]:
    """The page on a phone of 390 by 844, which is touched."""
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", PHONE)
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
    browser.get("about:blank")
    yield Page(browser, path, "t=1.5&lang=en")
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    browser.get("about:blank")


@pytest.fixture
def page(browser: Chrome, path: Path) -> Page:
    return Page(browser, path, "lang=en", SIZE)


def test_a_phone_has_no_sideways_scroll_and_room_for_fingers(phone: Page) -> None:
    clipped = "const box = document.querySelector('.events'); return box.scrollWidth - box.clientWidth"
    assert phone.run("return innerWidth") == PHONE["width"]
    assert phone.run(f"return {CONTROLS}.length") > 10
    for language in LANGUAGES:
        phone.run("replay.language(arguments[0], false)", language)
        phone.wait_for_frame()
        found = [phone.run(script) for script in (BEYOND, SMALL, clipped)]
        assert (language, *found) == (language, [], [], 0)
        assert phone.run("return document.documentElement.scrollWidth") <= PHONE["width"]


def test_a_screen_reader_has_a_name_for_everything(page: Page) -> None:
    """By the browser's own tree of names."""
    nodes = page.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
    roles = {"button", "combobox", "slider", "img", "image", "region", "complementary", "table"}
    found: dict[str, list[Any]] = {}
    for node in nodes:
        role = node.get("role", {}).get("value")
        if role in roles and not node["ignored"]:
            found.setdefault("img" if role == "image" else role, []).append(node.get("name", {}).get("value"))
    assert {role: names for role, names in found.items() if not all(names)} == {}
    assert len(found["button"]) > 6
    assert len(found["combobox"]) == 4
    assert len(found["img"]) >= 9  # picture, track plot and curves
    page.slide(2.5)
    assert page.run("return document.getElementById('time').getAttribute('aria-valuetext')") == "0:02.50"


def test_in_chinese_nothing_is_left_in_english(page: Page) -> None:
    """But names, what the scenario and the ships' files say of themselves, and units."""
    own = page.run(
        "return [replay.data.name, replay.data.description, 'shipcollision-fmu', "
        "...replay.data.ships.flatMap((ship) => [ship.name, ship.model, ship.kind]), "
        "...[...document.querySelectorAll('.title h1, .title li span')].map((node) => node.textContent)]"
    )

    def english() -> set[str]:
        text = "\n".join(page.run(SAID))
        for name in sorted(own, key=len, reverse=True):
            text = text.replace(name, "")
        return {word for word in re.findall(r"[A-Za-z]{2,}", text) if word not in UNITS | {"Shift"}}

    assert len(english()) > 40
    try:
        page.run("replay.language('zh', false)")
        page.wait_for_frame()
        assert english() == set()
        assert page.run("return document.documentElement.lang") == "zh"
    finally:
        page.run("replay.language('en', false)")


def test_the_list_of_languages_changes_the_page_and_is_kept(page: Page) -> None:
    choose = (
        "const list = document.getElementById('language'); list.value = arguments[0];"
        "list.dispatchEvent(new Event('change'))"
    )
    page.run(choose, "nb")
    assert page.run("return document.querySelector('.panel h2').textContent") == "Kollisjoner"
    assert page.run("return localStorage.getItem('shipcollision-language')") == "nb"
    page.run("replay.language('en'); localStorage.removeItem('shipcollision-language')")


@pytest.mark.parametrize(
    ("low", "high", "least", "has_zero", "wanted"),
    [
        (4.0, 5.0, 0.2, True, (-0.15, 5.4)),
        (-5.0, -4.0, 0.2, True, (-5.4, 0.15)),
        (-1.0, 1.0, 0.2, True, (-1.16, 1.16)),
        (0.0, 0.01, 0.2, True, (-0.006, 0.216)),
        (340.0, 350.0, 1.0, False, (339.2, 350.8)),
        (90.0, 90.0, 1.0, False, (89.5, 90.5)),
        (None, None, 0.5, True, (0.0, 0.5)),
    ],
)
def test_axes_have_zero_where_it_matters(
    low: float | None, high: float | None, least: float, has_zero: bool, wanted: tuple[float, float]
) -> None:
    found = run_javascript("axis_range.js", "axisRange", "return axisRange(...data)", [low, high, least, has_zero])
    assert found == pytest.approx(wanted)


def test_speeds_are_given_in_knots_as_well(page: Page) -> None:
    """1 kn is 1852 m an hour."""
    page.slide(2.0)
    page.wait_for_frame()
    chips = page.run(
        "return [...document.querySelectorAll('[data-plot=speed] .chip')]"
        ".map((chip) => [chip.querySelector('b').textContent, chip.querySelector('.knots').textContent])"
    )
    assert len(chips) == 2
    for metres, knots in chips:
        assert float(knots.removesuffix(" kn")) == pytest.approx(float(metres) * 3600 / 1852, abs=0.06)
    closing = page.run("return document.querySelector('.events td.number').innerText").split()
    assert float(closing[1]) == pytest.approx(float(closing[0]) * 3600 / 1852, abs=0.06)
    assert closing[2] == "kn"


@pytest.mark.parametrize("time", [0.0, 4.0])
def test_the_track_plot_shows_the_ships_where_they_are(page: Page, guan2014: Path, time: float) -> None:
    """Midship and heading of each outline, read by means of the numbers at the grid."""
    page.slide(time)
    page.wait_for_frame()
    texts = page.run(
        "return [...document.querySelectorAll('.plan text')]"
        ".map((t) => [t.textContent, +t.getAttribute('x'), +t.getAttribute('y'), t.getAttribute('text-anchor')])"
    )
    hulls = page.run(
        "return [...document.querySelectorAll('.plan .hull')].map((node) => node.getAttribute('transform'))"
    )
    grid = [(float(text.replace("\u2212", "-")), x, y, anchor) for text, x, y, anchor in texts if text != "N"]
    east = sorted((value, x) for value, x, _, anchor in grid if anchor == "middle")
    north = sorted((value, y) for value, _, y, anchor in grid if anchor == "end")
    scale = (east[-1][1] - east[0][1]) / (east[-1][0] - east[0][0])
    assert (north[0][1] - north[-1][1]) / (north[-1][0] - north[0][0]) == pytest.approx(scale)  # equal, north up
    with (guan2014 / "states.csv").open(newline="") as file:
        row = next(row for row in csv.DictReader(file) if abs(float(row["time"]) - time) < 1e-9)
    origin = page.run("return replay.data.origin")
    names = page.run("return replay.data.ships.map((ship) => ship.name)")
    for name, hull in zip(names, hulls, strict=True):
        x, y, turn = map(float, re.findall(r"-?\d+\.\d+", hull))
        found = (north[0][0] - (y + 4 - north[0][1]) / scale, east[0][0] + (x - east[0][1]) / scale)
        wanted = [float(row[f"{name}.position.{axis}"]) - origin[k] for k, axis in enumerate(("north", "east"))]
        assert hypot(found[0] - wanted[0], found[1] - wanted[1]) < 0.2
        yaw = float(row[f"{name}.attitude.yaw"])
        assert (cos(yaw - turn * 3.141592653589793 / 180), sin(yaw)) == pytest.approx((1.0, sin(yaw)), abs=1e-6)
        assert abs(degrees(yaw)) > 1.0


def test_a_quantity_that_never_changes_has_no_plot_and_is_named(browser: Chrome, meeting: MakeRun) -> None:
    """The barges move in the horizontal plane only."""
    flat = Page(browser, write_page(meeting()), "lang=en", SIZE)
    plots = flat.run("return [...document.querySelectorAll('[data-plot]')].map((node) => node.dataset.plot)")
    assert "roll" not in plots
    assert "speed" in plots
    assert flat.run("return document.getElementById('steady').textContent") == (
        "Left out, as it does not change: Roll (0.00 °)"
    )


def test_the_card_of_keys_opens_at_its_beginning(page: Page) -> None:
    """The button at its end has the focus."""
    page.run("dispatchEvent(new KeyboardEvent('keydown', { key: '?' }))")
    high, seen, top = page.run("""
        const card = document.querySelector("dialog[open]");
        const found = [card.scrollHeight, card.clientHeight, card.scrollTop];
        card.close();
        return found;
    """)
    assert high > seen  # else there is nothing to scroll
    assert top == 0
