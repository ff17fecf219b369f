"""Damping of heave, roll and pitch by waves, friction and vortices.

    Z = -D_33 w      K = -(D_44 + D_44q |p|) p      M = -D_55 q           ship/seakeeping.py has the coefficients

w, p, q relative to the water, in b [m/s, rad/s]. Surge, sway and yaw have their damping in the MMG polynomials; what
sway force the hull meets when it rolls is in those too, taken at the depth z_H where it acts.
"""

from __future__ import annotations

from .seakeeping import Seakeeping

__all__ = ["Damping"]


class Damping:
    """(Z, K, M) of one ship."""

    def __init__(self, sea: Seakeeping) -> None:
        self._D_33, self._D_44, self._D_44q, self._D_55 = sea.D_33, sea.D_44, sea.D_44q, sea.D_55

    def __call__(self, w: float, p: float, q: float) -> tuple[float, float, float]:
        """Z [N], K and M [N m]."""
        return -self._D_33 * w, -(self._D_44 + self._D_44q * abs(p)) * p, -self._D_55 * q
