"""`shipcollision show`: what it writes, says and refuses."""

from __future__ import annotations

import importlib.util
import stat
import sys
import webbrowser
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from shipcollision_fmu.cli import main
from shipcollision_fmu.show import extras
from shipcollision_fmu.show.film import animation

from .conftest import MakeRun
from .foreign import with_names


@pytest.fixture
def run(meeting: MakeRun) -> Path:
    return meeting()


def shown(*arguments: str | Path) -> Result:
    return CliRunner().invoke(main, ["show", *map(str, arguments)])


def names(folder: Path) -> set[str]:
    """Files and folders, hidden ones too: nothing half-written stays."""
    return {path.name for path in folder.iterdir()}


def test_osg_and_glb(run: Path) -> None:
    before = names(run)
    result = shown(run, "--osg", "--glb")
    assert (result.exit_code, result.stderr) == (0, "")
    lines = result.stdout.splitlines()
    assert lines[0] == str(run / "scene.osgt")
    assert lines[2] == f"  OSG_FILE_PATH={run} osgviewer --window 80 80 1280 720 -p {run}/camera.path {run}/scene.osgt"
    assert lines[3] == str(run / "scene.glb")
    assert names(run) - before == {"scene.osgt", "camera.path", "soft.png", "smoke.png", "Images", "scene.glb"}
    assert stat.S_IMODE((run / "scene.osgt").stat().st_mode) == stat.S_IMODE((run / "states.csv").stat().st_mode)


@pytest.mark.slow
def test_plots_and_still(run: Path) -> None:
    result = shown(run, "--plots", "--still", "1")
    assert result.exit_code == 0
    assert [Path(line).name for line in result.stdout.splitlines()] == [
        "track.png", "track.svg", "motion.png", "motion.svg", "energy.png", "energy.svg", "still.png",
    ]  # fmt: skip
    assert all(Path(line).is_file() for line in result.stdout.splitlines())


@pytest.mark.slow
def test_films(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(animation, "RATE", 2.0)
    result = shown(run, "--gif", "--mp4")
    assert (result.exit_code, result.stdout.split()) == (0, [str(run / "impact.gif"), str(run / "impact.mp4")])


def test_without_an_option_the_page_is_written_and_all_is_listed(run: Path) -> None:
    result = shown(run)
    assert result.exit_code == 0, result.stderr
    lines = result.stdout.splitlines()
    assert lines[0] == str(run / "replay.html")
    assert lines[1] == "meeting: 3 s, 1 collision, ships own, target"
    assert "  replay.html  the page: open it in a browser" in lines
    assert "  scene.osgt   OpenSceneGraph, --osg (not written yet)" in lines


def test_open(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda address: bool(opened.append(address)) or True)
    assert shown(run, "--open", "--glb").exit_code == 0
    assert opened == [(run / "replay.html").resolve().as_uri()]
    assert {"replay.html", "scene.glb"} <= names(run)


def test_open_without_a_browser(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    result = shown(run, "--open")
    assert result.exit_code == 1
    assert result.stderr == f"error: found no browser to open {run / 'replay.html'}: open it yourself\n"


@pytest.mark.parametrize(
    ("option", "module", "extra"),
    [
        ("--plots", "matplotlib", "plots"),
        ("--gif", "PIL", "film"),
        ("--still=1", "PIL", "film"),
        ("--mp4", "PIL", "mp4"),
        ("--mp4", "imageio_ffmpeg", "mp4"),
    ],
)
def test_a_missing_package_is_one_line_with_the_remedy(
    run: Path, monkeypatch: pytest.MonkeyPatch, option: str, module: str, extra: str
) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(extras, "find_spec", lambda name: None if name == module else find(name))
    before = names(run)
    result = shown(run, option)
    assert result.exit_code == 1
    assert result.stderr.endswith(
        f"needs packages that are not installed: run `{sys.executable} -m pip install 'shipcollision-fmu[{extra}]'` "
        f"(in a clone: '.[{extra}]')\n"
    )
    assert result.stderr.count("\n") == 1
    assert names(run) == before


@pytest.mark.parametrize("option", ["--open", "--osg", "--glb", "--plots", "--gif", "--mp4"])
def test_bad_folders(tmp_path: Path, option: str) -> None:
    (tmp_path / "empty").mkdir()
    for folder, what in (("empty", "is empty"), ("none", "does not exist")):
        result = shown(tmp_path / folder, option)
        assert result.exit_code == 2
        assert result.stderr.startswith(f"error: {tmp_path / folder} {what}")
        assert result.stderr.count("\n") == 1
    assert not list((tmp_path / "empty").iterdir())


def test_a_time_that_the_run_does_not_have(run: Path) -> None:
    result = shown(run, "--still", "9")
    assert result.exit_code == 2
    assert result.stderr == "error: time 9 s is not in the run: give one from 0 to 3 s\n"


def test_what_cannot_be_written_is_said_and_leaves_nothing(run: Path) -> None:
    """A folder stands where the file would be."""
    (run / "scene.glb").mkdir()
    before = names(run)
    result = shown(run, "--glb")
    assert result.exit_code == 1
    assert result.stderr.startswith(f"error: cannot write to {run / 'scene.glb'}: ")
    assert result.stderr.count("\n") == 1
    assert names(run) == before


def test_a_ship_named_like_a_script_is_listed_as_text(run: Path, tmp_path: Path) -> None:
    named = with_names(run, tmp_path / "named", {"own": "<script>\x1b[31m"})
    result = shown(named)
    assert result.exit_code == 0, result.stderr
    assert "ships <script> [31m, target" in result.stdout
