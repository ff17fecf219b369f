"""The command line, from click's own description of it."""

from __future__ import annotations

from inspect import cleandoc

import click

from shipcollision_fmu.cli import main

from .markdown import cell, plain, table

__all__ = ["commands"]


def commands() -> str:
    """Every command with its usage, its help and its options."""
    parent = click.Context(main, info_name="shipcollision", **main.context_settings)
    return "\n".join(_command(name, main.commands[name], parent) for name in sorted(main.commands))


def _command(name: str, command: click.Command, parent: click.Context) -> str:
    context = click.Context(command, info_name=name, parent=parent)
    records = [parameter.get_help_record(context) for parameter in command.get_params(context)]
    rows = [(f"`{left}`", cell(right) or "as above") for left, right in filter(None, records)]
    usage = command.get_usage(context).removeprefix("Usage: ")
    said = "\n\n".join(map(_paragraph, cleandoc(command.help or "").split("\n\n")))
    return f"## `{name}`\n\n```sh\n{usage}\n```\n\n{said}\n\n{table(('option', 'meaning'), rows)}"


def _paragraph(text: str) -> str:
    """A paragraph of a help text; click keeps the lines of a paragraph that begins with a backspace."""
    if text.startswith("\b\n"):
        return f"```text\n{text[2:]}\n```"
    return plain(" ".join(text.split()))
