"""FMI compliance of an FMU file, by FMPy's checks: schema, names, structure, start values, units."""

from __future__ import annotations

from pathlib import Path
from zipfile import is_zipfile

from fmpy.validation import validate_fmu

from ..errors import InputError

__all__ = ["problems"]


def problems(fmu: Path) -> list[str]:
    """What is wrong with an FMU, a line each; empty when nothing is. Raises InputError for a file that is no FMU."""
    if not fmu.is_file():
        raise InputError(f"{fmu} does not exist: build the FMUs with `shipcollision build`")
    if not is_zipfile(fmu):
        raise InputError(f"{fmu} is not a zip archive: give the path of a .fmu file")
    return [" ".join(problem.split()) for problem in validate_fmu(str(fmu))]
