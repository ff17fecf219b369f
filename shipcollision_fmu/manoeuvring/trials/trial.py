"""A trial: the ship step by step, and what is read off its track."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from math import atan2, degrees, hypot

from ...errors import StepError
from ..hull_forces import BETA
from ..model import ShipManoeuvring
from .steady_course import STEP, SteadyCourse, make_model

__all__ = ["Figure", "Moment", "Trial", "find_moment_of_heading", "make_trial", "sail_trial"]

PATIENCE = 150.0
"""Lengths at the steady speed after which a trial that has not ended is given up."""

WIDEST_DRIFT = 0.5 * (BETA[0] + BETA[1])
"""[rad] |beta| in the middle of the hand-over from the hull's polynomials to the cross flow. Beyond, the set makes less
than half of the hull's forces, and a figure says nothing of the ship."""

TIGHTEST = 1.5
"""|r'| = |r| L/U. Sets are fitted up to 0.8 or so, and ships turn with 1.3 at most (a radius of 0.77 L). A set that
spins on the spot would keep all of IMO's limits."""

SLOW = 0.2
"""Of the approach speed: below it, at the end of a crash stop, drift is without meaning."""


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
    """A result: name, value, unit, IMO's limit where there is a limit, and the limit that may be allowed instead.

    doubtful: the trial left the range of the hull's polynomials, so there is no verdict.
    """

    name: str
    value: float
    unit: str
    limit: float | None = None
    waived: float | None = None
    doubtful: bool = False

    @property
    def within(self) -> bool | None:
        """Whether the limit is kept, None where there is none or the figure is doubtful."""
        return None if self.limit is None or self.doubtful else self.value <= self.limit


@dataclass(frozen=True)
class Trial:
    """A finished trial: its title, its figures by name, the track, and why there is no verdict, else ''."""

    title: str
    figures: dict[str, Figure]
    track: list[Moment] = field(repr=False)
    doubt: str = ""

    def __getitem__(self, name: str) -> float:
        return self.figures[name].value


def make_trial(start: SteadyCourse, title: str, figures: list[Figure], track: list[Moment]) -> Trial:
    """The trial with its figures; without a verdict where the ship left the range of the hull's polynomials."""
    doubt = _describe_excess(track, start.ship.L_pp)
    return Trial(title, {f.name: replace(f, doubtful=bool(doubt)) for f in figures}, track, doubt)


def _describe_excess(track: list[Moment], L: float) -> str:
    least = SLOW * track[0].speed
    moving = [now for now in track if now.speed > least]
    drift_angle = max(abs(atan2(now.sway, now.surge)) for now in moving)
    turn = max(L * abs(now.yaw_rate) / now.speed for now in moving)
    if drift_angle <= WIDEST_DRIFT and turn <= TIGHTEST:
        return ""
    return (
        f"no verdict: the ship drifts by up to {degrees(drift_angle):.0f} deg and turns with up to r L/U = {turn:.2f}; "
        f"the polynomials of [manoeuvring] hold up to {degrees(WIDEST_DRIFT):.0f} deg and {TIGHTEST}: look at the "
        "signs and sizes of the set, above all of N_v, N_r and gamma_R"
    )


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
