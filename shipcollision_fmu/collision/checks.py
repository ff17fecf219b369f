"""Refusals of the collision model: parameters out of range, and inputs that are broken signals."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, isfinite

from ..errors import InputError, StepError
from ..ship.frames import Array
from .bodies import Body
from .feedback import COMMON_FEEDBACKS
from .interface import CollisionParameters, ShipState
from .responses import RESPONSES

__all__ = ["MAXIMUM_FRICTION", "check_parameters", "check_pending", "check_states", "check_step"]

MAXIMUM_FRICTION = 10.0
"""Largest friction coefficient. More is a mistake, and 10 already sticks."""

ABSURD_SPEED = 1e3
"""Speeds [m/s] from here on are refused: a broken signal, not a ship."""

ABSURD_PLACE = 1e9
"""Distances from the origin [m] from here on are refused: the Earth is not that large."""


def check_parameters(p: CollisionParameters) -> None:
    """Raises InputError on a parameter out of its range."""
    bounds = (
        ("friction", p.friction, 0.0, MAXIMUM_FRICTION, "Coulomb's coefficient, 0.1 to 0.6 for steel"),
        ("restitution", p.restitution, 0.0, 1.0, "the share of the approach that comes back, 0 for ships that crush"),
    )
    for name, value, low, high, remedy in bounds:
        if not low <= value <= high:
            raise InputError(f"{name} = {value} is outside {low:g} to {high:g}: give {remedy}")
    for name, value, usual in (
        ("substep", p.substep, "0.01 s"), ("minimum_separation_time", p.minimum_separation_time, "10 s"),
        ("clearance_range", p.clearance_range, "200 m"),
    ):  # fmt: skip
        if not (isfinite(value) and value > 0.0):
            raise InputError(f"{name} = {value} must be a positive number: leave it out, or give e.g. {usual}")
    if p.response not in RESPONSES:
        raise InputError(f"response = {p.response!r} is not known: choose one of {', '.join(RESPONSES)}")
    if p.feedback not in COMMON_FEEDBACKS:
        raise InputError(f"feedback = {p.feedback!r} is not known: choose one of {', '.join(COMMON_FEEDBACKS)}")


def check_step(t: float, H: float, bodies: Sequence[Body], states: Sequence[ShipState]) -> None:
    """Raises StepError on a time, a step or a ship's state that is not finite, or absurd."""
    if not (isfinite(t) and isfinite(H) and H > 0.0):
        raise StepError(f"a step from t = {t} s by {H} s cannot be made: both must be finite and the step positive")
    check_states(t, bodies, states)


def check_states(t: float, bodies: Sequence[Body], states: Sequence[ShipState]) -> None:
    """Raises StepError on a ship's state that is not finite, or absurd."""
    for body, state in zip(bodies, states, strict=False):
        if not isfinite(
            sum(state.position) + sum(state.attitude) + sum(state.velocity) + sum(state.rate)
            + sum(state.impulse_applied)
        ):  # fmt: skip
            _refuse_not_finite(body.name, state, t)
        speed, tip, place = hypot(*state.velocity), hypot(*state.rate) * body.reach, hypot(*state.position)
        if speed > ABSURD_SPEED or tip > ABSURD_SPEED or place > ABSURD_PLACE:
            quantity, value, unit, limit = (
                ("velocity", speed, "m/s", ABSURD_SPEED) if speed > ABSURD_SPEED
                else ("rate", tip, "m/s at the ship's ends", ABSURD_SPEED) if tip > ABSURD_SPEED
                else ("position", place, "m from the origin", ABSURD_PLACE)
            )  # fmt: skip
            raise StepError(
                f"{body.name}.{quantity} is {value:g} {unit} at t = {t} s, above {limit:g} {unit}: check the "
                "signal and its unit, and after an impact the mass of the ship model (kg)"
            )


def check_pending(t: float, body: Body, nu: Array, applied: Sequence[float]) -> None:
    """Raises StepError where the impulse that is pending is absurd. nu (6,): twist with it; applied (6):
    impulse_applied, which made it so."""
    u, v, w, p, q, r = nu.tolist()
    speed = max(hypot(u, v, w), hypot(p, q, r) * body.reach)
    if not speed <= ABSURD_SPEED:
        raise StepError(
            f"{body.name}.impulse_applied = {[*applied]} at t = {t} s leaves an impulse pending that would move the "
            f"ship at {speed:g} m/s, above {ABSURD_SPEED:g} m/s: return the part of {body.name}.impulse that the "
            "ship has applied, at first zero"
        )


def _refuse_not_finite(name: str, state: ShipState, t: float) -> None:
    for quantity in ("position", "attitude", "velocity", "rate", "impulse_applied"):
        values = getattr(state, quantity)
        if not all(map(isfinite, values)):
            raise StepError(f"{name}.{quantity} = {values} at t = {t} s is not finite: check the ship model's output")
