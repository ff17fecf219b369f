"""A Griffe extension: paragraphs of docstrings that are aligned in columns become code blocks.

    states, contacts    NumPy structured arrays
    events              what is in events.json

Markdown would run such lines together when they are not indented.
"""

from __future__ import annotations

import re
from inspect import cleandoc
from typing import Any

from griffe import Extension, Object

__all__ = ["AlignedColumns", "with_blocks"]

_COLUMNS = re.compile(r"\S {2,}\S")


class AlignedColumns(Extension):
    """Changes docstrings as they are collected."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Indent the aligned paragraphs of the object's docstring."""
        if obj.docstring is not None:
            obj.docstring.value = with_blocks(obj.docstring.value)


def with_blocks(text: str) -> str:
    """The text with four spaces before every line of its aligned paragraphs."""
    return "\n\n".join(map(_block, cleandoc(text).split("\n\n")))


def _block(paragraph: str) -> str:
    lines = paragraph.splitlines()
    aligned = sum(1 for line in lines if _COLUMNS.search(line) or line.startswith("  "))
    if 2 * aligned < len(lines) or paragraph.startswith("    "):
        return paragraph
    return "\n".join(f"    {line}" for line in lines)
