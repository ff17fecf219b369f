"""The replay page in Debian's Chromium, without a screen, drawn by the processor."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from selenium.webdriver import Chrome
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

__all__ = ["PATIENCE", "Page", "chromium"]

FLAGS = (
    "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--disable-dev-shm-usage",
)  # fmt: skip
PATIENCE = 300.0
"""Wait for a page [s], a hundred times what it takes: the machine may be busy with other work."""
AROUND = """
    const [x, y, half] = arguments;
    const canvas = document.getElementById("picture");
    const gl = canvas.getContext("webgl2");
    const scale = canvas.width / canvas.clientWidth;
    const size = 2 * half + 1;
    const pixels = new Uint8Array(4 * size * size);
    gl.readPixels(Math.round(x * scale) - half, canvas.height - Math.round(y * scale) - half, size, size,
                  gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return Array.from(pixels);
"""
WHOLE = """
    const canvas = document.getElementById("picture");
    const gl = canvas.getContext("webgl2");
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let digest = 2166136261;
    for (const pixel of new Uint32Array(pixels.buffer)) digest = Math.imul(digest ^ pixel, 16777619) >>> 0;
    return digest;
"""


class Page:
    """A replay page, open."""

    def __init__(self, driver: Chrome, path: Path, wishes: str = "", size: tuple[int, int] = (920, 560)) -> None:
        self.driver, self.path = driver, path
        self._address, self._size = f"{path.as_uri()}{wishes and '#'}{wishes}", size
        self.open()

    def open(self) -> None:
        """Opens the page, unless the browser has it open."""
        if self.driver.current_url == self._address:
            return
        self.driver.set_window_size(*self._size)
        self.driver.get("about:blank")
        for kind in ("performance", "browser"):
            self._logged(kind)  # of the page before
        self.driver.get(self._address)
        self.wait("return document.body?.dataset.ready")
        assert self.run("return document.body.dataset.ready") == "true", self.complaints()
        self._wait_for_size()

    def resize(self, width: int, height: int) -> None:
        """Gives the window another size, and waits for the picture in it: until then it may be empty."""
        self.driver.set_window_size(width, height)
        self.wait(f"return outerWidth === {width} && outerHeight === {height}")
        self._wait_for_size()

    def _wait_for_size(self) -> None:
        """What is drawn once its size is known comes after the first frame's scripts."""
        for _ in range(2):
            self.wait_for_frame()

    def wait(self, script: str) -> None:
        """Until JavaScript returns something true."""
        WebDriverWait(self.driver, PATIENCE, poll_frequency=0.05).until(lambda d: d.execute_script(script))

    def run(self, script: str, *arguments: Any) -> Any:
        """Runs JavaScript in the page; its `return` comes back."""
        return self.driver.execute_script(script, *arguments)

    def slide(self, time: float) -> dict[str, Any]:
        """Moves the time slider as a hand does, and says what is in the picture then."""
        self.run(
            "const slider = document.getElementById('time'); slider.value = arguments[0];"
            "slider.dispatchEvent(new Event('input'));",
            time,
        )
        drawn: dict[str, Any] = self.run("return replay.drawn()")
        return drawn

    def wait_for_frame(self) -> None:
        """Waits for what the page has put off to its next frame, such as the numbers beside the curves."""
        self.driver.execute_async_script("requestAnimationFrame(arguments[arguments.length - 1]);")

    def colour(self, point: Any, half: int = 2) -> tuple[float, float, float]:
        """Mean red, green, blue, 0 to 255, of the pixels around where a point in n [m] is in the picture."""
        x, y = self.run("return replay.project(arguments[0])", [float(c) for c in point])
        pixels = self.run(AROUND, x, y, half)
        n = len(pixels) // 4
        red, green, blue = (sum(pixels[k::4]) / n for k in range(3))
        return (red, green, blue)

    def fingerprint(self) -> int:
        """A digest of all pixels of the picture."""
        return int(self.run(WHOLE))

    def complaints(self) -> list[str]:
        """Errors and warnings on the console since the last call."""
        return [f"{entry['level']}: {entry['message']}" for entry in self._logged("browser")]

    def requests(self) -> list[str]:
        """Addresses that were asked for since the last call."""
        messages = [json.loads(entry["message"])["message"] for entry in self._logged("performance")]
        return [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]

    def _logged(self, kind: str) -> list[dict[str, Any]]:
        entries: list[dict[str, Any]] = self.driver.get_log(kind)
        return entries


@contextmanager
def chromium(profile: Path) -> Iterator[Chrome]:
    """A browser with an empty profile in a folder; tests/needs.py has found the two programs."""
    options = Options()
    options.binary_location = str(shutil.which("chromium"))
    for flag in (*FLAGS, f"--user-data-dir={profile}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = Chrome(options=options, service=Service(shutil.which("chromedriver")))
    try:
        driver.set_script_timeout(PATIENCE)
        yield driver
    finally:
        driver.quit()
