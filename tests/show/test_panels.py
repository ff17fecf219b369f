"""Windows and containers of the page, each drawn on its own piece; the outside of hulls, weathered."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from selenium.webdriver import Chrome

from shipcollision_fmu.ship.frames import Array, rotation_from_quaternion
from shipcollision_fmu.show.gltf import gltf
from shipcollision_fmu.show.page import build_page
from shipcollision_fmu.show.scene.outfit import Fitting
from shipcollision_fmu.show.scene.palette import Paint
from shipcollision_fmu.show.scene.scene import load_scene

from .browser import Page
from .live.javascript import run_javascript
from .scene.drawn_ships import draw_ship

WIDE = (1280, 800)


def list_pieces(fittings: Iterable[Fitting], part: str) -> tuple[Array, Array]:
    """Corners (k, 4, 3) and outward normals (k, 3) of the plane quadrilaterals of a part, in b."""
    surfaces = [fitting.surface for fitting in fittings if fitting.part == part and not fitting.is_closed]
    corners = np.concatenate([surface.vertices.reshape(-1, 4, 3) for surface in surfaces])
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return corners, across / np.linalg.norm(across, axis=1, keepdims=True)


def measure_panels(corners: Array, normals: Array) -> tuple[Array, Array, Array]:
    """What the page's module says of pieces: panels (k, 4, 4), numbers (k, 4), and how brightly each is lit (k,)."""
    body = """const { panel, number } = measurePanels(data.index, data.places, data.normals);
        return [panel, number, number.map((one, i) => litOf(one, panel[4 * i + 2]))].map((list) => [...list]);"""
    index = 4 * np.arange(len(corners))[:, None] + [0, 1, 2, 0, 2, 3]
    panel, number, lit = run_javascript(
        "panels.js", "litOf, measurePanels", body,
        {"index": index.ravel().tolist(), "places": corners.ravel().tolist(),
         "normals": np.repeat(normals, 4, axis=0).ravel().tolist()},
    )  # fmt: skip
    return np.reshape(panel, (-1, 4, 4)), np.reshape(number, (-1, 4)), np.reshape(lit, (-1, 4))[:, 0]


def test_places_on_pieces_are_metres_from_their_lower_left_corner() -> None:
    corners, normals = list_pieces(draw_ship("ferry", 140.0).looks.fittings, "windows")
    panels, numbers, _ = measure_panels(corners, normals)
    sides = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1), np.linalg.norm(corners[:, 2] - corners[:, 1], axis=1)
    np.testing.assert_allclose(np.sort(panels[:, 0, 2:], axis=1), np.sort(np.transpose(sides), axis=1), atol=1e-4)
    np.testing.assert_allclose(panels[..., 1].max(axis=1), panels[:, 0, 3], atol=1e-4)
    np.testing.assert_allclose(panels[..., :2].min(axis=1), 0.0, atol=1e-4)
    lower_left = np.take_along_axis(corners, (panels[..., 0] + panels[..., 1]).argmin(axis=1)[:, None, None], axis=1)
    right = np.cross(normals, [0.0, 0.0, 1.0])  # of who looks at the piece from outside; z is down
    assert ((corners - lower_left) @ right[..., None]).min() > -1e-4
    assert (corners - lower_left)[..., 2].max() < 1e-4
    assert np.ptp(numbers, axis=1).max() == 0.0
    assert len(np.unique(numbers[:, 0])) > 0.95 * len(numbers)


def test_some_cabins_are_lit_and_a_bridge_hardly() -> None:
    lit = np.array(run_javascript("panels.js", "litOf", "return data.map((number) => litOf(number, 0.9));",
                                  np.linspace(0.0, 0.999, 200).tolist()))  # fmt: skip
    assert 0.3 < (lit > 0.3).mean() < 0.7
    assert np.ptp(lit[lit > 0.3]) > 0.4
    assert lit.min() < 0.1 < 1.01 > lit.max()
    assert run_javascript("panels.js", "litOf", "return litOf(data, 3.0);", 0.99) < 0.2


