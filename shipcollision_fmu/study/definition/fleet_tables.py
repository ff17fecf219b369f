"""[own] and [target] of a study file: ships by name with weights, and pools of ships sampled by kind."""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import Field, PlainValidator, field_validator, model_validator

from ...ship.loading.consistency import C_B_LIMITS, PROPORTIONS, SIZES
from ...ship.loading.messages import suggest
from ...ship.ship_type import list_type_words, names_a_type
from ...ship.tables.table import NotNegative, Table
from .distribution_text import Variable
from .distributions import Constant, Discrete, TableColumn

__all__ = ["FleetTable", "PoolTable"]

HINTS = dict.fromkeys(("L_pp", "B", "T"), "give metres")
MOST_OF_A_POOL = 1_000_000
"""Ships of a pool. More would not fit beside their rows."""

LIMITS = {
    **SIZES, "L_over_B": PROPORTIONS["L_pp", "B"], "B_over_T": PROPORTIONS["B", "T"], "C_b": C_B_LIMITS,
    "loading": (0.3, 1.0),
}  # fmt: skip
"""Limits of the dimensions of sampled ships: those of a ship file, and of the draught as a share of the loaded one."""


RATIOS = {"lb": "L_over_B", "bt": "B_over_T"}
"""By the letters alone: L/B, L_B and LB mean the same."""


class PoolTable(Table):
    """[[own.sampled]]: so many ships of a kind, made from their main dimensions by the estimate of a ship file."""

    @model_validator(mode="before")
    @classmethod
    def _name_ratios(cls, given: Any) -> Any:
        for key in given if isinstance(given, dict) else ():
            name = RATIOS.get(re.sub("[^a-z]", "", key.lower()))
            if name is not None:
                raise ValueError(f"{key} is not a known key: did you mean {name}?")
        return given

    kind: str = Field(description='the type of ship, e.g. "tanker, loaded", as [ship] kind of a ship file has it')
    count: int = Field(
        default=100, ge=1, le=MOST_OF_A_POOL, description="the number of different ships; rows choose among them"
    )
    weight: NotNegative = Field(default=1.0, description="the weight of the whole pool beside the ships by name")
    L_pp: Variable = Field(description="the length between perpendiculars [m]")
    B: Variable | None = Field(default=None, description="the breadth [m]; or L_over_B instead")
    L_over_B: Variable | None = Field(default=None, description="length over breadth, 4 to 9 for most ships")
    T: Variable | None = Field(default=None, description="the draught [m]; or B_over_T instead")
    B_over_T: Variable | None = Field(default=None, description="breadth over draught, 2 to 4 for most ships")
    C_b: Variable = Field(description="the block coefficient, 0.5 to 0.85 for most ships")
    loading: Variable = Field(
        default=Constant(value=1.0), description="the draught as a share of T, 0.3 to 1; 1 is fully loaded"
    )

    @field_validator("kind")
    @classmethod
    def _check_kind(cls, kind: str) -> str:
        if not names_a_type(kind):
            words = list_type_words()
            near = next(filter(None, (suggest(word, words) for word in (kind, *re.split(r"[\s,]+", kind)))), "")
            raise ValueError(f"{kind!r} names no type of ship:{near or ' take one of the words ' + ', '.join(words)}")
        return kind

    @model_validator(mode="after")
    def _check(self) -> PoolTable:
        for one, other in (("B", "L_over_B"), ("T", "B_over_T")):
            given = [name for name in (one, other) if getattr(self, name) is not None]
            if len(given) != 1:
                raise ValueError(f"has {' and '.join(given) or f'neither {one} nor {other}'}: give one of the two")
        for name, (least, most) in LIMITS.items():
            check_limits(name, getattr(self, name), least, most, HINTS.get(name, "it is a ratio"))
        return self


def check_limits(name: str, given: Any, least: float, most: float, remedy: str) -> None:
    """Raise ValueError for a distribution that has words, or reaches beyond limits."""
    if given is None or isinstance(given, TableColumn):
        return
    if given.words():
        raise ValueError(f"{name} = {given.words()[0]!r} must be a number, {least:g} to {most:g}: {remedy}")
    for end, word, key in zip(given.limits(), ("down", "up"), ("least", "most"), strict=True):
        if not least <= end <= most:
            if isinstance(given, Constant):
                raise ValueError(f"{name} = {given.value:g} must be {least:g} to {most:g}: {remedy}")
            raise ValueError(
                f"{name} goes {word} to {end:g}, must be {least:g} to {most:g}: change or give {key}; {remedy}"
            )


def _read_ships(given: Any) -> dict[str, float] | TableColumn:
    """Weights by name."""
    if isinstance(given, str):
        return {given: 1.0}
    if isinstance(given, list) and given and all(isinstance(name, str) for name in given):
        twice = next((name for name in given if given.count(name) > 1), None)
        if twice is not None:
            raise ValueError(f"{twice!r} is there twice: give a table of weights, {{{twice} = 2.0, ...}}")
        return dict.fromkeys(given, 1.0)
    if isinstance(given, dict) and set(given) == {"table", "column"}:
        return TableColumn.model_validate(given)
    if isinstance(given, dict) and given:
        for name, weight in given.items():
            if type(weight) not in (int, float) or not 0.0 <= weight < float("inf"):
                raise ValueError(f"{name} = {weight!r} must be a weight, a number of at least 0")
        return {name: float(weight) for name, weight in given.items()}
    raise ValueError(
        f'the value {given!r} must name ships: ["kvlcc2", "kcs"], or with weights {{kvlcc2 = 3.0, kcs = 1.0}}'
    )


class FleetTable(Table):
    """[own] or [target]: the ships of a role."""

    ships: Annotated[Any, PlainValidator(_read_ships)] = Field(
        default=None,
        description="ships by name or path: a list, weights by name, or {table = NAME, column = NAME}",
    )
    sampled: list[PoolTable] = Field(default=[], description="pools of ships made from their main dimensions")
    loading: Variable = Field(
        default=Constant(value=1.0),
        description="the draught of the ships by name as a share of their own, 0.3 to 1: a number, or discrete",
    )

    @model_validator(mode="after")
    def _check(self) -> FleetTable:
        if self.ships is None and not self.sampled:
            raise ValueError('has no ships: give ships = ["kvlcc2"], or a table [[own.sampled]]')
        if isinstance(self.ships, TableColumn) and self.sampled:
            raise ValueError("has ships from a table and sampled ones: give one of the two")
        weights = [pool.weight for pool in self.sampled]
        if isinstance(self.ships, dict):
            weights += self.ships.values()
        if not isinstance(self.ships, TableColumn) and not sum(weights) > 0.0:
            raise ValueError("all weights are 0: give a ship or a pool a weight above 0")
        if not isinstance(self.loading, Constant | Discrete):
            raise ValueError("loading must be a number or discrete: each value makes another ship of each name")
        check_limits("loading", self.loading, *LIMITS["loading"], "1 is the draught of the ship file")
        return self
