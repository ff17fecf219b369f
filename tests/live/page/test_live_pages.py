"""The live pages in a browser, with their server: what is steered, seen, refused and said."""

from __future__ import annotations

import asyncio
import csv
from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees
from pathlib import Path
from threading import Event
from time import time
from typing import Any

import pytest
from selenium.webdriver import ActionChains, Chrome, Keys
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.live.server import serve as serve_module
from shipcollision_fmu.live.server.app import LiveApp
from shipcollision_fmu.live.session.commands import Back, End, Fail, Mark, Pause
from shipcollision_fmu.live.session.pacer import Pacer
from tests.conftest import Write
from tests.live.live_server import eventually

from .live_server import PATIENCE, BridgePage, LiveServer, serve_live

PHONE, TOUCH = (390, 844), 44
SMALL = (500, 440)
"""Size of the window [pixels] where drawing takes long without a graphics card."""
APART = """
[scenario]
name = "apart"
duration = 600.0
step = 0.1

[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 350.0
speed = 6.0
hydrodynamics = true
orders = [{ time = 0.0, rev_per_s = 0.9 }]

[ships.target]
ship = "kvlcc2"
position = [{north}, {east}]
heading_deg = 90.0
speed = {speed}
hydrodynamics = true
"""


def write_apart(folder: Path, north: float = 3000.0, east: float = 1000.0, speed: float = 1.0) -> Path:
    """A scenario of two tankers; with these numbers they never meet."""
    path = folder / "apart.toml"
    numbers = {"north": north, "east": east, "speed": speed}
    text = APART
    for name, value in numbers.items():
        text = text.replace(f"{{{name}}}", str(value))
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def apart(browser: Chrome, tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """Two tankers, a mile and a half apart, four times as fast as the clock. That a busy machine does not keep up is
    never said, as no page here is about it: it would be an alarm."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Pacer, "is_paced", lambda pacer, now: True)
        with serve_live(browser, write_apart(tmp_path_factory.mktemp("apart")), rate=4.0) as served:
            yield served


@pytest.fixture
def server(apart: LiveServer) -> LiveServer:
    """The two tankers where they began: after minutes at the wheel, on a busy machine, they could meet."""
    apart.pause()
    apart.session.submit(Back("start")).result(PATIENCE)
    apart.pause(False)
    return apart


@pytest.fixture
def bridge(browser: Chrome, server: LiveServer) -> BridgePage:
    """The bridge of own, in command of it, and up to date."""
    page = BridgePage(browser, server.address())
    server.pause()
    page.wait_for(server.session.snapshot.step_count)
    page.wait("return live.state.command.own === live.client")
    server.pause(False)
    page.wait("return !live.state.paused")
    return page


@contextmanager
def as_phone(browser: Chrome) -> Iterator[None]:
    """A phone's screen, under fingers."""
    size = {"width": PHONE[0], "height": PHONE[1], "deviceScaleFactor": 1, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
    try:
        yield
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})


FRAMES = """
    const done = arguments[arguments.length - 1], before = live.drawn().frames;
    let left = 12;
    const next = () => (left-- ? requestAnimationFrame(next) : done(live.drawn().frames - before));
    requestAnimationFrame(next);
"""


def press(page: BridgePage, keys: str) -> None:
    page.driver.find_element(By.ID, "picture").send_keys(keys)


def test_a_picture_is_drawn_in_every_frame(bridge: BridgePage) -> None:
    """Not in every other one, which would halve the pictures in a second."""
    assert bridge.driver.execute_async_script(FRAMES) >= 12


CHART_LIGHT = """
    const copy = new OffscreenCanvas(64, 64).getContext("2d", { willReadFrequently: true });
    copy.drawImage(document.querySelector(".chart-canvas"), 0, 0, 64, 64);
    const { data } = copy.getImageData(0, 0, 64, 64);
    let sum = 0;
    for (let i = 1; i < data.length; i += 4) sum += data[i];
    return (4 * sum) / data.length;
"""


def test_the_bridge_is_dark_beside_a_night(bridge: BridgePage) -> None:
    """So that eyes used to the dark see the picture; its chart follows."""

    def look(sky: str) -> tuple[str, float]:
        Select(bridge.driver.find_element(By.ID, "sky")).select_by_value(sky)
        return bridge.run("return document.documentElement.dataset.theme"), bridge.run(CHART_LIGHT)

    bridge.run("localStorage.removeItem('shipcollision-theme')")
    bridge.driver.refresh()
    bridge.wait("return document.body?.dataset.ready === 'true' && live.state !== null")
    (day, bright), (night, dark), (again, _) = look("day"), look("night"), look("day")
    assert (day, night, again) == ("light", "dark", "light")
    assert dark < 0.5 * bright


def test_keys_steer_the_ship_and_instruments_follow(bridge: BridgePage) -> None:
    press(bridge, Keys.ARROW_RIGHT * 3)
    bridge.wait("return Math.abs(live.state.ships.own.rudder_order - 15 * Math.PI / 180) < 1e-9")
    bridge.wait("return live.state.ships.own.rudder > 0.2 && live.state.ships.own.nu[5] > 1e-4")
    bridge.wait("return document.getElementById('show-rudder').textContent.startsWith('S')")
    bridge.wait("return document.querySelector('.tile.rot small').textContent === '\\u25b6'")
    heading = "Number(document.getElementById('show-heading_short').textContent)"
    shown, yaw = bridge.run(f"return [{heading}, live.state.ships.own.eta[5]]")
    assert abs((shown - degrees(yaw) + 180.0) % 360.0 - 180.0) < 3.0
    assert bridge.run("return document.getElementById('wheel').getAttribute('aria-valuetext')") == "Starboard 15°"
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.rudder_order === 0")
    press(bridge, Keys.ARROW_UP)
    bridge.wait("return document.querySelector('[data-telegraph=\"3\"]').getAttribute('aria-checked') === 'true'")
    press(bridge, Keys.BACKSPACE)
    bridge.wait("return live.state.ships.own.rev_order === 0")
    press(bridge, "a")
    bridge.wait("return live.state.ships.own.heading_order !== null")
    bridge.wait("return document.getElementById('course').value !== ''")
    before = bridge.run("return Number(document.getElementById('course').value)")
    press(bridge, "..")
    bridge.wait("return live.state.ships.own.heading_order !== null")
    wanted = (before + 2.0) % 360.0
    bridge.wait(f"return Math.abs(live.state.ships.own.heading_order * 180 / Math.PI - {wanted}) < 1e-6")
    press(bridge, "h")
    assert bridge.complaints() == []


