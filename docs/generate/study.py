"""The keys of a study file, its distributions, and the columns of its tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import BaseModel
from pydantic_core import PydanticUndefined

from shipcollision_fmu.study.definition.distributions import DISTRIBUTIONS, Constant, Distribution
from shipcollision_fmu.study.definition.fleet_tables import FleetTable, PoolTable
from shipcollision_fmu.study.definition.situations import SituationsTable
from shipcollision_fmu.study.definition.study_file import EncounterTable, Header, RunTable, TableFile
from shipcollision_fmu.study.definition.variables import NUMBERS, WORDS
from shipcollision_fmu.study.rows.columns import COLLISIONS, ENCOUNTERS, StudyColumn

from .markdown import cell, table

__all__ = ["collisions", "distributions", "encounters", "keys", "variables"]

TABLES: Mapping[str, type[BaseModel]] = {
    "[study]": Header, "[own], [target]": FleetTable, "[[own.sampled]], [[target.sampled]]": PoolTable,
    "[run]": RunTable, "[tables.NAME]": TableFile, "[situations]": SituationsTable,
}  # fmt: skip


def keys() -> str:
    """Every key of a study file but those of [encounter] and [grid], by table."""
    return "\n".join(f"### `{name}`\n\n{_describe_keys(model)}" for name, model in TABLES.items())


def distributions() -> str:
    """The keys of each distribution."""
    rows = []
    for word, model in DISTRIBUTIONS.items():
        if model is Constant:
            continue
        fields = [(key, field) for key, field in model.model_fields.items() if key != "distribution"]
        given = "; ".join(f"`{key}`{'' if field.is_required() else '*'}: {field.description}" for key, field in fields)
        rows.append((f'`"{word}"`', cell((model.__doc__ or "").split("\n")[0]), cell(given)))
    return table(("`distribution`", "what it is", "keys; with * may be left out"), rows)


def variables() -> str:
    """The keys of [encounter] and [grid]."""
    rows = [(f"`{name}`", ", ".join(f"`{word}`" for word in words), "all", _words_default(name), _describe(name))
            for name, words in WORDS.items()]  # fmt: skip
    for name, of in NUMBERS.items():
        default = "of the kind" if of.default is None else f"{of.default:g}"
        if name.startswith(("current", "wind")):
            default = "of the file"
        limits = f"{of.least:g} to {of.most:g}" + (f" {of.unit}" if of.unit else "")
        levels = "all" if len(of.levels) == 3 else ", ".join(of.levels)
        rows.append((f"`{name}`", limits, levels, default, cell(f"{of.meaning}; {of.hint}")))
    return table(("key", "limits", "levels", "default", "meaning"), rows)


def encounters() -> str:
    """The columns of the table of encounters."""
    return _describe_columns(ENCOUNTERS)


def collisions() -> str:
    """The columns of the table of collisions."""
    return _describe_columns(COLLISIONS)


def _describe_keys(model: type[BaseModel]) -> str:
    rows = [
        (f"`{key}`", _default(field.get_default(), field.is_required()), cell(field.description or ""))
        for key, field in model.model_fields.items()
    ]
    return table(("key", "default", "meaning"), rows)


def _default(value: Any, is_required: bool) -> str:
    if is_required:
        return "required"
    if isinstance(value, Constant):
        value = value.value
    return "" if value in (None, "", [], PydanticUndefined) else f"`{value}`"


def _words_default(name: str) -> str:
    given = EncounterTable.model_fields[name].default
    assert isinstance(given, Distribution)
    return f"`{given.words()[0]}`"


def _describe(name: str) -> str:
    return cell((EncounterTable.model_fields[name].description or "").split(", ")[0])


def _describe_columns(columns: Sequence[StudyColumn]) -> str:
    return table(
        ("column", "type", "unit", "meaning"),
        [(f"`{column.name}`", column.type, column.unit, cell(column.meaning)) for column in columns],
    )
