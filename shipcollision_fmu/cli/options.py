"""Types of options and arguments that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

__all__ = ["FMI", "PATH"]


class _Path(click.Path):
    """A path; an empty path (an unset variable of the shell) is a mistake, not the current folder."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("is empty: name a folder or a file", param, ctx)
        return super().convert(value, param, ctx)


PATH = _Path(path_type=Path)
FMI = click.Choice(["2", "3"])