def test_screen_readers_are_told_of_news_and_not_of_every_number(bridge: BridgePage) -> None:
    """While the numbers run on, no live region changes, but where an alarm begins."""
    regions = """return [...document.querySelectorAll('output, [aria-live], [role=alert], [role=status]')]
        .map((one) => one.textContent)"""
    before = bridge.run(regions)
    at = bridge.run("return document.getElementById('time-now').textContent")
    bridge.wait(f"return live.state.time > {bridge.state('.time')} + 4")
    bridge.wait(f"return document.getElementById('time-now').textContent !== '{at}'")
    assert bridge.run(regions) == before
    bridge.run("document.getElementById('tcpa-limit').value = 60; document.getElementById('cpa-limit').value = 10;")
    bridge.run(
        "for (const id of ['tcpa-limit', 'cpa-limit']) document.getElementById(id).dispatchEvent(new Event('input'))"
    )
    bridge.wait("return document.querySelector('[role=alert]').textContent.includes('target: CPA')")
    bridge.run("document.getElementById('cpa-limit').value = 0")
    bridge.run("document.getElementById('cpa-limit').dispatchEvent(new Event('input'))")
    press(bridge, Keys.ENTER)
    bridge.wait("return !document.querySelector('[data-alarm=\"cpa target\"]')")


STUCK = "until the instructor ends the failure"
PRESSED = """
    window.pressed = [];
    const pilot = document.getElementById("autopilot");
    new MutationObserver(() => pressed.push(pilot.ariaPressed)).observe(pilot, { attributeFilter: ["aria-pressed"] });
"""

NO_FRAMES = """
    const next = requestAnimationFrame;
    window.held = [];
    window.requestAnimationFrame = (frame) => held.push(frame);
    window.frames_again = () => {
        window.requestAnimationFrame = next;
        held.forEach((frame) => next(frame));
    };
"""
HELD_UP = """
    const connection = live.session.connection;
    const { ask } = connection;
    const released = new Promise((resolve) => (window.release = resolve));
    connection.ask = (...all) => released.then(() => ask.apply(connection, all));
    released.then(() => (connection.ask = ask));
"""


def test_a_refused_order_never_looks_taken(bridge: BridgePage, server: LiveServer) -> None:
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.heading_order === null")
    bridge.wait("return document.getElementById('autopilot').ariaPressed === 'false'")
    server.session.submit(Fail("own", "rudder", True)).result(30.0)
    try:
        bridge.wait("return live.state.ships.own.failures.length > 0")
        bridge.run(PRESSED)
        press(bridge, "a")
        bridge.wait(f"return document.querySelector('.messages').textContent.includes('{STUCK}')")
        assert bridge.run("return pressed.includes('true')") is False
        press(bridge, Keys.END)
        bridge.wait(f"return document.querySelector('.messages').textContent.includes('{STUCK}')")
        ordered = "live.state.ships.own.rudder_order * 180 / Math.PI"
        bridge.wait(f"return Math.abs(document.getElementById('wheel').ariaValueNow - {ordered}) < 1")
    finally:
        server.session.submit(Fail("own", "rudder", False)).result(30.0)
    press(bridge, "a")
    bridge.wait("return pressed.includes('true')")
    press(bridge, "am")
    bridge.wait("return live.state.ships.own.rudder_order === 0")


def test_a_refused_order_looks_as_the_one_before_on_a_slow_machine(bridge: BridgePage, server: LiveServer) -> None:
    """Auto was on, midships is taken, Auto again is refused, all before the page draws the next frame."""
    press(bridge, "a")
    bridge.wait("return document.getElementById('autopilot').ariaPressed === 'true'")
    bridge.wait("return live.state.ships.own.heading_order !== null")
    at = bridge.run("return document.getElementById('time-now').textContent")
    bridge.wait(f"return document.getElementById('time-now').textContent !== '{at}'")  # all numbers are shown at once
    bridge.run(NO_FRAMES)
    bridge.wait("return held.length > 0")
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.heading_order === null")
    server.session.submit(Fail("own", "rudder", True)).result(30.0)
    try:
        bridge.wait("return live.state.ships.own.failures.length > 0")
        bridge.run(PRESSED)
        press(bridge, "a")
        bridge.wait(f"return document.querySelector('.messages').textContent.includes('{STUCK}')")
        assert bridge.run("return pressed.includes('true')") is False
        bridge.run("frames_again()")
        bridge.wait("return document.getElementById('wheel').ariaValueNow === '0'")
        assert bridge.run("return pressed.includes('true')") is False
    finally:
        server.session.submit(Fail("own", "rudder", False)).result(30.0)


