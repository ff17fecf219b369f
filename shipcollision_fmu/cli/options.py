"""Types of options and arguments that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

__all__ = ["FMI", "NUMBER", "PATH", "SCENARIO", "SHIP", "STUDY", "TOML_PATH", "WHOLE_NUMBER", "Choice"]


class _Path(click.Path):
    """A path; an empty path (an unset variable of the shell) is a mistake, not the current folder."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("is empty: name a folder or a file", param, ctx)
        return super().convert(value, param, ctx)


class _TomlPath(_Path):
    """The path of a TOML file that is written; `run` takes a name without the suffix for that of a shipped scenario."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        path = super().convert(value, param, ctx)
        if Path(path).suffix != ".toml":
            self.fail(f"{path} does not end in .toml: call it {Path(path).with_suffix('.toml')}", param, ctx)
        return path


class _Number(click.types.FloatParamType):
    """A number, with an example in the refusal."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            return float(value)
        except ValueError:
            self.fail(f"{value!r} is not a number: give one such as 0.5", param, ctx)


class _WholeNumber(click.types.IntParamType):
    """A whole number, with an example in the refusal."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        try:
            return int(value)
        except ValueError:
            self.fail(f"{value!r} is not a whole number: give one such as 3", param, ctx)


class Choice(click.Choice[str]):
    """One of some words, with a suggestion in the refusal. `metavar` stands for it in the usage of an argument."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value not in self.choices:
            from ..ship.loading.messages import suggest

            near = suggest(str(value), self.choices)
            self.fail(
                f"{value!r}:{near}" if near else f"{value!r} must be one of {', '.join(self.choices)}", param, ctx
            )
        return value


class _Named(click.types.StringParamType):
    """The name of something that is shipped, or the path of a TOML file; completed by the shell."""

    def __init__(self, of: str) -> None:
        self._of = of

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """The names that begin so, after which the shell looks for files."""
        if self._of == "ship":
            from ..ship.loading.library import list_ship_names as list_names
        elif self._of == "study":
            from ..study.definition.study import list_study_names as list_names
        else:
            from ..scenario.scenario import list_scenario_names as list_names
        found = [CompletionItem(name) for name in list_names() if name.startswith(incomplete)]
        return [CompletionItem(incomplete, type="file"), *found]  # bash forgets what comes before `file`


PATH = _Path(path_type=Path)
TOML_PATH = _TomlPath(path_type=Path)
NUMBER, WHOLE_NUMBER = _Number(), _WholeNumber()
FMI = Choice(["2", "3"])
SHIP, SCENARIO, STUDY = _Named("ship"), _Named("scenario"), _Named("study")
