"""Study: all that determines the rows of a study, and read_study().

    file  ->  StudyFile (keys, limits)  ->  tables and ships are read  ->  checks between tables  ->  Study

A Study opens no file: what it needs of others is in it, so that it can be sent to another machine.
"""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from math import prod
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ...errors import StudyError
from ...files import is_file, is_folder
from ...ship.loading.library import find_models
from ...ship.loading.messages import describe_error, suggest_or_list
from ...ship.loading.toml import parse_toml
from .dimensions import list_dimensions
from .distributions import Distribution
from .empirical import EmpiricalTable, read_empirical_table
from .fleet import Fleet, digest_ships, make_fleet
from .level_checks import check_level
from .situations import read_situations
from .study_file import MOST_ROWS, Header, RunTable, StudyFile
from .table_checks import check_columns
from .variables import SAILED, WORDS
from .warnings import list_warnings

__all__ = ["Study", "list_study_names", "parse_study", "read_study"]

SOBOL_DIMENSIONS = 32
"""Dimensions for which rows/direction_numbers.py has numbers."""
FORMAT = 2
"""Counts changes of how rows and columns are made from a study: part of the fingerprint, so that old and new rows never
mix."""


@dataclass(frozen=True, eq=False, repr=False)
class Study:
    """A study, ready to make rows.

    text          the study file as given
    source        its name in messages
    folder        that of its file, in which paths in it begin
    inputs        sha256 of each ship, table and folder that it names, by a name for messages
    fingerprint   sha256 of all that determines the rows: keys of the file, inputs, version of the package
    variables     distributions by name
    grid          values by name, all combined; the first name varies slowest
    tables        empirical tables by name
    own, target   the ships; empty fleets where those of the situations stay
    situations    contents of files of traffic by name, and their duration [s] if one is given
    """

    text: str
    source: str
    folder: str
    inputs: dict[str, str]
    fingerprint: str
    header: Header
    rows: int
    run: RunTable
    variables: dict[str, Distribution]
    grid: dict[str, list[Any]]
    tables: dict[str, EmpiricalTable]
    own: Fleet
    target: Fleet
    situations: dict[str, bytes]
    situation_duration: float | None

    @property
    def name(self) -> str:
        """Its name, and that of its folder."""
        return self.header.name

    @property
    def level(self) -> str:
        """ "impact", "encounter" or "sailed"."""
        return self.header.level

    @property
    def dimensions(self) -> list[str]:
        """What is drawn at random, in the order of the sampler's dimensions."""
        return list_dimensions(self.tables, {"own": self.own, "target": self.target}, self.variables, self.grid)

    @property
    def warnings(self) -> list[str]:
        """What is hardly meant, in a line each."""
        return list(list_warnings(self.rows, self.dimensions, self.grid, self.variables, self.tables))

    @property
    def seed(self) -> int:
        """The seed of its random numbers."""
        return self.header.seed

    def __repr__(self) -> str:
        """Name, size and level, in one line."""
        return f"study {self.name}: {self.rows} rows, level {self.level}, sampler {self.header.sampler}"


def list_study_names() -> list[str]:
    """Names of the shipped studies, sorted."""
    return sorted(path.stem for path in (find_models() / "studies").glob("*.toml"))


def read_study(name_or_path: str | Path) -> Study:
    """The study of a shipped name (`quick`) or of a file (`my/study.toml`).

    An argument with the suffix .toml or a path separator is a file. In study.toml of the folder of a study, paths begin
    where they began in the original. Raises StudyError, in one line, for a file that is missing or refused, and for
    ships or tables that it names and that cannot be read.
    """
    path = _locate(name_or_path)
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise StudyError(f"{path} cannot be read: {error.strerror}: give the path of a study file") from None
    except UnicodeDecodeError as error:
        raise StudyError(f"{path.name} is not UTF-8 text (byte {error.start}): save it as UTF-8") from None
    return parse_study(text, path.name, _find_home(path))


def _find_home(path: Path) -> Path:
    """The folder in which paths of a study file begin: for the copy beside the tables of a study, the original's."""
    if path.name == "study.toml":
        with suppress(OSError, ValueError, KeyError, TypeError):
            home = Path(json.loads((path.parent / "study.json").read_bytes())["folder"])
            if home.is_dir():
                return home
    return path.parent


