"""A server that is gone, a run that has ended, a ship that is not there."""

from __future__ import annotations

import asyncio
from pathlib import Path
from threading import Event

import pytest
from selenium.webdriver import Chrome, Keys

from shipcollision_fmu.live.server import serve as serve_module
from shipcollision_fmu.live.server.app import LiveApp
from shipcollision_fmu.live.session.commands import End
from tests.conftest import Write
from tests.live.page.live_server import SMALL, BridgePage, LiveServer, press, serve_live

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
