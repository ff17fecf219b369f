"""Rules for modelDescription.xml that FMPy's validator does not check, a function for each rule; and all rules.

A rule takes a Subject and yields a line for each breach. RULES is the table of all rules, with those for the archive.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from .archive_rules import (
    check_documents,
    check_icon,
    check_library,
    check_platforms,
    check_reproducible,
    check_token_of_content,
)
from .subject import Subject, join_some

__all__ = ["RULES", "Rule"]

_REALS = ("Real", "Float64", "Float32")
_WHOLE = ("Integer", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Enumeration")


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
        yield f"without a unit: {join_some(bare)}; give each a unit, '1' where it is a mere number"


def check_unit_exponents(subject: Subject) -> Iterator[str]:
    """Every unit has exponents of the SI base units, by which importers convert; its name is not used."""
    bare = [unit.name for unit in subject.description.unitDefinitions if unit.baseUnit is None]
    if bare:
        yield f"units without exponents of the SI base units: {join_some(bare)}; add a BaseUnit to each"
    empty = [
        node.get("name", "") for node in subject.root.iter("Unit")
        if (base := node.find("BaseUnit")) is not None and not base.attrib
    ]  # fmt: skip
    if empty:
        yield (
            f"units whose BaseUnit is empty: {join_some(empty)}; some importers take them for unknown: write "
            'factor="1.0"'
        )


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
            f"outputs without dependencies, which then depend on every input: {join_some(silent)}; add "
            'dependencies, "" where an output follows from the last step alone'
        )


def check_dependency_kinds(subject: Subject) -> Iterator[str]:
    """Knowns of an output are inputs, states and the time, not parameters or other outputs."""
    for unknown in subject.description.outputs:
        for known in unknown.dependencies or []:
            if known.causality in ("parameter", "output", "structuralParameter") and known.derivative is None:
                yield f"output {unknown.variable.name} depends on {known.name}, which is a {known.causality}"


def check_nominals(subject: Subject) -> Iterator[str]:
    """Every Real has a nominal value, its own or its type's, by which solvers scale and plots choose their range."""
    if not (bare := [v.name for v in subject.variables if v.type in _REALS and not _find_nominal(v)]):
        return
    yield f"without a nominal value: {join_some(bare)}; give one to each or to its type"


def check_experiment(subject: Subject) -> Iterator[str]:
    """The default experiment has what a user of an importer would otherwise have to guess."""
    experiment = subject.description.defaultExperiment
    named = {"stopTime": "stopTime", "tolerance": "tolerance", "stepSize": "stepSize"}
    missing = [name for name in named if experiment is None or getattr(experiment, name) is None]
    if missing:
        yield f"DefaultExperiment has no {', '.join(missing)}: hosts then take values of their own"


def check_authorship(subject: Subject) -> Iterator[str]:
    """Author, copyright and licence are said."""
    missing = [name for name in ("author", "copyright", "license") if not subject.root.get(name)]
    if missing:
        yield f"the description does not say {', '.join(missing)}"


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


def check_token(subject: Subject) -> Iterator[str]:
    """The guid of FMI 2.0, or instantiation token of 3.0, is not empty: it distinguishes builds."""
    if not (subject.description.guid or "").strip():
        yield "guid (instantiationToken) is empty"


RULES = (
    Rule("units", "every Real has a unit", False, check_units),
    Rule("exponents", "every unit has its SI exponents", False, check_unit_exponents),
    Rule("start", "start values are there, of their type and within limits", True, check_start_values),
    Rule("limits", "min is not above max", True, check_limits),
    Rule("initial", "inputs have no `initial`", True, check_initial),
    Rule("dependencies", "outputs say what they depend on", False, check_dependencies),
    Rule("knowns", "outputs depend on knowns only", True, check_dependency_kinds),
    Rule("enumerations", "enumerations have items, all different", True, check_enumerations),
    Rule("nominals", "every Real has a nominal value", False, check_nominals),
    Rule("experiment", "DefaultExperiment has stop time, tolerance and step size", False, check_experiment),
    Rule("authorship", "author, copyright and licence", False, check_authorship),
    Rule("library", "a library with the name of the model identifier", True, check_library),
    Rule("platforms", "libraries that can be loaded where they lie", True, check_platforms),
    Rule("documents", "external dependencies and licences where importers look", True, check_documents),
    Rule("icon", "an icon", False, check_icon),
    Rule("token", "guid or instantiation token", True, check_token),
    Rule("content", "the guid of our own FMUs is that of their content", True, check_token_of_content),
    Rule("reproducible", "same inputs, same bytes", False, check_reproducible),
)
"""Every rule, in the order of the report."""


def _list_numbers(v: Any) -> list[str]:
    """Start values that are numbers, as text."""
    if v.type not in (*_REALS, *_WHOLE):
        return []
    return str(v.start).split() if v.dimensions else [str(v.start)]


def _parse_number(kind: str, text: str) -> float:
    return float(text.replace("INF", "inf")) if kind in _REALS else int(text)


def _find_nominal(v: Any) -> Any:
    """Nominal value of a Real or of its type."""
    return v.nominal or (v.declaredType is not None and v.declaredType.nominal)


def _find_limits(v: Any) -> tuple[Any, Any]:
    """min and max of a numeric variable, or of its type; None where there is none."""
    declared = v.declaredType
    low = v.min if v.min is not None or declared is None else declared.min
    high = v.max if v.max is not None or declared is None else declared.max
    if v.type == "Enumeration" and declared is not None and declared.items:
        values = [int(item.value) for item in declared.items]
        low, high = low if low is not None else min(values), high if high is not None else max(values)
    return (low, high) if v.type in (*_REALS, *_WHOLE) else (None, None)
