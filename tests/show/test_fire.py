"""Fire as the page draws it: it lights the hull beside it, and its smoke is given the wind of the run."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.ship.frames import rotation_from_quaternion
from shipcollision_fmu.show.page import write_page
from shipcollision_fmu.show.scene.scene import load_scene

from .browser import Page

BURNING = 6.0
"""[s] of guan2014, its end: the fire burns and the flash is over."""


@pytest.mark.needs("pybullet")
def test_a_fire_lights_the_hull_at_night(browser: Chrome, guan2014: Path) -> None:
    """Plating 25 m from the fire, on the side that is seen, is brighter and redder than where it is 120 m away."""
    write_page(guan2014)
    scene = load_scene(guan2014)
    fire = next(effect for effect in scene.effects if effect.kind == "fire")
    page = Page(browser, guan2014 / "replay.html", "sky=night&camera=impact&bare", (900, 560))
    pose = page.slide(BURNING)["poses"][fire.ship]
    R = rotation_from_quaternion(pose["quaternion"])

    def colour(along: float) -> tuple[float, float, float]:
        point = fire.point + [along, 0.0, 0.0]
        return page.colour(pose["position"] + R @ [point[0], point[1], 0.4 * point[2]], half=3)

    near, far = colour(25.0), colour(120.0)
    assert near[0] > 1.3 * far[0]
    assert near[0] - far[0] > 2.0 * (near[2] - far[2])


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
