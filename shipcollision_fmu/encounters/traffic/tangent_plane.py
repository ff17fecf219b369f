"""Latitude and longitude to north and east, on the plane that touches the WGS 84 ellipsoid at n's origin.

    r_ECEF = ((N + 0) cos phi cos lambda, N cos phi sin lambda, N (1 - e^2) sin phi),   N = a / sqrt(1 - e^2 sin^2 phi)
    (north, east) = components of r - r_0 along the north and east of the origin

A course refers to north at its own position. Meridians converge, by 0.14 deg over 10 km at 58 deg of latitude, so a
course is turned by this angle. The plane shortens distances by (d/R)^2/6: by 4 mm at 10 km, by 4 m at 100 km.
"""

from __future__ import annotations

from math import atan2, cos, radians, sin, sqrt

import numpy as np

from ...ship.frames import Array

__all__ = ["TangentPlane"]

SEMI_MAJOR_AXIS = 6378137.0
"""a of WGS 84 [m], exact by definition."""
FLATTENING = 1.0 / 298.257223563
"""f of WGS 84, exact by definition."""
_E2 = FLATTENING * (2.0 - FLATTENING)


class TangentPlane:
    """The plane at an origin of latitude and longitude [deg]."""

    def __init__(self, latitude: float, longitude: float) -> None:
        self._origin = _ecef(latitude, longitude)
        self._axes = np.stack(_find_axes(latitude, longitude))

    def position(self, latitude: float, longitude: float) -> tuple[float, float]:
        """North and east [m] of a position [deg]."""
        north, east = self._axes @ (_ecef(latitude, longitude) - self._origin)
        return float(north), float(east)

    def direction(self, latitude: float, longitude: float, course: float) -> float:
        """Direction in the plane [rad], clockwise from the origin's north, of a true course [rad] at a position."""
        north, east = _find_axes(latitude, longitude)
        x, y = self._axes @ (cos(course) * north + sin(course) * east)
        return atan2(y, x)


def _ecef(latitude: float, longitude: float) -> Array:
    """Earth-fixed coordinates (3,) [m] of a position [deg] on the ellipsoid."""
    phi, lam = radians(latitude), radians(longitude)
    N = SEMI_MAJOR_AXIS / sqrt(1.0 - _E2 * sin(phi) ** 2)
    return np.array([N * cos(phi) * cos(lam), N * cos(phi) * sin(lam), N * (1.0 - _E2) * sin(phi)])


def _find_axes(latitude: float, longitude: float) -> tuple[Array, Array]:
    """Unit vectors north and east at a position [deg], earth-fixed."""
    phi, lam = radians(latitude), radians(longitude)
    north = np.array([-sin(phi) * cos(lam), -sin(phi) * sin(lam), cos(phi)])
    return north, np.array([-sin(lam), cos(lam), 0.0])
