"""Standard manoeuvring trials of one ship, sailed in process: turning circle, zigzag, crash stop.

    turning circle   from a straight approach the rudder goes over and stays there
                     advance            distance along the approach until the heading has changed by 90 deg
                     transfer           distance across it then
                     tactical diameter  distance across it when the heading has changed by 180 deg
                     steady radius      U/r, drift = atan2(-v, u), and speed lost, when the turn no longer changes
    zigzag           rudder to one side until the heading has changed by the heading angle, then to the other, and so on
                     overshoot          how far the heading runs on past that angle after each counter-rudder
    crash stop       full astern until the ship has no way on
                     track reach        distance sailed; head reach: along the approach; lateral deviation: across it

Limits: IMO resolution MSC.137(76) (2002), Standards for Ship Manoeuvrability, for ships of 100 m and more at the test
speed; L/V is length over test speed [s].

    turning ability             advance <= 4.5 L, tactical diameter <= 5 L           at 35 deg of rudder
    initial turning ability     <= 2.5 L sailed until 10 deg of heading              at 10 deg of rudder
    yaw checking, 10/10         first overshoot <= 10 deg where L/V < 10 s, 20 deg where L/V >= 30 s, 5 + L/V/2 between;
                                second <= 25 deg, 40 deg, 17.5 + 0.75 L/V
    yaw checking, 20/20         first overshoot <= 25 deg
    stopping ability            track reach <= 15 L; an Administration may allow a ship of large displacement up to 20 L

Where the ship drifts or turns so fast that the hull's polynomials no longer hold, there is no verdict (trial.py).

Distances are of midship (CO), from where it was when the order was given. The water is at rest and deep.
"""

from __future__ import annotations

from math import atan2, degrees, hypot, isfinite, pi, radians

from ...errors import ScenarioError
from .steady_course import SteadyCourse
from .trial import Figure, Moment, Trial, find_moment_of_heading, make_trial, sail_trial

__all__ = ["sail_crash_stop", "sail_turning_circle", "sail_zigzag"]

STEADY = 1e-4
"""A turn is steady when speed and rate change by less than this part of themselves over 10 deg of heading."""
MOST_TURN = 6.0 * pi
"""[rad] A turn that is not steady after this change of heading is taken as it is."""
OVERSHOOTS = 4
"""Counter-rudders of a zigzag."""


def sail_turning_circle(start: SteadyCourse, rudder_deg: float, *, port: bool = False) -> Trial:
    """A turn with the rudder over to starboard, or to port; rudder_deg > 0. Raises ScenarioError, StepError."""
    _check_angle(start, "rudder_deg", rudder_deg)
    sign = -1.0 if port else 1.0
    L = start.ship.L_pp
    track: list[Moment] = []
    last_ten = [(0.0, 0.0, 0.0)]
    for now in sail_trial(start, f"the turn with {rudder_deg:g} deg of rudder", lambda _: sign * radians(rudder_deg)):
        track.append(now)
        turned = sign * now.heading
        if turned >= last_ten[-1][0] + radians(10.0):
            _, speed, rate = last_ten[-1]
            last_ten.append((turned, now.speed, now.yaw_rate))
            changed = max(abs(now.speed - speed) / now.speed, abs(now.yaw_rate - rate) / abs(now.yaw_rate))
            if turned >= 2.0 * pi and (changed < STEADY or turned >= MOST_TURN):
                break
    at_90, at_180 = (find_moment_of_heading(track, sign * angle) for angle in (0.5 * pi, pi))
    end = track[-1]
    imo = rudder_deg >= 35.0 - 1e-9
    figures = [
        Figure("advance", at_90.x / L, "L", 4.5 if imo else None),
        Figure("transfer", sign * at_90.y / L, "L"),
        Figure("tactical diameter", sign * at_180.y / L, "L", 5.0 if imo else None),
        Figure("steady radius", end.speed / abs(end.yaw_rate) / L, "L"),
        Figure("drift angle", degrees(sign * atan2(-end.sway, end.surge)), "deg"),
        Figure("rate of turn", degrees(abs(end.yaw_rate)), "deg/s"),
        Figure("speed kept", end.speed / start.speed, "1"),
        Figure("time to 90 deg", at_90.time, "s"),
        Figure("time to 180 deg", at_180.time, "s"),
    ]
    side = "port" if port else "starboard"
    return make_trial(start, f"turning circle, {rudder_deg:g} deg to {side}", figures, track)


