"""What brings the floating ship back: buoyancy and weight in heave, roll and pitch.

    Z_n     = -rho g A_wp z_F,  z_F = D - x_F sin(theta)               along down, at the centre of flotation
    Q_phi   = -m g (GM_T + 1/2 BM_T tan^2(phi)) sin(phi)               wall-sided, Scribanti
    Q_theta = -m g GM_L sin(theta)

D, phi, theta from the ship afloat at rest. Beyond the heel at which the deck edge comes to the water, tan^2(phi) is
held: the ship is no longer wall-sided, and this is stiffer than a real one. Q are moments about the axes of the Euler
angles. As a moment in b, with phi_dot = p + (q sin phi + r cos phi) tan theta and theta_dot = q cos phi - r sin phi:

    K = Q_phi      M = Q_phi sin phi tan theta + Q_theta cos phi      N = Q_phi cos phi tan theta - Q_theta sin phi

So these forces are the slope of a potential energy, and no motion can draw work from them.
"""

from __future__ import annotations

from math import atan, cos, sin

from .degrees_of_freedom import Six
from .seakeeping import Seakeeping

__all__ = ["Restoring"]


class Restoring:
    """The wrench of buoyancy and weight about CO in b, and its potential energy."""

    def __init__(self, sea: Seakeeping) -> None:
        self._K_33, self._K_44, self._K_55 = sea.K_33, sea.K_44, sea.K_55
        self._K_44_BM = 0.5 * sea.K_44 * sea.BM_T / sea.GM_T
        self._x_F = sea.x_F
        self._tan2_deck = sea.tan_deck**2
        self._cos_deck = cos(atan(sea.tan_deck))

    def compute_roll_moment(self, s_phi: float, c_phi: float) -> float:
        """Q_phi [N m]."""
        tan2 = s_phi * s_phi / (c_phi * c_phi) if c_phi > self._cos_deck else self._tan2_deck
        return -(self._K_44 + self._K_44_BM * tan2) * s_phi

    def __call__(self, D: float, s_phi: float, c_phi: float, s_theta: float, c_theta: float) -> Six:
        """(X, Y, Z, K, M, N) [N, N m] at the depth D [m] of CO and the sines and cosines of phi and theta."""
        Z_n = -self._K_33 * (D - self._x_F * s_theta)
        Q_phi, Q_theta = self.compute_roll_moment(s_phi, c_phi), -self._K_55 * s_theta
        about_z = Q_phi * s_theta / c_theta
        Y, Z = Z_n * c_theta * s_phi, Z_n * c_theta * c_phi
        return (
            -Z_n * s_theta, Y, Z,
            Q_phi,
            about_z * s_phi + Q_theta * c_phi - self._x_F * Z,
            about_z * c_phi - Q_theta * s_phi + self._x_F * Y,
        )  # fmt: skip

    def compute_energy(self, D: float, phi: float, theta: float) -> float:
        """Potential energy [J], 0 afloat at rest."""
        c_phi = cos(phi)
        if c_phi > self._cos_deck:
            wall_sided = 1.0 / c_phi + c_phi - 2.0
        else:
            c = self._cos_deck
            wall_sided = 1.0 / c + c - 2.0 + self._tan2_deck * (c - c_phi)
        z_F = D - self._x_F * sin(theta)
        return (
            0.5 * self._K_33 * z_F * z_F
            + self._K_44 * (1.0 - c_phi)
            + self._K_44_BM * wall_sided
            + self._K_55 * (1.0 - cos(theta))
        )
