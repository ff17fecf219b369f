"""How a ship moves between impulses when no manoeuvring model moves it. One law serves both models.

    kirchhoff   Kirchhoff's equations: the momentum of ship and water stays, the velocity does not. In 4 and 6 degrees
                of freedom with buoyancy and weight (restoring.py) and the damping of heave, roll and pitch (damping.py)
    free        Kirchhoff's equations alone: energy and momentum are conserved
    straight    the velocity of CG and the angular velocity stay constant in n (coasting.py): Guan et al. (2014)

In 3 and 4 degrees of freedom the motion is that of the plane, in level axes (kirchhoff_plane.py); held motions, which
are zero in a ship of these models, keep their rates. In 6 it is that of space (kirchhoff_space.py). Without restoring
and damping a step of h [s] is n equal substeps, otherwise

    kick(dt/2) (move(dt) kick(dt))^(n-1) move(dt) kick(dt/2)        dt = h/n        M d(nu) = dt (restoring + damping)

n follows from the motion and h alone: ship model and collision model then take the same steps, and find the same motion
to the bit. A straight course without drift is a steady solution and goes by coasting.py.

Surge, sway and yaw have no damping: a ship that coasts keeps its energy. The Munk moment turns a drifting ship
broadside, and a long ship swings about that. Ships that shall keep their course need the manoeuvring model, or
`straight`.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import asin, atan2, ceil, cos, hypot, pi, sin, sqrt, tan
from typing import Protocol

from ..errors import InputError, ShipError, StepError
from .coasting import coast
from .damping import Damping
from .degrees_of_freedom import Six, free_inverse
from .frames import Rows, Three, rotation_rows
from .kirchhoff_plane import Four, KirchhoffPlane
from .kirchhoff_space import KirchhoffSpace
from .restoring import Restoring
from .seakeeping import compute_seakeeping
from .ship import Ship

__all__ = ["COASTING", "CoastingLaw", "Motion", "make_coasting"]

COASTING = ("kirchhoff", "free", "straight")
"""The laws by name; the first is the default."""

FINEST = 0.1
"""Change of direction [rad] in a substep, estimated from rates and speeds. KVLCC2, which drifts at 5 m/s, then has its
heading to 2e-4 rad after 400 s; the error grows with the square."""

FINEST_OSCILLATION = 0.1
"""Phase [rad] of the fastest heave, roll or pitch in a substep. With 0.3, periods are wrong by 0.4 %."""

MAXIMUM_SUBSTEPS = 10_000
"""Most substeps of a step: 0.5 s of computing. A step that needs more was meant in another unit."""

Seq = Sequence[float]
Motion = tuple[Seq, Seq, Seq, Seq]
"""Position of CO [m] and attitude [rad] in n, velocity [m/s] and rate [rad/s] in b."""


class CoastingLaw(Protocol):
    """The motion of one ship between impulses. keeps_course: a ship that goes ahead, upright, goes straight on."""

    keeps_course: bool

    def coast(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq, h: float) -> Motion:
        """The motion after h [s]. Raises StepError for a step that is too long for the motion."""

    def is_straight(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq) -> bool:
        """Whether the ship goes straight on without turning."""


def make_coasting(ship: Ship, degrees_of_freedom: int, law: str) -> CoastingLaw:
    """The law of a ship by its name.

    Raises InputError for an unknown name, and ShipError for a ship that does not float upright.
    """
    if law not in COASTING:
        raise InputError(f"coasting = {law!r} must be one of {', '.join(COASTING)}")
    if law == "straight":
        return _Straight(ship)
    if degrees_of_freedom == 6:
        return _Space(ship, restored=law == "kirchhoff")
    return _Plane(ship, degrees_of_freedom, restored=law == "kirchhoff" and degrees_of_freedom == 4)


class _Straight:
    def __init__(self, ship: Ship) -> None:
        self._r_bg, self.keeps_course = ship.r_bg.tolist(), True

    def coast(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq, h: float) -> Motion:
        return (*coast(position, attitude, velocity, rate, self._r_bg, h), rate)

    def is_straight(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq) -> bool:
        return not any(rate)


class _Sea:
    """Restoring and damping of a ship, and its fastest oscillation."""

    def __init__(self, ship: Ship, degrees_of_freedom: int) -> None:
        try:
            sea = compute_seakeeping(ship)
        except ShipError as error:
            raise ShipError(f"{error}; or let it coast without buoyancy, coasting = 'straight'") from None
        self.restoring, self.damping = Restoring(sea), Damping(sea)
        inverse = free_inverse(ship.M, degrees_of_freedom)
        stiffness = ((2, sea.K_33), (3, sea.K_44), (4, sea.K_55))
        self.fastest = sqrt(max(K * float(inverse[i, i]) for i, K in stiffness))


class _Plane:
    """In 3 and 4 degrees of freedom."""

    def __init__(self, ship: Ship, degrees_of_freedom: int, restored: bool) -> None:
        M = ship.M
        self._radius = sqrt(float(M[5, 5] / M[0, 0]))
        self._roll = degrees_of_freedom == 4
        self._sea = _Sea(ship, 4) if restored else None
        self._plane = KirchhoffPlane(M, free_inverse(M, degrees_of_freedom), self._radius)
        self._c = float(free_inverse(M, degrees_of_freedom)[3, 3])
        self.keeps_course = bool(M[0, 1] == 0.0)
        self._centre = [float(M[1, 5] / M[1, 1]), float(-M[0, 5] / M[0, 0]), 0.0]
        self._is_isotropic = degrees_of_freedom == 3 and M[0, 0] == M[1, 1] and self.keeps_course

    def coast(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq, h: float) -> Motion:
        phi, theta, psi = attitude
        if phi == 0.0 == theta and (
            self._is_isotropic or (velocity[1] == 0.0 == rate[0] and rate[1] == 0.0 == rate[2] and self.keeps_course)
        ):  # an isotropic body moves as if there were no water
            return (*coast(position, attitude, velocity, rate, self._centre, h), rate)
        u, v, w, p, q, r = _to_level(velocity, rate, phi, theta)
        n = _count(h, abs(r) + (abs(u) + abs(v)) / self._radius, self._sea)
        dt, step, (x, y, z) = h / n, self._plane.step, position
        nu: Four = (u, v, p if self._roll else 0.0, r)
        if self._sea is not None:
            nu = self._kick(self._sea, nu, phi, 0.5 * dt)
        mean = nu
        for k in range(1, n + 1):
            c, s = cos(psi), sin(psi)
            dx, dy, mean, nu = step(nu, mean, dt)
            x, y, psi = x + c * dx - s * dy, y + s * dx + c * dy, psi + dt * mean[3]
            phi += dt * mean[2]
            if self._sea is not None:
                nu = self._kick(self._sea, nu, phi, dt if k < n else 0.5 * dt)
        if not self._roll:
            phi += h * p
        theta += h * q
        return (
            (x, y, z + h * w),
            (phi, theta, psi),
            *_from_level((nu[0], nu[1], w, nu[2] if self._roll else p, q, nu[3]), phi, theta),
        )

    def is_straight(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq) -> bool:
        return (
            (velocity[1] == 0.0 or self._is_isotropic) and rate[0] == 0.0 == rate[1] and rate[2] == 0.0
            and self.keeps_course and attitude[0] == 0.0 == attitude[1]
        )  # fmt: skip

    def _kick(self, sea: _Sea, nu: Four, phi: float, dt: float) -> Four:
        """nu after dt [s] of restoring and damping in roll, by the midpoint rule."""
        moment, damp, p = sea.restoring.compute_roll_moment(sin(phi), cos(phi)), sea.damping, nu[2]
        half = p + 0.5 * dt * self._c * (moment + damp(0.0, p, 0.0)[1])
        return self._plane.kick(nu, dt * (moment + damp(0.0, half, 0.0)[1]))


class _Space:
    """In 6 degrees of freedom."""

    def __init__(self, ship: Ship, restored: bool) -> None:
        M = ship.M
        self._roll_radius = sqrt(float(M[3, 3] / M[0, 0]))
        self._yaw_radius = sqrt(float(min(M[4, 4], M[5, 5]) / M[0, 0]))
        self._sea = _Sea(ship, 6) if restored else None
        self._space = KirchhoffSpace(M, free_inverse(M, 6), self._roll_radius)
        self.keeps_course = bool(M[0, 1] == 0.0 == M[0, 2])
        self._r_bg = ship.r_bg.tolist()

    def coast(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq, h: float) -> Motion:
        (u, v, w), (p, q, r), (x, y, z), (phi, theta, psi) = velocity, rate, position, attitude
        if self.is_straight(position, attitude, velocity, rate):
            return (*coast(position, attitude, velocity, rate, self._r_bg, h), rate)
        speed = abs(u) / self._yaw_radius + (abs(v) + abs(w)) / self._roll_radius
        n = _count(h, abs(p) + abs(q) + abs(r) + speed, self._sea)
        dt, step, sea, nu = h / n, self._space.step, self._sea, (u, v, w, p, q, r)
        rows = rotation_rows(phi, theta, psi)
        if sea is not None:
            nu = self._kick(sea, nu, z, rows[2], 0.5 * dt)
        mean, turned = nu, 0.0
        for k in range(1, n + 1):
            (dx, dy, dz), columns, mean, nu = step(nu, mean, dt)
            (a, b, c), (d, e, f), (g, i, j) = rows
            x, y, z = x + a * dx + b * dy + c * dz, y + d * dx + e * dy + f * dz, z + g * dx + i * dy + j * dz
            turned += dt * (g * mean[3] + i * mean[4] + j * mean[5])
            rows = _turn(rows, *columns)
            if sea is not None:
                nu = self._kick(sea, nu, z, rows[2], dt if k < n else 0.5 * dt)
        return (x, y, z), _angles(rows, psi + turned), nu[:3], nu[3:]

    def is_straight(self, position: Seq, attitude: Seq, velocity: Seq, rate: Seq) -> bool:
        return (
            rate[0] == 0.0 == rate[1] and rate[2] == 0.0 == velocity[1] and velocity[2] == 0.0 and self.keeps_course
            and (self._sea is None or (position[2] == 0.0 == attitude[0] and attitude[1] == 0.0))
        )  # fmt: skip

    def _kick(self, sea: _Sea, nu: Six, z: float, down: Three, dt: float) -> Six:
        """nu after dt [s] of restoring and damping, by the midpoint rule. down: the third row of R_nb."""
        s_theta, c_theta = -down[0], max(hypot(down[1], down[2]), 1e-9)
        X, Y, Z, K, M, N = sea.restoring(z, down[1] / c_theta, down[2] / c_theta, s_theta, c_theta)
        half = 0.5 * dt
        Z_D, K_D, M_D = sea.damping(nu[2], nu[3], nu[4])
        mid = self._space.kick_oscillation(
            nu, (half * X, half * Y, half * (Z + Z_D), half * (K + K_D), half * (M + M_D), half * N)
        )  # fmt: skip
        Z_D, K_D, M_D = sea.damping(*mid)
        return self._space.kick(nu, (dt * X, dt * Y, dt * (Z + Z_D), dt * (K + K_D), dt * (M + M_D), dt * N))


def _count(h: float, turning: float, sea: _Sea | None) -> int:
    """Number of substeps of h [s]; turning: rate of change of the direction of the motion [rad/s]."""
    need = h * turning / FINEST
    if sea is not None:
        need = max(need, h * sea.fastest / FINEST_OSCILLATION)
    if not need <= MAXIMUM_SUBSTEPS:
        raise StepError(
            f"a step of {h:g} s takes {need:.3g} substeps of a ship that coasts, at most {MAXIMUM_SUBSTEPS}: take "
            "shorter steps, or coasting = 'straight'"
        )
    return max(1, ceil(need - 1e-9))


def _to_level(velocity: Seq, rate: Seq, phi: float, theta: float) -> Six:
    """nu_l = (u, v, w, phi_dot, theta_dot, psi_dot) of a twist in b."""
    if phi == 0.0 == theta:
        return velocity[0], velocity[1], velocity[2], rate[0], rate[1], rate[2]
    s_phi, c_phi, s_theta, c_theta = sin(phi), cos(phi), sin(theta), cos(theta)
    below = s_phi * velocity[1] + c_phi * velocity[2]
    under = s_phi * rate[1] + c_phi * rate[2]
    ahead = c_theta * rate[0] + s_theta * under
    return (
        c_theta * velocity[0] + s_theta * below, c_phi * velocity[1] - s_phi * velocity[2],
        c_theta * below - s_theta * velocity[0],
        ahead / c_theta, c_phi * rate[1] - s_phi * rate[2],
        c_theta * under - s_theta * rate[0] + ahead * tan(theta),
    )  # fmt: skip


def _from_level(nu_l: Six, phi: float, theta: float) -> tuple[Seq, Seq]:
    """Velocity and rate in b: the inverse of _to_level."""
    u, v, w, p, q, r = nu_l
    if phi == 0.0 == theta:
        return (u, v, w), (p, q, r)
    s_phi, c_phi, s_theta, c_theta = sin(phi), cos(phi), sin(theta), cos(theta)
    below = c_theta * w + s_theta * u
    velocity = (c_theta * u - s_theta * w, c_phi * v + s_phi * below, c_phi * below - s_phi * v)
    under = c_theta * r
    return velocity, (p - s_theta * r, c_phi * q + s_phi * under, c_phi * under - s_phi * q)


def _turn(rows: Rows, e_x: Three, e_y: Three, e_z: Three) -> Rows:
    """Rows of the product of a matrix and the one of these columns."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    (j, k, m), (n, o, p), (q, r, s) = e_x, e_y, e_z
    return (
        (a * j + b * k + c * m, a * n + b * o + c * p, a * q + b * r + c * s),
        (d * j + e * k + f * m, d * n + e * o + f * p, d * q + e * r + f * s),
        (g * j + h * k + i * m, g * n + h * o + i * p, g * q + h * r + i * s),
    )


def _angles(rows: Rows, expected: float) -> tuple[float, float, float]:
    """Roll, pitch and heading [rad] of R_nb; the heading within half a turn of the expected one."""
    (a, b, _), (d, e, _), (g, i, j) = rows
    pitch = asin(min(1.0, max(-1.0, -g)))
    roll, yaw = (0.0, atan2(-b, e)) if hypot(i, j) < 1e-12 else (atan2(i, j), atan2(d, a))
    return roll, pitch, yaw + 2 * pi * round((expected - yaw) / (2 * pi))
