"""Reads a variable of a study file: a number or a word, or a table with the key `distribution`."""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import PlainValidator, ValidationError

from ...ship.loading.messages import describe_problems, join_problems, suggest_or_list
from .distributions import DISTRIBUTIONS, Constant, Distribution

__all__ = ["Variable", "read_distribution"]

OF_A_TABLE = {"table", "column"}
"""Keys that name a column of a table; `distribution` may be left out beside them."""


def read_distribution(given: Any) -> Distribution:
    """The distribution. Raises ValueError, in one line, for what is none."""
    if isinstance(given, Distribution):
        return given
    if isinstance(given, dict):
        return _read_table(given)
    try:
        return Constant(value=given)
    except ValidationError:
        hint = '; a list of values is {distribution = "discrete", values = [...]}' if isinstance(given, list) else ""
        raise ValueError(
            f'the value {given!r} must be a finite number, a word, or a table such as {{distribution = "uniform", '
            f"least = 1.0, most = 9.0}}{hint}"
        ) from None


def _read_table(given: dict[str, Any]) -> Distribution:
    named = given.get("distribution", "table" if set(given) & OF_A_TABLE else None)
    if named is None:
        raise ValueError(f"distribution is missing: give one of {', '.join(DISTRIBUTIONS)}")
    if not isinstance(named, str) or named not in DISTRIBUTIONS:
        near = suggest_or_list(str(named), list(DISTRIBUTIONS))
        raise ValueError(f"distribution = {named!r} is unknown:{near}")
    model = DISTRIBUTIONS[named]
    try:
        return model.model_validate(given)
    except ValidationError as error:
        raise ValueError(join_problems([_without_brackets(line) for line in describe_problems(error, model)])) from None


def _without_brackets(line: str) -> str:
    """ "[sd] = -1 must ..." as "sd = -1 must ...": the key is not a table here."""
    return re.sub(r"^\[([^\]]*)\](:?) ?", r"\1\2 ", line)


Variable = Annotated[Distribution, PlainValidator(read_distribution)]
"""The type of a key that takes a distribution."""
