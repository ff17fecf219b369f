"""Sea, sky, cameras and effects of the replay page: what must hold of pictures that are made for the eye."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By

from shipcollision_fmu.ship.frames import Array, rotation_from_quaternion
from shipcollision_fmu.show.page import write_page
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.browser import Page
from tests.show.conftest import MakeRun

pytestmark = pytest.mark.needs("pybullet")

LUMINANCE = """
    const canvas = document.getElementById("picture"), gl = canvas.getContext("webgl2");
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let sum = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      sum += 0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2];
    }
    return (4 * sum) / pixels.length;
"""


ROWS = """
    const canvas = document.getElementById("picture"), gl = canvas.getContext("webgl2");
    const { width, height } = canvas, pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return Array.from({ length: height }, (_, row) => {
      const light = [];
      for (let x = 0; x < width / 12; x++) {
        const i = 4 * ((height - 1 - row) * width + x);
        light.push(0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2]);
      }
      return light.sort((a, b) => a - b)[light.length >> 1];
    });
"""
"""Of each row of the picture from the top, the median light of its pixels at the left edge, where there is no ship."""


@pytest.fixture(scope="module")
def scene(guan2014: Path) -> Scene:
    return load_scene(guan2014)


@pytest.fixture(scope="module")
def opened(browser: Chrome, guan2014: Path) -> Page:
    return Page(browser, write_page(guan2014), "plain=yes&camera=all&t=0", (640, 440))


@pytest.fixture
def page(opened: Page) -> Page:
    """The page of the paper's run, in the plain picture, by day, seen as at first."""
    opened.open()
    opened.run("replay.sky('day'); replay.seek(0); replay.camera('all'); replay.drawn()")
    return opened


def eye(page: Page) -> Array:
    return np.array(page.run("return replay.drawn().eye"))


def place(page: Page, scene: Scene, ship: str, point: Array) -> Array:
    """A point of a ship's b in n, as the ship is drawn."""
    pose: dict[str, Any] = page.run("return replay.drawn().poses")[ship]
    found: Array = np.array(pose["position"]) + rotation_from_quaternion(np.array(pose["quaternion"])) @ point
    return found


def test_day_dusk_and_night_are_darker_in_this_order(page: Page) -> None:
    light = {}
    for sky in ("day", "dusk", "night"):
        page.run("replay.sky(arguments[0]); replay.drawn()", sky)
        light[sky] = page.run(LUMINANCE)
    assert light["day"] > 1.15 * light["dusk"]
    assert light["dusk"] > 2.0 * light["night"]
    assert light["night"] > 2.0
    assert page.run("return document.getElementById('sky').value") == "night"
    assert page.complaints() == []


@pytest.mark.parametrize("is_plain", [True, False])
def test_a_moonlit_night_is_dark_and_has_a_horizon(page: Page, is_plain: bool) -> None:
    """Between the sky above it and the sea below it; neither is black, as on a clear night with a moon."""
    page.run("replay.sky('night'); replay.plain(arguments[0]); replay.drawn()", is_plain)
    rows = np.array(page.run(ROWS))
    tall = len(rows)
    drop = rows[: -int(0.04 * tall)] - rows[int(0.04 * tall) :]
    horizon = int(np.argmax(drop[int(0.15 * tall) : int(0.7 * tall)])) + int(0.15 * tall)
    sky, sea = rows[horizon - 4 : horizon + 1].mean(), rows[horizon + int(0.04 * tall) :][:8].mean()
    assert 45.0 < sky < 110.0
    assert 18.0 < sea < 0.75 * sky
    page.run("replay.plain(true)")


def test_the_first_view_is_low_with_sky_over_the_ships(page: Page, scene: Scene) -> None:
    at = eye(page)
    middle = np.mean([place(page, scene, ship.name, np.zeros(3)) for ship in scene.ships], axis=0)
    away = middle - at
    height, distance = -at[2], float(np.hypot(*away[:2]))
    assert 3.0 < height < 0.15 * distance
    horizon = at + 50_000.0 * away / distance
    width, tall = page.run("const c = document.getElementById('picture'); return [c.clientWidth, c.clientHeight]")
    x, y = page.run("return replay.project(arguments[0])", [float(horizon[0]), float(horizon[1]), 0.0])
    assert abs(x - 0.5 * width) < 0.25 * width
    assert 0.25 < y / tall < 0.5  # so much of the picture is sky


