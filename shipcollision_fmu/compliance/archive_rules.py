"""Rules for the files in the archive of an FMU, a function for each rule: libraries, documents, digest, dates."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from uuid import UUID

from ..fmi.build_record import RECORD, digest
from .subject import Subject, join_some

__all__ = [
    "check_documents",
    "check_icon",
    "check_library",
    "check_platforms",
    "check_reproducible",
    "check_token_of_content",
]

_LIBRARY = re.compile(r"binaries/([^/]+)/([^/]+)\.(so|dll|dylib)$")
_FORMATS = {"linux": (b"\x7fELF",), "win": (b"MZ",), "darwin": (b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe")}
"""How a library of a system begins, by what is in the names of its folders (linux64, x86_64-windows, darwin64)."""
_LINUX_ALONE = ("pybullet",)
"""Python packages that have wheels for Linux alone."""


def check_library(subject: Subject) -> Iterator[str]:
    """There is a library with the name of the model identifier, the only name that importers load."""
    identifiers = {
        one.modelIdentifier
        for one in (subject.description.coSimulation, subject.description.modelExchange)
        if one is not None
    }
    found = [match for entry in subject.entries if (match := _LIBRARY.match(entry.filename))]
    named = {match[2] for match in found}
    sources = any(entry.filename.startswith("sources/") for entry in subject.entries)
    if not found and not sources:
        yield "no library under binaries/ and no sources"
    if found and not identifiers <= named:
        libraries, expected = join_some(sorted(named)), join_some(sorted(identifiers))
        yield f"the libraries are called {libraries}, the model identifier is {expected}"


def check_platforms(subject: Subject) -> Iterator[str]:
    """A library is one of its folder's system, and what it loads exists there."""
    for name in subject.contents:
        match = _LIBRARY.match(name)
        if match is None:
            continue
        system = next((system for system in ("darwin", "linux", "win") if system in match[1]), "")
        if system and not subject.contents[name].startswith(_FORMATS[system]):
            yield f"{name} is no library of {match[1]}: no host can load it"
        needed = subject.contents.get("resources/requirements.txt", b"").decode(errors="replace")
        missing = [one for one in _LINUX_ALONE if re.search(rf"^{one}\b", needed, re.MULTILINE)]
        if system not in ("", "linux") and missing:
            yield f"{name} cannot work: {missing[0]} of resources/requirements.txt exists for Linux alone; leave it out"


def check_documents(subject: Subject) -> Iterator[str]:
    """Documents where importers look for them: external dependencies and the entry to the licences."""
    names = set(subject.contents)
    able = subject.description.coSimulation or subject.description.modelExchange
    outside = able is not None and able.needsExecutionTool and subject.description.fmiVersion.startswith("3")
    if outside and not names & {f"documentation/externalDependencies.{kind}" for kind in ("txt", "html")}:
        yield "needsExecutionTool is true: documentation/externalDependencies.txt or .html must say what the FMU needs"
    licences = [name for name in names if name.startswith("documentation/licenses/")]
    entries = {f"documentation/licenses/license.{kind}" for kind in ("txt", "html", "spdx")}
    if licences and not names & entries:
        yield "there are licences, but documentation/licenses/license.txt, where readers begin, is missing"


def check_icon(subject: Subject) -> Iterator[str]:
    """An icon, by which people tell FMUs apart in a diagram."""
    name = "terminalsAndIcons/icon.png" if subject.description.fmiVersion.startswith("3") else "model.png"
    if name not in subject.contents:
        yield f"there is no icon: add {name}"


def check_token_of_content(subject: Subject) -> Iterator[str]:
    """In an FMU of this project the guid is a digest of all other content, and equals the guid in its record."""
    record = f"resources/{RECORD}"
    if record not in subject.contents:
        return
    said = json.loads(subject.contents[record])
    guid = subject.description.guid
    if said.get("guid") != guid:
        yield f"guid is {guid}, but {record} has {said.get('guid')}: the file was changed after it was built"
        return
    files = {name: data for name, data in subject.contents.items() if name != record}
    anonymous = files["modelDescription.xml"].replace(f'"{guid}"'.encode(), b'""')
    made = str(UUID(digest({**files, "modelDescription.xml": anonymous})[:32]))
    if made != guid:
        yield f"guid is {guid}, but the content gives {made}: the file was changed after it was built"


def check_reproducible(subject: Subject) -> Iterator[str]:
    """The same inputs should give the same bytes: no date of the build anywhere."""
    if subject.root.get("generationDateAndTime") is not None:
        yield "generationDateAndTime makes every build another file"
    if len({entry.date_time for entry in subject.entries}) > 1:
        yield "the files in the archive have different dates: set one, and every build gives the same bytes"
