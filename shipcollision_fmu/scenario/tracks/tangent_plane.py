"""Latitude and longitude to north and east, on the plane that touches the WGS 84 ellipsoid at n's origin.

    r_ECEF = ((N + 0) cos phi cos lambda, N cos phi sin lambda, N (1 - e^2) sin phi),   N = a / sqrt(1 - e^2 sin^2 phi)
    (north, east) = components of r - r_0 along the north and east of the origin

A course refers to north at its own position. Meridians converge, by 0.14 deg over 10 km at 58 deg of latitude, so a
course is turned by this angle. The plane shortens distances by (d/R)^2/6: by 4 mm at 10 km, by 4 m at 100 km.
"""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, radians, sin, sqrt

import numpy as np

from ...errors import ScenarioError
from ...ship.frames import Array

__all__ = ["TangentPlane"]

SEMI_MAJOR_AXIS = 6378137.0
"""a of WGS 84 [m], exact by definition."""
FLATTENING = 1.0 / 298.257223563
"""f of WGS 84, exact by definition."""
REACH = 1.0e6
"""[m] Farthest position that has a latitude and longitude. The plane is 4 km too short there, but still over earth."""
ITERATIONS = 6
"""Of the geodetic latitude; each gains two digits and a half."""
_E2 = FLATTENING * (2.0 - FLATTENING)


class TangentPlane:
    """The plane at an origin of latitude and longitude [deg]."""

    def __init__(self, latitude: float, longitude: float) -> None:
        self._origin = _ecef(latitude, longitude)
        self._axes = np.stack(_find_axes(latitude, longitude))
        self._up = np.cross(self._axes[1], self._axes[0])

    def position(self, latitude: float, longitude: float) -> tuple[float, float]:
        """North and east [m] of a position [deg]."""
        north, east = self._axes @ (_ecef(latitude, longitude) - self._origin)
        return float(north), float(east)

    @staticmethod
    def geocentric(latitude: float, longitude: float) -> Array:
        """Earth-fixed coordinates (3,) [m] of a position [deg] on the ellipsoid."""
        return _ecef(latitude, longitude)

    def geographic(self, north: float, east: float) -> tuple[float, float]:
        """Latitude and longitude [deg] of a position [m]: the inverse of `position`, on the ellipsoid.

        Raises ScenarioError for a position farther from the origin than the plane reaches.
        """
        if not hypot(north, east) <= REACH:
            raise ScenarioError(
                f"{hypot(north, east) / 1e3:.0f} km from the origin there is no latitude and longitude, the limit is "
                f"{REACH / 1e3:.0f} km: set [place] nearer to the ships"
            )
        r = self._origin + north * self._axes[0] + east * self._axes[1]
        x, y, z = (r - self._drop(north, east) * self._up).tolist()
        p = hypot(x, y)
        phi = atan2(z, p * (1.0 - _E2))
        for _ in range(ITERATIONS):
            N = SEMI_MAJOR_AXIS / sqrt(1.0 - _E2 * sin(phi) ** 2)
            phi = atan2(z + _E2 * N * sin(phi), p)
        return degrees(phi), degrees(atan2(y, x))

    def _drop(self, north: float, east: float) -> float:
        """Depth [m] of the ellipsoid under a point of the plane, along the origin's vertical.

        x / a^2 + ... = 1 with r = r_p - d up is a quadratic in d, whose smaller root is the near side.
        """
        weights = np.array([1.0, 1.0, 1.0 / (1.0 - _E2)]) / SEMI_MAJOR_AXIS**2
        r = self._origin + north * self._axes[0] + east * self._axes[1]
        a, b, c = (float(weights @ v) for v in (self._up * self._up, r * self._up, r * r))
        return (b - sqrt(b * b - a * (c - 1.0))) / a

    def true_course(self, latitude: float, longitude: float, direction: float) -> float:
        """True course [rad] at a position [deg] of a direction in the plane [rad]: the inverse of `direction`, within
        0.0003 rad at 100 km, since the horizon there is tilted against the plane."""
        return direction - self.direction(latitude, longitude, 0.0)

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
