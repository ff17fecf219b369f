"""Units of the FMUs' variables, as FMI 2.0 has them: exponents of the SI base units.

value in base units = factor * value in the unit            (BaseUnit)
value in the display unit = factor * value in the unit      (DisplayUnit)
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

__all__ = ["UNITS", "DisplayUnit", "Unit"]


@dataclass(frozen=True)
class DisplayUnit:
    """What people read instead."""

    name: str
    factor: float


@dataclass(frozen=True)
class Unit:
    """Exponents of kg, m, s and rad; the factor to them; the unit in which people read it, if that is another one.

    quantity: what is measured in it, a word that is also the name of its type. nominal: a value of the usual size, by
    which solvers scale and plots choose their range.
    """

    quantity: str
    nominal: float
    kg: int = 0
    m: int = 0
    s: int = 0
    rad: int = 0
    factor: float = 1.0
    display: DisplayUnit | None = None

    @property
    def exponents(self) -> dict[str, int]:
        """Those that are not zero."""
        powers = {"kg": self.kg, "m": self.m, "s": self.s, "rad": self.rad}
        return {name: power for name, power in powers.items() if power}

    @property
    def base(self) -> dict[str, str]:
        """Attributes of its BaseUnit. A mere number has its factor alone: some importers take an element without
        attributes for a unit that nobody has described."""
        said = {name: str(power) for name, power in self.exponents.items()}
        return said if said and self.factor == 1.0 else {**said, "factor": repr(self.factor)}


_DEGREES = 180.0 / pi
_KNOT = 3600.0 / 1852.0
_MEGA = 1e-6

UNITS: dict[str, Unit] = {
    "1": Unit("Number", 1.0),
    "J": Unit("Energy", 1e7, kg=1, m=2, s=-2, display=DisplayUnit("MJ", _MEGA)),
    "N": Unit("Force", 1e6, kg=1, m=1, s=-2, display=DisplayUnit("MN", _MEGA)),
    "N.m": Unit("Moment", 1e8, kg=1, m=2, s=-2, display=DisplayUnit("MN.m", _MEGA)),
    "N/m": Unit("Stiffness", 1e6, kg=1, s=-2),
    "N.s/m": Unit("Damping", 1e6, kg=1, s=-1),
    "N.m.s": Unit("AngularImpulse", 1e9, kg=1, m=2, s=-1, display=DisplayUnit("MN.m.s", _MEGA)),
    "N.s": Unit("Impulse", 1e7, kg=1, m=1, s=-1, display=DisplayUnit("MN.s", _MEGA)),
    "kg": Unit("Mass", 1e7, kg=1),
    "m": Unit("Length", 100.0, m=1),
    "m/s": Unit("Velocity", 5.0, m=1, s=-1, display=DisplayUnit("kn", _KNOT)),
    "rad": Unit("Angle", 1.0, rad=1, display=DisplayUnit("deg", _DEGREES)),
    "rad/s": Unit("AngularVelocity", 0.01, rad=1, s=-1, display=DisplayUnit("deg/s", _DEGREES)),
    "rev/s": Unit("RotationalSpeed", 1.0, rad=1, s=-1, factor=2.0 * pi, display=DisplayUnit("rev/min", 60.0)),
    "s": Unit("Time", 1.0, s=1),
}
"""Every unit that a table may use. The radian keeps its exponent, so that a torque is not taken for an energy per
radian."""
