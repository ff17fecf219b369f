"""What a study file may hold, as plain text: for `shipcollision study --keys` and for the documents."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from pydantic import BaseModel
from pydantic_core import PydanticUndefined

from .distributions import DISTRIBUTIONS, Constant, Distribution
from .fleet_tables import FleetTable, PoolTable
from .situations import SituationsTable
from .study_file import EncounterTable, Header, RunTable, TableFile
from .variables import NUMBERS, WORDS

__all__ = ["TABLES", "DistributionKeys", "Key", "VariableKey", "list_distributions", "list_keys", "list_variables"]

TABLES: Mapping[str, type[BaseModel]] = {
    "[study]": Header, "[own], [target]": FleetTable, "[[own.sampled]], [[target.sampled]]": PoolTable,
    "[run]": RunTable, "[tables.NAME]": TableFile, "[situations]": SituationsTable,
}  # fmt: skip
"""The tables of a study file but [encounter] and [grid]."""


class Key(NamedTuple):
    """A key of a table: its name, its default ("required" where it must be given), its meaning."""

    name: str
    default: str
    meaning: str

    @property
    def is_required(self) -> bool:
        """Whether it must be given."""
        return self.default == REQUIRED


class VariableKey(NamedTuple):
    """A key of [encounter] and [grid]: its name, its limits or words, the levels at which it acts, default, meaning."""

    name: str
    limits: str
    words: tuple[str, ...]
    levels: str
    default: str
    meaning: str


class DistributionKeys(NamedTuple):
    """A distribution: the word in the key `distribution`, what it is, its keys."""

    word: str
    meaning: str
    keys: list[Key]


REQUIRED = "required"


def list_keys(table: type[BaseModel]) -> list[Key]:
    """The keys of a table."""
    return [
        Key(name, REQUIRED if field.is_required() else _format(field.get_default()), field.description or "")
        for name, field in table.model_fields.items()
    ]


def list_variables() -> Iterator[VariableKey]:
    """The keys of [encounter] and [grid]."""
    for name, words in WORDS.items():
        given = EncounterTable.model_fields[name].default
        assert isinstance(given, Distribution)
        yield VariableKey(name, "", words, "all", given.words()[0], _describe(name))
    for name, of in NUMBERS.items():
        default = "of the kind" if of.default is None else f"{of.default:g}"
        if name.startswith(("current", "wind")):
            default = "of the file"
        limits = f"{of.least:g} to {of.most:g}" + (f" {of.unit}" if of.unit else "")
        levels = "all" if len(of.levels) == 3 else ", ".join(of.levels)
        yield VariableKey(name, limits, (), levels, default, f"{of.meaning}; {of.hint}")


def list_distributions() -> Iterator[DistributionKeys]:
    """The distributions and their keys."""
    for word, model in DISTRIBUTIONS.items():
        if model is not Constant:
            keys = [key for key in list_keys(model) if key.name != "distribution"]
            yield DistributionKeys(word, (model.__doc__ or "").split("\n")[0], keys)


def _describe(name: str) -> str:
    return (EncounterTable.model_fields[name].description or "").split(", ")[0]


def _format(value: Any) -> str:
    if isinstance(value, Constant):
        value = value.value
    return "" if value in (None, "", [], PydanticUndefined) else str(value)
