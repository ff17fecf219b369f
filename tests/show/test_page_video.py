"""Full screen and the video of replay.html, by the browser's own means."""

from __future__ import annotations

import subprocess
import time
from pathlib import Path

import imageio_ffmpeg
import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By

from shipcollision_fmu.show.page import write_page

from .browser import PATIENCE, Page

pytestmark = pytest.mark.needs("pybullet")
EBML = bytes.fromhex("1a45dfa3")
"""First bytes of a WebM file: RFC 8794, section 11.2.1."""


PIECES = """
    const { MediaRecorder: Recorder } = window;
    window.pieces = 0;
    window.MediaRecorder = function (...all) {
        window.MediaRecorder = Recorder;
        window.media = new Recorder(...all);
        media.addEventListener("dataavailable", ({ data }) => (pieces += data.size > 0));
        return media;
    };
    window.MediaRecorder.isTypeSupported = (kind) => Recorder.isTypeSupported(kind);
"""
"""Counts the pieces of the next video, each of a frame or more, that are encoded."""
RECORDED = """
    if (replay.time > 2) replay.seek(0.5);
    media.requestData();
    return pieces > 3 && replay.time > 0.3;
"""
"""Whether some frames are in the video. A busy machine draws and encodes few, and the run is not to end before."""


@pytest.fixture(scope="module")
def path(guan2014: Path) -> Path:
    return write_page(guan2014)


@pytest.fixture
def page(browser: Chrome, path: Path) -> Page:
    return Page(browser, path, "lang=en&t=0", (500, 440))


def test_a_video_of_the_picture_is_saved(page: Page, tmp_path: Path) -> None:
    """Another program reads it: it has the picture's size, and frames."""
    page.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    page.run("replay.seek(0)")
    page.run(PIECES)
    page.driver.find_element(By.ID, "record").click()
    page.wait(RECORDED)
    assert page.run("return document.getElementById('record').getAttribute('aria-label')") == "Stop recording"
    page.run("replay.seek(1e9)")  # the run ends, and the video with it
    file = tmp_path / "guan2014.webm"
    deadline = time.monotonic() + PATIENCE
    while not file.is_file() and time.monotonic() < deadline:
        time.sleep(0.05)
    assert file.read_bytes()[:4] == EBML
    width, height = page.run("const c = document.getElementById('picture'); return [c.width, c.height]")
    decode = [imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "gray", "-"]
    decoded = subprocess.run(decode, check=True, capture_output=True).stdout
    assert len(decoded) % (width * height) == 0
    assert len(decoded) // (width * height) >= 2
    assert len(set(decoded[: width * height])) > 50  # shades of sea, sky and ships
    assert page.run("return document.querySelector('.notice').textContent").startswith("Saved guan2014.webm, ")
    assert page.run("return document.getElementById('record').getAttribute('aria-label')") == "Record a video"


def test_a_browser_that_cannot_record_says_so(page: Page) -> None:
    said = page.run("""
        const kept = window.MediaRecorder;
        delete window.MediaRecorder;
        document.getElementById("record").click();
        window.MediaRecorder = kept;
        return document.querySelector(".notice").innerText;
    """)  # at once: it is gone after some seconds
    assert said == "This browser cannot record WebM video. Chromium and Firefox can."


def test_full_screen_and_back(page: Page) -> None:
    button = page.driver.find_element(By.ID, "full-screen")
    button.click()
    page.wait("return document.fullscreenElement?.className === 'stage'")
    page.wait("return document.getElementById('full-screen').getAttribute('aria-pressed') === 'true'")
    button.click()
    page.wait("return document.fullscreenElement === null")
