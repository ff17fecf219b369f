"""The shell completes commands, options, ships and scenarios, and files where a TOML file may be given."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.shell_completion import BashComplete

from shipcollision_fmu.cli import main
from shipcollision_fmu.scenario.scenario import list_scenario_names
from shipcollision_fmu.ship.loading.library import list_ship_names

GUIDE = Path(__file__).parents[1] / "docs" / "guide" / "run.md"


def completed(*words: str) -> list[tuple[str, str]]:
    """Type and value of what a shell offers for the last word."""
    found = BashComplete(main, {}, "shipcollision", "_SHIPCOLLISION_COMPLETE").get_completions(
        list(words[:-1]), words[-1]
    )
    return [(item.type, item.value) for item in found]


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (("run", ""), list_scenario_names()),
        (("package", "kv"), ["kvlcc2_crossing"]),
        (("ships", "kvlcc"), ["kvlcc2", "kvlcc2_l7"]),
        (("trial", ""), list_ship_names()),
        (("encounter", "t-bone", "--own", "kc"), ["kcs"]),
        (("import", "a.json", "--ship", "buo"), ["buoy"]),
    ],
)
def test_names_and_files_are_offered(words: tuple[str, ...], names: list[str]) -> None:
    """The file comes first: bash forgets what it was offered before."""
    assert completed(*words) == [("file", words[-1]), *(("plain", name) for name in names)]


def test_commands_options_and_choices_are_offered() -> None:
    assert completed("sc") == [("plain", "scenarios")]
    assert completed("trial", "kvlcc2", "zig") == [("plain", "zigzag")]
    assert ("plain", "--algorithm") in completed("run", "--a")
    assert completed("run", "--algorithm", "j") == [("plain", "jacobi")]


def test_the_guide_says_how(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its line for bash, without the shell: click answers the variable with a script that asks it again."""
    (variable,) = re.findall(r'^eval "\$\((\w+)=bash_source shipcollision\)"$', GUIDE.read_text(encoding="utf-8"), re.M)
    assert variable == "_SHIPCOLLISION_COMPLETE"
