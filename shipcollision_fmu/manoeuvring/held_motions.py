"""The start of a ship of which 3 or 4 degrees of freedom are free: its motion without what is held.

In 3 degrees of freedom roll, pitch and heave are held, in 4 pitch and heave, all in level axes (degrees_of_freedom.py).
The equations would keep a held motion for ever as it was at the start, so it must be zero there.

    nu_l = L^-1 nu      the held components become zero      nu = L nu_l

The level surge, sway and yaw rate, and in 4 degrees of freedom the roll rate, keep their values, and so does the level
momentum. A heeled ship has a level heave velocity as soon as it sways along its deck.
"""

from __future__ import annotations

from ..errors import ScenarioError
from ..ship.degrees_of_freedom import FREE, Six, from_level, to_level

__all__ = ["project_start"]

ROUNDING = 1e-6
"""Angle [rad] and velocity [m/s, rad/s] of a held motion that another program's rounding explains. They become zero
without a word: with less, a state that was written with nine digits would be refused or warned of."""

_ANGLES = {3: (3, 4), 4: (4,)}
"""Indices of the held angles in eta, by degrees of freedom."""
_NAMES = ("surge velocity", "sway velocity", "heave velocity", "roll rate", "pitch rate", "yaw rate")


def project_start(eta: Six, nu: Six, degrees_of_freedom: int) -> tuple[Six, Six, str]:
    """(eta, nu, warning): the start without held motions; the warning says what a heeled ship has lost by it.

    Raises ScenarioError for a held angle, and for a held velocity of an upright ship: both can be set to zero.
    """
    if degrees_of_freedom == 6:
        return eta, nu, ""
    for k in _ANGLES[degrees_of_freedom]:
        if abs(eta[k]) > ROUNDING:
            raise _refuse(("roll angle", "pitch angle")[k - 3], eta[k], degrees_of_freedom)
    n, e, d, phi, _, psi = eta
    eta = (n, e, d, phi if degrees_of_freedom == 4 else 0.0, 0.0, psi)
    nu_l = to_level(nu, eta[3])
    held = [k for k in range(6) if k not in FREE[degrees_of_freedom] and nu_l[k] != 0.0]
    if not held:
        return eta, nu, ""
    lost = [k for k in held if abs(nu_l[k]) > ROUNDING]
    if lost and eta[3] == 0.0:
        raise _refuse(_NAMES[lost[0]], nu_l[lost[0]], degrees_of_freedom)
    a, b, c, p, q, r = (0.0 if k in held else value for k, value in enumerate(nu_l))
    warning = ""
    if lost:
        parts = " and ".join(f"{_NAMES[k]} = {nu_l[k]:g}" for k in lost)
        warning = (
            f"initial {parts} in level axes left out: {degrees_of_freedom} degrees of freedom hold it; the level "
            "surge, sway, yaw rate and roll rate are kept"
        )
    return eta, from_level((a, b, c, p, q, r), eta[3]), warning


def _refuse(name: str, value: float, degrees_of_freedom: int) -> ScenarioError:
    return ScenarioError(
        f"initial {name} = {value:g} must be 0 with hydrodynamics = true in {degrees_of_freedom} degrees of freedom, "
        "which hold it: set it to 0, or degrees_of_freedom = 6"
    )
