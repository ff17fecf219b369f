"""replay.html as a user sees it: in a browser, from a file, without a network."""

from __future__ import annotations

import base64
import csv
import gzip
import json
import re
import shlex
import subprocess
import time
from io import BytesIO
from math import degrees
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from selenium.webdriver import ActionChains, Chrome, Keys
from selenium.webdriver.common.by import By

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.ship.frames import rotation, rotation_from_quaternion
from shipcollision_fmu.show.gltf import gltf
from shipcollision_fmu.show.gltf.gltf import build_glb
from shipcollision_fmu.show.gltf.ribbons import lay_ribbon
from shipcollision_fmu.show.outputs import describe
from shipcollision_fmu.show.page import build_page, write_page
from shipcollision_fmu.show.scene.run_folder import STATE
from shipcollision_fmu.show.scene.scene import Scene, load_scene
from tests.show.conftest import GUAN2014

from .browser import Page
from .conftest import MakeRun
from .foreign import with_many_collisions, with_names

CENTIMETRE = 0.01
SMALL = (500, 440)
"""Size of the window [pixels] where drawing takes long without a graphics card."""
IMAGES = Path(__file__).parents[2] / "docs" / "images"
TIMES = ("before", "during", "after")


@pytest.fixture(
    scope="module",
    params=[
        GUAN2014,
        pytest.param("kvlcc2_crossing", marks=pytest.mark.slow),
    ],
)
def folder(request: pytest.FixtureRequest) -> Path:
    """The shipped runs, with their pages written."""
    run = Path(request.getfixturevalue(request.param))
    write_page(run)
    return run


@pytest.fixture(scope="module")
def scene(folder: Path) -> Scene:
    return load_scene(folder)


@pytest.fixture(scope="module")
def opened(browser: Chrome, folder: Path) -> Page:
    return Page(browser, folder / "replay.html")


@pytest.fixture
def page(opened: Page) -> Page:
    """The page of a shipped run, open; left as it was by the test before."""
    opened.open()
    return opened


def moments(scene: Scene, folder: Path) -> dict[str, float]:
    """Times of rows of states.csv: before the first impact, just after it, and at the end."""
    times = [float(row["time"]) for row in rows_of(folder)]
    first = scene.events[0].time
    near = [min(times, key=lambda t: abs(t - wanted)) for wanted in (0.8 * first, first + 0.6)]
    return dict(zip(TIMES, [*near, times[-1]], strict=True))


