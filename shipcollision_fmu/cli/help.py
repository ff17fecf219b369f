"""HelpContext: help whose lines end between words; click breaks crash-stop in two."""

from __future__ import annotations

from collections.abc import Iterable

import click

__all__ = ["HelpContext"]

_UNBROKEN = "\N{NON-BREAKING HYPHEN}"


class _Formatter(click.HelpFormatter):
    """click's, to which words with hyphens are one word."""

    def write_text(self, text: str) -> None:
        super().write_text(text.replace("-", _UNBROKEN))

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2) -> None:
        super().write_dl([(term, text.replace("-", _UNBROKEN)) for term, text in rows], col_max, col_spacing)

    def getvalue(self) -> str:
        return super().getvalue().replace(_UNBROKEN, "-")


class HelpContext(click.Context):
    """click's context with that help."""

    formatter_class = _Formatter
