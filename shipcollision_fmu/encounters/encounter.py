"""encounter(): a scenario whose two ships do collide, made backwards from the impact.

    check_request            the kind and its defaults                              request.py
    plan_impact              the struck place on "target", the angle to "own"       planned_impact.py
    plan_approaching_ships   speeds, current, wind, helm orders                     approaching_ship.py
    make_track               the way to the impact, straight or sailed              approach_track.py
    aim_track                corrected until the collision model agrees             targeting.py
    check_no_earlier_overlap hulls apart until the impact                           earlier_overlap.py
    write_encounter          the scenario file                                      encounter_file.py

An impact that the request rules out is refused: hulls that do not close at the place, or that lie along each other.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, replace
from math import cos, hypot, inf, radians, sin
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ScenarioError
from ..scenario.scenario import Scenario, parse_scenario
from ..scenario.tables.environment import Environment
from .approach_track import compute_relative_velocity, make_track, sail_as_in_run, shift_track
from .approaching_ship import ApproachingShip, plan_approaching_ships
from .earlier_overlap import check_no_earlier_overlap
from .encounter_file import Approach, write_encounter
from .plan_contact import find_contacts
from .planned_impact import PlannedImpact, describe_impact, plan_impact
from .request import Request, check_request, check_surroundings, count_steps, make_request, value_or_default
from .targeting import ACCEPTED, ImpactFinder, aim_track

__all__ = ["Encounter", "encounter"]

SLOWEST_CLOSING = 0.05
"""[m/s] Least closing speed along the normal. Slower hulls come to lie against each other instead of
colliding."""
GRAZING = 0.03
"""Least closing speed as a fraction of the relative speed: 1.7 deg from the hull's side. Nearer to it,
the overlap that targeting needs moves the place along the hull by more than the accepted distance."""
TOLERANCE = 0.45
"""[m] Largest distance of the impact from the place when the scenario is run as written; 0.5 m is promised."""
HAIR = 1e-5
"""[m] Shift of the start between two attempts to write the file: the last digit in which it gives positions."""
HAIRS = 20
"""Attempts to write the file."""
USUAL_TIME = 60.0
"""[s] Least default time from the start to the impact."""
STRAIGHT_TIME = 30.0
"""[s] Default time on a straight course before the rudder order."""


@dataclass(frozen=True)
class Encounter:
    """A generated encounter: the file's text, its scenario, and the impact to which it leads.

    point           the place on the target, (x, y) in its b [m]
    normal          outward normal of the target there, (2,) in its b
    angle           angle between the headings [rad]
    time            time of the impact [s]
    closing_speed   along the normal [m/s]
    """

    text: str
    scenario: Scenario
    point: tuple[float, float]
    normal: tuple[float, float]
    angle: float
    time: float
    closing_speed: float


def encounter(request: Request | str, directory: str | Path = ".", **options: Any) -> Encounter:
    """The encounter of a request, as a scenario file for `directory`.

    `request`: a Request, or the name of a kind with options: encounter("t-bone", own="kcs", own_speed=4.0).
    Raises ScenarioError, in one line, for options that are refused and for ships that do not meet as requested;
    ShipError for a ship that cannot be loaded.
    """
    if isinstance(request, str):
        request = make_request(request, options)
    elif options:
        request = replace(request, **options)
    kind = check_request(request)
    usual = max(USUAL_TIME, value_or_default(request.before, kind.before) + STRAIGHT_TIME)
    steps = count_steps(value_or_default(request.time, usual), request.step)
    sailed = kind.sailed if request.hydrodynamics is None else request.hydrodynamics
    impact = plan_impact(request, kind)
    check_surroundings(request, kind, sailed)
    around, own, target = plan_approaching_ships(request, kind, sailed, steps)
    with closing(ImpactFinder(own, target, steps, request.step)) as finder:
        approach = _aim(request, impact, own, target, around, steps, finder)
        check_no_earlier_overlap(
            approach.own_track, approach.target_track, impact.sections, impact.deck, steps, request.step
        )
        text, scenario = _write_as_run(
            lambda to: write_encounter(request, kind, impact, steps, around, to, sailed, Path(directory)),
            lambda text: parse_scenario(text, f"encounter {request.kind}", directory),
            request, impact, approach, steps, finder,
        )  # fmt: skip
    return Encounter(
        text=text,
        scenario=scenario,
        point=(float(impact.place.point[0]), float(impact.place.point[1])),
        normal=(float(approach.contact.normals[0][0]), float(approach.contact.normals[0][1])),
        angle=abs(impact.heading),
        time=steps * request.step,
        closing_speed=approach.closing_speed,
    )


def _aim(
    request: Request, impact: PlannedImpact, own: ApproachingShip, target: ApproachingShip,
    around: Environment, steps: int, finder: ImpactFinder,
) -> Approach:  # fmt: skip
    """The first contact in plan for which the tracks lead to the impact, which is at n's origin."""
    psi, h, place = radians(request.heading_deg), request.step, impact.place
    R = np.array([[cos(psi), -sin(psi)], [sin(psi), cos(psi)]])
    target_track = make_track(target, -R @ place.point, psi, around, steps, h)
    contacts = find_contacts(place, impact.sections["own"], impact.heading)
    own_track = make_track(own, R @ (contacts[0].position - place.point), psi + impact.heading, around, steps, h)
    least_off = inf
    for i, contact in enumerate(contacts):
        shifted = shift_track(own_track, R @ (contact.position - contacts[0].position))
        velocity = compute_relative_velocity(shifted[steps], target_track[steps])
        speeds = [float(-velocity @ (R @ normal)) for normal in contact.normals]
        least = max(SLOWEST_CLOSING, GRAZING * float(np.linalg.norm(velocity)))
        if min(speeds) < least:
            if i == 0:
                raise _refuse_grazing(request, impact, min(speeds), least)
            continue
        track, off = aim_track(finder, shifted, target_track, place.point, contact.normals[0], speeds[0], steps, h)
        if off <= ACCEPTED:
            return Approach(own, target, track, target_track, contact, speeds[0])
        least_off = min(least_off, off)
    raise _refuse_miss(request, impact, least_off)


