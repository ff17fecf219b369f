"""Links and paths in the documents lead somewhere: on a code host, where nobody builds the site.

MkDocs in strict mode checks the links between the pages of the site. Here are the READMEs as well, the anchors, and
every path of a source file that a document names: a file that moves takes them along.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from docs.generate.parts import filled

ROOT = Path(__file__).parents[2]
LEFT_OUT = {".git", ".venv", "node_modules", "site", "runs", "dist"}
"""Folders that are not entered: the environment alone has 50 000 files."""


def list_files() -> Iterator[Path]:
    """Every file of the project."""
    for folder, below, names in os.walk(ROOT):
        below[:] = set(below) - LEFT_OUT
        yield from (Path(folder, name).relative_to(ROOT) for name in names)


FILES = sorted(list_files())
DOCUMENTS = [path for path in FILES if path.suffix == ".md" or path == Path("mkdocs.yml")]

_LINK = re.compile(r"\]\(([^)\s]+)\)")
_SOURCE = re.compile(r"(?<![\w/.-])([\w./-]*\w\.(?:py|c|toml|js|mjs))(?:::(\w+))?(?![\w(])")
_OWN_NAMES = {
    "harbour.toml",
    "my.toml",
    "scenario.toml",
    "unfinished.toml",
    "mine.toml",
    "study.toml",
    "my/ship.toml",
    "my/scenario.toml",
    "vessel.fmu",
    "vessel.toml",
    "barge.toml",
    "FILE.toml",
    "NAME.toml",
    "three.js",
}
"""Files of the reader's, and a library that is called like a file."""


@cache
def text(document: Path) -> str:
    """The document, with the parts from the code put in where there are any."""
    return filled((ROOT / document).read_text(encoding="utf-8"))


def without_code(document: Path) -> str:
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text(document), flags=re.DOTALL | re.MULTILINE))


@cache
def anchors(document: Path) -> set[str]:
    """Identifiers of the headings, as MkDocs and code hosts make them, and those that are given."""
    plain = re.sub(r"^```.*?^```", "", text(document), flags=re.DOTALL | re.MULTILINE)
    found = set(re.findall(r"\{ #(\S+) \}", plain))
    for heading in re.findall(r"^#+ (.+)$", plain, re.MULTILINE):
        shown = unicodedata.normalize("NFKD", re.sub(r"\{ #\S+ \}|`|\*", "", heading)).strip().lower()
        found.add(re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", shown)))
    return found


@cache
def sources() -> tuple[str, ...]:
    """Every file of the project, as "/path"."""
    return tuple(f"/{path.as_posix()}" for path in FILES if path.parts[0] != "build")


def test_the_documents_are_found() -> None:
    assert {Path("README.md"), Path("CONTRIBUTING.md"), Path("docs/index.md"), Path("models/README.md")} <= set(
        DOCUMENTS
    )


@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("document", DOCUMENTS, ids=str)
def test_every_link_leads_to_a_file_and_a_heading(document: Path) -> None:
    wrong = []
    for link in _LINK.findall(without_code(document)):
        target, _, anchor = link.partition("#")
        if "://" in link or link.startswith("mailto:"):
            continue
        path = (ROOT / document).parent / target if target else ROOT / document
        known = anchors(path.resolve().relative_to(ROOT)) if path.is_file() and path.suffix == ".md" else {anchor}
        if not path.exists() or (anchor and anchor not in known):
            wrong.append(link)
    assert wrong == []


@pytest.mark.parametrize("document", [d for d in DOCUMENTS if d.name != "CHANGELOG.md"], ids=str)
def test_every_source_file_that_is_named_exists(document: Path) -> None:
    written = (ROOT / document).read_text(encoding="utf-8")  # what the code says of itself is not the document's fault
    wrong = []
    for name, test in _SOURCE.findall(written):
        if name in _OWN_NAMES:
            continue
        places = [place for place in sources() if place.endswith(f"/{name.lstrip('./')}")]
        if not places:
            wrong.append(name)
        elif test and not any(f"def {test}(" in (ROOT / place[1:]).read_text("utf-8") for place in places):
            wrong.append(f"{name}::{test}")
    assert wrong == []
