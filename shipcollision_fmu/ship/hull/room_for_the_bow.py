"""Whether rake, flare and bilge leave room for the bow, and which change of one key makes room.

The edges of the bow move inwards and aft from the deck down. Where an edge vanishes on the way, no hull has that form.
A long bow has a sharp entrance and little room: lengthening it helps only where it is shorter than its rake.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import floor, log10

from ..tables.hull import HullTable
from .levels import has_every_edge

__all__ = ["describe_lack_of_room", "find_largest_bilge"]

CAUSES = ("flare_deg", "stem_rake_deg", "bilge")
"""Keys that take room from the bow. At zero all three leave the plan of the deck, which has room."""

LENGTHS = 50
"""Steps in which other lengths of the bow are tried."""

HALVINGS = 30
"""Of an interval in which a limit is looked for: to 1e-9 of it."""


def describe_lack_of_room(L_oa: float, B: float, T: float, table: HullTable) -> str:
    """What is wrong with a parametric hull without room for its bow, and remedies that give room; else no text."""

    def fits(**changed: float) -> bool:
        return has_every_edge(L_oa, B, T, table.model_copy(update=changed))

    if fits():
        return ""

    def limit(key: str) -> float:
        return _find_largest(lambda value: fits(**{key: value}), getattr(table, key))

    given = [key for key in CAUSES if getattr(table, key) > 0.0]
    remedies = [f"{key} at most {limit(key):.4g}" for key in given if fits(**{key: 0.0})]
    shorter, longer = _find_lengths(lambda length: fits(bow_length=length), table, L_oa)
    remedies += [f"bow_length = {length:.4g}" for length in (*shorter, *longer)]
    said = " or ".join(remedies) if remedies else " and ".join(f"{key} = 0" for key in given)
    return (
        f"[hull] rake, flare and bilge leave no room for the bow: bow_length = {table.bow_length} m, stem_rake_deg = "
        f"{table.stem_rake_deg}, flare_deg = {table.flare_deg}, bilge = {table.bilge} m; give {said}"
    )


def _find_lengths(fits: Callable[[float], bool], table: HullTable, L_oa: float) -> tuple[list[float], list[float]]:
    """The nearest bow length [m] below and the nearest above the given one that fit, as far as there are any.

    A bow that is too long is too sharp for its flare; one that is too short ends before its rake and flare do.
    """
    own, most = table.bow_length, L_oa - table.stern_length
    below = (own * (1.0 - step / LENGTHS) for step in range(1, LENGTHS))
    above = (own + (most - own) * step / LENGTHS for step in range(1, LENGTHS))
    return _list_first(fits, below), _list_first(fits, above)


def _list_first(fits: Callable[[float], bool], lengths: Iterable[float]) -> list[float]:
    """The first length, with the 4 digits that a message prints, that fits; none if none does."""
    return next(([x] for x in (float(f"{length:.4g}") for length in lengths) if x > 0.0 and fits(x)), [])


def find_largest_bilge(L_oa: float, B: float, T: float, table: HullTable) -> float:
    """The largest bilge [m] that the hull has room for with its other keys; 0 where there is none."""

    def fits(bilge: float) -> bool:
        return has_every_edge(L_oa, B, T, table.model_copy(update={"bilge": bilge}))

    return _find_largest(fits, 0.99 * min(T, B / 2))


def _find_largest(fits: Callable[[float], bool], most: float) -> float:
    """The largest value up to `most` that fits, rounded down to 4 digits; 0 fits."""
    low, high = 0.0, most
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fits(middle) else (low, middle)
    return _round_down(high if fits(high) else low)


def _round_down(value: float) -> float:
    """The value with 4 digits, towards zero: a message prints as many."""
    if value <= 0.0:
        return 0.0
    unit = 10.0 ** (floor(log10(value)) - 3)
    return floor(value / unit) * unit
