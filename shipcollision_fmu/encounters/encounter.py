"""Encounters that do collide, made backwards from the impact that is wanted.

    request             what can be asked for: type, angle, place, speeds, what comes before
    plan_contact        at the impact: the struck ship "target" with a heading, on her section the place; "own" with
                        her bow to it, her heading turned by the angle
    approach_track      before it: coasting ships come in a straight line, ships under way are sailed with the model
    targeting           the collision model is given the last steps; what it finds beside the place is corrected
    check               the hulls close there, and touch nowhere before

The result is a scenario file like any other. What cannot meet is refused.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, replace
from math import cos, degrees, hypot, inf, radians, sin
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ScenarioError
from ..scenario.scenario import Scenario, scenario_of
from ..ship.hull.hull import build_hull
from ..ship.loading.library import load_ship
from .approach_track import Mover, as_run, nearer, relative_velocity, steered, track, under_way
from .encounter_file import Coming, Impact, encounter_text
from .plan_contact import common_deck, place, section, touches
from .request import Kind, Wanted, asked_for, checked, either, whole_steps
from .targeting import BEST, Range, aimed, check_nothing_before

__all__ = ["Encounter", "encounter"]

SLOWEST_CLOSING = 0.05
"""[m/s] along the normal: slower, and the hulls lie against each other rather than collide."""
GRAZING = 0.03
"""Of the relative speed along the normal: less, within 1.7 deg of the hull's side, and no place can be foretold."""
PROMISED = 0.45
"""[m] from the place, of the half metre that is promised."""
HAIR = 1e-5
"""[m] A start written in the file differs from the next by so much."""
HAIRS = 20


@dataclass(frozen=True)
class Encounter:
    """A generated encounter: the file's text, the scenario, and what it leads to.

    point: the place on the target, (x, y) in her b [m]; normal there, outwards, (2,) in her b; angle between the
    headings [rad]; time of the impact [s]; closing speed along the normal [m/s].
    """

    text: str
    scenario: Scenario
    point: tuple[float, float]
    normal: tuple[float, float]
    angle: float
    time: float
    closing_speed: float


def encounter(wanted: Wanted | str, directory: str | Path = ".", **options: Any) -> Encounter:
    """The encounter that leads to the impact that is wanted, as a scenario file for `directory`.

    `wanted`: a Wanted, or the type's name with its options: encounter("t-bone", own="kcs", own_speed=4.0).
    Raises ScenarioError, in one line, for what cannot be or cannot meet, ShipError for ships that cannot be had.
    """
    if isinstance(wanted, str):
        wanted = asked_for(wanted, options)
    elif options:
        wanted = replace(wanted, **options)
    kind = checked(wanted)
    steps = whole_steps(either(wanted.time, max(60.0, either(wanted.before, kind.before) + 30.0)), wanted.step)
    sailed = kind.sailed if wanted.hydrodynamics is None else wanted.hydrodynamics
    impact = _impact(wanted, kind)
    current, own, target = _movers(wanted, kind, sailed, steps)
    with closing(Range(own, target, steps, wanted.step)) as range_:
        coming = _coming(wanted, impact, own, target, current, steps, range_)
        check_nothing_before(coming.own_track, coming.target_track, impact.sections, impact.deck, steps, wanted.step)
        text, scenario = _as_recorded(
            lambda to: encounter_text(wanted, kind, impact, steps, current, to, sailed, Path(directory)),
            lambda text: scenario_of(text, f"encounter {wanted.kind}", directory),
            wanted, impact, coming, steps, range_,
        )  # fmt: skip
    return Encounter(
        text=text,
        scenario=scenario,
        point=(float(impact.at.point[0]), float(impact.at.point[1])),
        normal=(float(coming.contact.normals[0][0]), float(coming.contact.normals[0][1])),
        angle=abs(impact.heading),
        time=steps * wanted.step,
        closing_speed=coming.closing_speed,
    )


def _impact(wanted: Wanted, kind: Kind) -> Impact:
    ships = {"own": load_ship(wanted.own), "target": load_ship(wanted.target)}
    hulls = {name: build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for name, ship in ships.items()}
    deck = common_deck(hulls["own"], hulls["target"])
    sections = {name: section(hull, deck) for name, hull in hulls.items()}
    s, angle = either(wanted.at, kind.at), radians(either(wanted.angle_deg, kind.angle_deg))
    struck = place(sections["target"], ships["target"].hull.trim_x + s * ships["target"].L_oa, wanted.side)
    return Impact(struck, s, -angle if wanted.side == "starboard" else angle, sections, deck, ships)


