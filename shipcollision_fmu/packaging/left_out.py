"""Contents of a scenario that a package does not hold: refused, or described in notes."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import ScenarioError
from .system_structure import SystemStructure, TimedOrder

__all__ = ["check_orders_fit", "describe_left_out"]

OPTION = "--initial-orders"
"""Option of `shipcollision package` that leaves out everything a helm does after time 0."""


def check_orders_fit(system: SystemStructure, form: str, orders: Sequence[TimedOrder]) -> None:
    """Raise ScenarioError when the system has an autopilot, route or evasion, or `orders`, which the form cannot hold.

    form: the package, in words, for the message.
    """
    lost = [*system.helm, *_describe_orders(orders)]
    if lost:
        raise ScenarioError(
            f"{system.scenario.name} cannot be packaged whole: {'; '.join(lost)}; only our own master does this, and "
            f"{form} has no place for it. Take {OPTION} to hold the orders of time 0"
        )


def describe_left_out(system: SystemStructure, orders: Sequence[TimedOrder]) -> tuple[str, ...]:
    """Sentences on everything that is not in the package; `orders` are the orders left out."""
    lost = [*system.helm, *_describe_orders(orders)]
    return tuple(f"Left out: {phrase}; the orders of time 0 are held." for phrase in lost) + system.left_out


def _describe_orders(orders: Sequence[TimedOrder]) -> list[str]:
    """A phrase for each ship with its times."""
    phrases = []
    for ship in dict.fromkeys(order.ship for order in orders):
        times = dict.fromkeys(f"{order.time:g}" for order in orders if order.ship == ship)
        phrases.append(f"[ships.{ship}] gives orders at {', '.join(times)} s")
    return phrases
