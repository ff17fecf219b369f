"""Units of the FMUs' variables, as FMI 2.0 has them: exponents of the SI base units.

value in base units = factor * value in the unit            (BaseUnit)
value in the display unit = factor * value in the unit      (DisplayUnit)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi

__all__ = ["UNITS", "DisplayUnit", "Unit"]


@dataclass(frozen=True)
class DisplayUnit:
    """What people read instead."""

    name: str
    factor: float


@dataclass(frozen=True)
class Unit:
    """Exponents of kg, m, s and rad; the factor to them; the unit in which people read it, if that is another one."""

    kg: int = 0
    m: int = 0
    s: int = 0
    rad: int = 0
    factor: float = 1.0
    display: tuple[DisplayUnit, ...] = field(default=())

    @property
    def exponents(self) -> dict[str, int]:
        """Those that are not zero."""
        powers = {"kg": self.kg, "m": self.m, "s": self.s, "rad": self.rad}
        return {name: power for name, power in powers.items() if power}


_DEGREES = 180.0 / pi

UNITS: dict[str, Unit] = {
    "1": Unit(),
    "J": Unit(kg=1, m=2, s=-2),
    "N": Unit(kg=1, m=1, s=-2),
    "N.m": Unit(kg=1, m=2, s=-2),
    "N/m": Unit(kg=1, s=-2),
    "N.s/m": Unit(kg=1, s=-1),
    "N.m.s": Unit(kg=1, m=2, s=-1),
    "N.s": Unit(kg=1, m=1, s=-1),
    "kg": Unit(kg=1),
    "m": Unit(m=1),
    "m/s": Unit(m=1, s=-1),
    "rad": Unit(rad=1, display=(DisplayUnit("deg", _DEGREES),)),
    "rad/s": Unit(rad=1, s=-1, display=(DisplayUnit("deg/s", _DEGREES),)),
    "rev/s": Unit(rad=1, s=-1, factor=2.0 * pi, display=(DisplayUnit("rev/min", 60.0),)),
    "s": Unit(s=1),
}
"""Every unit that a table may use. The radian keeps its exponent, so that a torque is not taken for an energy per
radian."""