def _write_as_run(
    write: Callable[[Approach], str], read: Callable[[str], Scenario], request: Request, impact: PlannedImpact,
    approach: Approach, steps: int, finder: ImpactFinder,
) -> tuple[str, Scenario]:  # fmt: skip
    """Text and scenario of the first of HAIRS starts that, rounded as written, leads to the place.

    The starts differ by some HAIR and all lead to the same line of contact. Each is sailed to the bit as a run does.
    """
    text = write(approach)
    scenario = read(text)
    target, off, least_off = sail_as_in_run(scenario, "target", steps), inf, inf
    for attempt in range(HAIRS):
        hit = finder.find_impact(sail_as_in_run(scenario, "own", steps), target)
        off = inf if hit is None else hypot(*(impact.place.point - hit.point))
        if off <= TOLERANCE:
            return text, scenario
        least_off = min(least_off, off)
        shift = (attempt // 2 + 1) * (-1) ** attempt * HAIR
        text = write(approach._replace(own_track=shift_track(approach.own_track, np.array([shift, shift]))))
        scenario = read(text)
    raise _refuse_miss(request, impact, least_off)


def _refuse_grazing(request: Request, impact: PlannedImpact, closing_speed: float, least: float) -> ScenarioError:
    return ScenarioError(
        f"{describe_impact(request, impact)}: there they close at {round(closing_speed, 2) + 0.0:.2f} m/s, at least "
        f"{least:.2f} m/s is needed; change the angle, the speeds, the side or the place"
    )


def _refuse_miss(request: Request, impact: PlannedImpact, off: float) -> ScenarioError:
    how = f"touch first {off:.2g} m off" if off < inf else "pass the place"
    return ScenarioError(
        f"{describe_impact(request, impact)}: their hulls lie along each other there and {how}, where {ACCEPTED:g} m "
        "is accepted; change the angle by a degree or two, or the place"
    )
