"""Processor time of a picture of the pages without a graphics card, and pictures per second while a run plays.

    python benchmarks/page_frames.py [SECONDS]         of play in each round, default 5

Needs Linux, Chromium and the extra `test`. The page of `kvlcc2_crossing` and the bridge of a live run of it are open in
a window of 1280 x 720 pixels; SwiftShader draws them on the processor. `bare` is the page without its panel. A browser
without a graphics card puts pages together in one of two ways: by SwiftShader too, as in the tests, or by itself.

    at rest      processor time of all processes of the browser for a picture with all pixels, the least of ROUNDS, and
                 against that of a picture of one triangle of the same size in the same browser
    playing      pictures per second, processor time of each, share of the pixels in each direction that is drawn, and
                 the share of the machine that the browser had meanwhile: other work takes the rest
"""

# ruff: noqa: E402 - the tests' browser is found only when the root of the project is on the path
from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from time import perf_counter
from typing import Any

from selenium.webdriver import Chrome

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from shipcollision_fmu import simulate
from shipcollision_fmu.cli.console import print_table, say
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.show.page import write_page
from tests.live.page.live_server import BridgePage, serve_live
from tests.show import browser as tests_browser
from tests.show.browser import Page, chromium

ROUNDS, PICTURES, SIZE = 2, 6, (1280, 720)
SETTLE = 8.0
"""[s] of play before the first round, in which the page finds how many pixels there is time for."""
WAYS = {"SwiftShader": (), "processor": ("--disable-gpu",)}
"""How pages are put together, and what the browser is told besides or in place of the tests' flags."""
FULL = "bare&camera=all"
VIEWS = {"overview, bare": FULL, "overview": "camera=all", "impact with fire, bare": "bare&camera=impact"}
TIMES = {"impact with fire, bare": 30.0}
"""Where a view is looked at [s], if not at 5 s."""

HEADS = (
    "put together by", "view", "picture", ">at rest [ms]", ">per triangle", ">playing [1/s]", ">each [ms]",
    ">pixels", ">machine",
)  # fmt: skip

TRIANGLE = """
<!doctype html><body style="margin:0"><canvas id="picture" width="1280" height="720"></canvas><script>
const gl = document.getElementById("picture").getContext("webgl2", {antialias: false, preserveDrawingBuffer: true});
const program = gl.createProgram();
for (const [kind, text] of [[gl.VERTEX_SHADER, `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 0.5 : -0.5, gl_VertexID == 2 ? 0.5 : -0.5, 0.0, 1.0); }`],
[gl.FRAGMENT_SHADER, `#version 300 es
precision highp float; out vec4 colour; void main() { colour = vec4(1.0); }`]]) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(program, shader);
}
gl.linkProgram(program); gl.useProgram(program);
window.replay = {time: 0, seek(time) { gl.clear(gl.COLOR_BUFFER_BIT); gl.drawArrays(gl.TRIANGLES, 0, 3); }};
document.body.dataset.ready = "true";
</script></body>
"""
MANY = """
    const [count, done] = [arguments[0], arguments[arguments.length - 1]], from = (window.from ??= replay.time);
    let i = 0;
    const next = () => (i++ < count ? (replay.seek(from + 0.02 * i), requestAnimationFrame(next)) : done());
    requestAnimationFrame(next);
"""
COUNT = """
    const [seconds, done] = [arguments[0], arguments[arguments.length - 1]], start = performance.now();
    let frames = 0;
    const next = () => {
      frames++;
      if (performance.now() - start < 1000 * seconds) return requestAnimationFrame(next);
      const canvas = document.getElementById("picture");
      done([frames, (performance.now() - start) / 1000, canvas.width / canvas.clientWidth]);
    };
    requestAnimationFrame(next);
"""


