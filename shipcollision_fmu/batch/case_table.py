"""The table of cases, from arguments that broadcast like arrays of NumPy; what is no real number is refused by name."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal
from numbers import Real
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import ScenarioError
from ..ship.frames import Array
from .impact_columns import CASES

__all__ = ["fill_cases"]

LONGEST = 60
"""Characters of a value that a refusal shows."""


def fill_cases(caller: str, numbers: dict[str, npt.ArrayLike], side: npt.ArrayLike) -> npt.NDArray[Any]:
    """The table of cases, of the shape to which all arguments broadcast; what is not given is zero.

    Raises ScenarioError for an argument that is not of real numbers, or partly masked, for a side that is none, and for
    shapes that do not fit.
    """
    sides = _as_array(caller, "side", side)
    is_starboard = np.asarray(sides == "starboard")
    unknown = sides[~(is_starboard | (sides == "port"))].tolist()
    if unknown:
        raise ScenarioError(f"{caller}: side = {unknown[0]!r} must be port or starboard")
    arrays = {name: _as_numbers(caller, name, value) for name, value in numbers.items()}
    try:
        shape = np.broadcast_shapes(sides.shape, *(array.shape for array in arrays.values()))
    except ValueError:
        given = ", ".join(f"{name} {array.shape}" for name, array in arrays.items() if array.shape)
        raise ScenarioError(f"{caller}: the shapes do not broadcast to one: {given}, side {sides.shape}") from None
    cases = np.zeros(shape, CASES)
    for name, array in arrays.items():
        cases[name] = array
    cases["is_starboard"] = is_starboard
    return cases


def _as_numbers(caller: str, name: str, value: npt.ArrayLike) -> Array:
    """The argument as an array of real numbers."""
    array = _as_array(caller, name, value)
    if array.dtype.kind == "O":
        odd = [i for i, entry in enumerate(array.flat) if not isinstance(entry, Real | Decimal)]
    else:
        odd = [] if array.dtype.kind in "biuf" else [0]  # neither text nor complex numbers, dates and tables
    if odd and array.size:
        place = tuple(map(int, np.unravel_index(odd[0], array.shape)))
        entry = array[place]
        said = repr(entry.item() if isinstance(entry, np.generic) else entry)
        raise ScenarioError(
            f"{caller}: {_name(name, place)} = {said[:LONGEST]} is no real number: give numbers, or an array of them"
        )
    try:
        return array.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ScenarioError(f"{caller}: {name} is no array of numbers: {error}") from None


def _as_array(caller: str, name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    """The argument as an array. A mask would be lost: what is masked is refused."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        place = np.argwhere(np.ma.getmaskarray(value))[0].tolist()
        raise ScenarioError(
            f"{caller}: {_name(name, place)} is masked, and cases have no masks: fill it with a number, or leave "
            "out the cases that are masked"
        )
    try:
        return np.asarray(value)
    except ValueError as error:
        raise ScenarioError(f"{caller}: {name} is no array: {error}") from None


def _name(name: str, place: Sequence[int]) -> str:
    return f"{name}[{', '.join(map(str, place))}]" if len(place) else name