def rows_of(folder: Path) -> list[dict[str, str]]:
    with (folder / "states.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_it_opens_without_a_complaint_and_asks_nobody_for_anything(page: Page) -> None:
    page.run("replay.camera('impact'); replay.seek(1e9); replay.drawn(); replay.seek(0); replay.drawn()")
    assert page.complaints() == []
    asked = page.requests()
    assert asked[0].startswith(page.path.as_uri())
    assert [url for url in asked[1:] if not url.startswith(("data:", "blob:"))] == []


@pytest.mark.parametrize("when", TIMES)
def test_ships_are_where_states_csv_puts_them(page: Page, folder: Path, scene: Scene, when: str) -> None:
    at = moments(scene, folder)[when]
    drawn = page.slide(at)
    assert drawn["time"] == pytest.approx(at, abs=1e-6)
    row = next(row for row in rows_of(folder) if float(row["time"]) == at)
    assert set(drawn["poses"]) == {ship.name for ship in scene.ships}
    for ship in scene.ships:
        x = np.array([float(row[f"{ship.name}.{state}"]) for state in STATE[:6]])
        pose = drawn["poses"][ship.name]
        shown = pose["position"] + ship.hull.vertices @ rotation_from_quaternion(pose["quaternion"]).T
        wanted = x[:3] + ship.hull.vertices @ rotation(x[3:]).T
        assert np.linalg.norm(shown - wanted, axis=1).max() < CENTIMETRE


@pytest.mark.parametrize("when", TIMES)
def test_scratches_have_grown_as_far_as_they_have(page: Page, folder: Path, scene: Scene, when: str) -> None:
    at = moments(scene, folder)[when]
    drawn = page.slide(at)
    borne = [(scratch, scene.ship(scratch.ship)) for scratch in scene.scratches]
    ribbons = [lay_ribbon(scratch, ship.plating, ship.L_pp) for scratch, ship in borne]
    triangles = sum(int((shape.times[shape.triangles].max(axis=1) <= at + 1e-4).sum()) for shape in ribbons)
    assert drawn["scratchPoints"] == sum(int((scratch.times <= at + 1e-6).sum()) for scratch in scene.scratches)
    assert drawn["scratchTriangles"] == triangles
    assert (triangles == 0) == (when == "before")


def test_dents_are_there_after_the_contact_alone(page: Page, folder: Path, scene: Scene) -> None:
    """None before, all at the end, and none again when time goes back."""
    times = moments(scene, folder)
    dents = [page.slide(times[when])["dents"] for when in ("before", "after", "before")]
    assert len(scene.dents) > 1
    assert dents == [[0] * len(scene.dents), [1] * len(scene.dents), [0] * len(scene.dents)]


def test_the_impact_is_seen_where_it_happens(page: Page, folder: Path, scene: Scene) -> None:
    """At the contact point or up to 9 m above: a ship before, a bright flash during, and fire or smoke to the end."""
    times = moments(scene, folder)
    effect = scene.effects[0]
    page.run("replay.camera('impact')")

    def seen(at: float) -> list[tuple[float, float, float]]:
        pose = page.slide(at)["poses"][effect.ship]
        R = rotation_from_quaternion(pose["quaternion"])
        place = effect.point + 0.3 * effect.outwards
        above = [np.array(pose["position"]) + R @ (place - [0.0, 0.0, up]) for up in (0.0, 3.0, 6.0, 9.0)]
        return [page.colour(point) for point in above]  # a bow that strikes has a forecastle, over which fire rises

    before = max(seen(times["before"]))
    bright = [colour for colour in seen(times["during"]) if colour[0] > 225]
    assert before[0] < 225
    assert bright
    flash = np.mean(bright, axis=0)
    assert flash[0] > 1.15 * flash[2]  # yellow or orange, not white; its core alone is hot
    assert np.linalg.norm(np.subtract(flash, before)) > 60
    page.run("replay.camera('all')")


def test_the_sides_are_seen_in_their_ships_colours(page: Page, scene: Scene) -> None:
    """Where the ships' topsides are, from the side that the camera is on, and where they are not."""
    page.run("replay.camera('all')")
    poses = page.slide(0.0)["poses"]
    hues = []
    for ship in scene.ships:
        R = rotation_from_quaternion(poses[ship.name]["quaternion"])
        z = 0.5 * float(ship.hull.vertices[:, 2].min())
        sides = [poses[ship.name]["position"] + R @ [0.25 * ship.L_oa, side * 0.5 * ship.B, z] for side in (-1, 1)]
        screen = [page.run("return replay.project(arguments[0])", side.tolist()) for side in sides]
        near = sides[int(screen[1][1] > screen[0][1])]  # the lower in the picture is the nearer
        hues.append(page.colour(near, half=1))
    blue, red = hues
    assert blue[2] > 1.4 * blue[0]
    assert red[0] > 1.8 * red[2]


@pytest.mark.parametrize("plain", ["yes", pytest.param("no", marks=pytest.mark.slow)])
def test_shade_darkens_the_picture(
    browser: Chrome, guan2014: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, plain: str
) -> None:
    """A ship's deck and house, with the ambient occlusion of the scene and without."""
    seen = []
    for name, shade_ship in (("shaded", gltf.shade_ship), ("bare", lambda shapes, breadth: [None] * len(shapes))):
        monkeypatch.setattr(gltf, "shade_ship", shade_ship)
        path = tmp_path / f"{name}.html"
        path.write_text(build_page(load_scene(guan2014)), encoding="utf-8")
        page = Page(browser, path, f"plain={plain}&t=0.5&camera=ship-1", SMALL)
        page.run("replay.drawn()")
        with Image.open(BytesIO(browser.get_screenshot_as_png())) as picture:
            seen.append(np.asarray(picture.convert("L")).astype(int))
    change = seen[1] - seen[0]
    assert (change > 10).sum() > 200
    assert (change < -10).sum() < 0.1 * (change > 10).sum()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("before", "after"),
    [((500, 440), (1400, 900)), pytest.param((1400, 600), (500, 900), marks=pytest.mark.slow)],
)
def test_the_overview_is_fitted_again_when_the_window_changes(
    browser: Chrome, guan2014: Path, before: tuple[int, int], after: tuple[int, int]
) -> None:
    """The ships are where they are after a fresh choice of the overview, until the user has zoomed."""
    write_page(guan2014)
    browser.get("about:blank")  # the page is loaded anew, in a window of this size
    page = Page(browser, guan2014 / "replay.html", "camera=all", size=before)
    scene = load_scene(guan2014)
    page.slide(0.0)

    def ends() -> np.ndarray:
        poses = page.run("return replay.drawn()")["poses"]
        return np.array(
            [
                page.run(
                    "return replay.project(arguments[0])",
                    [
                        float(c)
                        for c in poses[ship.name]["position"]
                        + rotation_from_quaternion(poses[ship.name]["quaternion"]) @ [along * ship.L_oa, 0.0, 0.0]
                    ],
                )
                for ship in scene.ships
                for along in (-0.5, 0.5)
            ]
        )

    def resized(size: tuple[int, int]) -> np.ndarray:
        page.resize(*size)
        return ends()

    fitted = resized(after)
    page.run("replay.camera('all')")
    np.testing.assert_allclose(fitted, ends(), atol=1.0)
    width, height = page.run("const c = document.getElementById('picture'); return [c.clientWidth, c.clientHeight]")
    assert (fitted >= 0).all()
    assert (fitted <= [width, height]).all()
    assert (np.ptp(fitted, axis=0) / [width, height]).max() > 0.6

    page.run(
        "document.getElementById('picture').dispatchEvent(new WheelEvent('wheel', "
        "{deltaY: -400, bubbles: true, cancelable: true}))"
    )
    page.run("replay.drawn()")
    zoomed = np.ptp(ends(), axis=0)[1] / height
    kept = np.ptp(resized(before), axis=0)[1] / page.run("return document.getElementById('picture').clientHeight")
    assert kept == pytest.approx(zoomed, rel=0.02)


