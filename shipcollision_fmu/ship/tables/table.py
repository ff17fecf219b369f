"""The base of every table that a user writes, and the kinds of number in it, for other rooms as well."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, JsonValue, PlainSerializer

__all__ = ["ESTIMATED", "NotNegative", "Pair", "Positive", "Row", "Table", "Vector"]

ESTIMATED: dict[str, JsonValue] = {"without": "estimated"}
"""Mark of a key that the main dimensions and the kind give where it is left out (loading/dimensions_estimate.py), for
the reference page."""

Positive = Annotated[float, Field(gt=0.0)]
NotNegative = Annotated[float, Field(ge=0.0)]
Pair = Annotated[list[float], Field(min_length=2, max_length=2)]
Row = Annotated[list[float], Field(min_length=6, max_length=6)]
Vector = Annotated[
    list[float], Field(min_length=3, max_length=3), AfterValidator(tuple), PlainSerializer(list, list[float])
]
"""Three numbers, read as a list and kept as a tuple: the tables of a ship are shared and must not change."""


class Table(BaseModel):
    """A table of a file: unknown keys, numbers in quotes and numbers that are not finite are refused; it is frozen."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)