def _movers(wanted: Wanted, kind: Kind, sailed: bool, steps: int) -> tuple[tuple[float, float], Mover, Mover]:
    """Current [m/s, north and east], own and target."""
    own_speed, target_speed = either(wanted.own_speed, kind.own_speed), either(wanted.target_speed, kind.target_speed)
    drift, towards = either(wanted.drift_speed, kind.drift_speed), radians(wanted.drift_deg)
    free = wanted.degrees_of_freedom or 3
    if not sailed:
        return (
            (0.0, 0.0),
            Mover(wanted.own, own_speed, 0.0, None, free),
            Mover(wanted.target, target_speed + drift * cos(towards), drift * sin(towards), None, free),
        )
    set_ = radians(wanted.heading_deg) + towards
    current = (round(drift * cos(set_), 9), round(drift * sin(set_), 9))  # a ship without way goes where the water goes
    own, target = under_way(wanted.own, own_speed, free), under_way(wanted.target, target_speed, free)
    if kind.helm:
        begin = steps - round(either(wanted.before, kind.before) / wanted.step)
        rudder_deg = either(wanted.rudder_deg, kind.rudder_deg)
        own = Mover(own.file, own.surge, own.sway, steered(own.orders or (), max(0, begin), rudder_deg), free)
    return current, own, target


def _coming(
    wanted: Wanted, impact: Impact, own: Mover, target: Mover, current: tuple[float, float], steps: int, range_: Range
) -> Coming:  # fmt: skip
    """The tracks that end at the impact, which is at n's origin."""
    psi, h, at = radians(wanted.heading_deg), wanted.step, impact.at
    R = np.array([[cos(psi), -sin(psi)], [sin(psi), cos(psi)]])
    target_track = track(target, -R @ at.point, psi, current, steps, h)
    ways = touches(at, impact.sections["own"], impact.heading)
    own_track = track(own, R @ (ways[0].position - at.point), psi + impact.heading, current, steps, h)
    least_off = inf
    for i, contact in enumerate(ways):
        shifted = nearer(own_track, R @ (contact.position - ways[0].position))
        velocity = relative_velocity(shifted[steps], target_track[steps])
        speeds = [float(-velocity @ (R @ normal)) for normal in contact.normals]
        least = max(SLOWEST_CLOSING, GRAZING * float(np.linalg.norm(velocity)))
        if min(speeds) < least:
            if i == 0:
                raise _grazing(wanted, impact, min(speeds), least)
            continue
        aimed_track, off = aimed(range_, shifted, target_track, at.point, contact.normals[0], speeds[0], steps, h)
        if off <= BEST:
            return Coming(own, target, aimed_track, target_track, contact, speeds[0])
        least_off = min(least_off, off)
    raise _beside(wanted, impact, least_off)


def _as_recorded(
    text_of: Callable[[Coming], str], scenario_of_text: Callable[[str], Scenario], wanted: Wanted, impact: Impact,
    coming: Coming, steps: int, range_: Range,
) -> tuple[str, Scenario]:  # fmt: skip
    """The file, and that it leads to the place when it is run, to the bit.

    Of starts within a hair of each other, which all lead to the same line of contact, the first is taken from which
    the first contact is found near enough to the middle.
    """
    text = text_of(coming)
    scenario = scenario_of_text(text)
    target, off, least_off = as_run(scenario, "target", steps), inf, inf
    for attempt in range(HAIRS):
        found = range_.found(as_run(scenario, "own", steps), target)
        off = inf if found is None else hypot(*(impact.at.point - found.point))
        if off <= PROMISED:
            return text, scenario
        least_off = min(least_off, off)
        by = (attempt // 2 + 1) * (-1) ** attempt * HAIR
        text = text_of(coming._replace(own_track=nearer(coming.own_track, np.array([by, by]))))
        scenario = scenario_of_text(text)
    raise _beside(wanted, impact, least_off)


def _grazing(wanted: Wanted, impact: Impact, closing_speed: float, least: float) -> ScenarioError:
    return ScenarioError(
        f"{_where(wanted, impact)}: there they close at {closing_speed + 0.0:.2f} m/s, at least {least:.2f} is "
        "needed; change the angle, the speeds, the side or the place"
    )


def _beside(wanted: Wanted, impact: Impact, off: float) -> ScenarioError:
    how = f"touch first {off:.2g} m off" if off < inf else "pass the place"
    return ScenarioError(
        f"{_where(wanted, impact)}: their hulls lie along each other there and {how}, where {BEST:g} m is accepted; "
        "change the angle by a degree or two, or the place"
    )


def _where(wanted: Wanted, impact: Impact) -> str:
    where = f"s = {impact.s:g} of her" + (" end" if abs(impact.s) == 0.5 else f" {wanted.side} side")
    own, target = (impact.ships[role].name for role in ("own", "target"))
    return f"encounter {wanted.kind}: at {degrees(abs(impact.heading)):g} deg {own} does not meet {target} at {where}"
