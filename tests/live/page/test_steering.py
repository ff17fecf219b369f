"""The ship is steered by keys and by mouse; what is ordered is shown, and what is refused never looks taken."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from math import degrees

import pytest
from selenium.webdriver import ActionChains, Keys
from selenium.webdriver.common.by import By

from shipcollision_fmu.live.session.commands import Fail
from tests.live.page.live_server import PATIENCE, BridgePage, LiveServer, press


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


@contextmanager
def stuck_rudder(bridge: BridgePage, server: LiveServer) -> Iterator[None]:
    """The rudder is stuck, and the page has seen it."""
    server.session.submit(Fail("own", "rudder", True)).result(PATIENCE)
    try:
        bridge.wait("return live.state.ships.own.failures.length > 0")
        yield
    finally:
        server.session.submit(Fail("own", "rudder", False)).result(PATIENCE)


def press_refused(bridge: BridgePage, keys: str) -> None:
    """Keys of an order, until the page says that it is refused."""
    press(bridge, keys)
    bridge.wait(f"return document.querySelector('.messages').textContent.includes('{STUCK}')")


def test_a_refused_order_never_looks_taken(bridge: BridgePage, server: LiveServer) -> None:
    press(bridge, "m")
    bridge.wait("return live.state.ships.own.heading_order === null")
    bridge.wait("return document.getElementById('autopilot').ariaPressed === 'false'")
    with stuck_rudder(bridge, server):
        bridge.run(PRESSED)
        press_refused(bridge, "a")
        assert bridge.run("return pressed.includes('true')") is False
        press_refused(bridge, Keys.END)
        ordered = "live.state.ships.own.rudder_order * 180 / Math.PI"
        bridge.wait(f"return Math.abs(document.getElementById('wheel').ariaValueNow - {ordered}) < 1")
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
    with stuck_rudder(bridge, server):
        bridge.run(PRESSED)
        press_refused(bridge, "a")
        assert bridge.run("return pressed.includes('true')") is False
        bridge.run("frames_again()")
        bridge.wait("return document.getElementById('wheel').ariaValueNow === '0'")
        assert bridge.run("return pressed.includes('true')") is False


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