def test_scrubbing_back_brings_the_same_picture(page: Page, folder: Path, scene: Scene) -> None:
    during = moments(scene, folder)["during"]
    page.slide(during)
    first = page.fingerprint()
    page.slide(during + 1.5)
    assert page.fingerprint() != first
    page.slide(during)
    assert page.fingerprint() == first


@pytest.mark.slow
def test_table_keys_and_curves_lead_to_their_times(page: Page, scene: Scene) -> None:
    page.slide(0.0)
    page.driver.find_element(By.CSS_SELECTOR, "table button").click()
    assert page.run("return replay.time") == pytest.approx(scene.events[0].time)
    assert page.run("return document.getElementById('camera').value") == "impact"
    body = page.driver.find_element(By.ID, "picture")
    body.send_keys(Keys.END)
    assert page.run("return replay.time") == scene.end
    body.send_keys(Keys.HOME + "n")
    assert page.run("return replay.time") == pytest.approx(scene.events[0].time)
    chart = page.driver.find_element(By.CSS_SELECTOR, ".plot .u-over")
    ActionChains(page.driver).move_to_element(chart).click().perform()
    assert page.run("return replay.time") == pytest.approx(0.5 * (scene.start + scene.end), rel=0.02)
    dark = "return document.documentElement.dataset.theme === 'dark'"
    was = page.run(dark)
    body.send_keys("t")
    assert page.run(dark) != was
    body.send_keys("t")
    page.run("replay.camera('all')")


