"""FMI compliance of an FMU file: FMPy's checks (schema, names, structure, start values, units), and what they leave
out (rules.py: the description and the file; calls.py: what calls show)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path
from zipfile import is_zipfile

from fmpy.validation import validate_fmu

from ..errors import InputError
from .calls import PROBES
from .calls import findings as found_by_calls
from .rules import RULES, Subject

__all__ = ["NAMES", "Finding", "findings", "problems"]

NAMES = ("fmpy", *(rule.name for rule in RULES), *(probe.name for probe in PROBES))
"""Names of all checks."""


@dataclass(frozen=True)
class Finding:
    """Something that a check found: the check's name, a line, and whether the standard is broken or good practice."""

    check: str
    line: str
    binding: bool

    def __str__(self) -> str:
        return f"{self.check}: {self.line}"


def findings(fmu: Path, *, calls: bool = True, ignore: Collection[str] = ()) -> list[Finding]:
    """What is wrong with an FMU, problems and notes. With calls = False the FMU's code is not run.

    Raises InputError for a file that is no FMU, and for a check to ignore that is none.
    """
    unknown = [name for name in ignore if name not in NAMES]
    if unknown:
        raise InputError(f"{unknown[0]!r} is not a check: one of {', '.join(NAMES)}")
    if fmu.is_dir():
        raise InputError(f"{fmu} is a folder: give the path of a .fmu file")
    if not fmu.is_file():
        raise InputError(f"{fmu} does not exist: build the FMUs with `shipcollision build`")
    if not is_zipfile(fmu):
        raise InputError(f"{fmu} is not a zip archive: give the path of a .fmu file")
    found = [Finding("fmpy", " ".join(problem.split()), True) for problem in validate_fmu(str(fmu))]
    try:
        subject = Subject(fmu)
    except Exception as error:  # what cannot be read has been told by fmpy, unless it can read it
        return [one for one in found if one.check not in ignore] or [Finding("fmpy", _line(error), True)]
    for rule in RULES:
        if rule.name not in ignore:
            found += [Finding(rule.name, line, rule.binding) for line in rule.broken(subject)]
    if calls:
        found += [Finding(probe.name, line, probe.binding) for probe, line in found_by_calls(fmu)]
    return [one for one in found if one.check not in ignore]


def problems(fmu: Path, *, calls: bool = True) -> list[str]:
    """What breaks the standard, a line each; empty when nothing does. Raises InputError for a file that is no FMU."""
    return [str(one) for one in findings(fmu, calls=calls) if one.binding]


def _line(error: BaseException) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
