"""Reads the folder of a finished run, from any master, and refuses an incomplete folder.

    states.csv     time [s] and 12 states per ship, a row per communication point
    contacts.csv   a row per contact point and step
    signals.csv    time, clearance [m] and dissipated energy [J], rows as in states.csv
    events.json    collisions and scratches
    bodies.json    hulls, inertias, obstacles
    summary.json   scenario, steps

Checks: every file exists and is complete, tables have the summary's number of rows and finite numbers, and every named
body has a shape. Columns and keys that pictures do not need are ignored.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

import numpy as np
import numpy.typing as npt
from pydantic import ConfigDict, Field, ValidationError

from ...errors import InputError
from ...fmi.names import STATE
from ...ship.frames import Array
from ...ship.tables.table import Row, Table

__all__ = ["FILES", "REMEDY", "Bodies", "Events", "RunFolder", "read_columns", "read_run_folder", "read_text"]

FILES = ("states.csv", "contacts.csv", "signals.csv", "events.json", "bodies.json", "summary.json")
SIGNALS = ("clearance", "energy.dissipated")
CONTACT_NUMBERS = ("time", "scratch", "impulse_normal", "impulse_tangential", "energy")
REMEDY = "give a folder that `shipcollision run` has stored a run in, or run the scenario again"
OTHER_FOLDER = (
    "give a folder that `shipcollision run` or `shipcollision study` has written; a study begins its folder some "
    "seconds after its start"
)
"""Remedy where nothing of a run is found."""

Vector = tuple[float, float, float]
Content = TypeVar("Content", bound="_Model")


class _Model(Table):
    """An object of a run's JSON: keys of later versions are ignored, and lists are read as the tuples that they are."""

    model_config = ConfigDict(extra="ignore", strict=False)


class _Surface(_Model):
    vertices: list[Vector] = Field(min_length=4)
    triangles: list[tuple[int, int, int]] = Field(min_length=4)


class ShipBody(_Surface):
    """A ship in bodies.json."""

    ship: str = ""
    kind: str = ""
    L_pp: float = Field(gt=0)
    L_oa: float = Field(gt=0)
    B: float = Field(gt=0)
    T: float = Field(gt=0)
    shape: str = ""
    inertia: Annotated[list[Row], Field(min_length=6, max_length=6)]
    degrees_of_freedom: Literal[3, 4, 6] = 6
    """Runs of version 0.1 before this key have none."""


class ObstacleBody(_Surface):
    """An obstacle in bodies.json."""

    kind: str = ""
    position: Vector
    heading: float


class Bodies(_Model):
    """bodies.json."""

    ships: dict[str, ShipBody] = Field(min_length=1)
    obstacles: dict[str, ObstacleBody] = Field(default={})


class Point(_Model):
    """A contact point in n and in both bodies' frames [m]."""

    n: Vector
    b_a: Vector
    b_b: Vector


class _Impulse(_Model):
    magnitude: float


class CollisionEvent(_Model):
    """A collision in events.json."""

    id: int
    ship_a: str
    ship_b: str
    start: float
    end: float
    first_point: Point
    closing_speed: float | None
    angle: float | None
    impulse: _Impulse
    energy: float


class ScratchEvent(_Model):
    """A scratch in events.json."""

    id: int
    collision: int
    ship_a: str
    ship_b: str
    start: float
    end: float
    first_point: Point
    time: list[float] = Field(min_length=1)
    b_a: list[Vector] = Field(min_length=1)
    b_b: list[Vector] = Field(min_length=1)


class Events(_Model):
    """events.json."""

    collisions: list[CollisionEvent]
    scratches: list[ScratchEvent]


class Summary(_Model):
    """The keys of summary.json that pictures need."""

    scenario: str
    description: str = ""
    steps: int = Field(ge=1)
    algorithm: str = ""
    engine: str = "python"
    """A run with Python has no such key."""


@dataclass(frozen=True, eq=False)
class RunFolder:
    """A run as read: `states` (rows, ships, 12), `times` (rows,) [s], `signals` and `contacts` by column."""

    path: Path
    times: Array
    states: Array
    signals: dict[str, Array]
    contacts: dict[str, Array]
    events: Events
    bodies: Bodies
    summary: Summary


def read_run_folder(path: str | Path) -> RunFolder:
    """The run in the folder `path`. Raises InputError, in one line, when it is incomplete."""
    folder = Path(path)
    texts = _read_texts(folder)
    summary = _parse(folder / "summary.json", texts, Summary)
    bodies = _parse(folder / "bodies.json", texts, Bodies)
    events = _parse(folder / "events.json", texts, Events)
    rows = summary.steps + 1
    state_columns = [f"{ship}.{state}" for ship in bodies.ships for state in STATE]
    states = read_columns(folder / "states.csv", texts["states.csv"], ("time", *state_columns), rows)
    signals = read_columns(folder / "signals.csv", texts["signals.csv"], ("time", *SIGNALS), rows)
    contacts = read_columns(folder / "contacts.csv", texts["contacts.csv"], CONTACT_NUMBERS, None)
    times = states[:, 0]
    _check_times(folder, times, signals[:, 0])
    _check_triangles(folder, bodies)
    _check_events(folder, events, bodies, contacts[:, CONTACT_NUMBERS.index("scratch")])
    return RunFolder(
        folder, times, states[:, 1:].reshape(rows, len(bodies.ships), len(STATE)),
        dict(zip(SIGNALS, signals[:, 1:].T, strict=True)), dict(zip(CONTACT_NUMBERS, contacts.T, strict=True)),
        events, bodies, summary,
    )  # fmt: skip


