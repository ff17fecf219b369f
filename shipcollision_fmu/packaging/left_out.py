"""What of a scenario a package does not hold: refused, or said where people read it."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import ScenarioError
from .system_structure import SystemStructure, TimedOrder

__all__ = ["notes", "refuse_orders"]

OPTION = "--initial-orders"
"""Of `shipcollision package`: go on without what a helm does after time 0."""


def refuse_orders(system: SystemStructure, what: str, orders: Sequence[TimedOrder]) -> None:
    """Raises ScenarioError when the system has orders that `what` cannot hold, or a helm that no FMU is."""
    lost = [*system.helm, *_ordered(orders)]
    if lost:
        raise ScenarioError(
            f"{system.scenario.name} cannot be packaged whole: {'; '.join(lost)}; that is done by our own master, "
            f"and {what} has no place for it. Take {OPTION} to hold the orders of time 0"
        )


def notes(system: SystemStructure, orders: Sequence[TimedOrder]) -> tuple[str, ...]:
    """What is not in the package, a sentence each; `orders` are those left out."""
    lost = [*system.helm, *_ordered(orders)]
    return tuple(f"Left out: {phrase}; the orders of time 0 are held." for phrase in lost) + system.left_out


def _ordered(orders: Sequence[TimedOrder]) -> list[str]:
    """A phrase per ship."""
    phrases = []
    for ship in dict.fromkeys(order.ship for order in orders):
        times = dict.fromkeys(f"{order.time:g}" for order in orders if order.ship == ship)
        phrases.append(f"[ships.{ship}] gives orders at {', '.join(times)} s")
    return phrases
