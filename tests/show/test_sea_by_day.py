"""Ships in the full picture's sea by day: hulls mirrored and throwing shadows, water without grain, a soft horizon."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.ship.frames import Array, rotation_from_quaternion
from shipcollision_fmu.show.page import write_page
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.browser import Page

SIZE = (920, 700)
SUN_TURN = 1.15
"""Of the day in daylight.js: the sun's bearing from that of the first view [rad]."""
MOON_TURN = -2.86
"""Of the night there."""
STEP = np.deg2rad(15.0)
"""Bearings among which the first view is chosen (cameras.js)."""

LEFT_EDGE = """
    const canvas = document.getElementById("picture"), gl = canvas.getContext("webgl2");
    const { width, height } = canvas, wide = Math.round(width / 12), pixels = new Uint8Array(4 * wide * height);
    gl.readPixels(0, 0, wide, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return Array.from({ length: height }, (_, row) => Array.from({ length: wide }, (_, x) => {
      const i = 4 * ((height - 1 - row) * wide + x);
      return 0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2];
    }));
"""
"""Light of the picture's pixels at its left edge, where there is no ship, row by row from the top."""


@pytest.fixture(scope="module")
def scene(kvlcc2_crossing: Path) -> Scene:
    return load_scene(kvlcc2_crossing)


@pytest.fixture(scope="module")
def opened(browser: Chrome, kvlcc2_crossing: Path) -> Page:
    """Two tankers, blue and red, under way, in the full picture."""
    return Page(browser, write_page(kvlcc2_crossing), "plain=no&t=5&camera=all", SIZE)


@pytest.fixture(scope="module")
def drawn(opened: Page) -> dict[str, Any]:
    """What is drawn, asked once: a picture takes seconds."""
    found: dict[str, Any] = opened.run("return replay.drawn()")
    return found


@pytest.fixture
def page(opened: Page, drawn: dict[str, Any]) -> Page:
    opened.open()
    return opened


def light_beside(page: Page, drawn: dict[str, Any], ship: Any, way: Array, out: float, shares: Any) -> float:
    """Mean light of the water `out` metres from a ship's plating towards `way`, in n, at shares of her length."""
    pose = drawn["poses"][ship.name]
    origin, R = np.array(pose["position"]), rotation_from_quaternion(np.array(pose["quaternion"]))
    side = float(np.sign(way @ R[:, 1]))
    points = [origin + R @ [along * ship.L_oa, side * 0.5 * ship.B, 0.0] + out * way for along in shares]
    return float(np.mean([np.mean(page.colour(point * [1.0, 1.0, 0.0], half=1)) for point in points]))


def test_the_water_beside_a_hull_mirrors_it_and_not_the_sky(page: Page, drawn: dict[str, Any], scene: Scene) -> None:
    ship = scene.ships[0]
    way = (np.array(drawn["eye"]) - drawn["poses"][ship.name]["position"]) * [1, 1, 0]
    near, far = (
        light_beside(page, drawn, ship, way / np.linalg.norm(way), out, np.linspace(-0.2, 0.2, 5))
        for out in (25.0, 300.0)
    )
    assert near < 0.89 * far


def test_a_hull_throws_its_shadow_on_the_water(page: Page, drawn: dict[str, Any], scene: Scene) -> None:
    middle = np.mean([pose["position"] for pose in drawn["poses"].values()], axis=0)
    north, east = (np.array(drawn["eye"]) - middle)[:2]
    sun = STEP * np.round(np.arctan2(east, north) / STEP) + SUN_TURN
    way = -np.array([np.cos(sun), np.sin(sun), 0.0])
    shaded, lit = (light_beside(page, drawn, scene.ships[0], way, out, (0.4, 0.42, 0.45)) for out in (10.0, 30.0))
    assert shaded < 0.94 * lit


def test_by_night_the_shadow_of_the_moon_is_faint(
    browser: Chrome, kvlcc2_crossing: Path, page: Page, scene: Scene
) -> None:
    """Most of the water's light is the sky's, and the road of the moon goes on before a ship that stands in it."""
    del page  # which is open first
    night = Page(browser, write_page(kvlcc2_crossing), "plain=no&t=5&camera=all&sky=night", SIZE)
    drawn = night.run("return replay.drawn()")
    middle = np.mean([pose["position"] for pose in drawn["poses"].values()], axis=0)
    north, east = (np.array(drawn["eye"]) - middle)[:2]
    moon = STEP * np.round(np.arctan2(east, north) / STEP) + MOON_TURN
    way = -np.array([np.cos(moon), np.sin(moon), 0.0])
    shaded, lit = (
        np.mean([light_beside(night, drawn, scene.ships[0], way, out, np.linspace(-0.3, 0.3, 7)) for out in outs])
        for outs in ((35.0, 45.0), (150.0,))
    )
    assert shaded > 0.8 * lit


def test_the_sea_has_no_grain(page: Page, drawn: dict[str, Any]) -> None:
    """What no pixel can show is roughness: a pixel differs little from the one beside it."""
    light = np.array(page.run(LEFT_EDGE))
    sea = light[int(0.5 * len(light)) :]
    assert np.abs(np.diff(sea, axis=1)).mean() < 2.4
    assert sea.std() > 10.0  # there are waves


def test_the_plain_sea_mirrors_hulls_as_well(browser: Chrome, kvlcc2_crossing: Path, scene: Scene) -> None:
    plain = Page(browser, write_page(kvlcc2_crossing), "plain=yes&t=5&camera=all", SIZE)
    drawn, ship = plain.run("return replay.drawn()"), scene.ships[0]
    way = (np.array(drawn["eye"]) - drawn["poses"][ship.name]["position"]) * [1, 1, 0]
    near, far = (
        light_beside(plain, drawn, ship, way / np.linalg.norm(way), out, np.linspace(-0.2, 0.2, 5))
        for out in (25.0, 300.0)
    )
    assert near < far  # which it is not without the image: the foam along the side is white


@pytest.mark.parametrize("size", [(920, 700), (390, 844)])
def test_the_overview_holds_both_ships_in_its_middle_at_all_times(
    browser: Chrome, kvlcc2_crossing: Path, scene: Scene, size: tuple[int, int]
) -> None:
    """As near as they let it while the run goes on, though nobody chooses it anew."""
    overview = Page(browser, write_page(kvlcc2_crossing), "plain=yes&t=0&camera=all", size)
    wide, tall = overview.run("const c = document.getElementById('picture'); return [c.clientWidth, c.clientHeight]")
    middles, shares = [], []
    for time in np.linspace(0.0, scene.end, 5):
        poses = overview.slide(float(time))["poses"]
        ends = []
        for ship in scene.ships:
            pose = poses[ship.name]
            R = rotation_from_quaternion(np.array(pose["quaternion"]))
            ends += [(pose["position"] + R @ [k * ship.L_oa, 0.0, 0.0]).tolist() for k in (-0.5, 0.5)]
        places = np.array([overview.run("return replay.project(arguments[0])", end) for end in ends])
        assert (places > 0.0).all()
        assert (places < [wide, tall]).all()
        left, right = places[:, 0].min(), places[:, 0].max()
        middles.append(0.5 * (left + right))
        shares.append((right - left) / wide)
    assert np.ptp(middles) < 2.0
    assert max(shares) > 0.9
