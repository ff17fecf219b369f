"""The search of a site that is opened from a file: the frame that takes the worker's place, in a browser."""

from __future__ import annotations

from pathlib import Path
from shutil import copy

from selenium.webdriver import Chrome
from selenium.webdriver.support.ui import WebDriverWait

FRAME = Path(__file__).parents[2] / "docs" / "iframe-worker.js"
WORKER = "addEventListener('message', (event) => postMessage(`${event.data} is ${index[event.data]}`));"
PAGE = """<!doctype html><title>asking</title><script src="iframe-worker.js"></script><body><script>
  const worker = new Worker("folder/worker.js");
  worker.addEventListener("message", (event) => { document.title = event.data; });
  worker.postMessage("friction");
</script></body>"""


def test_a_page_from_a_file_has_a_worker(browser: Chrome, tmp_path: Path) -> None:
    copy(FRAME, tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "worker.js").write_text(f"const index = {{friction: 0.3}};\n{WORKER}\n", encoding="utf-8")
    page = tmp_path / "page.html"
    page.write_text(PAGE, encoding="utf-8")
    browser.get(page.as_uri())
    WebDriverWait(browser, 60.0).until(lambda driver: driver.title == "friction is 0.3")


def test_the_theme_takes_this_frame_and_none_from_the_network() -> None:
    settings = (FRAME.parents[1] / "mkdocs.yml").read_text(encoding="utf-8")
    assert f"\n    - {FRAME.name}\n" in settings
    assert "\n  - offline\n" in settings
