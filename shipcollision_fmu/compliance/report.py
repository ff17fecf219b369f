"""Findings about an FMU file: FMPy's checks (schema, names, structure, start values, units), rules.py and calls.py."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path
from zipfile import ZipFile, is_zipfile

from fmpy.validation import validate_fmu

from ..errors import InputError
from .calls import run_probes
from .probes import PROBES
from .rules import RULES
from .subject import Subject

__all__ = ["NAMES", "Finding", "find_problems", "validate"]

NAMES = ("fmpy", *(rule.name for rule in RULES), *(probe.name for probe in PROBES))
"""Names of all checks; --ignore accepts them."""


@dataclass(frozen=True)
class Finding:
    """A finding: the name of the check, a line, and whether the standard is broken (else good practice)."""

    check: str
    line: str
    binding: bool

    def __str__(self) -> str:
        return f"{self.check}: {self.line}"


def validate(fmu: Path, *, calls: bool = True, ignore: Collection[str] = ()) -> list[Finding]:
    """Findings about an FMU, problems and notes. With calls = False the FMU's code is not run.

    ignore: names of checks to leave out. Raises InputError for a file that is no FMU, and for an unknown name.
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
    with ZipFile(fmu) as archive:
        if "modelDescription.xml" not in archive.namelist():
            raise InputError(f"{fmu} is no FMU: it has no modelDescription.xml; give the path of a .fmu file")
    found = [Finding("fmpy", " ".join(problem.split()), True) for problem in validate_fmu(str(fmu))]
    try:
        subject = Subject(fmu)
    except Exception as error:  # reported by FMPy already, unless FMPy could read the file
        return [finding for finding in found if finding.check not in ignore] or [
            Finding("fmpy", _describe_error(error), True)
        ]
    for rule in RULES:
        if rule.name not in ignore:
            found += [Finding(rule.name, line, rule.binding) for line in rule.check(subject)]
    if calls:
        fmi = int(subject.description.fmiVersion[0])
        needs_tool = bool(getattr(subject.description.coSimulation, "needsExecutionTool", False))
        found += [Finding(probe.name, line, probe.is_binding(fmi, needs_tool)) for probe, line in run_probes(fmu)]
    return [finding for finding in found if finding.check not in ignore]


def find_problems(fmu: Path, *, calls: bool = True) -> list[str]:
    """Lines on breaches of the standard, empty for an FMU that complies. Raises InputError as validate() does."""
    return [str(finding) for finding in validate(fmu, calls=calls) if finding.binding]


def _describe_error(error: BaseException) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
