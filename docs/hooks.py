"""MkDocs hooks: the parts of the pages that come from the code are put in when the site is built."""

from __future__ import annotations

import re
from typing import Any

from generate.parts import filled

__all__ = ["on_page_content", "on_page_markdown"]

_PATH = re.compile(r"(?<=<code>)[\w./:-]+/[\w./:-]+(?=</code>)")


def on_page_markdown(markdown: str, **_: Any) -> str:
    """The page with each `<!-- generate: NAME -->` replaced by the part of that name."""
    text: str = filled(markdown)
    return text


def on_page_content(html: str, **_: Any) -> str:
    """The page with paths that may be broken after a slash, and names of tests after a word: columns are narrow."""
    broken: str = _PATH.sub(_breakable, html)
    return broken


def _breakable(found: re.Match[str]) -> str:
    path, _, test = found[0].partition("::")
    path = path.replace("/", "/<wbr>")
    return f"{path}::<wbr>{test.replace('_', '_<wbr>')}" if test else path
