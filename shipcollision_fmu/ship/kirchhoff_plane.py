"""Kirchhoff's equations in the plane: surge, sway and yaw of a ship in water at rest, and roll beside them.

    P_x' = r P_y      P_y' = -r P_x      L_x' = 0      L_z' = v P_x - u P_y        (P_x, P_y, L_x, L_z) = M nu_l

nu_l = (u, v, phi_dot, psi_dot) in the level axes (degrees_of_freedom.py), M the free block, constant there. In the
third line roll is cyclic: buoyancy and damping are added by coasting_law.py. Conserved are the kinetic energy, the
momentum (P_x, P_y) in n, and L_z about any fixed point. L_z' is the Munk moment: it turns a drifting ship broadside.

A step of h [s] moves the ship by the exponential map of SE(2), for the mean twist (u, v, r) of start and end:

    (dx, dy, dpsi) = exp(h (u, v, r))        P_1 = R(-dpsi) P_0        L_1 = L_0 - (dx, dy) x P_0

The momenta in n are those of the start for any mean twist. The work (nu_0 + nu_1)/2 . (M nu_1 - M nu_0) is zero for the
mean, so the kinetic energy stays, too. The scheme is of second order, reversible, and exact for steady turning.

Sources: Lamb (1932), sections 124 to 126; Fossen (2021), section 6.3; the scheme is the implicit midpoint rule of
Lie-Poisson systems with the exponential map.
"""

from __future__ import annotations

from math import cos, sin

from .frames import Array

__all__ = ["Four", "KirchhoffPlane"]

Four = tuple[float, float, float, float]

MAX_ITERATIONS = 30
"""Iterations of a step. Each gains a digit or two; too few lose energy, momentum is kept in any case."""

CONVERGED = 2e-15
"""Change of the mean twist over its size at which the iteration ends. The energy is right to that times the
change of the twist in the step."""


class KirchhoffPlane:
    """Motion in the plane. M, inverse (6, 6): of the ship, and of its free block with zeros elsewhere."""

    def __init__(self, M: Array, inverse: Array, radius: float) -> None:
        free = [0, 1, 3, 5] if inverse[3, 3] else [0, 1, 5]
        self._M: list[Four] = [_four(M, row, free) for row in (0, 1, 3, 5)]
        self._inverse: list[Four] = [_four(inverse, row, free) for row in (0, 1, 3, 5)]
        self._radius = radius  # of gyration [m]: makes a rate a speed

    def kick(self, nu: Four, K: float) -> Four:
        """nu after the angular impulse K [N m s] in roll."""
        (_, _, a, _), (_, _, b, _), (_, _, c, _), (_, _, d, _) = self._inverse
        return nu[0] + a * K, nu[1] + b * K, nu[2] + c * K, nu[3] + d * K

    def step(self, nu: Four, guess: Four, h: float) -> tuple[float, float, Four, Four]:
        """(dx [m], dy [m], mean twist, twist after) of h [s]: the shift is along the axes of the start.

        guess: the mean twist to begin with.
        """
        u, v, p, r = nu
        (a0, a1, a2, a3), (b0, b1, b2, b3), _, _ = self._M
        P_x = a0 * u + a1 * v + a2 * p + a3 * r
        P_y = b0 * u + b1 * v + b2 * p + b3 * r
        (a0, a1, _, a3), (b0, b1, _, b3), (c0, c1, _, c3), (d0, d1, _, d3) = self._inverse
        U, V, W, Q = guess
        radius, last = self._radius, 1e300
        limit = CONVERGED * (abs(u) + abs(v) + radius * (abs(p) + abs(r)))
        for _ in range(MAX_ITERATIONS):
            half = 0.5 * h * Q
            s, c = sin(half), cos(half)
            sine, versine = 2.0 * s * c, 2.0 * s * s  # of h Q
            f, g = (sine / Q, versine / Q) if abs(half) > 1e-5 else (h * (1.0 - half * half / 1.5), h * half)
            dx, dy = f * U - g * V, g * U + f * V
            # The change of the momentum, not the momentum: M M^-1 is 1 to rounding only, and energy would drift.
            X, Y, N = sine * P_y - versine * P_x, -sine * P_x - versine * P_y, dy * P_x - dx * P_y
            after = (
                u + (a0 * X + a1 * Y + a3 * N), v + (b0 * X + b1 * Y + b3 * N),
                p + (c0 * X + c1 * Y + c3 * N), r + (d0 * X + d1 * Y + d3 * N),
            )  # fmt: skip
            U1, V1, W1, Q1 = 0.5 * (u + after[0]), 0.5 * (v + after[1]), 0.5 * (p + after[2]), 0.5 * (r + after[3])
            change = abs(U1 - U) + abs(V1 - V) + radius * (abs(W1 - W) + abs(Q1 - Q))
            if change <= limit or (change >= last and change <= 1e3 * limit):
                break
            U, V, W, Q, last = U1, V1, W1, Q1, change
        return dx, dy, (U, V, W, Q), after


def _four(M: Array, row: int, free: list[int]) -> Four:
    a, b, c, d = (float(M[row, k]) if row in free and k in free else 0.0 for k in (0, 1, 3, 5))
    return a, b, c, d
