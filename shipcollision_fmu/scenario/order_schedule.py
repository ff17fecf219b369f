"""Orders of a ship by communication point: rudder and revolutions, and headings for the autopilot.

An order is held until the next order. It is given at the first communication point at or after its time,
k = ceil(time / step); the time of a point is k step, never a running sum.
"""

from __future__ import annotations

from math import ceil, radians

from .tables.ship_start import ShipStart

__all__ = ["find_point", "schedule_headings", "schedule_orders"]

FORGIVEN = 1e-9
"""Fraction of a step by which an order may come late, so that 0.3 s is 6 steps of 0.05 s in floating point."""


def schedule_orders(start: ShipStart, step: float) -> list[tuple[int, list[float]]]:
    """Communication points k, rising, with [rudder_order rad, propeller_order rev/s] from there on.

    Of orders that fall on one point the last counts.
    """
    schedule: dict[int, list[float]] = {}
    rudder, revolutions = 0.0, 0.0
    for order in start.orders:
        rudder = rudder if order.rudder_deg is None else radians(order.rudder_deg)
        revolutions = revolutions if order.rev_per_s is None else float(order.rev_per_s)
        schedule[find_point(order.time, step)] = [rudder, revolutions]
    return list(schedule.items())


def schedule_headings(start: ShipStart, step: float) -> list[tuple[int, float | None]]:
    """Communication points k, rising, with the autopilot's heading [rad] from there on; None for rudder orders."""
    schedule: dict[int, float | None] = {}
    for order in start.orders:
        if order.heading_deg is not None or order.rudder_deg is not None:
            heading = None if order.heading_deg is None else radians(order.heading_deg)
            schedule[find_point(order.time, step)] = heading
    return list(schedule.items())


def find_point(time: float, step: float) -> int:
    """The communication point at which an order or a change of that time [s] acts: the first at or after it."""
    return ceil(time / step - FORGIVEN)
