"""`shipcollision show` of a study: page, figures, data, the worst cases, and its refusals."""

from __future__ import annotations

import csv
import importlib.util
import json
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner, Result
from selenium.webdriver import Chrome

from shipcollision_fmu import __version__, run_study
from shipcollision_fmu.cli import main
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.show import extras
from shipcollision_fmu.study.definition.study import parse_study
from shipcollision_fmu.study.report import figures
from tests.study.rows import test_situations

TEXT = """
[study]
name = "harbour"
level = "impact"
rows = 400
seed = 3

[own]
ships = ["kcs", "kvlcc2"]

[encounter]
kind = "crossing"
angle_deg = { distribution = "uniform", least = 5.0, most = 175.0 }
at = { distribution = "uniform", least = -0.5, most = 0.5 }
own_speed = { distribution = "uniform", least = 1.0, most = 9.0 }
target_speed = { distribution = "uniform", least = 0.0, most = 9.0 }
"""
CHARTS = (
    "convergence", "energy_by_angle", "energy_by_place", "exceedance_energy", "exceedance_impulse", "sensitivity",
)  # fmt: skip


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the study, shown."""
    out = tmp_path_factory.mktemp("report") / "harbour"
    run_study(parse_study(TEXT), out, workers=0)
    assert called("show", out, "--no-replays").exit_code == 0
    return out


@pytest.fixture
def folder(finished: Path, tmp_path: Path) -> Path:
    """A copy of that folder, to be changed."""
    return Path(
        shutil.copytree(finished, tmp_path / "harbour", ignore=shutil.ignore_patterns("report.html", "figures"))
    )


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are empty, which saves a second and a half: for tests of what the page says, and of the data."""
    monkeypatch.setattr(figures, "save_figure", lambda figure, kind: b"")


def shown(folder: Path) -> Result:
    return called("show", folder, "--no-replays")


def called(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, list(map(str, arguments)))


def read_page(folder: Path) -> str:
    return (folder / "report.html").read_text(encoding="utf-8")


