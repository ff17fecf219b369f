"""The revolutions at which an engine of limited torque turns the propeller.

    Q_e = power/(2 pi n_rated)         most torque of the engine, at any revolutions [N m]
    |Q| <= Q_e                         Q: torque of the propeller (ship/propeller_torque.py)

The mean effective pressure of a diesel has a highest value, so its torque has one: on the spot a propeller of fixed
pitch turns at 0.75 to 0.85 of the rated revolutions, and a ship that runs ahead fast is too fast for a propeller that
turns astern. The governor keeps the engine from more. The shaft follows within a second or two, here at once.

Q/(rho D^3) is of second degree in n D and u_P. With q = Q_e/(rho D^3) [m2/s2], the limits of n D/sqrt(q) are functions
of u_P/sqrt(q) alone: they are tabulated once for each propeller.
"""

from __future__ import annotations

from collections.abc import Callable
from math import floor, sqrt

__all__ = ["TorqueLimit"]

WIDEST = 8.0
"""|u_P|/sqrt(q) of the table; ships at service speed have 3 to 6. Beyond, the limits grow with u_P."""

PER_UNIT = 8
"""Entries of the table per unit of u_P/sqrt(q): linear between them, within 0.5 % of the limit."""

Torque = Callable[[float, float], float]
"""Q/(rho D^3) [m2/s2] at u_P and n D [m/s]."""


class TorqueLimit:
    """Least and most revolutions [1/s] of an engine with the torque Q_e = most_torque [N m].

    least_wake: u_P is at least this part of u > 0. root: sqrt(q) [m/s]; most, least: n D/sqrt(q) of the table;
    per_speed: entries of the table per metre per second of u.
    """

    def __init__(self, torque: Torque, D_P: float, rho: float, most_torque: float, least_wake: float) -> None:
        self.root = sqrt(most_torque / (rho * D_P**3))
        self._n = self.root / D_P
        places = range(-round(WIDEST * PER_UNIT), round(WIDEST * PER_UNIT) + 1)
        self.most = [_find_limit(torque, k / PER_UNIT, 1.0) for k in places]
        self.least = [_find_limit(torque, k / PER_UNIT, -1.0) for k in places]
        self.per_speed = least_wake * PER_UNIT / self.root
        self._sure = [self._n * most for most in self.most[round(WIDEST * PER_UNIT) :]]

    def is_surely_free(self, u: float, n: float) -> bool:
        """Whether n > 0 [1/s] is within the limit at the surge velocity u [m/s] through the water, at a glance.

        The limit rises with the inflow, so that of the next lower place of the table is a bound.
        """
        return u >= 0.0 and n <= self._sure[min(int(u * self.per_speed), len(self._sure) - 1)]

    def find_range(self, u_P: float) -> tuple[float, float]:
        """Least revolutions (astern) and most (ahead) in the inflow u_P [m/s]."""
        inflow, scale = u_P / self.root, self._n
        if not -WIDEST < inflow < WIDEST:
            scale *= abs(inflow) / WIDEST
            inflow = WIDEST if inflow > 0.0 else -WIDEST
        place = (inflow + WIDEST) * PER_UNIT
        k = min(floor(place), len(self.most) - 2)
        share = place - k
        low, high = self.least[k], self.most[k]
        return scale * (low + share * (self.least[k + 1] - low)), scale * (high + share * (self.most[k + 1] - high))


def _find_limit(torque: Torque, u_P: float, side: float) -> float:
    """n D up to which the engine can turn the propeller ahead (side = 1) or astern (-1); 0 where it cannot hold it."""
    low, high = 0.0, 1.0
    while side * torque(u_P, side * high) <= 1.0:
        low, high = high, 2.0 * high
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if side * torque(u_P, side * middle) <= 1.0 else (low, middle)
    return side * low
