"""MkDocs hooks: the parts of the pages that come from the code are put in when the site is built."""

from __future__ import annotations

from typing import Any

from generate.parts import filled

__all__ = ["on_page_markdown"]


def on_page_markdown(markdown: str, **_: Any) -> str:
    """The page with each `<!-- generate: NAME -->` replaced by the part of that name."""
    return filled(markdown)