def sail_zigzag(start: SteadyCourse, rudder_deg: float, heading_deg: float, *, port: bool = False) -> Trial:
    """A zigzag, first to starboard or to port; both angles > 0. Raises ScenarioError, StepError."""
    _check_angle(start, "rudder_deg", rudder_deg)
    if not (isfinite(heading_deg) and 0.0 < heading_deg <= 60.0):
        raise ScenarioError(f"heading_deg = {heading_deg:g} must be greater than 0 and at most 60: e.g. 10 or 20")
    sign, delta, turn = -1.0 if port else 1.0, radians(rudder_deg), radians(heading_deg)
    L = start.ship.L_pp
    track: list[Moment] = []
    executes: list[tuple[Moment, float]] = []  # counter-rudder given, and the largest heading after it on that side
    side, sailed = sign, 0.0

    def order(_: Moment) -> float:
        return side * delta

    initial_turning = 0.0
    for now in sail_trial(start, f"the {rudder_deg:g}/{heading_deg:g} zigzag", order):
        if track:
            sailed += hypot(now.x - track[-1].x, now.y - track[-1].y)
        track.append(now)
        if executes:
            moment, largest = executes[-1]
            executes[-1] = (moment, max(largest, -side * now.heading))
        if side * now.heading >= turn:
            if not executes:
                initial_turning = sailed
            if len(executes) == OVERSHOOTS:
                break
            executes.append((now, side * now.heading))
            side = -side
    overshoots = [degrees(largest) - heading_deg for _, largest in executes]
    limits = _compute_overshoot_limits(rudder_deg, heading_deg, L / start.speed)
    figures = [
        Figure(f"{which} overshoot", overshoot, "deg", limit)
        for which, overshoot, limit in zip(("first", "second", "third", "fourth"), overshoots, limits, strict=True)
    ]
    ten_ten = rudder_deg == heading_deg == 10.0
    figures += [
        Figure("initial turning", initial_turning / L, "L", 2.5 if ten_ten else None),
        Figure("second execute", executes[0][0].time, "s"),
        Figure("third execute", executes[1][0].time, "s"),
        Figure("period", executes[2][0].time - executes[0][0].time, "s"),
    ]
    first = "port" if port else "starboard"
    return make_trial(start, f"zigzag {rudder_deg:g}/{heading_deg:g}, {first} first", figures, track)


def sail_crash_stop(start: SteadyCourse, *, rev_per_s: float | None = None) -> Trial:
    """Full astern until there is no way on; `rev_per_s` > 0 instead of the engine's most. ScenarioError, StepError."""
    engine = start.ship.engine
    assert engine is not None
    astern = engine.max_astern_rev_per_s if rev_per_s is None else rev_per_s
    if not 0.0 < astern <= engine.max_astern_rev_per_s:
        raise ScenarioError(
            f"ship {start.name!r} cannot stop with {astern:g} rev/s astern: must be above 0 and at most its engine's "
            f"max_astern_rev_per_s = {engine.max_astern_rev_per_s:g}"
        )
    L, sailed = start.ship.L_pp, 0.0
    track: list[Moment] = []
    for now in sail_trial(start, "the crash stop", lambda _: 0.0, -astern):
        if track:
            sailed += hypot(now.x - track[-1].x, now.y - track[-1].y)
        track.append(now)
        if now.surge <= 0.0:
            break
    end = track[-1]
    figures = [
        Figure("track reach", sailed / L, "L", 15.0, waived=20.0),
        Figure("head reach", end.x / L, "L"),
        Figure("lateral deviation", end.y / L, "L"),
        Figure("time to stop", end.time, "s"),
        Figure("change of heading", degrees(end.heading), "deg"),
    ]
    return make_trial(start, f"crash stop, {astern:.4g} rev/s astern", figures, track)


def _compute_overshoot_limits(rudder_deg: float, heading_deg: float, L_over_V: float) -> tuple[float | None, ...]:
    if rudder_deg == heading_deg == 20.0:
        return 25.0, None, None, None
    if not rudder_deg == heading_deg == 10.0:
        return None, None, None, None
    between = min(30.0, max(10.0, L_over_V))
    return 5.0 + 0.5 * between, 17.5 + 0.75 * between, None, None


def _check_angle(start: SteadyCourse, what: str, angle_deg: float) -> None:
    assert start.ship.rudder is not None
    most = start.ship.rudder.max_angle_deg
    if not (isfinite(angle_deg) and 0.0 < angle_deg <= most):
        raise ScenarioError(
            f"{what} = {angle_deg:g} must be greater than 0 and at most the rudder's max_angle_deg = {most:g} of ship "
            f"{start.name!r}; the side is chosen with --port"
        )
