"""A trial: the ship step by step, and what is read off its track."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import hypot

from ...errors import StepError
from ..model import ShipManoeuvring
from .steady_course import STEP, SteadyCourse, make_model

__all__ = ["Figure", "Moment", "Trial", "find_moment_of_heading", "sail_trial"]

PATIENCE = 150.0
"""Lengths at the steady speed after which a trial that has not ended is given up."""


@dataclass(frozen=True)
class Moment:
    """The ship at a time [s] of a trial: CO [m], heading [rad], u, v [m/s], r [rad/s], rudder [rad], propeller [1/s].

    x is along the approach, y to starboard of it, from where CO was when the order was given.
    """

    time: float
    x: float
    y: float
    heading: float
    surge: float
    sway: float
    yaw_rate: float
    rudder_angle: float
    propeller_speed: float

    @property
    def speed(self) -> float:
        """U [m/s]."""
        return hypot(self.surge, self.sway)


@dataclass(frozen=True)
class Figure:
    """A result: name, value, unit, IMO's limit where there is a limit, and the limit that may be allowed instead."""

    name: str
    value: float
    unit: str
    limit: float | None = None
    waived: float | None = None

    @property
    def within(self) -> bool | None:
        """Whether the limit is kept, None where there is none."""
        return None if self.limit is None else self.value <= self.limit


@dataclass(frozen=True)
class Trial:
    """A finished trial: its title, its figures by name, and the track."""

    title: str
    figures: dict[str, Figure]
    track: list[Moment] = field(repr=False)

    def __getitem__(self, name: str) -> float:
        return self.figures[name].value


def sail_trial(
    start: SteadyCourse, what: str, rudder: Callable[[Moment], float], rev_per_s: float | None = None
) -> Iterator[Moment]:
    """The ship at every step from the order on; `rudder` gives the rudder order [rad] before each."""
    model, h = make_model(start.name, start.speed, start.rev_per_s, start.degrees_of_freedom), start.step
    model.parameters.substep = h
    model.initialise()
    for k in range(round(PATIENCE / STEP)):
        now = _read_moment(model, k * h)
        yield now
        model.inputs.rudder_order = rudder(now)
        model.inputs.propeller_order = start.rev_per_s if rev_per_s is None else rev_per_s
        model.step(k * h, h)
    raise StepError(f"ship {start.name!r}: {what} has not ended after {PATIENCE:g} lengths at {start.speed:g} m/s")


def _read_moment(model: ShipManoeuvring, time: float) -> Moment:
    o = model.outputs
    return Moment(
        time, o.position[0], o.position[1], o.attitude[2], o.velocity[0], o.velocity[1], o.rate[2], o.rudder_angle,
        o.propeller_speed,
    )  # fmt: skip


def find_moment_of_heading(track: list[Moment], heading: float) -> Moment:
    """The moment of a change of heading [rad], between two steps."""
    k = next(k for k, now in enumerate(track) if abs(now.heading) >= abs(heading) and now.heading * heading > 0.0)
    before, after = track[k - 1], track[k]
    share = (heading - before.heading) / (after.heading - before.heading)
    pairs = zip(vars(before).values(), vars(after).values(), strict=True)
    return Moment(*(a + share * (b - a) for a, b in pairs))
