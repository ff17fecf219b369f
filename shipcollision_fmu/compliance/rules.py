"""Rules for modelDescription.xml and the archive that FMPy's validator does not check, a function for each rule.

A rule takes a Subject and yields a line for each breach. RULES is the table of all rules.
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
    """An FMU file in the forms that the rules need.

    Raises the errors of FMPy and ElementTree for a description that cannot be read.
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        with ZipFile(file) as archive:
            self.entries = archive.infolist()
            self.root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        self.description: Any = read_model_description(str(file), validate=False)
        self.variables: list[Any] = self.description.modelVariables

    @cached_property
    def contents(self) -> dict[str, bytes]:
        """All files in the archive by name."""
        with ZipFile(self.file) as archive:
            return {name: archive.read(name) for name in archive.namelist()}


@dataclass(frozen=True)
class Rule:
    """A rule: its name, its demand in words, whether the standard demands it (else good practice), its function."""

    name: str
    demand: str
    binding: bool
    check: Callable[[Subject], Iterable[str]]


def check_units(subject: Subject) -> Iterator[str]:
    """Every Real has a unit, since importers assume their own otherwise. '1' is the unit of a mere number."""
    bare = [
        v.name
        for v in subject.variables
        if v.type in _REALS and v.causality in ("input", "output", "parameter", "calculatedParameter")
        and not (v.unit or (v.declaredType is not None and v.declaredType.unit))
    ]  # fmt: skip
    if bare:
        yield f"without a unit: {_join_some(bare)}; give each a unit, '1' where it is a mere number"


def check_unit_exponents(subject: Subject) -> Iterator[str]:
    """Every unit has exponents of the SI base units, by which importers convert; its name is not used."""
    bare = [unit.name for unit in subject.description.unitDefinitions if unit.baseUnit is None]
    if bare:
        yield f"units without exponents of the SI base units: {_join_some(bare)}; add a BaseUnit to each"


def check_start_values(subject: Subject) -> Iterator[str]:
    """Start values exist, have their variable's type, and lie within min and max or among the items."""
    for v in subject.variables:
        if v.start is None:
            if v.causality in ("input", "parameter", "structuralParameter") and v.type != "Clock":
                yield f"{v.name} has no start value"
            continue
        for text in _list_numbers(v):
            try:
                value = _parse_number(v.type, text)
            except ValueError:
                yield f"the start value {text!r} of {v.name} is no {v.type}"
                break
            low, high = (None if limit is None else _parse_number(v.type, str(limit)) for limit in _find_limits(v))
            if (low is not None and value < low) or (high is not None and value > high):
                yield f"the start value {text} of {v.name} is outside its limits {low} to {high}"


def check_limits(subject: Subject) -> Iterator[str]:
    """min is at most max."""
    for v in subject.variables:
        low, high = _find_limits(v)
        if low is not None and high is not None and _parse_number(v.type, str(low)) > _parse_number(v.type, str(high)):
            yield f"min = {low} of {v.name} is above its max = {high}"


def check_initial(subject: Subject) -> Iterator[str]:
    """FMI 2.0, section 2.2.7: inputs and the independent variable have no attribute `initial`."""
    for node in subject.root.iter():
        if node.get("causality") in ("input", "independent") and node.get("initial") is not None:
            if node.get("causality") == "input" and subject.description.fmiVersion.startswith("3"):
                continue  # allowed there, when it is "exact"
            yield f"{node.get('name')} is {node.get('causality')} and must not have initial = {node.get('initial')!r}"


def check_dependencies(subject: Subject) -> Iterator[str]:
    """Outputs declare `dependencies`; without them an output depends on all inputs, and importers find false loops."""
    if not any(v.causality == "input" for v in subject.variables):
        return
    silent = [unknown.variable.name for unknown in subject.description.outputs if unknown.dependencies is None]
    if silent:
        yield (
            f"outputs without dependencies, which then depend on every input: {_join_some(silent)}; add "
            'dependencies, "" where an output follows from the last step alone'
        )


def check_dependency_kinds(subject: Subject) -> Iterator[str]:
    """Knowns of an output are inputs, states and the time, not parameters or other outputs."""
    for unknown in subject.description.outputs:
        for known in unknown.dependencies or []:
            if known.causality in ("parameter", "output", "structuralParameter") and known.derivative is None:
                yield f"output {unknown.variable.name} depends on {known.name}, which is a {known.causality}"


def check_enumerations(subject: Subject) -> Iterator[str]:
    """Items have different names and values; every Enumeration has a type with items."""
    for v in subject.variables:
        if v.type == "Enumeration" and (v.declaredType is None or not v.declaredType.items):
            yield f"{v.name} is an Enumeration without items: declare its type"
    for kind in subject.description.typeDefinitions:
        items = kind.items or []
        for what in ("name", "value"):
            if len({getattr(item, what) for item in items}) < len(items):
                yield f"two items of type {kind.name} have the same {what}"


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
        libraries, expected = _join_some(sorted(named)), _join_some(sorted(identifiers))
        yield f"the libraries are called {libraries}, the model identifier is {expected}"


def check_token(subject: Subject) -> Iterator[str]:
    """The guid of FMI 2.0, or instantiation token of 3.0, is not empty: it distinguishes builds."""
    if not (subject.description.guid or "").strip():
        yield "guid (instantiationToken) is empty"


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


RULES = (
    Rule("units", "every Real has a unit", False, check_units),
    Rule("exponents", "every unit has its SI exponents", False, check_unit_exponents),
    Rule("start", "start values are there, of their type and within limits", True, check_start_values),
    Rule("limits", "min is not above max", True, check_limits),
    Rule("initial", "inputs have no `initial`", True, check_initial),
    Rule("dependencies", "outputs say what they depend on", False, check_dependencies),
    Rule("knowns", "outputs depend on knowns only", True, check_dependency_kinds),
    Rule("enumerations", "enumerations have items, all different", True, check_enumerations),
    Rule("library", "a library with the name of the model identifier", True, check_library),
    Rule("token", "guid or instantiation token", True, check_token),
    Rule("content", "the guid of our own FMUs is that of their content", True, check_token_of_content),
    Rule("reproducible", "same inputs, same bytes", False, check_reproducible),
)
"""Every rule, in the order of the report."""


def _join_some(names: list[str]) -> str:
    """The first five names and the count of the others."""
    return ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")


def _list_numbers(v: Any) -> list[str]:
    """Start values that are numbers, as text."""
    if v.type not in (*_REALS, *_WHOLE):
        return []
    return str(v.start).split() if v.dimensions else [str(v.start)]


def _parse_number(kind: str, text: str) -> float:
    return float(text.replace("INF", "inf")) if kind in _REALS else int(text)


def _find_limits(v: Any) -> tuple[Any, Any]:
    """min and max of a numeric variable, or of its type; None where there is none."""
    declared = v.declaredType
    low = v.min if v.min is not None or declared is None else declared.min
    high = v.max if v.max is not None or declared is None else declared.max
    if v.type == "Enumeration" and declared is not None and declared.items:
        values = [int(item.value) for item in declared.items]
        low, high = low if low is not None else min(values), high if high is not None else max(values)
    return (low, high) if v.type in (*_REALS, *_WHOLE) else (None, None)