def test_auto_again_looks_taken_only_once_it_is(bridge: BridgePage) -> None:
    """Midships and Auto, one after the other, while the server's answers are held up."""
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.heading_order === null")
    press(bridge, "a")
    bridge.wait("return document.getElementById('autopilot').ariaPressed === 'true'")
    bridge.run(PRESSED + HELD_UP)
    press(bridge, "ma")
    bridge.wait("return document.getElementById('autopilot').ariaPressed === 'false'")
    bridge.wait_for_frame()
    assert set(bridge.run("return pressed.slice(pressed.indexOf('false'))")) == {"false"}
    bridge.run("release()")
    bridge.wait("return document.getElementById('autopilot').ariaPressed === 'true'")
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.rudder_order === 0")


def test_an_order_in_a_pause_is_shown_until_the_ship_has_it(bridge: BridgePage) -> None:
    """Two seconds of the wall clock, in which no step is made."""
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.rudder_order === 0")
    press(bridge, "p")
    bridge.wait("return live.state.paused")
    press(bridge, Keys.ARROW_RIGHT)
    bridge.run("window.later = Date.now() + 2000")
    bridge.wait("return Date.now() > later")
    assert bridge.state(".ships.own.rudder_order") == 0
    assert bridge.run("return document.getElementById('wheel').getAttribute('aria-valuenow')") == "5"
    press(bridge, "p")
    bridge.wait("return live.state.ships.own.rudder_order > 0.08")
    press(bridge, "m")


def test_the_rate_of_the_command_line_is_shown(bridge: BridgePage) -> None:
    """It is none of the list."""
    bridge.wait("return document.getElementById('rate').value === '4'")
    assert bridge.run("return document.getElementById('rate').selectedOptions[0].textContent") == "4\u00d7"
    texts = bridge.run("return [...document.getElementById('rate').options].map(({ textContent }) => textContent)")
    assert texts == ["1/4\u00d7", "1/2\u00d7", "1\u00d7", "2\u00d7", "4\u00d7", "5\u00d7", "10\u00d7", "20\u00d7"]


def test_the_card_of_keys_opens_at_its_beginning(bridge: BridgePage) -> None:
    press(bridge, "?")
    bridge.wait("return document.querySelector('dialog').open")
    high, seen, top = bridge.run(
        "const card = document.querySelector('dialog'); return [card.scrollHeight, card.clientHeight, card.scrollTop]"
    )
    press_in_card = "document.querySelector('dialog').close()"
    bridge.run(press_in_card)
    assert high > seen  # else there is nothing to scroll
    assert top == 0


LASTING = """
    const { setTimeout: later } = window;
    window.setTimeout = (call, wait, ...all) => (wait < 8000 ? later(call, wait, ...all) : 0);
"""
"""Messages stay: a busy machine is longer about opening a page than they do."""


def test_a_ship_that_is_not_there_is_said(browser: Chrome, server: LiveServer) -> None:
    lasting = browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": LASTING})
    try:
        page = BridgePage(browser, f"{server.address()}&ship=titanic")
        page.wait("return document.querySelector('.messages').textContent")
    finally:
        browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", lasting)
    said = page.run("return document.querySelector('.messages').textContent")
    assert said == "There is no ship titanic. The ships are own, target."
    assert page.run("return document.querySelector('h1').textContent") in ("", "own")


def test_the_log_of_the_instructor_survives_a_reload(browser: Chrome, server: LiveServer) -> None:
    page = BridgePage(browser, server.address("instructor"))
    page.wait("return live.state")
    server.session.submit(Mark("to be kept")).result(30.0)
    page.wait("return document.getElementById('book').textContent.includes('Mark to be kept')")
    before = page.run("return [...document.querySelectorAll('#book li')].map(({ textContent }) => textContent)")
    page.run("location.reload()")
    page.wait("return window.live?.state && document.querySelector('#book li')")
    after = page.run("return [...document.querySelectorAll('#book li')].map(({ textContent }) => textContent)")
    assert after[-len(before) :] == before


def test_no_number_of_a_closest_approach_gets_old(bridge: BridgePage) -> None:
    """It runs on, or gives way to words: where the danger is over, the connection is lost, or the run goes back."""
    found = bridge.run("""
        const { session } = live;
        const danger = (cpa) => {
            session.limits.cpa = cpa;
            session.watch(session.state);
            return session.alarms.list.get("cpa target")?.words() ?? null;
        };
        session.limits.tcpa = 1e9;
        const own = session.state.ships.own, target = session.state.ships.target;
        target.eta = [own.eta[0] + 3000, own.eta[1] + 100, 0, 0, 0, own.eta[5]];
        own.nu = [5, 0, 0, 0, 0, 0];
        target.nu = [0, 0, 0, 0, 0, 0];
        own.eta[5] = 0;
        const said = [danger(1000), danger(1)];
        session.alarms.clearAll();
        said.push(danger(1000));
        session.lose();
        said.push(session.alarms.list.get("cpa target")?.words() ?? null);
        session.alarms.clearAll();
        session.limits.cpa = 0;
        return said;
    """)
    assert found[0].startswith("target: CPA 0.05")
    assert found[1] == "target: CPA no longer below the limits"
    assert found[2] == found[0]
    assert found[3] is None


