"""A finished run in Python: three lines, a table of its collisions, data frames and the page in a notebook."""

from __future__ import annotations

import re
import sys
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.support.ui import WebDriverWait

from shipcollision_fmu import HostError, Run, load_scenario, simulate
from shipcollision_fmu.cosim.run_repr import run_html, run_text
from shipcollision_fmu.show.page import build_page
from shipcollision_fmu.show.scene.scene import load_scene
from tests.conftest import Write
from tests.show.browser import PATIENCE


@pytest.fixture
def run(scenario_file: Write) -> Run:
    return simulate(load_scenario(scenario_file()), in_process=True)


def test_a_run_is_three_lines(run: Run) -> None:
    first, second, third = repr(run).splitlines()
    assert re.fullmatch(r"encounter: 60 steps of 0\.05 s, gauss-seidel, in process, \d[\d.e+-]* s of wall time", first)
    (collision,) = run.events["collisions"]
    energy, start = collision["energy"] / 1e6, collision["start"]
    assert start == pytest.approx(
        1.0, abs=0.02
    )  # they reach each other at the end of a substep, or at that of the next
    assert second == f"1 collision, {energy:.4g} MJ lost to contact: own and target at {start:.4g} s"
    for name in re.findall(r"\.(\w+)", third):
        assert hasattr(run, name)


def test_a_run_without_a_collision_says_how_near_the_ships_came(scenario_file: Write) -> None:
    run = simulate(load_scenario(scenario_file(("duration = 3.0", "duration = 0.5"))), in_process=True)
    assert repr(run).splitlines()[1] == f"no collision; least clearance {run.summary['least_clearance']:.3g} m"
    assert "<table>" not in run._repr_html_()
    assert "no collision; least clearance" in run._repr_html_()


def test_many_collisions_fit_the_line(run: Run) -> None:
    events = {"collisions": [{**run.events["collisions"][0], "start": float(k)} for k in range(9)]}
    second = run_text(run.summary, events, run.timing).splitlines()[1]
    assert second.startswith("9 collisions, ")
    assert second.endswith(": own and target at 0 s, own and target at 1 s, own and target at 2 s, ...")


def test_the_table_has_a_row_for_each_collision(run: Run) -> None:
    (collision,) = run.events["collisions"]
    rows = re.findall(r"<tr>(.*?)</tr>", run._repr_html_())
    headings = re.findall(r"<th>(.*?)</th>", rows[0])
    cells = re.findall(r"<td>(.*?)</td>", rows[1])
    assert len(rows) == 2
    assert len(headings) == len(cells)
    found = dict(zip(headings, cells, strict=True))
    assert found["ships"] == "own, target"
    assert float(found["energy [MJ]"]) == pytest.approx(collision["energy"] / 1e6, rel=1e-3)
    assert float(found["angle [deg]"]) == pytest.approx(90.0)
    assert found["Δv [m/s]"].startswith("own ")


def test_text_of_the_run_is_escaped(run: Run) -> None:
    evil = "<script>alert(1)</script>\x1b[2J"
    collision = {**run.events["collisions"][0], "ship_a": evil, "delta_v": {evil: [0.0, 0.0, 1.0]}}
    html = run_html({**run.summary, "scenario": evil}, {"collisions": [collision]}, run.timing)
    assert "<script" not in html
    assert "\x1b" not in html.partition("<table>")[0]
    assert html.count("&lt;script&gt;") == 3


def test_the_tables_are_data_frames(run: Run) -> None:
    frames = run.to_pandas()
    assert frames._fields == ("states", "contacts", "signals")
    for frame, table in ((frames.states, run.states), (frames.signals, run.signals)):
        assert frame.index.name == "time"
        assert np.array_equal(frame.index, table["time"])
        assert tuple(frame.columns) == table.dtype.names[1:]  # type: ignore[index]  # structured arrays have names
        for column in frame.columns:
            assert np.array_equal(frame[column], table[column])
    assert tuple(frames.contacts.columns) == run.contacts.dtype.names
    assert frames.contacts["ship_b"].tolist() == run.contacts["ship_b"].tolist()
    assert frames.contacts.groupby("impact")["energy"].sum()[1] == pytest.approx(run.events["collisions"][0]["energy"])


def test_a_data_frame_is_a_copy(run: Run) -> None:
    before = run.states["own.velocity.surge"].copy()
    states = run.to_pandas().states
    states.loc[:, "own.velocity.surge"] = 1.0
    assert np.array_equal(run.states["own.velocity.surge"], before)


def test_pandas_that_is_missing_is_one_line_with_the_command(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(HostError) as refused:
        run.to_pandas()
    assert str(refused.value) == (
        "Run.to_pandas needs pandas, which is not installed: run "
        f"`{sys.executable} -m pip install 'shipcollision-fmu[pandas]'` (in a clone: '.[pandas]')"
    )


def test_the_page_of_a_notebook_is_that_of_the_runs_folder(run: Run, tmp_path: Path) -> None:
    run.write(tmp_path / "run")
    page = run.page(height=500)
    assert page.text == build_page(load_scene(tmp_path / "run"))
    frame = page._repr_html_()
    found = re.fullmatch(
        r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts" style="[^"]*height: 500px[^"]*"></iframe>', frame
    )
    assert found is not None
    assert unescape(found[1]) == page.text
    assert "<!doctype" not in repr(page)


def test_the_page_plays_inside_a_notebook(run: Run, tmp_path: Path, browser: Chrome) -> None:
    notebook = tmp_path / "notebook.html"
    notebook.write_text(f"<!doctype html><meta charset='utf-8'><p>cell</p>{run.page()._repr_html_()}", encoding="utf-8")
    browser.set_window_size(500, 440)  # drawing takes long without a graphics card
    browser.get_log("browser")  # of pages before
    browser.get(notebook.as_uri())
    browser.switch_to.frame(0)
    WebDriverWait(browser, PATIENCE, poll_frequency=0.05).until(
        lambda d: d.execute_script("return document.body?.dataset.ready")
    )
    assert browser.execute_script("return document.body.dataset.ready") == "true"
    assert browser.execute_script("replay.seek(2.0); return Object.keys(replay.drawn().poses)") == ["own", "target"]
    assert browser.execute_script("try { return parent.document.title } catch { return null }") is None
    assert [entry["message"] for entry in browser.get_log("browser")] == []
