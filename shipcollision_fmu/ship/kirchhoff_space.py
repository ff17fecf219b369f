"""Kirchhoff's equations in space: a rigid body that moves freely in water at rest.

    P' = P x omega      L' = L x omega + P x v      (P, L) = M nu,  nu = (v, omega)       all in b about CO

Conserved are the kinetic energy, the momentum R P in n, and R L + x x R P about the origin of n. A step of h [s] moves
the body by the exponential map of SE(3) for the mean twist (v, omega) of start and end:

    E = exp(skew(a))      a = h omega      d = h (v + g a x v + k a x (a x v))      angle = |a|
    g = (1 - cos(angle))/angle^2           k = (1 - sin(angle)/angle)/angle^2
    R_1 = R_0 E      x_1 = x_0 + R_0 d      P_1 = E' P_0      L_1 = E' (L_0 - d x P_0)

What is conserved and why is said in kirchhoff_plane.py, of which this is the form in space.

Sources: Lamb (1932), sections 117 to 124; Fossen (2021), section 6.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import sin, sqrt

from .degrees_of_freedom import Six
from .frames import Array

__all__ = ["KirchhoffSpace"]

Three = tuple[float, float, float]
Columns = tuple[Three, Three, Three]

MAX_ITERATIONS = 40
"""Iterations of a step. Each gains a digit or two; too few lose energy, momentum is kept in any case."""

CONVERGED = 4e-15
"""Change of the mean twist over its size at which the iteration ends. The energy is right to that times the
change of the twist in the step."""


class KirchhoffSpace:
    """Motion in space. M, inverse (6, 6): of the ship; radius [m]: of gyration in roll."""

    def __init__(self, M: Array, inverse: Array, radius: float) -> None:
        self._M, self._inverse, self._radius = M.tolist(), inverse.tolist(), radius

    def kick(self, nu: Six, impulse: Sequence[float]) -> Six:
        """nu after an impulse (6,) in b about CO."""
        a, b, c, d, e, f = times(self._inverse, impulse)
        return nu[0] + a, nu[1] + b, nu[2] + c, nu[3] + d, nu[4] + e, nu[5] + f

    def kick_oscillation(self, nu: Six, impulse: Sequence[float]) -> tuple[float, float, float]:
        """w, p and q after an impulse (6,): what heave, roll and pitch are then."""
        a, b, c, d, e, f = impulse
        _, _, r2, r3, r4, _ = self._inverse
        return (
            nu[2] + (r2[0] * a + r2[1] * b + r2[2] * c + r2[3] * d + r2[4] * e + r2[5] * f),
            nu[3] + (r3[0] * a + r3[1] * b + r3[2] * c + r3[3] * d + r3[4] * e + r3[5] * f),
            nu[4] + (r4[0] * a + r4[1] * b + r4[2] * c + r4[3] * d + r4[4] * e + r4[5] * f),
        )

    def step(self, nu: Six, guess: Six, h: float) -> tuple[Three, Columns, Six, Six]:
        """(d [m] in b of the start, columns of E, mean twist, twist after) of h [s].

        guess: the mean twist to begin with.
        """
        P_x, P_y, P_z, L_x, L_y, L_z = times(self._M, nu)
        radius, inverse, last = self._radius, self._inverse, 1e300
        u, v, w, p, q, r = nu
        U, V, W, P, Q, R = guess
        limit = CONVERGED * (abs(u) + abs(v) + abs(w) + radius * (abs(p) + abs(q) + abs(r)))
        for _ in range(MAX_ITERATIONS):
            d, (e_x, e_y, e_z) = _exponential((U, V, W, P, Q, R), h)
            x, y, z = d
            M_x, M_y, M_z = L_x - (y * P_z - z * P_y), L_y - (z * P_x - x * P_z), L_z - (x * P_y - y * P_x)
            # The change of the momentum, not the momentum: M M^-1 is 1 to rounding only, and energy would drift.
            a, b, c, f, g, k = times(
                inverse,
                (
                    (e_x[0] - 1.0) * P_x + e_x[1] * P_y + e_x[2] * P_z,
                    e_y[0] * P_x + (e_y[1] - 1.0) * P_y + e_y[2] * P_z,
                    e_z[0] * P_x + e_z[1] * P_y + (e_z[2] - 1.0) * P_z,
                    e_x[0] * M_x + e_x[1] * M_y + e_x[2] * M_z - L_x,
                    e_y[0] * M_x + e_y[1] * M_y + e_y[2] * M_z - L_y,
                    e_z[0] * M_x + e_z[1] * M_y + e_z[2] * M_z - L_z,
                ),
            )
            A, B, C, D, E, F = u + 0.5 * a, v + 0.5 * b, w + 0.5 * c, p + 0.5 * f, q + 0.5 * g, r + 0.5 * k
            change = abs(A - U) + abs(B - V) + abs(C - W) + radius * (abs(D - P) + abs(E - Q) + abs(F - R))
            U, V, W, P, Q, R = A, B, C, D, E, F
            if change <= limit or last <= change <= 1e3 * limit:
                break
            last = change
        return d, (e_x, e_y, e_z), (U, V, W, P, Q, R), (u + a, v + b, w + c, p + f, q + g, r + k)


def times(rows: Sequence[Sequence[float]], x: Sequence[float]) -> Six:
    """The product of a matrix (6, 6) and a vector (6,)."""
    a, b, c, d, e, f = x
    r0, r1, r2, r3, r4, r5 = rows
    return (
        r0[0] * a + r0[1] * b + r0[2] * c + r0[3] * d + r0[4] * e + r0[5] * f,
        r1[0] * a + r1[1] * b + r1[2] * c + r1[3] * d + r1[4] * e + r1[5] * f,
        r2[0] * a + r2[1] * b + r2[2] * c + r2[3] * d + r2[4] * e + r2[5] * f,
        r3[0] * a + r3[1] * b + r3[2] * c + r3[3] * d + r3[4] * e + r3[5] * f,
        r4[0] * a + r4[1] * b + r4[2] * c + r4[3] * d + r4[4] * e + r4[5] * f,
        r5[0] * a + r5[1] * b + r5[2] * c + r5[3] * d + r5[4] * e + r5[5] * f,
    )


def _exponential(nu: Six, h: float) -> tuple[Three, Columns]:
    """d and the columns of E of a twist held for h [s]."""
    u, v, w, p, q, r = nu
    a, b, c = h * p, h * q, h * r
    square = a * a + b * b + c * c
    angle = sqrt(square)
    if angle < 1e-2:  # the series, exact to rounding; without it, 1 - cos loses digits
        f = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0))
        g = 0.5 - square / 24.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0))
        k = 1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0))
    else:
        f = sin(angle) / angle
        g = 2.0 * (sin(0.5 * angle) / angle) ** 2
        k = (1.0 - f) / square
    x, y, z = b * w - c * v, c * u - a * w, a * v - b * u  # a x v
    d = (
        h * (u + g * x + k * (b * z - c * y)),
        h * (v + g * y + k * (c * x - a * z)),
        h * (w + g * z + k * (a * y - b * x)),
    )
    return d, (
        (1.0 - g * (b * b + c * c), g * a * b + f * c, g * a * c - f * b),
        (g * a * b - f * c, 1.0 - g * (a * a + c * c), g * b * c + f * a),
        (g * a * c + f * b, g * b * c - f * a, 1.0 - g * (a * a + b * b)),
    )