@pytest.mark.slow
def test_wheel_telegraph_and_course_answer_to_the_mouse(bridge: BridgePage) -> None:
    driver = bridge.driver
    driver.find_element(By.CSS_SELECTOR, '[data-telegraph="-2"]').click()
    bridge.wait("return live.state.ships.own.rev_order < 0")
    course = driver.find_element(By.ID, "course")
    course.click()
    course.send_keys(Keys.CONTROL + "a" + Keys.NULL + "123" + Keys.ENTER)
    bridge.wait("return Math.abs(live.state.ships.own.heading_order * 180 / Math.PI - 123) < 1e-6")
    # The wheel is turned from where it stands, and the autopilot turns it, too: midships first.
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.rudder_order === 0")
    bridge.wait("return document.getElementById('wheel').getAttribute('aria-valuenow') === '0'")
    wheel = driver.find_element(By.ID, "wheel")
    driver.execute_script("arguments[0].scrollIntoView({ block: 'center' })", wheel)
    # A quarter turn to port from the top of the rim: 90 degrees of the wheel are 15 of the rudder.
    held = ActionChains(driver, duration=50).move_to_element_with_offset(wheel, 0, -44).click_and_hold()
    for x, y in ((-22, -38), (-38, -22), (-44, 0)):
        held = held.move_to_element_with_offset(wheel, x, y)
    held.release().perform()
    bridge.wait("return Math.abs(live.state.ships.own.rudder_order * 180 / Math.PI + 15) < 1.01")
    press(bridge, "a")
    bridge.wait("return live.state.ships.own.heading_order !== null")
    ActionChains(driver).move_to_element_with_offset(wheel, 0, -44).click_and_hold().move_by_offset(
        -30, 9
    ).release().perform()
    bridge.wait("return live.state.ships.own.heading_order === null")


@pytest.mark.slow
def test_cameras_stand_on_the_ship(bridge: BridgePage, server: LiveServer) -> None:
    """On the bridge the eye is over the wheelhouse; the wings are a ship's breadth apart; binoculars make 7 of 1. The
    ship stands still meanwhile."""
    server.pause()
    bridge.wait("return live.state.paused && Math.abs(live.drawn().time - live.state.time) < 1e-9")
    seen = {mode: bridge.run(f"live.camera('{mode}'); return live.drawn()") for mode in ("bridge", "port", "starboard")}
    apart = [a - b for a, b in zip(seen["starboard"]["eye"], seen["port"]["eye"], strict=True)]
    info = bridge.run("return live.session.infoOf('own')")
    assert sum(x * x for x in apart) ** 0.5 == pytest.approx(info["B"], rel=0.02)
    assert seen["bridge"]["eye"][1] == pytest.approx(-info["bridge"][2], abs=0.5)
    press(bridge, "1b")
    assert bridge.run("return live.drawn().zoom") == 7
    assert bridge.run("return document.getElementById('binoculars').getAttribute('aria-pressed')") == "true"
    press(bridge, "b4")
    assert bridge.run("return live.drawn().mode") == "chase"
    press(bridge, "vv1")
    server.pause(False)
    assert bridge.complaints() == []


def test_ships_are_drawn_where_the_state_puts_them(bridge: BridgePage) -> None:
    """While paused the picture is of the latest state."""
    press(bridge, "p")
    bridge.wait("return live.state.paused")
    bridge.wait("return Math.abs(live.drawn().time - live.state.time) < 1e-9")
    drawn, ships = bridge.run("return [live.drawn().poses, live.state.ships]")
    for name, ship in ships.items():
        assert drawn[name]["position"] == pytest.approx(ship["eta"][:3], abs=0.01)
    press(bridge, "p")
    bridge.wait("return !live.state.paused")


@pytest.mark.slow
def test_one_is_in_command_and_the_others_see_who(bridge: BridgePage, server: LiveServer) -> None:
    driver, first = bridge.driver, bridge.run("return live.client")
    mine = driver.current_window_handle
    driver.switch_to.new_window("tab")
    second = BridgePage(driver, server.address())
    second.wait(f"return document.getElementById('command-said').textContent === '{first} is in command.'")
    before = second.state(".ships.own.rev_order")
    driver.find_element(By.CSS_SELECTOR, '[data-telegraph="4"]').click()
    second.wait("return document.querySelector('.messages').textContent.includes('take command first')")
    assert second.state(".ships.own.rev_order") == before
    driver.find_element(By.ID, "command").click()
    second.wait("return document.querySelector('.messages').textContent.includes('let the instructor take it')")
    driver.get(server.address("instructor"))
    second.wait("return document.body?.dataset.ready && live.state")
    driver.find_element(By.CSS_SELECTOR, '[data-conn="own"]').click()
    second.wait("return live.state.command.own === live.client")
    instructor = second.run("return live.client")
    driver.close()
    driver.switch_to.window(mine)
    bridge.wait(
        f"return ['{instructor} is in command.', 'Nobody is in command.']"
        ".includes(document.getElementById('command-said').textContent)"
    )
    bridge.wait("return live.state.command.own === undefined")  # whoever goes gives up command
    driver.find_element(By.ID, "command").click()
    bridge.wait("return live.state.command.own === live.client")


@pytest.mark.slow
def test_the_instructor_cons_one_ship_after_another_and_sees_the_marks_that_there_are(
    browser: Chrome, server: LiveServer
) -> None:  # fmt: skip
    page = BridgePage(browser, server.address("instructor"))
    page.wait("return live.state && document.querySelector('[data-conn=own]')")
    for ship in ("target", "own"):
        browser.find_element(By.CSS_SELECTOR, f'[data-conn="{ship}"]').click()
        page.wait(f"return live.state.command.{ship} === live.client")
        page.run(f"live.ask('order', {{ship: '{ship}', rudder_deg: 0}})")
        page.wait(f"return live.state.ships.{ship}.rudder_order === 0")
    page.wait("return document.getElementById('wheel').getAttribute('aria-valuenow') === '0'")
    page.run("""
        const buttons = [...document.querySelectorAll('.conn-tools button')];
        const starboard = buttons.find((button) => button.textContent.startsWith('5°'));
        starboard.click();
        document.querySelector('[data-conn="target"]').click();
        starboard.click();
    """)
    for ship in ("own", "target"):
        page.wait(f"return Math.abs(live.state.ships.{ship}.rudder_order - 5 * Math.PI / 180) < 1e-9")
    for name in ("first", "second"):
        page.run(f"live.ask('mark', {{name: '{name}'}})")
        page.wait(f"return document.querySelector('[data-mark={name}]')")
        page.wait(f"return live.state.time > {page.state('.time')} + 0.5")
    page.run("live.ask('back', {name: 'first'})")
    page.wait("return !document.querySelector('[data-mark=second]')")
    assert page.run("return document.querySelector('[data-mark=first]') !== null")
    slow = page.run("""
        live.session.watch({...live.state, paused: false, paced: false, real_rate: 0.97});
        return live.session.alarms.list.get('slow').words();
    """)  # at once, as the next state may end it
    assert slow.endswith(": 0.97\u00d7")
    page.run("for (const ship of ['own', 'target']) live.ask('command', {ship, take: false})")
    assert page.complaints() == []