def test_headings_are_those_of_a_compass_and_surge_is_shown(page: Page, scene: Scene, folder: Path) -> None:
    """The bulk carrier of guan2014 heads -33.8 deg, as its yaw angle has it: 326.2 on a compass."""
    page.slide(scene.start)
    page.wait_for_frame()
    chips = {
        plot.find_element(By.TAG_NAME, "h3").text: [chip.text for chip in plot.find_elements(By.TAG_NAME, "b")]
        for plot in page.driver.find_elements(By.CSS_SELECTOR, ".plot")
    }
    first = rows_of(folder)[0]
    for ship, heading, surge in zip(scene.ships, chips["Heading"], chips["Surge"], strict=True):
        assert float(heading) == pytest.approx(degrees(float(first[f"{ship.name}.attitude.yaw"])) % 360.0, abs=0.051)
        assert float(surge.replace("\u2212", "-")) == pytest.approx(
            float(first[f"{ship.name}.velocity.surge"]), abs=0.0051
        )
    assert any(float(first[f"{ship.name}.attitude.yaw"]) < 0.0 for ship in scene.ships) or "guan2014" not in str(folder)


def test_playing_goes_on_to_the_end_and_stops(page: Page, scene: Scene) -> None:
    page.slide(scene.end - 0.02)
    page.driver.find_element(By.ID, "play").click()
    page.wait(f"return replay.time >= {scene.end!r}")
    page.wait("return document.getElementById('play').getAttribute('aria-label') === 'Play'")
    assert page.run("return replay.time") == scene.end


@pytest.mark.slow
def test_the_full_picture_is_drawn_without_a_complaint(browser: Chrome, guan2014: Path) -> None:
    """Waves, wakes, shadows, smooth edges: what a machine with a graphics card shows."""
    write_page(guan2014)
    full = Page(browser, guan2014 / "replay.html", "plain=no&t=1.2&camera=impact", SMALL)
    full.run("replay.drawn()")
    assert full.run("return document.getElementById('plain').getAttribute('aria-pressed')") == "false"
    first = full.fingerprint()
    assert "MeshStandardMaterial" in full.run("return replay.drawn().made.materials")
    full.run("replay.plain(true); replay.drawn()")
    assert full.fingerprint() != first
    full.run("replay.plain(false); replay.drawn()")
    assert full.fingerprint() == first
    assert full.complaints() == []


@pytest.mark.slow
def test_names_are_shown_as_text_only(browser: Chrome, guan2014: Path, tmp_path: Path) -> None:
    names = {
        "own": "<script>window.ran = 1</script>",
        "target": '"><img src=x onerror="window.ran = 1">',
        "guan2014": "</title></script><script>window.ran = 1</script>",
    }
    strange = Page(browser, write_page(with_names(guan2014, tmp_path / "run", names)))
    assert strange.run("return window.ran") is None
    assert strange.run("return document.querySelectorAll('script').length") == 3
    assert strange.run("return document.querySelectorAll('img').length") == 0
    shown = strange.run("return document.querySelector('.title').textContent")
    assert all(name in shown for name in names.values())
    assert strange.run("return document.title") == names["guan2014"]
    drawn = strange.slide(3.0)
    assert set(drawn["poses"]) == {names["own"], names["target"]}
    assert drawn["effects"] == 4
    assert strange.complaints() == []


@pytest.mark.slow
def test_no_contact_is_said_in_words(browser: Chrome, meeting: MakeRun) -> None:
    apart = Page(browser, write_page(meeting(("speed = 4.0", "speed = 0.5"))))
    assert "No contact. The hulls came within" in apart.run("return document.querySelector('.events').textContent")
    assert apart.slide(3.0)["scratchPoints"] == 0
    assert apart.run("return [...document.getElementById('camera').options].map((o) => o.value)") == [
        "all", "ship-0", "ship-1", "free",
    ]  # fmt: skip
    apart.driver.find_element(By.ID, "picture").send_keys("np")
    assert apart.complaints() == []


SAID = "return [...document.querySelectorAll('.title p')].map((p) => p.textContent)"
"""What stands below the name of a run."""


def test_nothing_is_said_of_a_run_with_python(page: Page, folder: Path, scene: Scene) -> None:
    assert len(page.run(SAID)) == 1
    assert "native run" not in describe(scene, folder)[0]


def test_a_native_run_is_called_one(browser: Chrome, meeting: MakeRun) -> None:
    """Below its name, and in the line on the command line."""
    folder = meeting()
    path = folder / "summary.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "engine": "native"}) + "\n")
    said = Page(browser, write_page(folder), size=SMALL).run(SAID)
    assert said[0].startswith("own runs into a barge")
    assert said[1:] == ["Native run: its FMUs ran without Python."]
    assert ", native run, " in describe(load_scene(folder), folder)[0]