def test_the_impact_is_seen_low_from_outside_the_opened_side(page: Page, scene: Scene) -> None:
    page.run("replay.seek(arguments[0]); replay.camera('impact')", scene.events[0].time + 1.0)
    effect = scene.effects[0]
    point, beside = (place(page, scene, effect.ship, effect.point + k * effect.outwards) for k in (0.0, 1.0))
    away = eye(page) - point
    assert away[:2] @ (beside - point)[:2] > 0.3 * np.hypot(*away[:2])
    assert -eye(page)[2] < 0.35 * np.hypot(*away[:2])
    for ship in scene.ships:
        origin, ahead = place(page, scene, ship.name, np.zeros(3)), place(page, scene, ship.name, np.array([1.0, 0, 0]))
        along = (eye(page) - origin)[:2] @ (ahead - origin)[:2]
        across = np.sqrt(max(0.0, float(np.sum((eye(page) - origin)[:2] ** 2)) - along**2))
        assert abs(along) > 0.5 * ship.L_oa or across > 0.5 * ship.B


@pytest.mark.one_in(2)
def test_a_ship_is_followed_from_where_the_other_is_not(browser: Chrome, kvlcc2_crossing: Path) -> None:
    """After the impact they lie side by side, and the starboard quarter of the struck ship looks at the other one."""
    scene = load_scene(kvlcc2_crossing)
    crossing = Page(browser, write_page(kvlcc2_crossing), "plain=yes&t=75&camera=ship-1", (500, 440))
    own, target = scene.ships
    pose = crossing.run("return replay.drawn().poses")[own.name]
    R = rotation_from_quaternion(np.array(pose["quaternion"]))
    middle = place(crossing, scene, target.name, np.zeros(3))
    for share in np.linspace(0.0, 0.7, 15):  # of the way to the middle
        x, y, _ = R.T @ (eye(crossing) + share * (middle - eye(crossing)) - np.array(pose["position"]))
        assert abs(x) > 0.5 * own.L_oa or abs(y) > 0.5 * own.B


@pytest.mark.parametrize("sky", ["night", pytest.param("dusk", marks=pytest.mark.slow)])
def test_scrubbing_back_brings_the_same_sea_and_sky(page: Page, sky: str) -> None:
    page.run("replay.sky(arguments[0]); replay.camera('ship-1')", sky)  # that of the impact finds a free view anew
    page.slide(1.0)
    first = page.fingerprint()
    page.slide(4.0)
    assert page.fingerprint() != first
    page.slide(1.0)
    assert page.fingerprint() == first


def test_the_water_is_white_behind_a_ship_under_way_and_not_abeam(page: Page, scene: Scene) -> None:
    own = scene.ships[0]
    page.run("replay.camera('ship-0')")
    page.slide(0.2)
    astern, abeam = (
        place(page, scene, own.name, np.array(point)) * [1, 1, 0]
        for point in ([-0.54 * own.L_oa, 0, 0], [-0.54 * own.L_oa, 2.0 * own.B, 0])
    )
    assert sum(page.colour(astern, half=1)) > sum(page.colour(abeam, half=1)) + 60


def test_the_water_is_white_where_the_bow_pushes_it_and_not_along_the_quarter(page: Page, scene: Scene) -> None:
    own = scene.ships[0]
    page.resize(1280, 900)  # the bow wave is some pixels there
    page.run("replay.camera('ship-0')")
    page.slide(0.2)
    line = own.plating.vertices[(np.abs(own.plating.vertices[:, 2]) < 0.5) & (own.plating.vertices[:, 1] > 0.0)]
    line = line[np.argsort(line[:, 0])]
    white = {}
    for x in (0.42, -0.2):
        beside = float(np.interp(x * own.L_oa, line[:, 0], line[:, 1]))
        for out in (0.03, 0.15, 0.8):
            point = place(page, scene, own.name, np.array([x * own.L_oa, beside + out * own.B, 0.0])) * [1, 1, 0]
            white[x, out] = sum(page.colour(point, half=1))
    page.resize(640, 440)
    assert white[0.42, 0.03] > white[0.42, 0.8] + 60
    assert white[-0.2, 0.15] < white[-0.2, 0.8] + 60