@pytest.mark.slow
def test_the_instructor_sets_what_there_is_to_set(browser: Chrome, server: LiveServer) -> None:
    page = BridgePage(browser, server.address("instructor"))
    page.wait("return live.state")

    def fill(field: str, value: str) -> None:
        """As a hand does: a field that has the focus is left alone by the page."""
        found = browser.find_element(By.ID, field)
        found.click()
        found.send_keys(Keys.CONTROL + "a" + Keys.NULL + Keys.BACKSPACE + value)

    fill("wind-speed", "20")
    fill("wind-from", "270")
    browser.find_element(By.ID, "set-wind").click()
    page.wait("return Math.abs(live.state.environment.wind.speed - 20 * 1852 / 3600) < 1e-9")
    assert page.state(".environment.wind.from_deg") == 270.0
    assert page.run("return document.querySelector('.converted').textContent") == "= 10.3 m/s"
    page.wait("return document.getElementById('book').textContent.includes('Wind 20.0 kn (10.3 m/s) from 270')")
    for text, said in (
        ("strong", "“strong” is no speed: give a number such as 12, 12 kn or 6 m/s."),
        ("120 kn", "“120 kn” is beyond the limit: give at most 116.6 kn (60.0 m/s)."),
        ("", "“” is no speed: give a number such as 12, 12 kn or 6 m/s."),
    ):
        fill("wind-speed", text)
        browser.find_element(By.ID, "set-wind").click()
        page.wait(f"return document.querySelector('.messages').textContent === '{said}'")
        assert page.state(".environment.wind.speed") == pytest.approx(20 * 1852 / 3600)
    fill("wind-speed", "6 m/s")
    fill("wind-from", "west")
    browser.find_element(By.ID, "set-wind").click()
    page.wait("return document.querySelector('.messages').textContent.startsWith('“west” is no direction')")
    fill("wind-from", "270°" + Keys.ENTER)
    page.wait("return live.state.environment.wind.speed === 6")
    Select(browser.find_element(By.ID, "speed-unit")).select_by_value("m/s")
    browser.find_element(By.ID, "mark-name").click()
    page.wait("return document.getElementById('wind-speed').value === '6'")
    assert page.run("return document.querySelector('.set-row span').textContent") == "Wind [m/s]"
    Select(browser.find_element(By.ID, "speed-unit")).select_by_value("kn")
    page.wait("return document.getElementById('wind-speed').value === '11.7'")
    fill("current-speed", "2")
    fill("current-towards", "90")
    browser.find_element(By.ID, "set-current").click()
    page.wait("return Math.abs(live.state.environment.current[1] - 2 * 1852 / 3600) < 1e-9")
    stuck = browser.find_element(By.CSS_SELECTOR, '[data-ship="target"] [data-fail="rudder"]')
    stuck.click()
    page.wait("return live.state.ships.target.failures.includes('rudder')")
    page.wait("return document.querySelector('[data-ship=target] [data-fail=rudder]').ariaPressed === 'true'")
    stuck.click()
    page.wait("return live.state.ships.target.failures.length === 0")
    fill("mark-name", "here")
    fill("mark-note", "Before the turn; ask for her intentions")
    browser.find_element(By.ID, "set-mark").click()
    page.wait("return document.querySelector('[data-mark=here]')")
    marked = page.state(".time")
    page.wait(f"return live.state.time > {marked} + 2")
    server.pause()  # time would be later again before a busy page has looked
    browser.find_element(By.CSS_SELECTOR, "[data-mark=here]").click()
    page.wait(f"return live.state.time < {marked} + 1.5")
    server.pause(False)
    Select(browser.find_element(By.ID, "rate")).select_by_value("20")
    page.wait("return live.state.rate === 20")
    browser.find_element(By.ID, "pause").click()
    page.wait("return live.state.paused")
    stopped = page.state(".step_count")
    page.wait("return !document.getElementById('step').hidden")
    browser.find_element(By.ID, "step").click()
    page.wait(f"return live.state.step_count === {stopped} + 1")
    Select(browser.find_element(By.ID, "rate")).select_by_value("2")
    browser.find_element(By.ID, "pause").click()
    page.wait("return !live.state.paused && live.state.rate === 2")
    said = "Mark here: Before the turn; ask for her intentions"
    assert said in page.run("return document.getElementById('book').textContent")
    page.run("location.reload()")
    page.wait("return window.live?.state && document.querySelector('[data-mark=here]')")
    noted = page.run(
        "return document.querySelector('[data-mark=here]').parentElement.querySelector('.note').textContent"
    )
    assert noted == "Before the turn; ask for her intentions"
    assert page.complaints() == []