@pytest.mark.slow
def test_a_hundred_collisions_are_listed_and_shown(browser: Chrome, guan2014: Path, tmp_path: Path) -> None:
    path = write_page(with_many_collisions(guan2014, tmp_path / "run", 100))
    assert path.stat().st_size < 5e6
    many = Page(browser, path, size=SMALL)
    assert many.run("return document.querySelectorAll('.events tbody tr').length") == 100
    scene = load_scene(tmp_path / "run")
    drawn = many.slide(3.0)
    assert drawn["scratchPoints"] == sum(int((s.times <= 3.0 + 1e-6).sum()) for s in scene.scratches) > 100
    assert many.complaints() == []


@pytest.fixture
def ten_minutes(tmp_path: Path) -> Path:
    """Folder of a run of 12 000 steps."""
    text = load_scenario_text("kvlcc2_crossing").replace("duration = 150.0", "duration = 600.0")
    (tmp_path / "long.toml").write_text(text)
    simulate(load_scenario(tmp_path / "long.toml"), in_process=True, out=tmp_path / "run")
    return tmp_path / "run"


@pytest.mark.slow
def test_ten_minutes_open_and_stay_small(browser: Chrome, ten_minutes: Path) -> None:
    path = write_page(ten_minutes)
    assert len(rows_of(ten_minutes)) == 12_001
    assert path.stat().st_size < 10e6
    page = Page(browser, path)
    assert page.slide(600.0)["time"] == 600.0
    assert page.complaints() == []


@pytest.mark.soak
def test_ten_minutes_are_written_and_open_in_five_seconds_each(browser: Chrome, ten_minutes: Path) -> None:
    """On a machine that does nothing else."""
    before = time.perf_counter()
    path = write_page(ten_minutes)
    written = time.perf_counter()
    Page(browser, path)
    assert written - before < 5.0
    assert time.perf_counter() - written < 5.0


def load_scenario_text(name: str) -> str:
    """The text of a shipped scenario's file."""
    return (Path(__file__).parents[2] / "models" / "scenarios" / f"{name}.toml").read_text(encoding="utf-8")


def test_the_page_holds_the_very_glb_and_the_same_scene_gives_the_same_page(guan2014: Path) -> None:
    scene = load_scene(guan2014)
    page = build_page(scene)
    packed = re.search(r'id="scene-glb">([^<]*)<', page)
    assert packed is not None
    assert gzip.decompress(base64.b64decode(packed[1])) == build_glb(scene)
    assert build_page(load_scene(guan2014)) == page


def test_licences_of_what_is_bundled_are_in_the_page(guan2014: Path) -> None:
    page = build_page(load_scene(guan2014))
    assert "Copyright © 2010-20" in page  # three.js
    assert "Leon Sorokin" in page  # uPlot
    assert page.count("Permission is hereby granted") >= 2


@pytest.mark.slow
@pytest.mark.needs("chromium")
def test_the_first_picture_is_the_one_that_its_command_makes(kvlcc2_crossing: Path, tmp_path: Path) -> None:
    """docs/images/kvlcc2_crossing.jpg, by the command in docs/guide/pictures.md."""
    write_page(kvlcc2_crossing)
    guide = (IMAGES.parent / "guide" / "pictures.md").read_text(encoding="utf-8")
    lines = re.search(r"^chromium .*?replay.html#[^\n]*$", guide, re.DOTALL | re.MULTILINE)
    assert lines is not None
    words = shlex.split(lines.group().replace("\\\n", "").replace("$PWD/runs/kvlcc2_crossing", str(kvlcc2_crossing)))
    taken = tmp_path / "kvlcc2_crossing.png"
    subprocess.run(
        [*words, "--no-sandbox", f"--user-data-dir={tmp_path / 'profile'}"], cwd=tmp_path, check=True, timeout=300
    )
    there, made = (
        np.asarray(Image.open(path).convert("RGB")).astype(int) for path in (IMAGES / "kvlcc2_crossing.jpg", taken)
    )
    assert there.shape == made.shape == (720, 1280, 3)
    assert np.abs(there - made).mean() < 4.0