def parse_study(text: str, source: str = "study", folder: str | Path = ".") -> Study:
    """The study in TOML text. source: its name in messages; folder: where paths in it begin. Raises StudyError."""
    data, folder = parse_toml(text, source, StudyError), Path(folder)
    _refuse_other_file(data, source)
    try:
        file = StudyFile.model_validate(data)
    except ValidationError as error:
        raise StudyError(f"{source}: {describe_error(error, StudyFile)}") from None
    tables = {
        name: read_empirical_table(name, folder / of.file, of.weight, f"{source}: [tables.{name}]")
        for name, of in file.tables.items()
    }
    check_columns(file, tables, source)
    variables = dict(file.encounter.list_given())
    check_level(file, variables, tables, source)
    sails = file.study.level == SAILED
    if file.situations is not None:  # their files say how the ships meet
        variables = {name: given for name, given in variables.items() if name not in WORDS}
    own = make_fleet("own", file.own, tables, folder, source, sails)
    situations = {}
    if file.situations is not None:
        situations = read_situations(file.situations, folder, f"{source}: [situations]")
    target = own
    if file.target is not None or situations:
        target = make_fleet("target", file.target, tables, folder, source, sails)
    inputs = _digest_inputs(file, own, target, tables, situations)
    study = Study(
        text, source, str(folder.resolve()), inputs, _digest(data, file, inputs), file.study,
        _count_rows(file, len(situations), source), file.run, variables,
        {"situation": list(situations), **file.grid} if situations else file.grid, tables, own, target, situations,
        None if file.situations is None else file.situations.duration,
    )  # fmt: skip
    _check_dimensions(study)
    return study


def _check_dimensions(study: Study) -> None:
    """Raise StudyError for more dimensions than Sobol's sequence has."""
    drawn = study.dimensions
    if study.header.sampler == "sobol" and len(drawn) > SOBOL_DIMENSIONS:
        raise StudyError(
            f"{study.source}: [study] sampler = 'sobol' has {SOBOL_DIMENSIONS} dimensions, and {len(drawn)} variables, "
            "ships and tables are drawn: take latin-hypercube"
        )


def _refuse_other_file(data: dict[str, Any], source: str) -> None:
    for table, what in (("scenario", "a scenario"), ("particulars", "a ship")):
        if table in data and "study" not in data:
            raise StudyError(f"{source} is {what}, not a study: give a study, which has a table [study]")


def _count_rows(file: StudyFile, situations: int, source: str) -> int:
    """The number of rows, a whole number of grids."""
    cells, rows = max(situations, 1) * prod(len(values) for values in file.grid.values()), file.study.rows
    if cells > MOST_ROWS:
        raise StudyError(f"{source}: [grid] has {cells} cells, the limit is {MOST_ROWS}: take fewer values of a key")
    if rows is None:
        if not file.grid and not situations:
            raise StudyError(f"{source}: [study] rows is missing: give the number of cases, or a table [grid]")
        return cells
    if rows % cells:
        cell = "cells of [grid]" if not situations else "situations" if not file.grid else "situations and cells"
        near = [n * cells for n in (rows // cells, rows // cells + 1) if n]
        raise StudyError(
            f"{source}: [study] rows = {rows} is {rows / cells:.4g} times the {cells} {cell}, must be a whole "
            f"number of times: take {' or '.join(map(str, near))}, or leave rows out"
        )
    return rows


def _digest_inputs(
    file: StudyFile, own: Fleet, target: Fleet, tables: dict[str, EmpiricalTable], situations: dict[str, bytes]
) -> dict[str, str]:
    inputs = digest_ships("own", own) | (digest_ships("target", target) if target is not own else {})
    for name, table in tables.items():
        columns = [[column, sha256(values.tobytes()).hexdigest()] for column, values in sorted(table.columns.items())]
        inputs[f"file {file.tables[name].file} of [tables.{name}]"] = sha256(json.dumps(columns).encode()).hexdigest()
    if situations and file.situations is not None:
        files = [[name, sha256(content).hexdigest()] for name, content in situations.items()]
        inputs[f"folder {file.situations.folder} of [situations]"] = sha256(json.dumps(files).encode()).hexdigest()
    return inputs


def _digest(data: dict[str, Any], file: StudyFile, inputs: dict[str, str]) -> str:
    """Rows of a Latin hypercube depend on how many there are. Those of other samplers do not: the study can grow."""
    from ... import __version__

    if file.study.sampler != "latin-hypercube":
        data = {**data, "study": {key: value for key, value in data["study"].items() if key != "rows"}}
    parts = [FORMAT, __version__, data, inputs]
    return sha256(json.dumps(parts, sort_keys=True, default=repr).encode()).hexdigest()


def _locate(name_or_path: str | Path) -> Path:
    if not isinstance(name_or_path, str | Path) or name_or_path == "":
        raise StudyError(f"study = {name_or_path!r} is no study: give a name or the path of a TOML file")
    text = str(name_or_path)
    known = list_study_names()
    if isinstance(name_or_path, Path) or text.endswith(".toml") or "/" in text or "\\" in text:
        path = Path(text)
        if is_folder(path):
            raise StudyError(f"{text} is a folder: give the path of a study file, or one of {', '.join(known)}")
        if not is_file(path):
            raise StudyError(
                f"study file {text} does not exist: give the path of a TOML file or one of {', '.join(known)}"
            )
        return path
    if text in known:
        return find_models() / "studies" / f"{text}.toml"
    if Path(text).suffix or is_file(Path(text)):
        raise StudyError(f"{text} is no TOML file: give a study file, NAME.toml, or one of {', '.join(known)}")
    raise StudyError(f"unknown study {text!r}:{suggest_or_list(text, known, 'give the path of a TOML file')}")
