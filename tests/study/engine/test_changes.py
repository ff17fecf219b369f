"""A study that changes after its folder was begun: what is refused and said, and what may change."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from shipcollision_fmu.cli import main
from tests.study.engine.folders import digest, list_files

TEXT = """
[study]
name = "mine"
level = "impact"
rows = 25
sampler = "random"
[own]
ships = ["ships/own.toml", "kcs"]
[[own.sampled]]
kind = "tanker, loaded"
count = 2
L_pp = { distribution = "normal", mean = 160.0, sd = 9.0, least = 100.0, most = 200.0 }
L_over_B = 6.0
B_over_T = 2.7
C_b = 0.8
[encounter]
own_speed = { table = "traffic", column = "speed" }
friction = 0.3
[tables.traffic]
file = "traffic.csv"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder: a study file, a ship and a table that it names, and the begun study in `out`."""
    monkeypatch.setattr("shipcollision_fmu.study.engine.parts.PART_ROWS", {"impact": 10})
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ships").mkdir()
    (tmp_path / "ships" / "own.toml").write_text('extends = "kvlcc2"\n')
    (tmp_path / "traffic.csv").write_text("speed\n4.0\n6.0\n")
    (tmp_path / "mine.toml").write_text(TEXT)
    assert called("mine.toml", "--out", "out").exit_code == 0
    return tmp_path


def called(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["study", *arguments, "--workers", "0"])


def change(path: str, old: str, new: str) -> None:
    text = Path(path).read_text()
    assert old in text
    Path(path).write_text(text.replace(old, new))


@pytest.mark.parametrize(
    ("path", "old", "new", "words"),
    [
        ("mine.toml", "friction = 0.3", "friction = 0.4", "[encounter] friction (was 0.3, is 0.4)"),
        ("mine.toml", "friction = 0.3", "", "[encounter] friction (was 0.3, is missing)"),
        ("mine.toml", '"random"', '"random"\nseed = 5', "[study] seed (was missing, is 5)"),
        ("mine.toml", ', "kcs"]', "]", "[own] ships (was ['ships/own.toml', 'kcs'], is ['ships/own.toml'])"),
        ("mine.toml", "C_b = 0.8", "C_b = 0.79", "[own] sampled[0].C_b (was 0.8, is 0.79)"),
        ("mine.toml", "sd = 9.0", "sd = 8.0", "[own] sampled[0].L_pp.sd (was 9.0, is 8.0)"),
        ("mine.toml", '"traffic.csv"', '"./traffic.csv"', "[tables.traffic] file (was traffic.csv, is ./traffic.csv)"),
        ("mine.toml", "file =", 'weight = "speed"\nfile =', "[tables.traffic] weight (was missing, is speed)"),
        ("mine.toml", "[encounter]", "[run]\nafter = 9.0\n[encounter]", "[run] after (was missing, is 9.0)"),
        (
            "mine.toml",
            "[[own.sampled]]",
            '[[own.sampled]]\nkind = "tug"\nL_pp = 30.0\nB = 9.0\nT = 4.0\nC_b = 0.6\n[[own.sampled]]',
            "[own] sampled[0].kind (was tanker, loaded, is tug), [own] sampled[0].count (was 2, is missing), "
            "[own] sampled[0].L_pp (was {'distribution': 'normal', 'mean': 160.0, 'sd': 9.0, 'lea..., is 30.0) "
            "and 6 more",
        ),
        (
            "mine.toml",
            'name = "mine"',
            f'name = "mine"\ndescription = "{"a" * 80}"',
            f"[study] description (was missing, is {'a' * 57}...)",
        ),
        ("ships/own.toml", "kvlcc2", "kcs", "ship ships/own.toml of [own] (its content)"),
        ("traffic.csv", "6.0", "7.0", "file traffic.csv of [tables.traffic] (its content)"),
    ],
)
def test_the_line_says_what_has_changed(folder: Path, path: str, old: str, new: str, words: str) -> None:
    before = digest(folder / "out")
    change(path, old, new)
    result = called("mine.toml", "--out", "out", "--resume")
    line = f"error: out holds another study: changed since: {words}; give a new folder with --out\n"
    assert (result.exit_code, result.stderr) == (2, line)
    assert digest(folder / "out") == before


def test_long_values_are_shown_where_they_differ(folder: Path) -> None:
    change("mine.toml", 'name = "mine"', f'name = "mine"\ndescription = "{"a" * 80} of steel"')
    assert called("mine.toml", "--out", "long").exit_code == 0
    change("mine.toml", "of steel", "of wood")
    said = called("mine.toml", "--out", "long", "--resume").stderr
    shown = "a" * 15
    assert f"[study] description (was ...{shown} of steel, is ...{shown} of wood)" in said


def test_many_changes_are_counted(folder: Path) -> None:
    change("mine.toml", "friction = 0.3", 'friction = 0.2\nat = 0.1\nside = "port"\nrestitution = 0.1\nheading_deg = 3')
    said = called("mine.toml", "--out", "out", "--resume").stderr
    assert "friction (was 0.3, is 0.2), [encounter] at (was missing, is 0.1), [encounter] side (was missing, " in said
    assert "is port) and 2 more; give" in said


def test_comments_and_layout_may_change(folder: Path) -> None:
    before = digest(folder / "out")
    change("mine.toml", "friction = 0.3\n", "friction = 3e-1  # of steel on steel\n")
    result = called("mine.toml", "--out", "out", "--resume")
    assert (result.exit_code, "; 0 computed in" in result.stdout) == (0, True)
    assert digest(folder / "out") == before


def test_the_copy_in_the_folder_goes_on(folder: Path) -> None:
    """Its paths begin where those of the original do."""
    before = digest(folder / "out")
    (folder / "out" / "encounters" / "part-000000000010-000000000019.parquet").unlink()
    result = called("out/study.toml", "--out", "out", "--resume")
    assert (result.exit_code, "; 10 computed in" in result.stdout) == (0, True)
    assert digest(folder / "out") == before
    assert called("out/study.toml", "--row", "3", "--out", "cases").exit_code == 0


def test_the_copy_without_the_original_says_what_is_missing(folder: Path) -> None:
    shutil.move("out", "elsewhere")
    shutil.rmtree("ships")
    (folder / "ships").write_text("")
    result = called("elsewhere/study.toml", "--out", "elsewhere", "--resume")
    assert result.stderr == (
        f"error: study.toml: [own] ships: ships/own.toml: no such file in {folder}, the study file's folder: "
        "did you mean mine.toml?\n"
    )


@pytest.mark.parametrize("sampler", ["random", "sobol"])
def test_a_study_can_grow(folder: Path, sampler: str) -> None:
    """A last part that was not full is computed again. The rest stays, and all is as if it had begun with more rows."""
    change("mine.toml", '"random"', f'"{sampler}"')
    for out, rows in (("grown", 25), ("whole", 42)):
        change("mine.toml", "rows = 25", f"rows = {rows}")
        assert called("mine.toml", "--out", out, "--csv").exit_code == 0
    kept = folder / "grown" / "encounters" / "part-000000000010-000000000019.parquet"
    stamp = kept.stat().st_mtime_ns
    result = called("mine.toml", "--out", "grown", "--resume", "--csv")
    assert (result.exit_code, "42 rows: " in result.stdout, "; 22 computed in" in result.stdout) == (0, True, True)
    assert kept.stat().st_mtime_ns == stamp
    assert digest(folder / "grown") == digest(folder / "whole")
    change("mine.toml", "rows = 42", "rows = 60")
    assert called("mine.toml", "--out", "grown", "--resume").exit_code == 0
    assert not (folder / "grown" / "encounters.csv").exists()


def test_a_study_does_not_shrink(folder: Path) -> None:
    change("mine.toml", "rows = 25", "rows = 10")
    before = list_files(folder / "out")
    result = called("mine.toml", "--out", "out", "--resume")
    assert result.stderr == (
        "error: out holds a study of 25 rows, more than rows = 10: give rows = 25 or more, or a new folder with --out\n"
    )
    assert list_files(folder / "out") == before


def test_a_latin_hypercube_does_not_grow(folder: Path) -> None:
    change("mine.toml", 'sampler = "random"\n', "")
    assert called("mine.toml", "--out", "cube").exit_code == 0
    change("mine.toml", "rows = 25", "rows = 42")
    result = called("mine.toml", "--out", "cube", "--resume")
    assert result.stderr == (
        "error: cube holds another study: rows = 42 in place of 25, and all rows of a latin-hypercube depend on their "
        "number; give a new folder with --out\n"
    )


def test_another_version_or_build_is_said(folder: Path) -> None:
    told = json.loads((folder / "out" / "study.json").read_text())
    for there, words in (
        ("0.0.9", "by version 0.0.9 of shipcollision-fmu, this is "),
        (None, "by another build of vers"),
    ):
        versions = {**told["versions"], **({"shipcollision_fmu": there} if there else {})}
        (folder / "out" / "study.json").write_text(json.dumps({**told, "versions": versions, "fingerprint": "other"}))
        said = called("mine.toml", "--out", "out", "--resume").stderr
        assert said.startswith(f"error: out holds another study: it was begun {words}")