def test_the_instructor_arms_failures(browser: Chrome, server: LiveServer) -> None:
    page = BridgePage(browser, server.address("instructor"))
    page.wait("return live.state")
    value, arm = browser.find_element(By.ID, "arm-value"), browser.find_element(By.ID, "arm")
    for text in ("soon", "5"):
        value.clear()
        value.send_keys(text)
        arm.click()
        page.wait(f"return document.querySelector('.messages').textContent.startsWith('“{text}” is no time')")
    eventually(lambda: server.session.snapshot.time > 1.0)
    value.clear()
    value.send_keys("0:01")
    arm.click()
    page.wait("return document.querySelector('.messages').textContent.includes('must be later than now')")
    Select(browser.find_element(By.ID, "arm-ship")).select_by_value("target")
    Select(browser.find_element(By.ID, "arm-what")).select_by_value("blackout")
    Select(browser.find_element(By.ID, "arm-when")).select_by_value("own")
    value.clear()
    value.send_keys("0.5" + Keys.ENTER)
    page.wait("return document.querySelector('[data-armed]')")
    page.run("location.reload()")
    page.wait("return window.live?.state && document.querySelector('[data-armed]')")
    said = page.run("return document.querySelector('[data-armed=\"target blackout\"] span').textContent")
    assert said == "target: Blackout within 0.500 NM of own"
    browser.find_element(By.CSS_SELECTOR, "[data-armed] button").click()
    page.wait("return !document.querySelector('[data-armed]')")
    Select(browser.find_element(By.ID, "arm-ship")).select_by_value("target")
    server.pause()
    soon = int(server.session.snapshot.time) + 2
    browser.find_element(By.ID, "arm-value").send_keys(f"{soon // 60}:{soon % 60:02}" + Keys.ENTER)
    page.wait("return document.querySelector('[data-armed=\"target rudder\"]')")
    server.pause(False)
    page.wait("return live.state.ships.target.failures.includes('rudder')")
    page.wait("return !document.querySelector('[data-armed]')")
    page.run("live.ask('fail', {ship: 'target', what: 'rudder', on: false})")
    assert page.complaints() == []


@pytest.mark.parametrize("role", ["bridge", "instructor"])
def test_on_a_phone_nothing_is_cut_off_and_fingers_hit(browser: Chrome, server: LiveServer, role: str) -> None:
    with as_phone(browser):
        page = BridgePage(browser, server.address(role))
        page.wait("return live.state")
        assert page.run("return innerWidth") == PHONE[0]
        assert page.run("return document.documentElement.scrollWidth") <= PHONE[0]
        small = page.run(
            """return [...document.querySelectorAll('button, select, input, a, [role=slider]')]
            .map((one) => [one.id || one.textContent, one.getBoundingClientRect()])
            .filter(([, box]) => box.width && Math.min(box.width, box.height) < arguments[0] - 0.01)
            .map(([name]) => name)""",
            TOUCH,
        )
        assert small == []
        if role == "bridge":  # however many alarms there are, they are one bar over the picture
            page.run(
                "for (const key of 'abcd') live.session.alarms.set(key, true, 'alarm', () => 'Words of alarm ' + key)"
            )
            page.wait("return document.querySelectorAll('#alarms li').length >= 4")
            bar = page.run("return document.querySelector('.alarm-bar').getBoundingClientRect()")
            assert bar["right"] <= PHONE[0]
            assert bar["height"] < 1.2 * TOUCH
        browser.get("about:blank")


@pytest.mark.slow
@pytest.mark.parametrize("role", ["bridge", "instructor"])
def test_every_control_has_a_name_in_the_chosen_language(browser: Chrome, server: LiveServer, role: str) -> None:
    page = BridgePage(browser, server.address(role))
    page.wait("return live.state")
    names = """return [...document.querySelectorAll('button, select, input, canvas, [role=slider]')]
        .map((one) => one.ariaLabel || one.textContent.trim() || one.labels?.[0]?.textContent || '')"""
    found = {}
    try:
        for language in ("de", "nb", "zh", "en"):
            Select(browser.find_element(By.ID, "language")).select_by_value(language)
            found[language] = page.run(names)
            assert all(found[language])
            assert page.run("return document.documentElement.lang") == language
    finally:
        page.run("localStorage.removeItem('shipcollision-language')")
    assert found["de"] != found["en"] != found["zh"] != found["nb"]


@pytest.mark.slow
def test_a_server_that_is_gone_is_said_and_found_again(bridge: BridgePage) -> None:
    bridge.run("window.kept = live.session.connection.address; live.session.connection.address = 'ws://127.0.0.1:9/';")
    bridge.run("live.session.connection.socket.close()")
    bridge.wait("return document.querySelector('[data-alarm=lost]')")
    assert bridge.run("return document.body.classList.contains('lost')")
    press(bridge, Keys.ARROW_LEFT)
    bridge.wait("return document.querySelector('.messages').textContent.includes('there is no connection')")
    bridge.run("live.session.connection.address = kept")
    bridge.wait("return live.session.connection.isOpen && !document.querySelector('[data-alarm=lost]')")
    bridge.wait("return live.state.command.own === live.client")
    bridge.driver.get("about:blank")


TOLD = """
    const { connection } = live.session;
    const { hear } = connection;
    let isNews = true;
    window.told = [];
    connection.hear = (type, message) => {
        const isOfContact = type === "state" ? message.contact.count > 0 : message.kind === "collision begins";
        const before = live.session.contacts.length;
        hear(type, message);
        if (message.kind === "back") isNews = true;
        if (!isNews || !isOfContact) return;
        isNews = false;
        const alarm = document.querySelector("[data-alarm=contact]");
        told.push([live.session.contacts.length - before, alarm?.className, live.session.alarms.sounding]);
    };
"""
"""Writes down what the first message of each contact has done once it is read: contacts that are new, the alarm that is
shown, and the one that is heard."""


