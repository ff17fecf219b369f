"""The instructor takes ships, sets failures, wind and current, and goes back to marks."""

from __future__ import annotations

import pytest
from selenium.webdriver import Chrome, Keys
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from shipcollision_fmu.live.session.commands import Mark
from tests.live.live_server import eventually
from tests.live.page.live_server import PATIENCE, BridgePage, LiveServer


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


def test_the_log_of_the_instructor_survives_a_reload(browser: Chrome, server: LiveServer) -> None:
    page = BridgePage(browser, server.address("instructor"))
    page.wait("return live.state")
    server.session.submit(Mark("to be kept")).result(PATIENCE)
    page.wait("return document.getElementById('book').textContent.includes('Mark to be kept')")
    before = page.run("return [...document.querySelectorAll('#book li')].map(({ textContent }) => textContent)")
    page.run("location.reload()")
    page.wait("return window.live?.state && document.querySelector('#book li')")
    after = page.run("return [...document.querySelectorAll('#book li')].map(({ textContent }) => textContent)")
    assert after[-len(before) :] == before
