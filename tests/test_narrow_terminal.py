"""Names and numbers stay whole at 60 and 80 characters: in tables, in lines of text, in help and in refusals."""

from __future__ import annotations

import sys
from io import StringIO

import pytest
from click.testing import CliRunner
from rich.console import Console
from rich.table import Table

from shipcollision_fmu.cli import main
from shipcollision_fmu.cli.console import say
from shipcollision_fmu.cli.lists import _list_ships
from shipcollision_fmu.cli.run_table import _format_heading, make_run_tables
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.cosim.simulate import simulate
from shipcollision_fmu.scenario.scenario import load_scenario
from tests.conftest import Write

WIDTHS = (40, 60, 80)
MARKS = {"Not", "shown", "in", "columns:"}


def shown(table: Table, width: int) -> str:
    """What a terminal of that width shows."""
    made = Console(width=width, file=StringIO())
    made.print(table, crop=False)
    assert isinstance(made.file, StringIO)
    return made.file.getvalue()


def words(text: str) -> set[str]:
    return {word.strip(",") for word in text.replace("\u2500", " ").split()}


@pytest.fixture(scope="module")
def published() -> Run:
    return simulate(load_scenario("guan2014"), in_process=True)


@pytest.fixture
def astern(scenario_file: Write) -> Run:
    """The target goes astern, and its heading is given as one turn and 350 deg to port."""
    path = scenario_file(("speed = 1.0", "speed = -1.0"), ("heading_deg = 0.0", "heading_deg = -350.0"))
    return simulate(load_scenario(path), in_process=True)


def assert_whole(table: Table) -> None:
    """No word of a narrow table is a part of one; lines fit, and where columns are missing a line says which."""
    everything = words(shown(table, 200))
    for width in WIDTHS:
        text = shown(table, width)
        parts = words(text) - everything - MARKS - {str(width)}
        assert parts == set(), (width, parts)
        assert max(map(len, text.splitlines())) <= width
        if "\u2500" in text and (missing := everything - words(text)):
            assert "Not shown in" in text, (width, missing)


def test_the_lists_stay_whole() -> None:
    assert_whole(_list_ships())
    assert "guan2014_target_manoeuvring" in shown(_list_ships(), 60)
    assert "Not shown" not in shown(_list_ships(), 80)


@pytest.mark.needs("pybullet")
def test_the_published_numbers_stay_whole(published: Run) -> None:
    (table,) = make_run_tables(published)
    assert_whole(table)
    assert "-356.0430  -356.0508" in shown(table, 60)
    assert "Not shown" not in shown(table, 80)


def test_headings_are_those_of_a_compass_and_astern_is_negative(astern: Run) -> None:
    tables = list(make_run_tables(astern))
    for table in tables:
        assert_whole(table)
    row = next(line for line in shown(tables[-1], 120).splitlines() if line.split()[:1] == ["target"])
    assert "-1.000 > " in row
    assert " 10.00 > " in row


@pytest.mark.parametrize(
    ("degrees", "text"), [(0.0, "0.00"), (-0.001, "0.00"), (359.999, "0.00"), (-90.0, "270.00"), (725.5, "5.50")]
)
def test_a_heading_is_from_0_to_360(degrees: float, text: str) -> None:
    assert _format_heading(degrees * 3.141592653589793 / 180.0) == text


def test_a_table_too_wide_for_its_words_becomes_lines() -> None:
    table = make_table("name", ">size [m]", "text", title="sizes [m]")
    table.add_row("a_rather_long_name", "1234.5678", "two words")
    assert shown(table, 24).splitlines() == [
        "sizes [m]", "a_rather_long_name", "  size [m]  1234.5678", "  text      two words"
    ]  # fmt: skip


def test_a_line_of_text_is_broken_between_words(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a terminal of 60 characters; what is read by a program stays one line."""
    text = "  104.8 MJ dissipated in contact, +0.0 MJ from coasting between two-part contacts"
    say(text)
    assert capsys.readouterr().out == f"{text}\n"
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    monkeypatch.setenv("COLUMNS", "60")
    say(text)
    assert capsys.readouterr().out.splitlines() == [
        "  104.8 MJ dissipated in contact, +0.0 MJ from coasting", "    between two-part contacts"
    ]  # fmt: skip
    say(f"stored in {'long-path/' * 8}")
    assert f"{'long-path/' * 8}" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["", *main.commands])
def test_help_breaks_no_word(name: str) -> None:
    def said(width: int) -> str:
        return CliRunner().invoke(main, [*name.split(), "--help"], terminal_width=width, max_content_width=width).output

    everything = words(said(300))
    for width in (60, 80):
        assert words(said(width)) <= everything
        assert max(map(len, said(width).splitlines())) <= width
        assert "..." not in said(width).partition("Commands:")[2]