def processor_time(root: int) -> float:
    """Processor time [s] that a process and all below it have taken."""
    children: dict[int, list[int]] = {}
    taken: dict[int, float] = {}
    for entry in Path("/proc").iterdir():
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split() if entry.name.isdigit() else None
        except OSError:  # it has ended
            continue
        if fields is not None:
            children.setdefault(int(fields[1]), []).append(int(entry.name))
            taken[int(entry.name)] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    found, total = [root], 0.0
    while found:
        process = found.pop()
        total += taken.get(process, 0.0)
        found += children.get(process, [])
    return total


def rest_cost(driver: Chrome, root: int, pictures: int = PICTURES) -> float:
    """Processor time of a picture of the open page with all pixels [ms]."""
    driver.execute_async_script(MANY, 1)
    costs = []
    for _ in range(ROUNDS):
        before = processor_time(root)
        driver.execute_async_script(MANY, pictures)
        costs.append(1000.0 * (processor_time(root) - before) / pictures)
    return min(costs)


def play_figures(driver: Chrome, root: int, seconds: float) -> tuple[float, float, float, float]:
    """Pictures per second, processor time of one [ms], share of the pixels, share of the machine, of what plays."""
    driver.execute_async_script(COUNT, SETTLE)
    before, start = processor_time(root), perf_counter()
    frames, took, share = driver.execute_async_script(COUNT, seconds)
    spent = processor_time(root) - before
    return frames / took, 1000.0 * spent / frames, share, spent / (perf_counter() - start) / (os.cpu_count() or 1)


def measure(driver: Chrome, way: str, page: Path, triangle: Path, seconds: float) -> list[tuple[Any, ...]]:
    """Rows of the table for a browser."""
    root = driver.service.process.pid
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": SIZE[0], "height": SIZE[1], "deviceScaleFactor": 1, "mobile": False},
    )
    Page(driver, triangle)
    least = rest_cost(driver, root)
    rows: list[tuple[Any, ...]] = [(way, "one triangle", "", f"{least:.0f}", "1", "", "", "", "")]
    Page(driver, page, f"{FULL}&plain=no")
    cost = rest_cost(driver, root, 2)  # of seconds each
    rows.append((way, "overview, bare", "full", f"{cost:.0f}", f"{cost / least:.1f}", "", "", "", ""))
    for view, wishes in VIEWS.items():
        Page(driver, page, f"{wishes}&plain=yes")
        at = TIMES.get(view, 5.0)
        driver.execute_script("replay.slow(false); replay.seek(arguments[0])", at)
        cost = rest_cost(driver, root)
        driver.execute_script("replay.seek(arguments[0]); replay.play()", at)
        played = figures(play_figures(driver, root, seconds))
        rows.append((way, view, "plain", f"{cost:.0f}", f"{cost / least:.1f}", *played))
    with serve_live(driver, "kvlcc2_crossing") as served:
        bridge = BridgePage(driver, served.address())
        bridge.wait("return live.state !== null")
        rows.append((way, "live bridge", "plain", "", "", *figures(play_figures(driver, root, seconds))))
    return rows


def figures(found: tuple[float, float, float, float]) -> tuple[str, ...]:
    rate, cost, share, ours = found
    return f"{rate:.1f}", f"{cost:.0f}", f"{share:.2f}", f"{100 * ours:.0f} %"


def main() -> None:
    """Measure, and print a table."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 5.0
    rows = []
    flags = tests_browser.FLAGS
    with tempfile.TemporaryDirectory() as folder:
        simulate("kvlcc2_crossing", in_process=True, out=Path(folder, "run"))
        page = write_page(Path(folder, "run"))
        triangle = Path(folder, "triangle.html")
        triangle.write_text(TRIANGLE, encoding="utf-8")
        for way, more in WAYS.items():
            kept = [flag for flag in flags if not (more and flag.startswith("--use-"))]
            tests_browser.FLAGS = (*kept, *more)  # type: ignore[assignment]
            with chromium(Path(folder, f"profile {way}")) as driver:
                rows += measure(driver, way, page, triangle, seconds)
    shown = make_table(*HEADS, title="page frames")
    for row in rows:
        shown.add_row(*row)
    print_table(shown)
    say(f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}")


main()
