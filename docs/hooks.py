"""MkDocs hooks: the parts of the pages that come from the code are put in when the site is built."""

from __future__ import annotations

import re
from typing import Any

from generate.parts import filled

__all__ = ["on_page_content", "on_page_markdown"]

_PATH = re.compile(r"(?<=<code>)[\w./:-]+/[\w./:-]+(?=</code>)")


def on_page_markdown(markdown: str, **_: Any) -> str:
    """The page with each `<!-- generate: NAME -->` replaced by the part of that name."""
    return filled(markdown)


def on_page_content(html: str, **_: Any) -> str:
    """The page with paths that may be broken after a slash, a colon or an underscore: they stand in narrow columns."""
    return _PATH.sub(lambda found: re.sub(r"(/|::|_)", r"\1<wbr>", found[0]), html)
