"""Random impacts of two ships: what the property tests of the single-contact laws draw from.

Numbers are drawn one by one, not from a seed, so that zeros, head-on courses and level ships come up and shrink well.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from hypothesis import strategies as st

from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import make_contact, point_jacobian
from shipcollision_fmu.collision.dynamics.contact_frame import contact_axes
from shipcollision_fmu.ship.degrees_of_freedom import FREE, free_inverse, held_mobility, level_axes, tilted_inverse
from shipcollision_fmu.ship.frames import attitude_from_rotation, rotation
from shipcollision_fmu.ship.inertia import added_mass_matrix, rigid_body_inertia

Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True, eq=False)
class Ship:
    """A ship at impact: CO x (3,) in n, R_nb, M (6, 6) about CO, its free inverse, twist nu (6,) in b.

    axes (6, 6): nu = axes nu_m, where M is the inertia of the motions nu_m; axes_n (3, 3): from theirs to n. Those of b
    in 6 degrees of freedom, else level (ship/degrees_of_freedom.py).
    """

    x: Array
    R: Array
    M: Array
    M_inverse: Array
    nu: Array
    axes: Array
    axes_n: Array
    free: int
    fixed: bool = False

    def jacobian(self, point: Array) -> Array:
        return point_jacobian(self.R, self.R.T @ (point - self.x))

    @property
    def held(self) -> Array:
        """(6, 6): what M^-1 of all motions is more than M_inverse, in b."""
        if self.fixed:
            return np.zeros((6, 6))
        held: Array = self.axes @ np.linalg.inv(self.M) @ self.axes.T - self.M_inverse
        return held

    def struck(self, point: Array, P: Array) -> Ship:
        """The ship after the impulse P (in n) at `point`."""
        return replace(self, nu=self.nu + self.M_inverse @ self.jacobian(point).T @ P)

    def state(self) -> BodyState:
        """The same as the collision model knows her, from her position, attitude, twist and inertia alone."""
        attitude = attitude_from_rotation(self.R)
        inverse = tilted_inverse(free_inverse(self.M, self.free), self.free, attitude)
        return BodyState.at(self.x, attitude, self.nu, inverse, held=held_mobility(self.M, self.free))

    @property
    def motion(self) -> Array:
        """nu_m (6,)."""
        nu_m: Array = np.linalg.solve(self.axes, self.nu)
        return nu_m

    @property
    def energy(self) -> float:
        return float(0.5 * self.motion @ self.M @ self.motion)


@dataclass(frozen=True, eq=False)
class Impact:
    """Two ships that touch at `point` with the normal from a to b; friction, restitution."""

    a: Ship
    b: Ship
    point: Array
    normal: Array
    mu: float
    e: float

    @property
    def axes(self) -> Array:
        return contact_axes(self.normal)

    @property
    def W(self) -> Array:
        """(3, 3) in contact axes."""
        return sum(  # type: ignore[return-value]  # a sum of arrays
            (G @ ship.M_inverse @ G.T)
            for ship in (self.a, self.b)
            for G in [self.axes @ ship.jacobian(self.point)]
        )  # fmt: skip

    @property
    def H(self) -> Array:
        """(3, 3) in contact axes: what the held motions would add along the vertical."""
        rows = [ship.jacobian(self.point)[2] for ship in (self.a, self.b)]
        added = sum(float(g @ ship.held @ g) for g, ship in zip(rows, (self.a, self.b), strict=True))
        return added * np.outer(self.axes[:, 2], self.axes[:, 2])

    @property
    def W_friction(self) -> Array:
        """(3, 3): W with H across the normal, which friction meets."""
        across = np.diag([0.0, 1.0, 1.0])
        return self.W + across @ self.H @ across

    def held_energy(self, P: Array) -> float:
        """What the water takes of heave and pitch after friction has moved them [J]."""
        return float(0.5 * P @ (self.W_friction - self.W) @ P)

    @property
    def v(self) -> Array:
        """Relative velocity b less a in contact axes; (3,)."""
        v: Array = self.axes @ (self.b.jacobian(self.point) @ self.b.nu - self.a.jacobian(self.point) @ self.a.nu)
        return v

    @property
    def scale(self) -> float:
        """Kinetic energy of both ships [J]."""
        return self.a.energy + self.b.energy

    def after(self, P: Array) -> Impact:
        """Both ships after the impulse P (3,) in contact axes."""
        P_n = self.axes.T @ P
        return replace(self, a=self.a.struck(self.point, -P_n), b=self.b.struck(self.point, P_n))

    def swapped(self) -> Impact:
        return replace(self, a=self.b, b=self.a, normal=-self.normal)

    def moved(self, turn: Array, shift: Array) -> Impact:
        """The same in a world turned and shifted."""
        a, b = (replace(s, x=turn @ s.x + shift, R=turn @ s.R, axes_n=turn @ s.axes_n) for s in (self.a, self.b))
        return replace(self, a=a, b=b, point=turn @ self.point + shift, normal=turn @ self.normal)

    def mirrored(self) -> Impact:
        """Port for starboard, in the world and in both ships."""
        F = np.diag([1.0, -1.0, 1.0])
        S = np.diag([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
        a, b = (
            replace(
                s, x=F @ s.x, R=F @ s.R @ F, M=S @ s.M @ S, M_inverse=S @ s.M_inverse @ S, nu=S @ s.nu,
                axes=S @ s.axes @ S, axes_n=F @ s.axes_n @ F,
            )
            for s in (self.a, self.b)
        )  # fmt: skip
        return replace(self, a=a, b=b, point=F @ self.point, normal=F @ self.normal)


def check_momentum(impact: Impact, P: Array) -> None:
    """P (in contact axes), booked by the collision model's own states, changes M nu of both ships by equal and
    opposite impulses at one point: -P on a and P on b in each of their free motions, and no moment about any fixed
    point. To 1e-10 of the impulse and of its moment, but for the rounding of what the ships had before.
    """
    states = [impact.a.state(), impact.b.state()]
    contact = make_contact(0, 1, states, impact.point, impact.normal, 0.0)
    P_n = impact.axes.T @ P
    for state, G, sign in zip(states, (contact.G_a, contact.G_b), (-1.0, 1.0), strict=True):
        state.book([sign * P_n @ G])
    size = float(np.linalg.norm(P_n))
    wrenches, wrench_size = np.zeros((2, 3)), np.zeros((2, 3))
    for ship, state, sign in zip((impact.a, impact.b), states, (-1.0, 1.0), strict=True):
        before, after = (ship.M @ np.linalg.solve(ship.axes, nu) for nu in (ship.nu, state.nu))
        had = np.abs(ship.M) @ np.abs(np.linalg.solve(ship.axes, ship.nu)) + np.abs(after)
        arm, free = impact.point - ship.x, list(FREE[ship.free])
        # Along and about which axes of n each motion is: roll is about the ship's own x, level or not.
        turns = ship.axes_n.copy()
        turns[:, 0] = ship.R[:, 0]
        expected = sign * np.concatenate([ship.axes_n.T @ P_n, turns.T @ np.cross(arm, P_n)])
        scale = np.repeat([size, float(np.linalg.norm(arm)) * size], 3)
        missed = np.abs(after - before - expected)
        assert (missed <= 1e-10 * scale + 1e-14 * had)[free].all(), (missed, scale, had)
        # What the ship took, in n: level and about the vertical, which are free in all of them.
        taken, rounding = ship.axes_n @ (after - before)[:3], float(had[:3].max())
        for k, about in enumerate((np.zeros(3), np.array([-400.0, 900.0, 30.0]))):
            moment = (ship.axes_n @ (after - before)[3:])[2] + np.cross(ship.x - about, taken)[2]
            wrenches[k] += [taken[0], taken[1], moment]
            far = float(np.linalg.norm(ship.x - about)) + float(np.linalg.norm(arm))
            wrench_size[k] += [size + 1e-4 * rounding] * 2 + [far * (size + 1e-4 * rounding) + 1e-4 * had[3:].max()]
    assert (np.abs(wrenches) <= 1e-10 * wrench_size).all(), (wrenches, wrench_size)


def floats(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_subnormal=False)


SHARE = floats(0.0, 1.0)
SLOPE = floats(-0.7, 0.7)


@st.composite
def ships(draw: st.DrawFn, degrees_of_freedom: int) -> Ship:
    """10 t to 400 000 t, any heading, heeled and trimmed; 6 degrees of freedom also with heave, roll and pitch."""
    m = 10.0 ** draw(floats(4.0, 8.6))
    L = 2.0 * m ** (1 / 3)
    m_y = draw(floats(0.0, 1.3)) * m
    M = rigid_body_inertia(
        m, [draw(floats(-0.05, 0.05)) * L, 0.0, draw(floats(-0.02, 0.02)) * L], np.array([0.06, 0.25, 0.25]) * L
    )
    M = M + added_mass_matrix(
        draw(floats(0.0, 0.1)) * m, m_y, m, 0.2 * m * (0.06 * L) ** 2, m * (0.25 * L) ** 2,
        draw(floats(0.0, 0.9)) * m * (0.25 * L) ** 2, z_y=draw(floats(0.0, 0.02)) * L,
    )  # fmt: skip
    attitude = [draw(floats(-0.3, 0.3)), draw(floats(-0.1, 0.1)), draw(floats(-np.pi, np.pi))]
    axes = np.eye(6) if degrees_of_freedom == 6 else level_axes(attitude)
    nu = np.array([draw(floats(-10, 10)), draw(floats(-3, 3)), 0.0, 0.0, 0.0, draw(floats(-0.03, 0.03))])
    if degrees_of_freedom == 6:
        nu[2:5] = [draw(floats(-1, 1)), draw(floats(-0.1, 0.1)), draw(floats(-0.03, 0.03))]
    if degrees_of_freedom == 4:
        nu[3] = draw(floats(-0.1, 0.1))
    offset = np.array([draw(floats(-0.5, 0.5)), draw(floats(-0.1, 0.1)), draw(floats(-0.05, 0.05))]) * L
    R = rotation(attitude)
    inverse = axes @ free_inverse(M, degrees_of_freedom) @ axes.T
    axes_n = R if degrees_of_freedom == 6 else rotation([0.0, 0.0, attitude[2]])
    return Ship(-R @ offset, R, M, inverse, axes @ nu, axes, axes_n, degrees_of_freedom)


@st.composite
def impacts(
    draw: st.DrawFn,
    mu: st.SearchStrategy[float] = SHARE,
    e: st.SearchStrategy[float] = SHARE,
    degrees_of_freedom: tuple[int, ...] = tuple(FREE),
    slope: st.SearchStrategy[float] = SLOPE,
) -> Impact:
    """Ships that approach each other at a contact point, both with the same degrees of freedom.

    slope: of the normal [rad].
    """
    free = draw(st.sampled_from(degrees_of_freedom))
    one, other = draw(ships(free)), draw(ships(free))
    angle, steep = draw(floats(-np.pi, np.pi)), draw(slope)
    normal = np.array([np.cos(angle) * np.cos(steep), np.sin(angle) * np.cos(steep), np.sin(steep)])
    point = np.array([draw(floats(-1e3, 1e3)), draw(floats(-1e3, 1e3)), draw(floats(-10, 10))])
    one, other = replace(one, x=one.x + point), replace(other, x=other.x + point)
    impact = Impact(one, other, point, normal, draw(mu), draw(e))
    closing = -float(impact.v[0])
    if closing < 0.0:  # parting: the other way round they approach
        one, other = (replace(s, nu=-s.nu) for s in (one, other))
    if abs(closing) < 1e-3:
        # Drive a along the normal.
        push = free_push(one, normal)
        one = replace(one, nu=one.nu + push)
    return replace(impact, a=one, b=other)


def free_push(ship: Ship, normal: Array) -> Array:
    """A twist of 1 m/s along the horizontal part of the normal."""
    forward = ship.axes_n.T @ np.array([normal[0], normal[1], 0.0])
    push: Array = ship.axes @ np.array([forward[0], forward[1], 0.0, 0.0, 0.0, 0.0])
    return push
