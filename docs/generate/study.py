"""The keys of a study file, its distributions, and the columns of its tables."""

from __future__ import annotations

from collections.abc import Sequence

from shipcollision_fmu.study.definition.reference import TABLES, Key, list_distributions, list_keys, list_variables
from shipcollision_fmu.study.rows.columns import COLLISIONS, ENCOUNTERS, StudyColumn

from .markdown import cell, table

__all__ = ["collisions", "distributions", "encounters", "keys", "variables"]


def keys() -> str:
    """Every key of a study file but those of [encounter] and [grid], by table."""
    return "\n".join(f"### `{name}`\n\n{_describe_keys(list_keys(model))}" for name, model in TABLES.items())


def distributions() -> str:
    """The keys of each distribution."""
    rows = []
    for word, meaning, given in list_distributions():
        text = "; ".join(f"`{key.name}`{'' if key.is_required else '*'}: {key.meaning}" for key in given)
        rows.append((f'`"{word}"`', cell(meaning), cell(text)))
    return table(("`distribution`", "what it is", "keys; with * may be left out"), rows)


def variables() -> str:
    """The keys of [encounter] and [grid]."""
    rows = []
    for key in list_variables():
        limits = ", ".join(f"`{word}`" for word in key.words) or key.limits
        default = f"`{key.default}`" if key.words else key.default
        rows.append((f"`{key.name}`", limits, key.levels, default, cell(key.meaning)))
    return table(("key", "limits", "levels", "default", "meaning"), rows)


def encounters() -> str:
    """The columns of the table of encounters."""
    return _describe_columns(ENCOUNTERS)


def collisions() -> str:
    """The columns of the table of collisions."""
    return _describe_columns(COLLISIONS)


def _describe_keys(given: Sequence[Key]) -> str:
    rows = [
        (f"`{key.name}`", key.default if key.is_required or not key.default else f"`{key.default}`", cell(key.meaning))
        for key in given
    ]
    return table(("key", "default", "meaning"), rows)


def _describe_columns(columns: Sequence[StudyColumn]) -> str:
    return table(
        ("column", "type", "unit", "meaning"),
        [(f"`{column.name}`", column.type, column.unit, cell(column.meaning)) for column in columns],
    )
