"""The tables of a study file and the checks that need one table alone."""

from __future__ import annotations

import re
from typing import Annotated, Any, Literal

from pydantic import Field, PlainValidator, field_validator, model_validator

from ...encounters.request import KINDS
from ...scenario.tables.header import MAXIMUM_STEPS
from ...ship.loading.messages import suggest_or_list
from ...ship.tables.table import NotNegative, Table
from .distribution_text import Variable
from .distributions import Constant, Distribution, TableColumn
from .fleet_tables import FleetTable, check_limits
from .situations import SituationsTable
from .variables import NUMBERS, WORDS

__all__ = ["MOST_ROWS", "SAMPLERS", "USUAL_TIME", "EncounterTable", "Header", "RunTable", "StudyFile", "TableFile"]

SAMPLERS = ("latin-hypercube", "random", "sobol")

MOST_ROWS = 10_000_000_000
"""Rows of the largest study, a year on a thousand cores."""
MOST_SEED = 2**63 - 1


class Header(Table):
    """[study]: name, level of detail, number of rows, and how the random numbers are made."""

    name: str = Field(description='the name of the study, e.g. "strait"')
    description: str = Field(default="", description="text for people; no effect")
    level: Literal["impact", "encounter", "sailed"] = Field(
        description="the level of detail: impact (the contact alone), encounter (coasting before and after) or sailed"
    )
    rows: int | None = Field(
        default=None, ge=1, le=MOST_ROWS, description="the number of cases; may be left out with [grid]"
    )
    seed: int = Field(default=1, ge=0, le=MOST_SEED, description="the start of the random numbers")
    sampler: Literal["latin-hypercube", "random", "sobol"] = Field(
        default="latin-hypercube", description="how the numbers fill the range: latin-hypercube, random or sobol"
    )

    @field_validator("name")
    @classmethod
    def _check_name(cls, name: str) -> str:
        if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", name):
            raise ValueError(f"{name!r} cannot name a folder: take letters, digits, '_', '-' and '.'")
        return name


USUAL_TIME = 1.0
"""[s] from the start to the impact at level encounter: coasting ships that close have touched nothing before it."""

OTHER_WORDS = {
    "duration": "a case ends `after` seconds after the impact, or so long after the last contact as `separation` says",
    "dt": "the communication step is `step`", "time_step": "the communication step is `step`",
}  # fmt: skip
"""What stands for keys that [run] of other programs, or of a scenario, has."""


class RunTable(Table):
    """[run]: numbers that are the same in every case."""

    @model_validator(mode="before")
    @classmethod
    def _refuse_other_words(cls, given: Any) -> Any:
        for word in given if isinstance(given, dict) else ():
            if word in OTHER_WORDS:
                raise ValueError(f"[run] {word} is not a known key: {OTHER_WORDS[word]}")
        return given

    degrees_of_freedom: Literal[3, 4, 6] = Field(
        default=3, description="of both ships: 3 (surge, sway, yaw), 4 (and roll) or 6"
    )
    time: float | None = Field(
        default=None, gt=0.0, le=7200.0, description="the time from the start to the impact [s]; without it, 1 at "
        "level encounter, and that of the kind at level sailed",
    )  # fmt: skip
    after: float = Field(default=60.0, gt=0.0, le=7200.0, description="the time from the impact to the end [s]")
    separation: NotNegative | None = Field(
        default=None, description="the time without contact [s] after which a case ends; without it, at `after`"
    )
    step: float = Field(default=0.05, ge=1e-3, le=10.0, description="the communication step [s]")

    @model_validator(mode="after")
    def _check_steps(self) -> RunTable:
        steps = round(((self.time or USUAL_TIME) + self.after) / self.step)
        if steps > MAXIMUM_STEPS:
            raise ValueError(
                f"[run] step = {self.step:g} s makes {steps} steps, the limit is {MAXIMUM_STEPS}: take a longer step"
            )
        return self


def _describe(name: str) -> str:
    of = NUMBERS[name]
    unit = f" [{of.unit}]" if of.unit else ""
    return f"{of.meaning}{unit}, {of.least:g} to {of.most:g}; {of.hint}"


def _number(name: str) -> Any:
    return Field(default=None, description=_describe(name))


