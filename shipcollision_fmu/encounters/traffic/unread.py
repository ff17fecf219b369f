"""The tables of a foreign file that nothing reads, so that its user is told."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

__all__ = ["MOST_NAMED", "list_unread", "name_unread"]

MOST_NAMED = 12
"""Tables that a note names; a file may have hundreds of kinds."""


def name_unread(model: BaseModel) -> list[str]:
    """A note that names the unread tables of a file, or none."""
    unread = list(dict.fromkeys(list_unread(model)))
    more = f" and {len(unread) - MOST_NAMED} more" if len(unread) > MOST_NAMED else ""
    return [f"Not used: {', '.join(unread[:MOST_NAMED])}{more}."] if unread else []


def list_unread(model: BaseModel, path: str = "") -> Iterator[str]:
    """Paths of the tables, and of the lists of tables, that the model ignores.

    Numbers and texts beside what is read are not named, unless the model says that all its members count
    (`ALL_COUNT`).
    """
    all_count = getattr(model, "ALL_COUNT", False)
    for key, value in (model.model_extra or {}).items():
        if _is_table(value) or (all_count and value is not None):
            yield f"{path}{key}"
    for key in type(model).model_fields:
        for below in _list_models(getattr(model, key)):
            yield from list_unread(below, f"{path}{key}.")


def _is_table(value: Any) -> bool:
    return bool(value) and (isinstance(value, dict) or (isinstance(value, list) and isinstance(value[0], dict)))


def _list_models(value: Any) -> Iterator[BaseModel]:
    if isinstance(value, BaseModel):
        yield value
    elif isinstance(value, list):
        yield from (item for item in value if isinstance(item, BaseModel))
