"""How each ship shows what it has applied: by the parameter of all ships, or by one of its own.

ledger, force, state, none   see dynamics/impulse_ledger.py
prescribed                   the ship follows a track, whatever hits it: its mass is infinite
common                       as the parameter of all ships says
"""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import InputError
from .interface import CollisionParameters, ShipParameters

__all__ = ["COMMON_FEEDBACKS", "PRESCRIBED", "SHIP_FEEDBACKS", "choose_feedbacks"]

PRESCRIBED = "prescribed"

COMMON_FEEDBACKS = ("ledger", "force", "state", "none")
"""Of all ships. A model in which all ships are prescribed would have nothing to answer."""

SHIP_FEEDBACKS = ("common", *COMMON_FEEDBACKS, PRESCRIBED)
"""Of one ship; the first is the start value."""


def choose_feedbacks(names: Sequence[str], parameters: CollisionParameters) -> list[str]:
    """The feedback of each ship. Raises InputError for an unknown one, and for two that differ."""
    return [_choose(name, ship, parameters.feedback) for name, ship in zip(names, parameters.ships, strict=True)]


def _choose(name: str, ship: ShipParameters, common: str) -> str:
    word = ship.feedback_name.strip() or ship.feedback
    if word not in SHIP_FEEDBACKS:
        given = "feedback_name" if ship.feedback_name.strip() else "feedback"
        raise InputError(f"{name}.{given} = {word!r} is not known: choose one of {', '.join(SHIP_FEEDBACKS)}")
    if ship.feedback not in (SHIP_FEEDBACKS[0], word):
        raise InputError(
            f"{name}.feedback = {ship.feedback!r} and {name}.feedback_name = {word!r} differ: give one of them"
        )
    return common if word == SHIP_FEEDBACKS[0] else word