class EncounterTable(Table):
    """[encounter]: how the ships meet. Each key takes a value or a distribution."""

    kind: Variable = Field(
        default=Constant(value="crossing"), description=f"the kind of encounter, one of {', '.join(KINDS)}"
    )
    side: Variable = Field(
        default=Constant(value="starboard"), description="the side of the target that is struck, port or starboard"
    )
    angle_deg: Variable | None = _number("angle_deg")
    at: Variable | None = _number("at")
    own_speed: Variable | None = _number("own_speed")
    target_speed: Variable | None = _number("target_speed")
    own_sway: Variable | None = _number("own_sway")
    target_sway: Variable | None = _number("target_sway")
    own_yaw_rate: Variable | None = _number("own_yaw_rate")
    target_yaw_rate: Variable | None = _number("target_yaw_rate")
    heading_deg: Variable | None = _number("heading_deg")
    friction: Variable | None = _number("friction")
    restitution: Variable | None = _number("restitution")
    drift_speed: Variable | None = _number("drift_speed")
    drift_deg: Variable | None = _number("drift_deg")
    before: Variable | None = _number("before")
    rudder_deg: Variable | None = _number("rudder_deg")
    current_speed: Variable | None = _number("current_speed")
    current_towards_deg: Variable | None = _number("current_towards_deg")
    wind_speed: Variable | None = _number("wind_speed")
    wind_from_deg: Variable | None = _number("wind_from_deg")

    @model_validator(mode="after")
    def _check(self) -> EncounterTable:
        for name, given in self.list_given():
            try:
                check_variable(name, given)
            except ValueError as error:
                raise ValueError(f"[encounter] {error}") from None
        return self

    def list_given(self) -> list[tuple[str, Distribution]]:
        """The variables that have a distribution, by name."""
        return [(name, given) for name in (*WORDS, *NUMBERS) if (given := getattr(self, name)) is not None]


def check_variable(name: str, given: Distribution) -> None:
    """Raise ValueError for a distribution that reaches beyond the limits of its variable."""
    if name in NUMBERS:
        of = NUMBERS[name]
        check_limits(name, given, of.least, of.most, of.hint)
        return
    if isinstance(given, TableColumn):
        return
    if not given.words():
        raise ValueError(f"{name} must be a word, or discrete with words: take of {', '.join(WORDS[name])}")
    for word in given.words():
        if word not in WORDS[name]:
            raise ValueError(f"{name} = {word!r} is unknown:{suggest_or_list(word, WORDS[name])}")


MOST_LEVELS = 100_000


def _read_axis(given: Any) -> list[float] | list[str]:
    """The values of an axis of the grid."""
    if isinstance(given, dict) and set(given) == {"least", "most", "count"}:
        least, most, count = given["least"], given["most"], given["count"]
        if type(count) is not int or not 2 <= count <= MOST_LEVELS:
            raise ValueError(f"count = {count!r} must be a whole number, 2 to {MOST_LEVELS}: the number of values")
        if not all(type(end) in (int, float) for end in (least, most)) or not -1e12 < least < most < 1e12:
            raise ValueError(f"least = {least!r} must be a number below most = {most!r}: put them in rising order")
        return [least + i * (most - least) / (count - 1) for i in range(count)]
    if isinstance(given, list) and 0 < len(given) <= MOST_LEVELS:
        if len(set(map(str, given))) < len(given):
            raise ValueError(f"the list {given!r} has a value twice: remove one of them")
        if all(isinstance(value, str) for value in given):
            return given
        if all(type(value) in (int, float) and abs(value) < 1e12 for value in given):
            return [float(value) for value in given]
    raise ValueError(
        f"the value {given!r} must be a list of numbers or of words, e.g. [30, 60, 90], or {{least = 30, most = 90, "
        "count = 3}"
    )


Axis = Annotated[Any, PlainValidator(_read_axis)]


class TableFile(Table):
    """[tables.NAME]: a file whose lines are drawn as a whole."""

    file: str = Field(min_length=1, description="the path of a CSV or Parquet file, from the study file's folder")
    weight: str | None = Field(default=None, description="the column of the lines' weights; all alike without it")


class StudyFile(Table):
    """A whole study file."""

    study: Header = Field(description="the table [study]: name, level, rows, seed, sampler")
    own: FleetTable | None = Field(default=None, description="the table [own]: the ships that strike")
    target: FleetTable | None = Field(
        default=None, description="the table [target]: the ships that are struck; those of [own] without it"
    )
    encounter: EncounterTable = Field(default=EncounterTable(), description="the table [encounter]: how they meet")
    run: RunTable = Field(default=RunTable(), description="the table [run]: what is the same in every case")
    situations: SituationsTable | None = Field(
        default=None, description="the table [situations]: files of traffic in place of [encounter] kind"
    )
    grid: dict[str, Axis] = Field(default={}, description="the table [grid]: values that are all combined")
    tables: dict[str, TableFile] = Field(default={}, description="a table [tables.NAME] for each file of data")

    @model_validator(mode="after")
    def _check_own(self) -> StudyFile:
        if self.own is None and self.situations is None:
            raise ValueError("[own] is missing: give the table [own]: the ships that strike")
        return self

    @model_validator(mode="after")
    def _check_grid(self) -> StudyFile:
        for name, values in self.grid.items():
            if name not in (*NUMBERS, *WORDS):
                raise ValueError(f"[grid] {name} is not a known key:{suggest_or_list(name, [*NUMBERS, *WORDS])}")
            if name in self.encounter.model_fields_set:
                raise ValueError(f"[grid] {name} is also a key of [encounter]: remove one of the two")
            for value in values:
                try:
                    check_variable(name, Constant(value=value))
                except ValueError as error:
                    raise ValueError(f"[grid] {error}") from None
        return self
