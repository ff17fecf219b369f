"""compare.html, the page of two runs: ships and outlines, curves, tracks, and the differences of collisions."""

from __future__ import annotations

import csv
import shutil
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from selenium.webdriver import Chrome

from shipcollision_fmu.cli import main
from shipcollision_fmu.show.page import build_comparison
from shipcollision_fmu.show.scene.scene import load_scene

from .browser import Page
from .conftest import MakeRun
from .live.javascript import run_javascript

ABSENT = "\u2013"


@pytest.fixture
def runs(meeting: MakeRun, tmp_path: Path) -> tuple[Path, Path]:
    """Folders of the meeting of two barges, and of the same at half the speed."""
    slow = shutil.move(meeting(("speed = 4.0", "speed = 2.0")), tmp_path / "slow")
    fast = shutil.move(meeting(), tmp_path / "fast")
    return Path(fast), Path(slow)


def compared(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, ["show", *map(str, arguments)])


def event(time: float, a: str, b: str, **more: Any) -> dict[str, Any]:
    return {"time": time, "ship_a": a, "ship_b": b, **more}


def test_collisions_are_paired_by_ships_and_order() -> None:
    first = [event(1.0, "a", "b"), event(2.0, "a", "c"), event(3.0, "b", "a")]
    second = [event(1.5, "b", "a"), event(9.0, "b", "c")]
    pairs = run_javascript("pairs.js", "pairCollisions", "return pairCollisions(...data)", [first, second])
    times = [tuple(one and one["time"] for one in pair) for pair in pairs]
    assert times == [(1.0, 1.5), (2.0, None), (3.0, None), (None, 9.0)]


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ((1.0, 1.5), ["1.00", "1.50", "+0.50"]),
        ((1.5, 1.0), ["1.50", "1.00", "\u22120.50"]),
        ((1.0, 1.001), ["1.00", "1.00", "0.00"]),
        ((1.0, None), ["1.00", ABSENT, ABSENT]),
    ],
)
def test_a_row_gives_both_values_and_their_difference(values: tuple[float, float | None], wanted: list[str]) -> None:
    pair = [None if value is None else event(value, "a", "b") for value in values]
    body = "return describeRow({ of: ({ time }) => time, digits: 2 }, data)"
    assert run_javascript("pairs.js", "describeRow", body, pair) == wanted


def test_the_page_shows_both_runs(browser: Chrome, runs: tuple[Path, Path]) -> None:
    fast, slow = runs
    result = compared(fast, "--compare", slow)
    assert (result.exit_code, result.stdout) == (0, f"{fast / 'compare.html'}: open it in a browser\n")
    page = Page(browser, fast / "compare.html", "lang=en", (700, 440))
    time = 1.0
    drawn = page.slide(time)
    for folder, found in ((fast, {n: p["position"] for n, p in drawn["poses"].items()}), (slow, drawn["others"])):
        with (folder / "states.csv").open(newline="") as file:
            row = next(row for row in csv.DictReader(file) if abs(float(row["time"]) - time) < 1e-9)
        assert set(found) == {"own", "target"}
        for name, position in found.items():
            wanted = [float(row[f"{name}.position.{axis}"]) for axis in ("north", "east", "down")]
            assert position == pytest.approx(wanted, abs=0.01)
    text = page.run("return document.querySelector('.comparison').innerText")
    assert text.split("\n")[0].split() == ["fast", "slow", "Difference"]
    events = [load_scene(folder).events for folder in runs]
    row = page.run(
        "return [...document.querySelectorAll('.comparison tr')].find((row) => row.innerText.startsWith('Energy'))"
        ".innerText.split(/\\s+/)"
    )
    energies = [events[k][0].energy / 1e6 for k in range(2)]
    shown = [float(value.replace("\u2212", "-")) for value in row[2:]]
    assert shown == pytest.approx([*energies, energies[1] - energies[0]], abs=0.051)
    assert page.run("return document.querySelectorAll('.plan .hull.other').length") == 2
    chips = page.run("return document.querySelectorAll('[data-plot=speed] .chip.other').length")
    assert chips == 2
    page.run("replay.drawn()")
    both = page.fingerprint()
    page.run("replay.showOther(false); replay.drawn()")
    assert page.fingerprint() != both  # the outlines are in the picture
    assert page.complaints() == []
    assert "fast: ships, solid lines" in page.run("return document.querySelector('.panel').innerText")


@pytest.mark.needs("pybullet")
def test_two_runs_are_within_four_megabytes(guan2014: Path) -> None:
    scene = load_scene(guan2014)
    assert len(build_comparison(scene, "one", scene, "two").encode()) < 4e6


def test_what_cannot_be_compared_is_refused(runs: tuple[Path, Path], tmp_path: Path) -> None:
    fast, slow = runs
    same = compared(fast, "--compare", fast)
    assert same.exit_code == 2
    assert same.stderr == f"error: {fast} is the run itself: give --compare the folder of another run\n"
    absent = compared(fast, "--compare", tmp_path / "none")
    assert absent.exit_code == 2
    assert absent.stderr.startswith(f"error: {tmp_path / 'none'} does not exist")
    both = compared(fast, "--compare", slow, "--glb")
    assert both.exit_code == 2
    assert "--glb shows one run, and --compare two: leave one of them out" in both.stderr
    assert not (fast / "compare.html").exists()