@pytest.mark.slow
def test_contact_is_seen_and_heard_with_the_first_message_of_it(browser: Chrome, scenario_file: Write) -> None:
    """That the message waits for no other is test_hub.py's."""
    with contact_three_times(browser, scenario_file) as (page, _):
        assert page.run("return told") == [[1, "alarm raised", "alarm"]] * 3


@pytest.mark.soak
def test_contact_is_seen_within_a_fifth_of_a_second(browser: Chrome, scenario_file: Write) -> None:
    """The least of three, on a machine that does nothing else."""
    with contact_three_times(browser, scenario_file) as (page, began):
        seen = page.run("return live.contacts.map(({ wall }) => wall / 1000)")
    delays = [there - here for here, there in zip(began, seen, strict=False)]
    assert len(delays) >= 3
    assert min(delays) > -0.002  # the page counts whole milliseconds
    assert min(delays) < 0.2


@contextmanager
def contact_three_times(browser: Chrome, scenario_file: Write) -> Iterator[tuple[BridgePage, list[float]]]:
    """A page after three times the same contact, by going back to the start, and when each began in the model [s]. Time
    stops with the contact, which would be over before a busy machine has looked."""
    began: list[float] = []
    with serve_live(browser, scenario_file(("duration = 3.0", "duration = 30.0")), paused=True) as served:

        def stop(event: dict[str, Any]) -> None:
            if event["kind"] == "collision begins":
                began.append(time())
                served.session.submit(Pause(True))

        served.session.listen(stop)
        page = BridgePage(browser, served.address(), SMALL)
        page.run(TOLD)
        for turn in range(3):
            press(page, "p")
            page.wait(f"return live.contacts.length > {turn}")
            assert page.run("return document.querySelector('[data-alarm=contact]').className") == "alarm raised"
            assert "own" in page.run("return document.querySelector('[data-alarm=contact]').textContent")
            press(page, Keys.ENTER)
            page.wait("return document.querySelector('[data-alarm=contact]').className === 'alarm silent'")
            page.wait("return Object.values(live.drawn().scratches).every((places) => places.length > 0)")
            served.session.submit(Back("start")).result(30.0)
            page.wait("return live.state.contact.count === 0")
            page.wait("return Object.values(live.drawn().scratches).every((places) => places.length === 0)")
            page.wait("return !document.querySelector('[data-alarm=contact]')")
        assert page.complaints() == []
        yield page, began


@pytest.mark.slow
def test_a_page_opened_after_a_collision_neither_burns_anew_nor_raises_an_alarm(browser: Chrome) -> None:
    """Of a collision that has burnt out, and after which the ships have parted: on bridge and instructor's page, and in
    the chart meanwhile. One that is fresh burns at its own time, at the points of the ships that touched. The run goes
    on in steps: a busy page would miss the times that matter."""
    with serve_live(browser, "guan2014", paused=True) as served:
        page = BridgePage(browser, served.address(), SMALL)
        page.wait("return document.body.dataset.ready")
        page.run("document.getElementById('chart-large').click()")
        while not served.session.snapshot.contact.count:
            served.step()
        begins = served.session.snapshot.contact.collisions[0].time
        for k in range(1, 12):
            served.step_until(begins + 0.5 * k)
            page.wait_until(served.session.snapshot.time)
        page.run("document.getElementById('chart-large').click()")
        begun = "Math.max(...live.effects.map(({ time }) => time)) - live.state.contact.collisions[0].time"
        page.wait("return live.effects.some(({ kind }) => kind === 'fire')")
        assert page.run(f"return {begun}") < 2.0
        scratched = page.run("return live.drawn().scratches")
        assert all(scratched.values())
        page.run("location.reload()")
        page.wait("return window.live?.effects?.some(({ kind }) => kind === 'fire')")
        assert page.run("return live.drawn().scratches") == scratched
        assert page.run(f"return {begun}") < 2.0
        ends = page.run("return live.state.contact.collisions[0]")
        points = {ends["ship_a"]: ends["a"], ends["ship_b"]: ends["b"]}
        assert all(points[effect["ship"]] == effect["point"] for effect in page.run("return live.effects"))
        assert page.state(".contact.points") == 0
        assert page.run("return live.session.alarms.list.has('contact')") is False
        served.step_until(100.0)  # they touch again at 167 s
        page.wait_until(100.0)
        assert page.state(".contact.points") == 0
        for role in ("bridge", "instructor"):
            browser.get("about:blank")
            opened = BridgePage(browser, served.address(role), SMALL)
            opened.wait("return live.state && document.body.dataset.ready")
            assert opened.state(".contact.count") > 0
            assert opened.run("return live.session.alarms.list.has('contact')") is False
            if role == "bridge":
                opened.wait("return live.effects.length > 0")
                assert opened.run("return live.drawn().effects") == 0


@pytest.mark.slow
def test_an_alarm_of_a_slow_machine_ends_once_it_keeps_up(bridge: BridgePage) -> None:
    """While the lag is still told, the rate that is measured may be that which is set, or more."""
    for rate, is_slow in ((3.9, True), (3.95, False), (5.1, False)):
        bridge.run(
            f"live.session.watch({{...live.state, rate: 4, paused: false, paced: false, real_rate: {rate}}});"
            "window.slow = live.session.alarms.list.has('slow')"
        )
        assert bridge.run("return slow") is is_slow


