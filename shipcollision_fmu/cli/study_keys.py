"""print_keys(): the keys of a study file, its distributions, and the columns of its tables, on stdout."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rich.markup import escape

from .console import print_table, say
from .table import make_table

__all__ = ["print_keys"]


def print_keys() -> None:
    """Prints a table for each table of a study file, and for each table that a study makes."""
    from ..study.definition.reference import TABLES, list_distributions, list_keys, list_variables
    from ..study.rows.columns import COLLISIONS, ENCOUNTERS

    for name, model in TABLES.items():
        _print(name, ("key", "default", "meaning"), list_keys(model))
    variables = ((key.name, ", ".join(key.words) or key.limits, *key[3:]) for key in list_variables())
    _print("[encounter], [grid]", ("key", "limits", "levels", "default", "meaning"), variables)
    for word, meaning, keys in list_distributions():
        _print(f'distribution = "{word}": {meaning}', ("key", "default", "meaning"), keys)
    for table, columns in (("encounters", ENCOUNTERS), ("collisions", COLLISIONS)):
        _print(f"Columns of {table}", ("column", "type", "unit", "meaning"), columns)


def _print(title: str, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    table = make_table(*header)
    for row in rows:
        table.add_row(*map(escape, row))
    say(title)
    print_table(table)
