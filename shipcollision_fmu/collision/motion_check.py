"""Whether the state of a ship agrees with itself: position against velocity, heading against rate.

A *window* begins and ends where the position received changes, so that a ship model with longer steps than the
collision model is measured over whole steps of its own. Over a window of T [s]:

    moved    (change of position) / T                   against    R(attitude) velocity, mean of start and end
    turned   (change of heading) / T                    against    (q sin phi + r cos phi) / cos theta, likewise

Both in n, the velocity in the plane. The bounds are wide: they are met by Euler schemes, waves, steps of 0.5 s and ship
models with another step, and missed by other units, frames and inputs that nobody connected.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, degrees, hypot, pi, radians, remainder, sin
from typing import NamedTuple

__all__ = ["SLOW", "Motion", "Verdict", "judge_motion"]

SLOW, SLOW_TURN = 0.5, 0.005
"""Speed [m/s] and rate [rad/s] below which a window shows nothing. Lower, and waves and rounding decide."""

SPEED_ERROR, RATE_ERROR, SHARE = 0.3, 0.003, 0.25
"""Differences that are no finding [m/s], [rad/s], and as a share of the larger value. With smaller ones a ship model
whose step is no multiple of the collision model's would be suspected; with 0.5 knots would not be found."""

KNOT, KILOMETRE_PER_HOUR = 3600.0 / 1852.0, 3.6
"""Per metre per second."""

Vector = tuple[float, float]


class Motion(NamedTuple):
    """A ship as received at t [s]: position [m], attitude [rad], velocity [m/s], rate [rad/s]."""

    t: float
    position: list[float]
    attitude: list[float]
    velocity: list[float]
    rate: list[float]


class Verdict(NamedTuple):
    """What a window shows. finding: key of findings.py, or empty; measured: for its message; speed, rate: whether they
    were seen to be right."""

    finding: str
    measured: Mapping[str, float | str]
    speed: bool = False
    rate: bool = False


def judge_motion(start: Motion, end: Motion) -> Verdict:
    """What the window from start to end shows of the velocity, and if that is right, of the rate."""
    T = end.t - start.t
    moved = (end.position[0] - start.position[0]) / T, (end.position[1] - start.position[1]) / T
    given = _mean_velocity(start, end)
    fast = max(hypot(*moved), hypot(*given))
    off = _distance(moved, given)
    if fast > SLOW and off > SPEED_ERROR + SHARE * fast:
        measured: dict[str, float | str] = {
            "moved": hypot(*moved), "given": hypot(*end.velocity[:2]), "off": off, "yaw": end.attitude[2],
            "unit": "knots" if hypot(*given) < 2.5 * hypot(*moved) else "km/h",
        }  # fmt: skip
        return Verdict(_explain_velocity(start, end, moved, given), measured)
    is_right = fast > SLOW and abs(remainder(end.attitude[2], 2.0 * pi)) > 0.15  # northwards all units agree
    turned = remainder(end.attitude[2] - start.attitude[2], 2.0 * pi) / T
    rate = 0.5 * (_heading_rate(start) + _heading_rate(end))
    fast = max(abs(turned), abs(rate))
    if fast > SLOW_TURN and abs(turned - rate) > RATE_ERROR + SHARE * fast:
        return Verdict(_explain_rate(turned, rate), {"moved": turned, "given": rate, "yaw": end.attitude[2]})
    return Verdict("", {}, is_right, fast > SLOW_TURN)


def _explain_velocity(start: Motion, end: Motion, moved: Vector, given: Vector) -> str:
    speed = hypot(*moved)
    if hypot(*given) < 0.05 * speed:
        return "no velocity"
    in_degrees = [s._replace(attitude=[radians(angle) for angle in s.attitude]) for s in (start, end)]
    u, v = (0.5 * (start.velocity[k] + end.velocity[k]) for k in (0, 1))
    hypotheses = (
        ("attitude in degrees", _mean_velocity(*in_degrees)),
        ("unit of the velocity", (given[0] / KNOT, given[1] / KNOT)),
        ("unit of the velocity", (given[0] / KILOMETRE_PER_HOUR, given[1] / KILOMETRE_PER_HOUR)),
        ("frame of the velocity", (u, v)),
    )
    nearest, key = min((_distance(moved, expected), key) for key, expected in hypotheses)
    return key if nearest < 0.1 * SPEED_ERROR + 0.05 * speed else "other velocity"


def _explain_rate(turned: float, rate: float) -> str:
    if abs(rate) < 0.05 * abs(turned):
        if abs(radians(turned) - rate) < SHARE * abs(rate):
            return "attitude in degrees"
        return "no rate"
    return "rate in degrees" if abs(degrees(turned) - rate) < SHARE * abs(rate) else "other rate"


def _mean_velocity(start: Motion, end: Motion) -> Vector:
    """Mean of the two velocities, in the plane of n."""
    (n_0, e_0), (n_1, e_1) = _velocity_in_n(start.attitude, start.velocity), _velocity_in_n(end.attitude, end.velocity)
    return 0.5 * (n_0 + n_1), 0.5 * (e_0 + e_1)


def _velocity_in_n(attitude: Sequence[float], velocity: Sequence[float]) -> Vector:
    (roll, pitch, yaw), (u, v, w) = attitude, velocity
    ahead = u * cos(pitch) + (v * sin(roll) + w * cos(roll)) * sin(pitch)
    abeam = v * cos(roll) - w * sin(roll)
    return ahead * cos(yaw) - abeam * sin(yaw), ahead * sin(yaw) + abeam * cos(yaw)


def _heading_rate(motion: Motion) -> float:
    (roll, pitch, _), (_, q, r) = motion.attitude, motion.rate
    return (q * sin(roll) + r * cos(roll)) / max(cos(pitch), 0.1)


def _distance(a: Vector, b: Vector) -> float:
    return hypot(a[0] - b[0], a[1] - b[1])
