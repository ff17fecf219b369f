"""Wounds as the page draws them: read from afar, without a fire before them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from selenium.webdriver import Chrome

from shipcollision_fmu.ship.frames import rotation_from_quaternion
from shipcollision_fmu.show.page import build_page
from shipcollision_fmu.show.scene.scene import load_scene

from .browser import Page


def test_an_opening_is_dark_with_bare_steel_at_its_edge(browser: Chrome, kvlcc2_crossing: Path, tmp_path: Path) -> None:
    """Along the ship by day: inside much darker than the side beside it, and grey plates where it is torn."""
    scene = load_scene(kvlcc2_crossing)
    opening = next(dent for dent in scene.dents if dent.kind == "side")
    path = tmp_path / "page.html"
    calm = tuple(effect for effect in scene.effects if effect.kind in ("dust", "splash"))
    path.write_text(build_page(replace(scene, effects=calm)), encoding="utf-8")
    page = Page(browser, path, "plain=yes&bare&sky=day", (900, 560))
    page.slide(opening.time + 8.0)
    page.run("replay.camera('impact')")
    pose = page.run("return replay.drawn()")["poses"][opening.ship]
    R = rotation_from_quaternion(pose["quaternion"])
    height = -float(scene.ship(opening.ship).hull.vertices[:, 2].min())
    shares = np.linspace(0.1, 2.4, 47)  # the other half has the bow before it
    x, y, _ = opening.point
    places = [pose["position"] + R @ [x + share * opening.half_width, y, -0.4 * height] for share in shares]
    colours = np.array([page.colour(place, half=0) for place in places])
    inside, beside, torn = colours[shares < 0.4], colours[shares > 2.0], colours[(shares > 0.4) & (shares < 1.2)]
    assert np.median(inside.sum(axis=1)) < 0.35 * np.median(beside.sum(axis=1))
    grey = torn[np.ptp(torn, axis=1) < 0.25 * torn.max(axis=1)]
    assert grey.max(initial=0.0) > 100.0  # levels of 255