def read_figure(folder: Path, name: str) -> dict[str, list[str]]:
    with (folder / "figures" / f"{name}.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: [row[key] for row in rows] for key in rows[0]}


def read_done(folder: Path) -> Any:
    table = pq.read_table(folder / "encounters")
    return table.filter(pc.equal(table["status"], "done"))


def change_part(folder: Path, column: str, values: Any) -> None:
    """Puts a column into the only part of a study."""
    (path,) = (folder / "encounters").iterdir()
    table = pq.read_table(path)
    metadata = table.schema.metadata
    if column in table.schema.names:
        table = table.drop([column])
    pq.write_table(table.append_column(column, values).replace_schema_metadata(metadata), path)


def test_every_figure_is_there_in_three_forms(finished: Path) -> None:
    names = {path.name for path in (finished / "figures").iterdir()}
    assert names == {f"{chart}.{kind}" for chart in CHARTS for kind in ("png", "svg", "csv")}
    page = read_page(finished)
    assert page.count("data:image/svg+xml;base64,") == len(CHARTS)
    assert not re.search(r"(src|href)=\"(https?:)?//", page)
    assert [link for link in re.findall(r'href="(figures/[^"]+)"', page) if not (finished / link).is_file()] == []


@pytest.mark.parametrize("width", [1280, 390])
def test_a_browser_shows_it_without_a_network(finished: Path, browser: Chrome, width: int) -> None:
    """All figures are drawn, nothing sticks out at the side, and no other address is asked for."""
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        browser.get("about:blank")
        browser.get_log("performance")
        browser.get_log("browser")
        browser.get((finished / "report.html").as_uri())
        drawn = browser.execute_script("return Array.from(document.images, i => i.complete ? i.naturalWidth : 0)")
        assert len(drawn) == len(CHARTS)
        assert min(drawn) > 300
        assert browser.execute_script("return document.documentElement.scrollWidth") <= width
        messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
        asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
        assert [url for url in asked if not url.startswith("data:")] == [(finished / "report.html").as_uri()]
        assert browser.get_log("browser") == []
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


@pytest.mark.usefixtures("undrawn")
def test_few_cases_have_few_bins_and_no_quantile_of_99_percent(tmp_path: Path) -> None:
    run_study(parse_study(TEXT.replace("rows = 400", "rows = 130")), tmp_path / "few", workers=0)
    assert shown(tmp_path / "few").exit_code == 0
    assert set(read_figure(tmp_path / "few", "convergence")["quantile"]) == {"nan"}
    assert len(read_figure(tmp_path / "few", "energy_by_angle")["cases"]) == 3


def test_curve_and_cases_are_those_of_the_tables(finished: Path) -> None:
    done = read_done(finished)
    energy = done["energy"].to_numpy()
    curve = read_figure(finished, "exceedance_energy")
    assert float(curve["energy"][-1]) == energy.max()
    assert float(curve["share"][-1]) == pytest.approx(1.0 / len(energy))
    middle = len(curve["energy"]) // 2
    assert float(curve["share"][middle]) == np.mean(energy >= float(curve["energy"][middle]))
    assert float(read_figure(finished, "convergence")["mean"][-1]) == pytest.approx(energy.mean())
    assert sum(map(int, read_figure(finished, "energy_by_angle")["cases"])) == len(energy)
    assert {"own speed", "own mass", "angle"} <= set(read_figure(finished, "sensitivity")["input"])


def test_the_page_says_what_is_left_out(finished: Path) -> None:
    done, page = read_done(finished).num_rows, read_page(finished)
    assert 0 < done < 400
    assert f"{done} of 400 cases are done, at level impact" in page
    assert f"{400 - done} cases ({100 * (400 - done) / 400:.3g} %) are refused" in page
    assert "not finished" not in page


def find_worst_rows(folder: Path) -> list[int]:
    done = read_done(folder)
    worst: list[int] = done["row"].to_numpy()[np.argsort(-done["energy"].to_numpy(), kind="stable")[:10]].tolist()
    return worst


@pytest.mark.usefixtures("undrawn")
def test_the_worst_ten_run_again_by_their_lines(finished: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = find_worst_rows(finished)
    lines = re.findall(r'<code class="line">([^<]+)</code>', read_page(finished))
    assert lines == [f"shipcollision show . --row {row}" for row in expected]
    monkeypatch.chdir(folder)
    result = called(*lines[0].split()[1:])
    row, page = expected[0], f"replays/row-{expected[0]}/replay.html"
    assert result.stdout.splitlines() == [
        f"row {row}, computed again, has the numbers of the table", f"{page}: open it in a browser"
    ]  # fmt: skip
    events = json.loads((folder / page).with_name("events.json").read_text())["collisions"]
    (line,) = read_done(folder).filter(pc.equal(read_done(folder)["row"], row)).to_pylist()
    assert events[0]["closing_speed"] == pytest.approx(line["closing_speed"], rel=1e-9)
    assert events[0]["first_point"]["b_a"] == pytest.approx([line[f"own_{axis}"] for axis in "xyz"], abs=1e-5)
    assert shown(folder).exit_code == 0
    assert re.findall(r'<a href="(replays/[^"]+)">', read_page(folder)) == [page]  # that of the others is a line still


@pytest.mark.slow
def test_the_page_leads_to_the_replays(folder: Path, browser: Chrome) -> None:
    """The links of the ten worst cases open pages that show their ships, from a file."""
    assert called("show", folder).exit_code == 0
    links = re.findall(r'<a href="(replays/[^"]+)">replay</a>', read_page(folder))
    assert links == [f"replays/row-{row}/replay.html" for row in find_worst_rows(folder)]
    assert "<code class" not in read_page(folder)
    browser.get((folder / "report.html").as_uri())
    browser.find_element("link text", "replay").click()
    assert browser.current_url == (folder / links[0]).as_uri()
    assert browser.title == f"harbour_{find_worst_rows(folder)[0]}"


def test_a_row_with_other_numbers_than_the_table_is_said(folder: Path) -> None:
    row = find_worst_rows(folder)[0]
    change_part(folder, "energy_normal", pa.array(np.full(400, 1.0)))
    assert f"row {row}, computed again, has other numbers than those of the table" in called(
        "show", folder, "--row", str(row)
    ).stdout  # fmt: skip


def test_a_row_that_is_not_computed_yet_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The study is still running, or was interrupted."""
    monkeypatch.setattr("shipcollision_fmu.study.engine.parts.PART_ROWS", {"impact": 200})
    out = tmp_path / "harbour"
    run_study(parse_study(TEXT, folder=tmp_path), out, workers=0)
    (out / "encounters" / "part-000000000200-000000000399.parquet").unlink()
    result = called("show", out, "--row", "200")
    assert (result.exit_code, result.stderr) == (
        2,
        f"error: {out}: row 200 is not computed yet: go on with `shipcollision study STUDY.toml --out DIR --resume`, "
        "then show it again\n",
    )
    assert not (out / "replays").exists()


def test_rows_that_cannot_be_replayed_are_refused(folder: Path, tmp_path: Path) -> None:
    table = pq.read_table(folder / "encounters")
    row = table.filter(pc.equal(table["status"], "refused"))["row"][0].as_py()
    assert called("show", folder, "--row", str(row)).stderr.startswith(f"error: study.toml: row {row} is refused: ")
    assert "row = 400 is not in the study" in called("show", folder, "--row", "400").stderr
    assert "--row shows a row of a study" in called("show", tmp_path, "--row", "1").stderr
    (folder / "study.toml").write_text(TEXT.replace("seed = 3", "seed = 4"), encoding="utf-8")
    assert called("show", folder, "--row", "1").stderr == (
        f"error: {folder}: row 1 cannot be run again: it was begun by another build of version {__version__}, or its "
        "study.toml was edited: put back what was there\n"
    )
    assert not (folder / "replays").exists()


@pytest.mark.usefixtures("undrawn")
def test_a_replay_that_cannot_be_made_is_a_line(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*arguments: object, **options: object) -> None:
        raise HostError("no compiler")

    monkeypatch.setattr("shipcollision_fmu.study.report.replays.simulate", fail)
    result = called("show", folder)
    assert (result.exit_code, result.stderr) == (0, f"no replay of row {find_worst_rows(folder)[0]}: no compiler\n")
    assert "runs it again, and writes its replay" in read_page(folder)


def test_a_replay_is_there_whole_or_not_at_all(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The disk is full when the page is written, after the files of the run; an earlier replay stays as it was."""

    def fail(run: Path) -> Path:
        assert (run / "states.csv").is_file()
        raise HostError(f"cannot write to {run}: No space left on device")

    def write(run: Path) -> Path:
        (run / "replay.html").write_bytes((run / "states.csv").read_bytes())  # a page takes a third of a second
        return run / "replay.html"

    monkeypatch.setattr("shipcollision_fmu.study.report.replays.write_page", write)
    first, second = map(str, find_worst_rows(folder)[:2])
    assert called("show", folder, "--row", first).exit_code == 0
    before = {path: path.read_bytes() for path in (folder / "replays").rglob("*") if path.is_file()}
    with monkeypatch.context() as patch:
        patch.setattr("shipcollision_fmu.study.report.replays.write_page", fail)
        for row in (first, second):
            result = called("show", folder, "--row", row)
            assert (result.exit_code, result.stderr) == (
                1,
                f"error: cannot write to {folder / 'replays' / f'row-{row}'}: No space left on device\n",
            )
            assert {path: path.read_bytes() for path in (folder / "replays").rglob("*") if path.is_file()} == before
            assert [path.name for path in (folder / "replays").iterdir()] == [f"row-{first}"]
    (folder / "replays" / f"row-{first}" / "old.txt").touch()
    assert called("show", folder, "--row", first).exit_code == 0
    assert {path: path.read_bytes() for path in before if path.suffix != ".json"} == {
        path: content for path, content in before.items() if path.suffix != ".json"
    }
    assert [path.name for path in (folder / "replays").iterdir()] == [f"row-{first}"]


@pytest.mark.usefixtures("undrawn")
def test_figures_of_an_earlier_report_do_not_stay(folder: Path) -> None:
    """Those that this report does not have any more; other files of the user's do."""
    (folder / "figures").mkdir()
    for name in ("exceedance_penetration.svg", "energy_by_place.png", "mine.png", "exceedance_energy.txt"):
        (folder / "figures" / name).touch()
    change_part(folder, "at", pa.array([0.25] * 400))
    assert shown(folder).exit_code == 0
    names = {path.name for path in (folder / "figures").iterdir()}
    assert not names & {"exceedance_penetration.svg", "energy_by_place.png"}
    assert names >= {"mine.png", "exceedance_energy.txt", "exceedance_energy.svg"}


@pytest.mark.slow
def test_a_study_of_situations_is_shown(tmp_path: Path) -> None:
    test_situations.write_situations(tmp_path)
    more = 'friction = {distribution = "uniform", least = 0.1, most = 0.6}'
    text = test_situations.STUDY.format(level="encounter", more="").replace("friction = 0.45", more)
    (tmp_path / "study.toml").write_text(text.replace('"encounter"', '"encounter"\nrows = 60'), encoding="utf-8")
    run_study(tmp_path / "study.toml", tmp_path / "out", workers=0)
    assert called("show", tmp_path / "out").exit_code == 0
    page = read_page(tmp_path / "out")
    assert "40 of 60 cases are done, at level encounter" in page
    assert {"friction", "situation"} <= set(read_figure(tmp_path / "out", "sensitivity")["input"])
    assert page.count('<a href="replays/row-') == 10
    assert "meeting.json" in page


def test_the_same_study_gives_the_same_page(finished: Path, folder: Path) -> None:
    assert shown(folder).exit_code == 0
    assert read_page(folder) == read_page(finished)


@pytest.mark.usefixtures("undrawn")
def test_a_study_that_is_not_finished_is_shown_as_far_as_it_is(folder: Path) -> None:
    told = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    (folder / "study.json").write_text(json.dumps({**told, "rows": 1000}), encoding="utf-8")
    assert shown(folder).exit_code == 0
    assert "The study is not finished: it has 1\N{NARROW NO-BREAK SPACE}000 cases." in read_page(folder)


@pytest.mark.usefixtures("undrawn")
def test_a_column_of_damage_has_a_curve(folder: Path) -> None:
    field = pa.field("penetration", pa.float64(), metadata={"unit": "m"})
    change_part(folder, field, pa.array(np.linspace(0.0, 3.0, 400)))
    assert shown(folder).exit_code == 0
    assert read_figure(folder, "exceedance_penetration")["penetration"][-1] == str(
        np.linspace(0.0, 3.0, 400)[read_done(folder)["row"].to_numpy()[-1]]
    )


@pytest.mark.usefixtures("undrawn")
def test_a_study_file_with_files_beside_it_is_said(folder: Path) -> None:
    text = TEXT.replace('"kvlcc2"]', '"ships/mine.toml"]')
    (folder / "study.toml").write_text(text, encoding="utf-8")
    assert called("show", folder).exit_code == 0
    assert "No case can be run again: study.toml: [own] ships: ships/mine.toml: no such file in" in read_page(folder)


@pytest.mark.usefixtures("undrawn")
def test_a_name_from_a_table_stays_text(folder: Path) -> None:
    change_part(folder, "own_ship", pa.array(["<script>alert(1)</script>"] * 400))
    assert shown(folder).exit_code == 0
    assert "<script>" not in read_page(folder)
    assert "&lt;script&gt;" in read_page(folder)


@pytest.mark.usefixtures("undrawn")
def test_constant_inputs_have_no_figure(folder: Path) -> None:
    change_part(folder, "at", pa.array([0.25] * 400))
    assert shown(folder).exit_code == 0
    assert not (folder / "figures" / "energy_by_place.csv").exists()


def refused(folder: Path, *options: str) -> str:
    result = called("show", folder, *options)
    assert result.exit_code in (1, 2)
    assert result.stderr.count("\n") == 1
    assert not (folder / "report.html").exists()
    assert not (folder / "figures").exists()
    return result.stderr.removeprefix("error: ").strip()


def test_pictures_of_runs_are_refused(folder: Path) -> None:
    line = f"--gif shows a run, and {folder} holds a study: leave it out (see `main show --help`)"
    assert refused(folder, "--gif") == line


def test_a_missing_package_is_one_line(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(extras, "find_spec", lambda name: None if name == "matplotlib" else find(name))
    line = refused(folder)
    assert line.startswith("the report of a study needs packages that are not installed: run `")
    assert "pip install 'shipcollision-fmu[plots]'" in line


def test_damaged_folders_are_refused(folder: Path) -> None:
    (part,) = (folder / "encounters").iterdir()
    remedy = "go on with `shipcollision study STUDY.toml --out DIR --resume`, then show it again"
    content = part.read_bytes()
    part.write_bytes(content[: len(content) // 2])
    assert refused(folder) == f"{part} is cut short or of another study: {remedy}"
    part.unlink()
    assert refused(folder) == f"{folder} has no part of its rows yet: wait while the study runs, or {remedy}"
    (folder / "study.json").write_text("{}", encoding="utf-8")
    assert refused(folder) == (
        f"{folder / 'study.json'} is not that of a study: give a folder that `shipcollision study` has written"
    )


def test_a_study_without_a_case_that_is_done_is_refused(folder: Path) -> None:
    change_part(folder, "status", pa.array(["refused"] * 400))
    change_part(folder, "reason", pa.array(["ships of 3.0 m"] + ["slow, 0.1 m/s"] * 100 + ["slow, 0.2 m/s"] * 299))
    assert refused(folder) == (
        f"{folder}: all 400 cases are refused, and there is nothing to show; the commonest reason, 399 times: "
        "slow, 0.2 m/s"
    )


def test_a_row_that_the_study_does_not_have_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    result = called("study", "study.toml", "--row", "400")
    assert (result.exit_code, result.stderr) == (
        2,
        "error: study.toml: row = 400 is not in the study: it has rows 0 to 399\n",
    )
    assert not (folder / "cases").exists()


def write_study(folder: Path, text: str) -> Path:
    """The folder of a study that is run and shown."""
    run_study(parse_study(text, folder=folder), folder / "out", workers=0)
    assert shown(folder / "out").exit_code == 0
    return folder / "out"


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("rows", [1, 200])
def test_a_study_without_a_distribution_says_that_its_cases_are_alike(tmp_path: Path, rows: int) -> None:
    """In place of figures of axes and a legend."""
    text = re.sub(r"\{ distribution.*\}", "2.0", TEXT).replace("rows = 400", f"rows = {rows}")
    text = text.replace("angle_deg = 2.0", "angle_deg = 90.0").replace("at = 2.0", "at = 0.1")
    text = text.replace('ships = ["kcs", "kvlcc2"]', 'ships = ["kcs"]')
    out = write_study(tmp_path, text)
    (energy,) = set(read_done(out)["energy"].to_pylist())
    page = read_page(out)
    who = "The only case has" if rows == 1 else "All 200 cases have"
    assert f"<h2>Exceedance of energy</h2>\n<p>{who} {energy * 1e-6:.4g} MJ: there is no curve.</p>" in page
    assert f"<h2>Exceedance of impulse</h2>\n<p>{who} " in page
    assert page.count("<img") == 0
    assert list((out / "figures").iterdir()) == []
    assert ("The only case is done, at level impact" in page) == (rows == 1)
    assert ("The case of most energy" if rows == 1 else "The 10 cases of most energy") in page
    assert not re.search(r"\b1 (of 1 )?cases", page)


def test_names_of_keys_and_columns_are_code(finished: Path) -> None:
    page = read_page(finished)
    assert "the column <code>reason</code> of the encounters says why" in page
    assert "`" not in re.sub(r"base64,[^\"]*", "", page)


def test_the_commonest_reason_is_told_with_its_number(finished: Path) -> None:
    """Reasons whose numbers alone differ are one."""
    table = pq.read_table(finished / "encounters")
    reasons = [text for text in table["reason"].to_pylist() if text is not None]
    assert all(re.match(r"at the place they close at [-0-9.]+ m/s, at least", text) for text in reasons)
    assert len(set(reasons)) > 1
    found = re.search(r"The commonest reason, (\d+) times: ([^<]*)\. Refused cases are left out", read_page(finished))
    assert found is not None
    assert (int(found[1]), found[2] in reasons) == (len(reasons), True)


GIVEN = "The interval holds for {}, not for the distribution behind them."
POOL = """
[[own.sampled]]
kind = "tanker, loaded"
count = 3
L_pp = { distribution = "uniform", least = 150.0, most = 200.0 }
L_over_B = 6.0
B_over_T = 2.7
C_b = 0.8
"""


@pytest.mark.usefixtures("undrawn")
def test_captions_say_what_the_intervals_take_as_given(finished: Path, folder: Path, tmp_path: Path) -> None:
    """Ships of a pool are drawn once for all cases, so the tail hangs on a few of them."""
    assert "not for the distribution behind" not in read_page(finished)
    text = TEXT + '\n[tables.traffic]\nfile = "traffic.csv"\n'
    pools = TEXT.replace("\n[encounter]", f"{POOL}\n[encounter]")
    told = {"the sampled ships as drawn": pools, "the lines of the tables": text}
    for given, file in told.items():
        (folder / "study.toml").write_text(file, encoding="utf-8")
        assert shown(folder).exit_code == 0
        assert read_page(folder).count(GIVEN.format(given)) == 3  # energy, impulse, convergence
    (folder / "study.toml").write_text(pools + '\n[tables.traffic]\nfile = "traffic.csv"\n', encoding="utf-8")
    assert shown(folder).exit_code == 0
    assert GIVEN.format(" and ".join(told)) in read_page(folder)


SHIP = """
[ship]
name = "{name}"
kind = "{kind}"
source = "sketch"

[particulars]
L_pp = {L_pp}
B = 20.0
T = 5.5
C_b = 0.61
"""


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("names", [("Ferry 120", "Coaster 90"), ("Twin", "Twin")])
def test_ships_from_files_have_their_names(tmp_path: Path, names: tuple[str, str]) -> None:
    """With the file beside them where two have one name. Shipped ships have the names that the study gives."""
    for file, name, L_pp in zip(("ferry.toml", "coaster.toml"), names, (120.0, 90.0), strict=True):
        text = SHIP.format(name=name, kind="ferry", L_pp=L_pp)
        (tmp_path / file).write_text(text, encoding="utf-8")
    text = TEXT.replace('"kvlcc2"]', '"ferry.toml", "coaster.toml"]\nloading = 0.8').replace("rows = 400", "rows = 60")
    page = read_page(write_study(tmp_path, text))
    if names[0] == names[1]:
        names = ("Twin (ferry.toml)", "Twin (coaster.toml)")
    cells = set(re.findall(r"<td>([^<]*)</td>", page))
    assert cells & {*names, "kcs", "ferry.toml"} == set()
    assert {f"{name} at 0.8 T" for name in (*names, "kcs")} <= cells


@pytest.mark.one_in(2)
@pytest.mark.parametrize("kind", ["container ship, loaded 100", "general cargo ship, pool 2: 100"])
@pytest.mark.parametrize("has_replays", [True, False])
def test_the_table_of_the_worst_cases_fits_1200_pixels(
    folder: Path, browser: Chrome, kind: str, has_replays: bool, undrawn: None
) -> None:
    """On a phone, which scrolls it sideways, the replay, the row and the energy stand first and are seen."""
    for role in ("own", "target"):
        change_part(folder, f"{role}_ship", pa.array([kind] * 400))
    if has_replays:
        for row in find_worst_rows(folder):
            (folder / f"replays/row-{row}").mkdir(parents=True)
            (folder / f"replays/row-{row}/replay.html").touch()
    assert shown(folder).exit_code == 0
    try:
        for width in (1200, 390):
            size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 500}
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
            browser.get((folder / "report.html").as_uri())
            over = "const w = document.querySelector('.wide'); return w.scrollWidth - w.clientWidth"
            assert browser.execute_script(over) <= 0 or width == 390
            right = "return document.querySelectorAll('.cases tr')[1].cells[2].getBoundingClientRect().right"
            assert browser.execute_script(right) <= width
            first = browser.execute_script("return document.querySelector('.cases th').textContent")
            assert first == "replay"
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


@pytest.mark.usefixtures("undrawn")
def test_the_ship_that_has_changed_is_named(tmp_path: Path) -> None:
    """By `show`, by `show --row` and on the page, as --resume names it."""
    ship, text = tmp_path / "ferry.toml", SHIP.format(name="Ferry 120", kind="ferry", L_pp=120.0)
    ship.write_text(text, encoding="utf-8")
    file = TEXT.replace('"kvlcc2"]', '"ferry.toml"]').replace("rows = 400", "rows = 30")
    out = write_study(tmp_path, file)
    ship.write_text(text.replace("B = 20.0", "B = 21.0"), encoding="utf-8")
    change = "changed since: ship ferry.toml of [own] (its content)"
    line = f"error: {out}: row 1 cannot be run again: {change}: put back what was there\n"
    assert called("show", out, "--row", "1").stderr == line
    result = called("show", out)
    assert (result.exit_code, result.stderr) == (0, f"no replays: {change}\n")
    assert f"No case can be run again: {change}. Put back what was there" in read_page(out)
    ship.write_text(text, encoding="utf-8")  # the remedy
    assert "has the numbers of the table" in called("show", out, "--row", str(find_worst_rows(out)[0])).stdout


def test_a_folder_of_neither_a_run_nor_a_study_is_refused(tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "a.txt").touch()
    (tmp_path / "empty").mkdir()
    faults = {"other": "is not the folder of a run or a study", "empty": "is empty", "missing": "does not exist"}
    for name, fault in faults.items():
        result = called("show", tmp_path / name)
        assert (result.exit_code, result.stderr) == (
            2,
            f"error: {tmp_path / name} {fault}: give a folder that `shipcollision run` or `shipcollision study` has "
            "written; a study begins its folder some seconds after its start\n",
        )