def _read_texts(folder: Path) -> dict[str, str]:
    if not folder.is_dir():
        fault = "is not a folder" if folder.exists() else "does not exist"
        raise InputError(f"{folder} {fault}: {OTHER_FOLDER}")
    missing = [name for name in FILES if not (folder / name).is_file()]
    if missing:
        if len(missing) == len(FILES):
            fault = "is empty" if not any(folder.iterdir()) else "is not the folder of a run or a study"
            raise InputError(f"{folder} {fault}: {OTHER_FOLDER}")
        fault = f"has no {' and no '.join(missing)}, so it is not the whole folder of a run"
        raise InputError(f"{folder} {fault}: {REMEDY}")
    return {name: read_text(folder / name) for name in FILES}


def read_text(path: Path) -> str:
    """The text of a file of a run. Raises InputError for one that cannot be read or is cut short."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        said = getattr(error, "strerror", None) or error  # an OSError's own text has the path again
        raise InputError(f"{path} cannot be read ({said}): {REMEDY}") from None
    if not text.endswith("\n"):
        fault = "ends in the middle of a line" if text.strip() else "is empty"
        raise InputError(f"{path}: {fault}: {REMEDY}")
    return text


def _parse(path: Path, texts: dict[str, str], model: type[Content]) -> Content:
    try:
        return model.model_validate(json.loads(texts[path.name]))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: is not JSON ({error}): {REMEDY}") from None
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "the whole"
        raise InputError(f"{path}: {where}: {first['msg']}: {REMEDY}") from None


def read_columns(path: Path, text: str, columns: Sequence[str], rows: int | None) -> Array:
    """The named columns of a table as (rows, columns); other columns may hold text."""
    header_line, _, body = text.partition("\n")
    header = next(csv.reader([header_line]), [])
    absent = [column for column in columns if column not in header]
    if absent:
        raise InputError(f"{path}: has no column {absent[0]!r}: {REMEDY}")
    if not body:
        table = np.zeros((0, len(columns)))
    else:
        try:
            table = np.loadtxt(
                io.StringIO(body), delimiter=",", comments=None, ndmin=2, quotechar='"',
                usecols=[header.index(column) for column in columns],
            )  # fmt: skip
        except ValueError as error:
            raise InputError(f"{path}: {_join_lines(error)}: {REMEDY}") from None
        _check_width(path, body, len(header))
    if rows is not None and len(table) != rows:
        raise InputError(f"{path}: has {len(table)} rows, summary.json says {rows}: it is not whole; {REMEDY}")
    if not np.isfinite(table).all():
        row, column = (int(i) for i in np.argwhere(~np.isfinite(table))[0])
        raise InputError(f"{path}: row {row + 1}: {columns[column]} = {table[row, column]} is not finite: {REMEDY}")
    return table


def _check_width(path: Path, body: str, width: int) -> None:
    """Refuse a last row without all columns, where a file is cut; loadtxt reads the named columns only."""
    last = next(csv.reader([body.rstrip("\n").rpartition("\n")[2]]), [])
    if len(last) != width:
        raise InputError(f"{path}: its last row has {len(last)} of {width} columns: it is not whole; {REMEDY}")


def _join_lines(error: ValueError) -> str:
    return " ".join(str(error).split()).rstrip(".")


def _check_times(folder: Path, times: Array, signal_times: Array) -> None:
    if np.any(np.diff(times) <= 0.0):
        row = int(np.argmax(np.diff(times) <= 0.0)) + 2
        raise InputError(f"{folder / 'states.csv'}: row {row}: time does not increase: {REMEDY}")
    if not np.array_equal(times, signal_times):
        raise InputError(f"{folder}: states.csv and signals.csv have different times, so are of two runs: {REMEDY}")


def _check_triangles(folder: Path, bodies: Bodies) -> None:
    surfaces: dict[str, Any] = {**bodies.obstacles, **bodies.ships}
    for name, surface in surfaces.items():
        indices: npt.NDArray[np.int64] = np.array(surface.triangles)
        if indices.min() < 0 or indices.max() >= len(surface.vertices):
            raise InputError(
                f"{folder / 'bodies.json'}: a triangle of {name} names vertex {indices.max()} of "
                f"{len(surface.vertices)}: {REMEDY}"
            )


def _check_events(folder: Path, events: Events, bodies: Bodies, scratch_numbers: Array) -> None:
    """Pairs are known, lines have a time per point, and the scratches are those of contacts.csv."""
    pairs: list[CollisionEvent | ScratchEvent] = [*events.collisions, *events.scratches]
    for name in [name for event in pairs for name in (event.ship_a, event.ship_b)]:
        if name not in bodies.ships and name not in bodies.obstacles:
            raise InputError(f"{folder / 'events.json'}: {name!r} is not in bodies.json: {REMEDY}")
    for scratch in events.scratches:
        if not len(scratch.time) == len(scratch.b_a) == len(scratch.b_b):
            raise InputError(f"{folder / 'events.json'}: scratch {scratch.id} has not a time per point: {REMEDY}")
    known = {scratch.id for scratch in events.scratches}
    seen = {int(number) for number in scratch_numbers if number > 0}
    if known != seen:
        odd = min(known ^ seen)
        where = ("events.json", "contacts.csv") if odd in known else ("contacts.csv", "events.json")
        raise InputError(f"{folder}: scratch {odd} is in {where[0]} and not in {where[1]}: not whole; {REMEDY}")
