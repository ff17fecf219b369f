"""Types of options and arguments that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

__all__ = ["FMI", "NUMBER", "PATH", "TOML_PATH", "WHOLE_NUMBER"]


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


PATH = _Path(path_type=Path)
TOML_PATH = _TomlPath(path_type=Path)
NUMBER, WHOLE_NUMBER = _Number(), _WholeNumber()
FMI = click.Choice(["2", "3"])
