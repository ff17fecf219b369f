"""MkDocs hooks: the parts of the pages that come from the code are put in when the site is built.

The examples are copied into the site, where a page's link to `../../examples/NAME` leads to `../examples/NAME`.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from generate.parts import filled
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files, InclusionLevel

__all__ = ["on_files", "on_page_content", "on_page_markdown"]

EXAMPLES = Path(__file__).parents[1] / "examples"

_PATH = re.compile(r"(?<=<code>)[\w./:-]+/[\w./:-]+(?=</code>)")


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """The files of the site with the examples; mkdocs.yml leaves out the other Python files."""
    for path in sorted(EXAMPLES.glob("*.[pc]*")):
        file = File.generated(config, f"examples/{path.name}", abs_src_path=str(path))
        file.inclusion = InclusionLevel.INCLUDED
        files.append(file)
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    """The page with each `<!-- generate: NAME -->` replaced by the part of that name, and links to examples."""
    text: str = filled(markdown)
    return text.replace("](../../examples/", "](../examples/")


def on_page_content(html: str, **_: Any) -> str:
    """The page with paths that may be broken after a slash, and names of tests after a word: columns are narrow."""
    broken: str = _PATH.sub(_breakable, html)
    return broken


def _breakable(found: re.Match[str]) -> str:
    path, _, test = found[0].partition("::")
    path = path.replace("/", "/<wbr>")
    return f"{path}::<wbr>{test.replace('_', '_<wbr>')}" if test else path