def test_the_plain_picture_has_no_materials_that_are_lit_per_pixel(page: Page) -> None:
    assert page.run("return replay.drawn().made.materials") == ["ShaderMaterial"]
    page.run("replay.seek(1e9)")  # with scratches and effects
    made = page.run("return replay.drawn().made")
    assert made["materials"] == ["ShaderMaterial"]
    assert made["share"] == 1.0


def test_railings_are_drawn_from_near_and_left_out_from_afar(page: Page) -> None:
    triangles = [page.run("return replay.drawn().made.triangles")]
    for turn in (-800, 800, 4000):
        page.run(
            "document.getElementById('picture').dispatchEvent(new WheelEvent('wheel', "
            "{deltaY: arguments[0], bubbles: true, cancelable: true}))",
            turn,
        )
        triangles.append(page.run("return replay.drawn().made.triangles"))
    first, near, back, far = triangles
    assert near > first + 500
    assert abs(back - first) < 200
    assert far < first - 500


def test_an_impact_passes_in_slow_motion_and_the_clock_says_so(page: Page, scene: Scene) -> None:
    page.run("replay.seek(arguments[0])", scene.events[0].time)
    shown = "return document.querySelector('.clock .rate').textContent"
    assert page.run("return replay.rate") == 0.25
    assert page.run(shown) == "0.25\u00d7"
    page.run("replay.slow(false)")
    assert page.run("return replay.rate") == 1.0
    assert page.run(shown) == ""
    page.run("replay.slow(true); replay.seek(arguments[0])", scene.end)
    assert page.run("return replay.rate") == 1.0


def test_sparks_fly_while_a_scratch_is_drawn(page: Page, scene: Scene) -> None:
    scratch = scene.scratches[0]
    drawn = [page.slide(t)["sparks"] for t in (scratch.times[0] - 0.1, scratch.times[-1], scratch.times[-1] + 3.0)]
    assert drawn[0] == drawn[2] == 0
    assert drawn[1] > 0


def test_lights_burn_at_night_at_their_places(page: Page, scene: Scene) -> None:
    """A masthead light shines out of the dark; by day it does not."""
    ship = scene.ships[0]
    assert page.run("return replay.drawn().lights") == sum(len(ship.lights) for ship in scene.ships) > 0
    at = eye(page)
    pose = page.run("return replay.drawn().poses")[ship.name]
    toward = rotation_from_quaternion(np.array(pose["quaternion"])).T @ (at - np.array(pose["position"]))
    seen = next(light for light in ship.lights if light.kind.startswith("mast") and light.is_seen_from(toward))
    point = place(page, scene, ship.name, seen.point)
    day = page.colour(point, half=1)
    page.run("replay.sky('night'); replay.drawn()")
    night = page.colour(point, half=1)
    around = page.colour(point + np.array([0.0, 0.0, -12.0]), half=1)
    assert sum(night) > sum(around) + 90  # the sky is not black
    page.run("replay.sky('day'); replay.drawn()")
    assert page.colour(point, half=1) == day


def test_waves_mirror_a_lamp_below_it_and_break_its_light(browser: Chrome, kvlcc2_crossing: Path) -> None:
    """There is light where the water would mirror the lamp, none beside it, and it changes with the waves."""
    scene = load_scene(kvlcc2_crossing)
    crossing = Page(browser, write_page(kvlcc2_crossing), "plain=yes&t=5&camera=all&sky=night", (920, 700))
    at = eye(crossing)
    poses = crossing.run("return replay.drawn().poses")
    gains, changes = [], []
    for ship in scene.ships:
        pose = poses[ship.name]
        toward = rotation_from_quaternion(np.array(pose["quaternion"])).T @ (at - np.array(pose["position"]))
        for light in ship.lights:
            if not light.is_seen_from(toward) or light.kind in ("masthead aft", "masthead fore"):
                continue
            crossing.run("replay.seek(5); replay.drawn()")
            lamp = place(crossing, scene, ship.name, light.point)
            share = at[2] / (at[2] + lamp[2])
            mirror = (at + share * (lamp - at)) * [1, 1, 0]
            across = np.cross((lamp - at) / np.linalg.norm(lamp - at), [0, 0, 1])
            shift = 0.05 * np.linalg.norm(mirror - at) * across
            beside = [sum(crossing.colour(mirror + k * shift, half=4)) for k in (-1, 1)]
            below = sum(crossing.colour(mirror, half=4))
            gains.append(below - max(beside))
            first = crossing.colour(mirror, half=0)
            crossing.run("replay.seek(6.3); replay.drawn()")
            changes.append(np.abs(np.subtract(crossing.colour(mirror, half=0), first)).max())
    assert max(gains) > 12
    assert max(changes) > 4


