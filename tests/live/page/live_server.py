"""A live run with its server, in threads of the test."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Event, Thread
from typing import Any

from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

from shipcollision_fmu import load_scenario
from shipcollision_fmu.live.server.access import Tokens
from shipcollision_fmu.live.server.app import LiveApp
from shipcollision_fmu.live.server.serve import bind, serve
from shipcollision_fmu.live.session.commands import End, Pause, Step
from shipcollision_fmu.live.session.session import Session
from tests.show.browser import Page

__all__ = ["PATIENCE", "SMALL", "BridgePage", "LiveServer", "press", "serve_live"]

PATIENCE = 300.0
"""[s] for a server to start or to stop, and for a page: many times what it takes, as the machine may be busy."""
SMALL = (500, 440)
"""Size of the window [pixels] where drawing takes long without a graphics card."""


@dataclass(frozen=True)
class LiveServer:
    """A live run that is served."""

    session: Session
    port: int

    def address(self, role: str = "bridge") -> str:
        return f"http://127.0.0.1:{self.port}{'/' if role == 'bridge' else '/instructor'}?token={role}"

    def pause(self, paused: bool = True) -> None:
        """Stops the simulation for what a busy page would miss, or lets it go on."""
        self.session.submit(Pause(paused)).result(PATIENCE)

    def step(self) -> None:
        """A step of a paused simulation."""
        self.session.submit(Step()).result(PATIENCE)

    def step_until(self, time: float) -> None:
        """Steps of a paused simulation up to a time [s]."""
        while self.session.snapshot.time < time - 1e-9:
            self.step()


class BridgePage(Page):
    """A live page, open."""

    def __init__(self, driver: Chrome, address: str, size: tuple[int, int] = (920, 440)) -> None:
        self.driver, self._address, self._size = driver, address, size
        self.open()

    def wait(self, script: str) -> None:
        """Until JavaScript returns something true."""
        WebDriverWait(self.driver, PATIENCE, poll_frequency=0.03).until(lambda d: d.execute_script(script), script)

    def wait_for(self, step_count: int) -> None:
        """Until a paused run after so many steps is what the page has."""
        self.wait(f"return live.state?.paused && live.state.step_count === {step_count}")

    def wait_until(self, time: float) -> None:
        """Until a paused run of that time [s] is in the page's frames."""
        self.wait(f"return live.session.present(performance.now())?.time > {time - 1e-6}")
        self.wait_for_frame()

    def state(self, path: str = "") -> Any:
        """The latest state, or a part of it such as ".ships.own"."""
        return self.run(f"return live.state{path}")


@contextmanager
def serve_live(browser: Chrome, scenario: str | Path, out: Path | None = None, **options: Any) -> Iterator[LiveServer]:
    """Serves a scenario until the end of the block; the browser leaves the page before, as the server waits for it."""
    session = Session(load_scenario(scenario), out=out, **options)
    listening, ready = bind("127.0.0.1", 0), Event()
    app = LiveApp(session, "own", tokens=Tokens("bridge", "instructor"))
    thread = Thread(target=serve, args=(app, listening, ready.set), daemon=True)
    thread.start()
    assert ready.wait(PATIENCE)
    try:
        yield LiveServer(session, listening.getsockname()[1])
    finally:
        for handle in browser.window_handles[1:]:
            browser.switch_to.window(handle)
            browser.close()
        browser.switch_to.window(browser.window_handles[0])
        browser.get("about:blank")
        session.submit(End())
        thread.join(PATIENCE)
        listening.close()
    assert not thread.is_alive()


def press(page: BridgePage, keys: str) -> None:
    """Keys, at the picture."""
    page.driver.find_element(By.ID, "picture").send_keys(keys)
