"""Fire as the page draws it: it lights the hull beside it, and its smoke is given the wind of the run."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.ship.frames import rotation_from_quaternion
from shipcollision_fmu.show.page import build_page
from shipcollision_fmu.show.scene.effects import Effect
from shipcollision_fmu.show.scene.scene import load_scene

from .browser import Page

BURNING = 6.0
"""[s] of guan2014, its end: the fire burns and the flash is over."""


def open_with_and_without_fire(
    browser: Chrome, run: Path, folder: Path
) -> Iterator[tuple[Page, Effect, dict[str, Any]]]:
    """The page of a run by night while its fire burns, then the same without the fire; and the burning ship's pose."""
    scene = load_scene(run)
    fire = next(effect for effect in scene.effects if effect.kind == "fire")
    dark = replace(scene, effects=tuple(e for e in scene.effects if e.kind not in ("fire", "explosion", "smoke")))
    for name, shown in (("fire", scene), ("dark", dark)):
        path = folder / f"{name}.html"
        path.write_text(build_page(shown), encoding="utf-8")
        page = Page(browser, path, "sky=night&camera=impact&bare", (900, 560))
        yield page, fire, page.slide(BURNING)["poses"][fire.ship]


@pytest.mark.needs("pybullet")
def test_a_fire_lights_the_hull_at_night(browser: Chrome, guan2014: Path, tmp_path: Path) -> None:
    """Plating is redder than in the same picture without a fire: in the halo, and beyond its reach of 27 m."""
    found = []
    for page, fire, pose in open_with_and_without_fire(browser, guan2014, tmp_path):
        R = rotation_from_quaternion(pose["quaternion"])
        x, y, z = fire.point
        in_halo, beyond = [x + 10.0, y, 0.8 * z], [x + 30.0, y, 0.9 * z]
        places = [pose["position"] + R @ place for place in (in_halo, beyond)]
        found.append([page.colour(place, half=3)[0] for place in places])
    (in_halo, beyond), (in_halo_without, beyond_without) = found
    assert beyond_without > 0.0  # the hull, in the picture
    assert in_halo > 1.2 * in_halo_without
    assert beyond > beyond_without + 3.0  # levels of 255: light on the plating alone


@pytest.mark.needs("pybullet")
def test_the_wind_of_a_run_is_that_of_its_surroundings(guan2014: Path, tmp_path: Path) -> None:
    """10 m/s from the east blow to the west; a run without the file tells no wind."""
    shutil.copytree(guan2014, tmp_path / "run")
    file = tmp_path / "run" / "surroundings.csv"
    head, row = file.read_text(encoding="utf-8").splitlines()[:2]
    values = dict(zip(head.split(","), row.split(","), strict=True))
    values |= {"wind.speed": "10.0", "wind.direction": "1.5707963267948966"}
    file.write_text(f"{head}\n{','.join(values.values())}\n", encoding="utf-8")
    np.testing.assert_allclose(load_scene(tmp_path / "run").wind, [0.0, -10.0], atol=1e-12)
    file.unlink()
    np.testing.assert_array_equal(load_scene(tmp_path / "run").wind, [0.0, 0.0])


@pytest.mark.needs("pybullet")
def test_the_light_of_a_fire_on_the_water_begins_at_its_foot(browser: Chrome, guan2014: Path, tmp_path: Path) -> None:
    """At night, against the same picture without a fire: bright beside the ship, and less farther away."""
    found = []
    for page, fire, pose in open_with_and_without_fire(browser, guan2014, tmp_path):
        foot = (pose["position"] + rotation_from_quaternion(pose["quaternion"]) @ fire.point)[:2]
        way = np.array(page.run("return replay.drawn().eye"))[:2] - foot
        way /= np.linalg.norm(way)
        found.append([page.colour([*(foot + away * way), 0.0], half=3)[0] for away in (10, 13, 16, 19, 28, 32, 36, 40)])
    added = np.subtract(*found)
    near, far = added[:4].mean(), added[4:].mean()  # a bow hides what is nearer
    assert near > 40.0  # levels of 255
    assert far < 0.7 * near


@pytest.mark.needs("pybullet")
def test_the_plain_picture_has_fewer_flames_and_puffs(browser: Chrome, guan2014: Path, tmp_path: Path) -> None:
    """About half of those of the full picture: what a fire and its smoke add to the triangles at one time."""
    scene = load_scene(guan2014)
    burning = tuple(effect for effect in scene.effects if effect.kind in ("fire", "smoke"))
    cold = tuple(effect for effect in scene.effects if effect.kind in ("dust", "splash"))
    triangles = {}
    for name, effects in (("burning", cold + burning), ("cold", cold)):
        path = tmp_path / f"{name}.html"
        path.write_text(build_page(replace(scene, effects=effects)), encoding="utf-8")
        for plain in ("yes", "no"):
            page = Page(browser, path, f"bare&plain={plain}&t={BURNING}", (500, 340))
            triangles[name, plain] = page.run("return replay.drawn()")["made"]["triangles"]
    plain, full = (triangles["burning", plain] - triangles["cold", plain] for plain in ("yes", "no"))
    assert 0.3 * full < plain < 0.7 * full