@pytest.mark.parametrize("plain", ["yes", "no"])
def test_lamps_shine_on_the_house_at_night(browser: Chrome, kvlcc2_crossing: Path, plain: str) -> None:
    """Moonlight is blue, lamps are warm."""
    scene = load_scene(kvlcc2_crossing)
    crossing = Page(browser, write_page(kvlcc2_crossing), f"plain={plain}&t=5&camera=all&sky=night", (640, 440))
    at = eye(crossing)
    poses = crossing.run("return replay.drawn().poses")
    warm = {}
    for ship in scene.ships:
        pose = poses[ship.name]
        R, origin = rotation_from_quaternion(np.array(pose["quaternion"])), np.array(pose["position"])
        walls = [f.surface for f in ship.fittings if f.part == "house" and f.is_closed]
        wall = max(walls, key=lambda surface: float(np.prod(np.ptp(surface.vertices, axis=0)[[0, 2]])))
        corners = wall.vertices[wall.triangles]
        area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        middle = corners.mean(axis=1)
        facing = np.einsum("ij,ij->i", area, (at - origin) @ R - middle) / np.linalg.norm((at - origin) @ R)
        red, _, blue = crossing.colour(origin + R @ middle[int(np.argmax(facing))], half=1)
        warm[ship.name] = red - blue
    assert max(warm.values()) > 3


def test_a_gentle_contact_raises_dust_and_spray_and_sets_nothing_on_fire(browser: Chrome, meeting: MakeRun) -> None:
    folder = meeting()
    scene = load_scene(folder)
    start = min(effect.time for effect in scene.effects)
    gentle = Page(browser, write_page(folder), "plain=yes", (500, 440))
    assert {effect["kind"] for effect in gentle.run("return replay.data.effects")} == {"dust", "splash"}
    assert gentle.slide(start - 0.01)["effects"] == 0
    assert gentle.slide(start + 0.02)["effects"] == 2


INK = """
    const canvas = document.querySelector(".plot canvas");
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0, count = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 128 && Math.abs(data[i] - data[i + 2]) < 60) (sum += data[i + 1]), count++;
    }
    return sum / count;
"""
"""Mean green of a plot's axes and grid."""


def test_the_page_is_dark_beside_a_night_until_somebody_chooses(page: Page) -> None:
    """White cards would blind; curves, chips and the track plot follow."""
    page.run("localStorage.removeItem('shipcollision-theme')")
    page.driver.get("about:blank")
    page.open()
    theme = "return document.documentElement.dataset.theme"
    lines = """return [...document.querySelectorAll('.track .way')].map((line) => line.getAttribute('stroke')).concat(
        [...document.querySelectorAll('.plot .chip i')].map((dot) => dot.style.getPropertyValue('--dot')))"""

    def look(sky: str) -> tuple[str, list[str], float]:
        page.run("replay.sky(arguments[0])", sky)
        page.wait_for_frame()
        return page.run(theme), page.run(lines), page.run(INK)

    day, night, again = look("day"), look("night"), look("day")
    assert (day[0], night[0]) == ("light", "dark")
    assert all(by_day != by_night for by_day, by_night in zip(day[1], night[1], strict=True))
    assert night[2] > day[2] + 40
    assert again[:2] == day[:2]
    assert abs(again[2] - day[2]) < 5
    look("night")
    page.driver.find_element(By.ID, "theme").click()
    assert page.run(theme) == "light"
    assert [look(sky)[0] for sky in ("day", "night")] == ["light", "light"]
    page.run("localStorage.removeItem('shipcollision-theme')")
    page.driver.get("about:blank")  # what was chosen goes with the page