def test_on_a_phone_the_tools_of_the_large_chart_can_be_tapped(browser: Chrome, server: LiveServer) -> None:
    with as_phone(browser):
        page = BridgePage(browser, server.address())
        page.wait("return live.state && document.body.dataset.ready")
        page.run("document.getElementById('chart-large').click()")
        hidden = page.run("""
            return [...document.querySelectorAll('.chart-tools button, .stage-tools button, .stage-tools select')]
                .filter((one) => {
                    const { left, right, top, bottom } = one.getBoundingClientRect();
                    return [[left + 4, top + 4], [right - 4, bottom - 4], [(left + right) / 2, (top + bottom) / 2]]
                        .some(([x, y]) => !one.contains(document.elementFromPoint(x, y)));
                }).map((one) => one.id || one.textContent)""")
        browser.get("about:blank")
    assert hidden == []


def test_on_a_phone_the_most_urgent_alarm_is_seen_first(browser: Chrome, server: LiveServer) -> None:
    """A collision, whatever else has been raised, acknowledged or is over before it; of others the newest."""
    with as_phone(browser):
        page = BridgePage(browser, server.address())
        page.wait("return live.state && document.body.dataset.ready")
        seen = page.run("""
            const { alarms } = live.session;
            alarms.list.clear();
            const raise = (key, priority = 'alarm', isThere = true) =>
                alarms.set(key, isThere, priority, () => 'Words of alarm ' + key);
            const first = () => {
                live.session.hear('event', {});
                const list = document.getElementById('alarms').getBoundingClientRect();
                return document.elementFromPoint(list.left + 20, list.top + list.height / 2).dataset.alarm;
            };
            const found = [];
            for (const key of ['one', 'two', 'three']) raise(key);
            found.push(first());
            raise('two', 'alarm', false);
            raise('contact');
            document.getElementById('alarms').scrollLeft = 400;
            raise('four');
            found.push(first());
            alarms.acknowledge();
            raise('five');
            raise('five', 'alarm', false);
            found.push(first());
            raise('careful', 'caution');
            found.push(first());
            return found;
        """)
        browser.get("about:blank")
    assert seen == ["three", "contact", "contact", "contact"]


def test_the_debriefing_is_offered_as_long_as_the_server_answers(
    browser: Chrome, scenario_file: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After that the page says where the run is, and the command that shows it. Alarms have an end, too."""
    gone = Event()

    async def linger(app: LiveApp, interrupted: asyncio.Event) -> None:
        """Until the test has seen that the debriefing is offered."""
        while not gone.is_set():
            await asyncio.sleep(0.05)

    monkeypatch.setattr(serve_module, "_linger", linger)
    out = tmp_path / "the run"
    with serve_live(browser, scenario_file(), out) as served:
        page = BridgePage(browser, served.address(), SMALL)
        page.run("live.session.alarms.set('cpa target', true, 'alarm', () => 'CPA')")
        served.session.submit(End())
        page.wait("return document.getElementById('debriefing')")
        assert page.run("return document.querySelectorAll('#alarms li').length") == 0
        said = "return document.querySelector('.over').textContent"
        assert f"shipcollision show '{out}'" in page.run(said)
        assert "server" not in page.run(said)
        gone.set()
        page.wait("return !document.getElementById('debriefing')")
        assert f"Stored in {out}. To see it later: shipcollision show '{out}'" in page.run(said)
        assert page.run(said).endswith("The server has ended as well.")
        assert not page.run("return document.body.classList.contains('lost')")


def assert_places_of_contacts(scratches: dict[str, list[list[float]]], contacts: Path) -> None:
    """Scratches of the page are at places where the model has contact, on each ship."""
    rows = list(csv.DictReader(contacts.read_text(encoding="utf-8").splitlines()))
    for ship, places in scratches.items():
        recorded = {
            tuple(float(row[f"{side}.{axis}"]) for axis in "xyz") for row in rows for side in "ab"
            if row[f"ship_{side}"] == ship
        }  # fmt: skip
        assert {tuple(place) for place in places} <= recorded


@pytest.mark.slow
def test_a_ship_is_steered_into_another_by_keys_and_the_run_is_that_of_the_orders(
    browser: Chrome, tmp_path: Path
) -> None:
    """Own ship would pass ahead of the other; hard over and full ahead it does not. The folder is the run of the orders
    as they were given, to the bit, and the debriefing shows it. From the contact on the run goes on in steps."""
    scenario, out = write_apart(tmp_path, 780.0, 90.0, 0.5), tmp_path / "run"
    assert simulate(load_scenario(scenario), in_process=True, out=tmp_path / "alone").events["collisions"] == []
    with serve_live(browser, scenario, out, rate=10.0, paused=True) as served:
        served.session.listen(lambda event: event["kind"] == "collision begins" and served.session.submit(Pause(True)))
        page = BridgePage(browser, served.address())
        page.wait("return live.state.command.own === live.client")
        page.wait("return document.getElementById('step').offsetWidth > 0")  # it is seen to be paused
        press(page, Keys.ARROW_UP * 2 + Keys.END + "p")
        page.wait("return live.contacts.length > 0")
        press(page, Keys.ENTER + Keys.BACKSPACE + "m")
        served.step_until(served.session.snapshot.time + 20.0)
        page.wait_until(served.session.snapshot.time)
        drawn = page.run("return live.drawn()")
        assert drawn["effects"] > 0
        assert all(drawn["scratches"].values())
        assert page.complaints() == []
        served.session.submit(End())
        page.wait("return document.getElementById('debriefing')")
        browser.find_element(By.ID, "debriefing").click()
        page.wait("return document.body?.dataset.ready === 'true' && window.replay")
        assert page.run("return replay.data.events.length") > 0
    assert_places_of_contacts(drawn["scratches"], out / "contacts.csv")
    simulate(load_scenario(out / "scenario.toml"), in_process=True, out=tmp_path / "again")
    for name in ("states.csv", "contacts.csv", "events.json"):
        assert (out / name).read_bytes() == (tmp_path / "again" / name).read_bytes(), name
