"""What FMPy's validator leaves out of modelDescription.xml and of the file, one function a rule.

A rule takes a Subject and gives lines, one for each thing that is wrong; it says nothing when there is nothing to say.
RULES is the table. What only calls can show is in calls.py.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any
from uuid import UUID
from xml.etree import ElementTree
from zipfile import ZipFile

from fmpy import read_model_description

from ..fmi.build_record import RECORD, digest

__all__ = ["RULES", "Rule", "Subject"]

_REALS = ("Real", "Float64", "Float32")
_WHOLE = ("Integer", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Enumeration")
_LIBRARY = re.compile(r"binaries/([^/]+)/([^/]+)\.(so|dll|dylib)$")


class Subject:
    """An FMU file, as the rules look at it. Raises what FMPy and ElementTree raise for a description that cannot be
    read."""

    def __init__(self, file: Path) -> None:
        self.file = file
        with ZipFile(file) as archive:
            self.entries = archive.infolist()
            self.root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        self.description: Any = read_model_description(str(file), validate=False)
        self.variables: list[Any] = self.description.modelVariables

    @cached_property
    def contents(self) -> dict[str, bytes]:
        """All files in the archive."""
        with ZipFile(self.file) as archive:
            return {name: archive.read(name) for name in archive.namelist()}


@dataclass(frozen=True)
class Rule:
    """A name to call it by, what it demands, whether the standard demands it too (else it is good practice: a note),
    and the function."""

    name: str
    demand: str
    binding: bool
    broken: Callable[[Subject], Iterable[str]]


def units(subject: Subject) -> Iterator[str]:
    """A Real without a unit is taken for whatever the importer has. '1' is the unit of a mere number."""
    bare = [
        v.name
        for v in subject.variables
        if v.type in _REALS and v.causality in ("input", "output", "parameter", "calculatedParameter")
        and not (v.unit or (v.declaredType is not None and v.declaredType.unit))
    ]  # fmt: skip
    if bare:
        yield f"without a unit: {_some(bare)}; give each a unit, '1' where it is a mere number"


def unit_exponents(subject: Subject) -> Iterator[str]:
    """Importers convert by the exponents of a unit, not by its name."""
    bare = [unit.name for unit in subject.description.unitDefinitions if unit.baseUnit is None]
    if bare:
        yield f"units without exponents of the SI base units: {_some(bare)}; add a BaseUnit to each"


def start_values(subject: Subject) -> Iterator[str]:
    """A start value is a value of its type, within min and max, and one of the items of an enumeration."""
    for v in subject.variables:
        if v.start is None:
            if v.causality in ("input", "parameter", "structuralParameter") and v.type != "Clock":
                yield f"{v.name} has no start value"
            continue
        for text in _numbers(v):
            try:
                value = _number(v.type, text)
            except ValueError:
                yield f"the start value {text!r} of {v.name} is no {v.type}"
                break
            low, high = (None if limit is None else _number(v.type, str(limit)) for limit in _limits(v))
            if (low is not None and value < low) or (high is not None and value > high):
                yield f"the start value {text} of {v.name} is outside its limits {low} to {high}"


def limits(subject: Subject) -> Iterator[str]:
    """min is below max: a range without values can never be kept."""
    for v in subject.variables:
        low, high = _limits(v)
        if low is not None and high is not None and _number(v.type, str(low)) > _number(v.type, str(high)):
            yield f"min = {low} of {v.name} is above its max = {high}"


def initial(subject: Subject) -> Iterator[str]:
    """FMI 2.0, section 2.2.7: inputs and the independent variable have no attribute `initial`."""
    for node in subject.root.iter():
        if node.get("causality") in ("input", "independent") and node.get("initial") is not None:
            if node.get("causality") == "input" and subject.description.fmiVersion.startswith("3"):
                continue  # allowed there, when it is "exact"
            yield f"{node.get('name')} is {node.get('causality')} and must not have initial = {node.get('initial')!r}"


def dependencies(subject: Subject) -> Iterator[str]:
    """An output without `dependencies` depends on all inputs: importers then see algebraic loops that are not there."""
    if not any(v.causality == "input" for v in subject.variables):
        return
    silent = [unknown.variable.name for unknown in subject.description.outputs if unknown.dependencies is None]
    if silent:
        yield (
            f"outputs that do not say what they depend on, and so depend on every input: {_some(silent)}; add "
            'dependencies, "" where an output follows from the last step alone'
        )


def dependency_kinds(subject: Subject) -> Iterator[str]:
    """An output depends on inputs, states and the time; parameters and other outputs are not among its knowns."""
    for unknown in subject.description.outputs:
        for known in unknown.dependencies or []:
            if known.causality in ("parameter", "output", "structuralParameter") and known.derivative is None:
                yield f"output {unknown.variable.name} depends on {known.name}, which is a {known.causality}"


def enumerations(subject: Subject) -> Iterator[str]:
    """Items have different names and values; every Enumeration has a type with items."""
    for v in subject.variables:
        if v.type == "Enumeration" and (v.declaredType is None or not v.declaredType.items):
            yield f"{v.name} is an Enumeration without items: declare its type"
    for kind in subject.description.typeDefinitions:
        items = kind.items or []
        for what in ("name", "value"):
            if len({getattr(item, what) for item in items}) < len(items):
                yield f"two items of type {kind.name} have the same {what}"


def library(subject: Subject) -> Iterator[str]:
    """There is a library, and it has the name of the model identifier: importers look for no other."""
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
        yield f"the libraries are called {_some(sorted(named))}, the model identifier is {_some(sorted(identifiers))}"


def token(subject: Subject) -> Iterator[str]:
    """The guid of FMI 2.0, the instantiation token of 3.0, tells one build from another: it must not be empty."""
    if not (subject.description.guid or "").strip():
        yield "guid (instantiationToken) is empty"


def token_of_content(subject: Subject) -> Iterator[str]:
    """In an FMU of this project the guid is a digest of everything else in it, and its record says the same."""
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


def reproducible(subject: Subject) -> Iterator[str]:
    """The same inputs should give the same bytes: no date of the build anywhere."""
    if subject.root.get("generationDateAndTime") is not None:
        yield "generationDateAndTime makes every build another file"
    if len({entry.date_time for entry in subject.entries}) > 1:
        yield "the files in the archive have different dates: set one, and every build gives the same bytes"


RULES = (
    Rule("units", "every Real has a unit", False, units),
    Rule("exponents", "every unit has its SI exponents", False, unit_exponents),
    Rule("start", "start values are there, of their type and within limits", True, start_values),
    Rule("limits", "min is not above max", True, limits),
    Rule("initial", "inputs have no `initial`", True, initial),
    Rule("dependencies", "outputs say what they depend on", False, dependencies),
    Rule("knowns", "outputs depend on knowns only", True, dependency_kinds),
    Rule("enumerations", "enumerations have items, all different", True, enumerations),
    Rule("library", "a library with the name of the model identifier", True, library),
    Rule("token", "guid or instantiation token", True, token),
    Rule("content", "the guid of our own FMUs is that of their content", True, token_of_content),
    Rule("reproducible", "same inputs, same bytes", False, reproducible),
)
"""Every rule, in the order in which findings are told."""


def _some(names: list[str]) -> str:
    """A few of them, and how many more."""
    return ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")


def _numbers(v: Any) -> list[str]:
    """The texts of the start values that are numbers."""
    if v.type not in (*_REALS, *_WHOLE):
        return []
    return str(v.start).split() if v.dimensions else [str(v.start)]


def _number(kind: str, text: str) -> float:
    return float(text.replace("INF", "inf")) if kind in _REALS else int(text)


def _limits(v: Any) -> tuple[Any, Any]:
    """Of the variable, or of its type."""
    declared = v.declaredType
    low = v.min if v.min is not None or declared is None else declared.min
    high = v.max if v.max is not None or declared is None else declared.max
    if v.type == "Enumeration" and declared is not None and declared.items:
        values = [int(item.value) for item in declared.items]
        low, high = low if low is not None else min(values), high if high is not None else max(values)
    return (low, high) if v.type in (*_REALS, *_WHOLE) else (None, None)