@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("plain", ["yes", pytest.param("no", marks=pytest.mark.slow)])
def test_windows_are_not_all_lit_alike(browser: Chrome, guan2014: Path, tmp_path: Path, plain: str) -> None:
    """At night, on walls that face the eye, panes are as bright as litOf says, as far as nothing is before them."""
    scene = load_scene(guan2014)
    path = tmp_path / "replay.html"
    path.write_text(build_page(scene), encoding="utf-8")
    page = Page(browser, path, f"bare&sky=night&camera=ship-1&plain={plain}", WIDE)
    drawn = page.slide(0.0)
    ship = scene.ships[1]  # which that camera follows
    corners, normals = list_pieces(ship.fittings, "windows")
    pose = drawn["poses"][ship.name]
    R = rotation_from_quaternion(pose["quaternion"])
    points = pose["position"] + corners.mean(axis=1) @ R.T
    to = drawn["eye"] - points
    faces = ((normals @ R.T) * to).sum(axis=1) > 0.5 * np.linalg.norm(to, axis=1)
    brightness = np.array([np.mean(page.colour(point, half=0)) for point in points[faces]])
    lit = measure_panels(corners, normals)[2][faces]
    assert np.corrcoef(lit, brightness)[0, 1] > 3.5 / np.sqrt(len(lit))  # by chance once in some thousand times


@pytest.mark.slow
@pytest.mark.needs("pybullet")
def test_plating_is_weathered(browser: Chrome, guan2014: Path, tmp_path: Path) -> None:
    """In the full picture by day, brightness varies along a hull's side, near the deck, half-way and at the water."""
    scene = load_scene(guan2014)
    path = tmp_path / "replay.html"
    path.write_text(build_page(scene), encoding="utf-8")
    page = Page(browser, path, "bare&sky=day&camera=ship-0&plain=no", WIDE)
    drawn = page.slide(0.0)
    ship = scene.ships[0]
    pose = drawn["poses"][ship.name]
    R = rotation_from_quaternion(pose["quaternion"])
    high = float(ship.hull.vertices[:, 2].min())
    side = np.sign((R.T @ (np.array(drawn["eye"]) - pose["position"]))[1]) * 0.5 * ship.B
    varied = []
    for z in (0.85 * high, 0.5 * high, 0.12 * high):
        row = np.array([(x, side, z) for x in np.linspace(-0.2, 0.2, 60) * ship.L_oa])
        seen = np.array([page.colour(point, half=0) for point in pose["position"] + row @ R.T]).mean(axis=1)
        varied.append(seen.std() / seen.mean())
    assert np.mean(varied) > 0.022


@pytest.mark.slow
@pytest.mark.needs("pybullet")
def test_containers_have_ribs_doors_and_dirt(
    browser: Chrome, guan2014: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the full picture, against one in which the page takes them for something else."""
    scene = load_scene(guan2014)
    number = next(i for i, ship in enumerate(scene.ships) if ship.kind.startswith("container"))
    found = gltf.find_paint
    seen = []
    for word in ("container", "cargo"):
        monkeypatch.setattr(gltf, "find_paint", lambda part, word=word: _rename(found(part), word))
        path = tmp_path / f"{word}.html"
        path.write_text(build_page(scene), encoding="utf-8")
        Page(browser, path, f"bare&sky=day&t=0&camera=ship-{number}&plain=no", WIDE).run("replay.drawn()")
        with Image.open(BytesIO(browser.get_screenshot_as_png())) as picture:
            seen.append(np.asarray(picture.convert("L")).astype(int))
    assert (np.abs(seen[1] - seen[0]) > 8).sum() > 2000


def _rename(paint: Paint, word: str) -> Paint:
    return replace(paint, name=paint.name.replace("container", word))
