"""What the bridge shows: the picture, its cameras, numbers, alarms, and words in the chosen language."""

from __future__ import annotations

import pytest
from selenium.webdriver import Chrome, Keys
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from tests.live.page.live_server import BridgePage, LiveServer, press

FRAMES = """
    const done = arguments[arguments.length - 1], before = live.drawn().frames;
    let left = 12;
    const next = () => (left-- ? requestAnimationFrame(next) : done(live.drawn().frames - before));
    requestAnimationFrame(next);
"""


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


@pytest.mark.slow
def test_an_alarm_of_a_slow_machine_ends_once_it_keeps_up(bridge: BridgePage) -> None:
    """While the lag is still told, the rate that is measured may be that which is set, or more."""
    for rate, is_slow in ((3.9, True), (3.95, False), (5.1, False)):
        bridge.run(
            f"live.session.watch({{...live.state, rate: 4, paused: false, paced: false, real_rate: {rate}}});"
            "window.slow = live.session.alarms.list.has('slow')"
        )
        assert bridge.run("return slow") is is_slow


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
