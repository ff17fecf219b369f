"""Encounters that do collide, made backwards from the impact that is wanted.

    at the impact    the struck ship "target" at n's origin with a heading; on her section a place: s of her length from
                     amidships, on a side; "own" with her bow to it, her heading turned by the angle
    before it        coasting ships come in a straight line; ships under way are sailed forwards with the model itself,
                     then their track is turned and shifted so that it ends at the impact (with a current, which does
                     not turn, the start is improved until it does)
    check            the hulls close there, and touch nowhere before

The angle is that between the headings, 0 overtaking, 180 head-on; own comes from the side that is named. s = 0.5 and
s = -0.5 are the middle of the stem and of the stern.
Speeds are those of the approach, through the water; a ship that turns is slower at the impact.

The result is a scenario file like any other. What cannot meet is refused.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, cos, degrees, hypot, isfinite, radians, sin
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..errors import ScenarioError
from ..manoeuvring.model import ShipManoeuvring
from ..ship.frames import Array
from ..ship.hull import build_hull
from ..ship.library import load_ship
from ..ship.refusal import suggestion
from ..ship.ship import Ship
from .scenario import Scenario, scenario_of
from .scenario_text import scenario_text
from .touching import Side, common_deck, gap, moved, place, section, touch
from .trials import self_propulsion

__all__ = ["FASTEST", "KINDS", "Encounter", "Wanted", "encounter", "ship_reference", "wanted", "whole_steps"]

SLOWEST_CLOSING = 0.05
"""[m/s] along the normal: slower, and the hulls lie against each other rather than collide."""
GRAZING = 0.03
"""Of the relative speed along the normal: less, within 1.7 deg of the hull's side, and no place can be foretold."""
OVERLAP = 0.012
"""[m] of the sections at the wanted time: about what detection lets pass, so that it finds the contact then."""
HALF_A_SUBSTEP = 0.005
"""[s] by which the hulls touch before the wanted time for the same reason; of the collision model's usual substep."""
DEEPEST = 0.03
"""[m] of overlap before the impact that is not yet another contact."""
FASTEST = 50.0
"""[m/s] A higher speed is one in another unit."""
LONGEST = 7200.0
"""[s] before and after the impact."""


@dataclass(frozen=True)
class Kind:
    """A type of encounter: what it is, and what holds where the user says nothing."""

    words: str
    angle_deg: float
    at: float
    own_speed: float
    target_speed: float
    sailed: bool = False  # needs hydrodynamics
    helm: str = ""  # what own's rudder does before the impact
    before: float = 0.0
    rudder_deg: float = 0.0
    drift_speed: float = 0.0


KINDS: dict[str, Kind] = {
    "head-on": Kind("meets target stem to stem", 180.0, 0.5, 5.0, 5.0),
    "crossing": Kind("crosses target's course and strikes her side", 90.0, 0.0, 5.0, 5.0),
    "overtaking": Kind("overtakes target and strikes her stern", 0.0, -0.5, 7.0, 3.0),
    "glancing": Kind("strikes target's side at a small angle", 20.0, 0.1, 6.0, 5.0),
    "t-bone": Kind("strikes the side of target, who lies stopped", 90.0, 0.0, 5.0, 0.0),
    "drifting-target": Kind("strikes target, who drifts across", 90.0, 0.0, 5.0, 0.0, drift_speed=1.0),
    "late-evasive": Kind(
        "puts her rudder over too late and strikes target", 70.0, 0.0, 6.0, 5.0, True, "evades", 40.0, 35.0
    ),
    "loss-of-steering": Kind(
        "strikes target after her rudder has jammed", 60.0, 0.0, 6.0, 4.0, True, "jams", 90.0, 15.0
    ),
}


@dataclass(frozen=True)
class Wanted:
    """The impact that is wanted, and what comes before it; None stands for what is usual for the kind.

    own, target        ships: a name or a path            angle_deg      between the headings, 0 to 180
    at                 place s on the target, -0.5 to 0.5 (stern to stem)       side      of the target that is struck
    own_speed, target_speed   [m/s]                       heading_deg    of the target at the impact
    time, after        from the start to the impact, and from it to the end [s]
    hydrodynamics      both ships under way with the manoeuvring model; None: if the kind needs it
    before, rudder_deg own's rudder order: how long before the impact [s], positive to starboard (late-evasive,
                       loss-of-steering)
    drift_speed, drift_deg    of a drifting target [m/s], and where to, from her bow clockwise
    """

    kind: str
    own: str = "kvlcc2"
    target: str = "kvlcc2"
    angle_deg: float | None = None
    at: float | None = None
    side: Side = "starboard"
    own_speed: float | None = None
    target_speed: float | None = None
    heading_deg: float = 0.0
    time: float | None = None
    after: float = 60.0
    step: float = 0.05
    hydrodynamics: bool | None = None
    before: float | None = None
    rudder_deg: float | None = None
    drift_speed: float | None = None
    drift_deg: float = 90.0
    name: str | None = None


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


class _Order(NamedTuple):
    """From a communication point on: rudder [deg], revolutions [1/s]."""

    k: int
    rudder_deg: float
    rev_per_s: float


@dataclass(frozen=True)
class _Mover:
    """How a ship comes to the impact: speed ahead and to starboard through the water, orders None when she coasts."""

    file: str
    surge: float
    sway: float
    orders: tuple[_Order, ...] | None


class _Pose(NamedTuple):
    """CO in n [m], heading [rad], velocity over ground in b [m/s], r [rad/s]."""

    north: float
    east: float
    heading: float
    surge: float
    sway: float
    yaw_rate: float


def wanted(kind: str, options: Mapping[str, Any]) -> Wanted:
    """From options by name, of which None stands for one that is not given."""
    return Wanted(kind, **{name: value for name, value in options.items() if value is not None})


def encounter(wanted: Wanted, directory: str | Path = ".") -> Encounter:
    """The encounter that leads to the impact that is wanted, as a scenario file for `directory`.

    Raises ScenarioError, in one line, for what cannot be or cannot meet, ShipError for ships that cannot be had.
    """
    kind = _kind(wanted)
    time = _either(wanted.time, max(60.0, _either(wanted.before, kind.before) + 30.0))
    steps = whole_steps(time, wanted.step)
    own_file, target_file = wanted.own, wanted.target
    ships = {"own": load_ship(own_file), "target": load_ship(target_file)}
    sailed = kind.sailed if wanted.hydrodynamics is None else wanted.hydrodynamics
    current, own, target = _movers(wanted, kind, sailed, steps)

    # The impact: target's CO at the origin for now.
    hulls = {name: build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for name, ship in ships.items()}
    deck = common_deck(hulls["own"], hulls["target"])
    sections = {name: section(hull, deck) for name, hull in hulls.items()}
    s, angle = _either(wanted.at, kind.at), radians(_either(wanted.angle_deg, kind.angle_deg))
    struck = place(sections["target"], ships["target"].hull.trim_x + s * ships["target"].L_oa, wanted.side)
    relative = -angle if wanted.side == "starboard" else angle
    contact = touch(struck, sections["own"], relative)
    psi_target = radians(wanted.heading_deg)
    R = np.array([[cos(psi_target), -sin(psi_target)], [sin(psi_target), cos(psi_target)]])

    # Backwards from it, with the contact at the origin.
    at_target, at_own = -R @ struck.point, R @ (contact.position - struck.point)
    target_track = _track(target, at_target, psi_target, current, steps, wanted.step)
    own_track = _track(own, at_own, psi_target + relative, current, steps, wanted.step)
    velocity = _relative_velocity(own_track[-1], target_track[-1])
    closing = [float(-velocity @ (R @ normal)) for normal in contact.normals]
    _check_they_meet(wanted, s, angle, min(closing), float(np.linalg.norm(velocity)), ships)
    own_track = _nearer(own_track, -R @ contact.normals[0] * (OVERLAP + HALF_A_SUBSTEP * closing[0]))
    _check_nothing_before(own_track, target_track, sections, wanted.step)

    starts = {"own": (own, own_track[0]), "target": (target, target_track[0])}
    text = _text(wanted, kind, s, angle, steps, current, starts, closing[0], sailed, Path(directory))
    return Encounter(
        text=text,
        scenario=scenario_of(text, f"encounter {wanted.kind}", directory),
        point=(float(struck.point[0]), float(struck.point[1])),
        normal=(float(contact.normals[0][0]), float(contact.normals[0][1])),
        angle=angle,
        time=steps * wanted.step,
        closing_speed=closing[0],
    )


def ship_reference(ship: str, directory: Path) -> str:
    """How a scenario file in `directory` names a ship: a shipped name as it is, a path relative to the file."""
    if ship.endswith(".toml") or "/" in ship or "\\" in ship:
        return Path(os.path.relpath(Path(ship).resolve(), directory.resolve())).as_posix()
    return ship


def _kind(wanted: Wanted) -> Kind:
    """The kind with its defaults; refuses what no encounter can have."""
    if wanted.kind not in KINDS:
        raise ScenarioError(
            f"unknown encounter {wanted.kind!r}:{suggestion(wanted.kind, list(KINDS))} known: {', '.join(KINDS)}"
        )
    kind = KINDS[wanted.kind]
    limits: list[tuple[str, float | None, float, float, str]] = [
        ("angle_deg", wanted.angle_deg, 0.0, 180.0, "0 is overtaking, 180 head-on; the side is chosen with --side"),
        ("at", wanted.at, -0.5, 0.5, "-0.5 is the target's stern, 0.5 her stem"),
        ("own_speed", wanted.own_speed, 0.0, FASTEST, "give metres per second"),
        ("target_speed", wanted.target_speed, 0.0, FASTEST, "give metres per second"),
        ("heading_deg", wanted.heading_deg, -360.0, 720.0, "clockwise from north"),
        ("time", wanted.time, wanted.step, LONGEST, "give seconds from the start to the impact"),
        ("after", wanted.after, wanted.step, LONGEST, "give seconds from the impact to the end"),
        ("step", wanted.step, 1e-3, 10.0, "give the communication step in seconds"),
        (
            "before",
            wanted.before,
            0.0,
            LONGEST if wanted.time is None else wanted.time,
            "it is within the time to the impact",
        ),
        ("rudder_deg", wanted.rudder_deg, -90.0, 90.0, "positive is to starboard"),
        ("drift_speed", wanted.drift_speed, 0.0, FASTEST, "give metres per second"),
        ("drift_deg", wanted.drift_deg, -360.0, 360.0, "from the target's bow clockwise"),
    ]
    for name, value, least, most, remedy in limits:
        if value is not None and not (isfinite(value) and least <= value <= most):
            raise ScenarioError(f"encounter {wanted.kind}: {name} = {value:g} must be {least:g} to {most:g}: {remedy}")
    if wanted.side not in ("port", "starboard"):
        raise ScenarioError(f"encounter {wanted.kind}: side = {wanted.side!r} must be port or starboard")
    for name, value, has in (
        ("before", wanted.before, kind.helm), ("rudder_deg", wanted.rudder_deg, kind.helm),
        ("drift_speed", wanted.drift_speed, kind.drift_speed),
    ):  # fmt: skip
        if value is not None and not has:
            raise ScenarioError(f"encounter {wanted.kind} has no {name}: leave it out, or take another type")
    if kind.sailed and wanted.hydrodynamics is False:
        raise ScenarioError(
            f"encounter {wanted.kind} needs ships that steer: leave out --coasting, or take another type"
        )
    if kind.drift_speed and wanted.target_speed:
        raise ScenarioError(f"encounter {wanted.kind}: the target drifts: give drift_speed, not target_speed")
    return kind


def _movers(wanted: Wanted, kind: Kind, sailed: bool, steps: int) -> tuple[tuple[float, float], _Mover, _Mover]:
    """Current [m/s, north and east], own and target."""
    own_speed, target_speed = _either(wanted.own_speed, kind.own_speed), _either(wanted.target_speed, kind.target_speed)
    drift, towards = _either(wanted.drift_speed, kind.drift_speed), radians(wanted.drift_deg)
    if not sailed:
        return (
            (0.0, 0.0),
            _Mover(wanted.own, own_speed, 0.0, None),
            _Mover(wanted.target, target_speed + drift * cos(towards), drift * sin(towards), None),
        )
    set_ = radians(wanted.heading_deg) + towards
    current = (round(drift * cos(set_), 9), round(drift * sin(set_), 9))  # a ship without way goes where the water goes
    own, target = _under_way(wanted.own, own_speed), _under_way(wanted.target, target_speed)
    if kind.helm:
        begin = steps - round(_either(wanted.before, kind.before) / wanted.step)
        rudder_deg = _either(wanted.rudder_deg, kind.rudder_deg)
        own = _Mover(own.file, own.surge, own.sway, _steered(own.orders or (), max(0, begin), rudder_deg))
    return current, own, target


def _under_way(ship: str, speed: float) -> _Mover:
    if load_ship(ship).manoeuvring is None:
        raise ScenarioError(f"ship {ship!r} can only coast, she has no [manoeuvring]: take --coasting, or another ship")
    return _Mover(ship, speed, 0.0, (_Order(0, 0.0, self_propulsion(ship, speed) if speed > 0.0 else 0.0),))


def _steered(orders: tuple[_Order, ...], k: int, rudder_deg: float) -> tuple[_Order, ...]:
    first = orders[0]
    if k == 0:
        return (_Order(0, rudder_deg, first.rev_per_s),)
    return (first, _Order(k, rudder_deg, first.rev_per_s))


def _track(
    mover: _Mover, end: Array, heading: float, current: tuple[float, float], steps: int, h: float
) -> list[_Pose]:
    """Poses at every communication point of a ship that ends at a pose."""
    if mover.orders is None:
        c, s = cos(heading), sin(heading)
        north, east = mover.surge * c - mover.sway * s, mover.surge * s + mover.sway * c
        times = [(k - steps) * h for k in range(steps + 1)]
        return [_Pose(end[0] + north * t, end[1] + east * t, heading, mover.surge, mover.sway, 0.0) for t in times]
    start = heading
    for _ in range(50):
        track = _sailed(mover, start, current, steps, h)
        error = heading - track[-1].heading
        if not any(current):  # water at rest is the same in every direction
            return _placed(_turned(track, error), end)
        if abs(error) < 1e-10:
            return _placed(track, end)
        start += error
    raise ScenarioError(
        f"ship {mover.file!r} does not come to {degrees(heading):.1f} deg in this current: take less drift"
    )


def _sailed(mover: _Mover, heading: float, current: tuple[float, float], steps: int, h: float) -> list[_Pose]:
    """The model's own track from n's origin, step by step as a run will make it."""
    model, (north, east) = ShipManoeuvring(), current
    parameters = model.parameters
    parameters.ship, parameters.degrees_of_freedom, parameters.hydrodynamics = mover.file, 3, True
    parameters.initial_attitude[2] = heading
    c, s = cos(heading), sin(heading)
    parameters.initial_velocity[:] = [mover.surge + north * c + east * s, mover.sway - north * s + east * c, 0.0]
    model.inputs.current[:] = [north, east]
    orders = {order.k: order for order in mover.orders or ()}
    model.inputs.orders[:] = [radians(orders[0].rudder_deg), orders[0].rev_per_s]
    model.initialise()
    o, track = model.outputs, []
    for k in range(steps + 1):
        track.append(_Pose(o.position[0], o.position[1], o.attitude[2], o.velocity[0], o.velocity[1], o.rate[2]))
        if k in orders:
            model.inputs.orders[:] = [radians(orders[k].rudder_deg), orders[k].rev_per_s]
        if k < steps:
            model.step(k * h, h)
    return track


def _turned(track: list[_Pose], by: float) -> list[_Pose]:
    c, s = cos(by), sin(by)
    return [
        p._replace(north=p.north * c - p.east * s, east=p.north * s + p.east * c, heading=p.heading + by) for p in track
    ]


def _placed(track: list[_Pose], end: Array) -> list[_Pose]:
    """Shifted so that it ends there."""
    north, east = end[0] - track[-1].north, end[1] - track[-1].east
    return [p._replace(north=p.north + north, east=p.east + east) for p in track]


def _nearer(track: list[_Pose], by: Array) -> list[_Pose]:
    return [p._replace(north=p.north + by[0], east=p.east + by[1]) for p in track]


def _relative_velocity(own: _Pose, target: _Pose) -> Array:
    """Of own relative to the target at n's origin, where they touch [m/s]; (2,) in n."""
    velocities = []
    for pose in (own, target):
        c, s = cos(pose.heading), sin(pose.heading)
        north = pose.surge * c - pose.sway * s + pose.yaw_rate * pose.east  # omega x (origin - CO)
        east = pose.surge * s + pose.sway * c - pose.yaw_rate * pose.north
        velocities.append(np.array([north, east]))
    relative: Array = velocities[0] - velocities[1]
    return relative


def _check_they_meet(
    wanted: Wanted, s: float, angle: float, closing: float, speed: float, ships: dict[str, Ship]
) -> None:
    least = max(SLOWEST_CLOSING, GRAZING * speed)
    if closing < least:
        where = f"s = {s:g} of her" + (" end" if abs(s) == 0.5 else f" {wanted.side} side")
        own, target = (ships[role].name for role in ("own", "target"))
        raise ScenarioError(
            f"encounter {wanted.kind}: at {degrees(angle):g} deg {own} does not meet {target} "
            f"at {where}: there they close at {closing + 0.0:.2f} m/s, at least {least:.2f} is needed; change "
            "the angle, the speeds, the side or the place"
        )


def _check_nothing_before(own: list[_Pose], target: list[_Pose], sections: dict[str, Array], h: float) -> None:
    """They must be apart at the start, and until the impact. Far apart, steps are taken as wide as that allows."""
    k, last = 0, len(own) - 1
    reach = sum(float(np.hypot(*polygon.T).max()) for polygon in sections.values())
    while k < last:
        (a, b), apart = (own[k], target[k]), 0.0
        apart = hypot(a.north - b.north, a.east - b.east) - reach
        if apart <= 0.0:
            polygons = [
                moved(sections[name], np.array([pose.north, pose.east]), pose.heading)
                for name, pose in (("own", a), ("target", b))
            ]
            apart = gap(*polygons)
            if apart < -DEEPEST and (last - k) * h > 2.0 * HALF_A_SUBSTEP + h:
                raise ScenarioError(
                    f"the ships touch elsewhere {(last - k) * h:.1f} s before the impact that is wanted: change the "
                    "angle, the place, the speeds or the rudder, or shorten the time before it"
                )
        k += max(1, int(apart / (4.0 * FASTEST * h)))


def _text(
    wanted: Wanted, kind: Kind, s: float, angle: float, steps: int, current: tuple[float, float],
    starts: dict[str, tuple[_Mover, _Pose]], closing: float, sailed: bool, directory: Path,
) -> str:  # fmt: skip
    T, end = steps * wanted.step, (steps + whole_steps(wanted.after, wanted.step)) * wanted.step
    where = "at her stem" if s == 0.5 else "at her stern" if s == -0.5 else f"on her {wanted.side} side, s = {s:g}"
    comment = [
        f"Made by `shipcollision encounter {wanted.kind}`, backwards from the impact.",
        *_sentence(kind, wanted).splitlines(),
        f"Impact wanted: at {T:g} s at n's origin, {where}, {degrees(angle):g} deg between the headings,",
        f"closing at {closing:.3g} m/s along the normal of the target's hull.",
    ]
    name = wanted.name or f"{wanted.kind}-{degrees(angle):g}".replace("-", "_").replace(".", "_")
    tables: dict[str, dict[str, Any]] = {
        "scenario": {
            "name": name,
            "description": f"own {kind.words}: {degrees(angle):g} deg, {where}.",
            "duration": round(end, 9),
            "step": wanted.step,
        }
    }
    for role, (mover, pose) in starts.items():
        straight = mover.orders is None and mover.sway == 0.0
        tables[f"ships.{role}"] = {
            "ship": ship_reference(mover.file, directory),
            "position": [_rounded(pose.north, 5), _rounded(pose.east, 5)],
            "heading_deg": _rounded(degrees(pose.heading), 7) % 360.0,
            "speed": _speed(pose.surge) if straight or _is_small(pose.sway) else None,
            "surge": None if straight or _is_small(pose.sway) else _speed(pose.surge),
            "sway": None if straight or _is_small(pose.sway) else _speed(pose.sway),
            "hydrodynamics": sailed or None,
            "degrees_of_freedom": 3 if sailed else None,  # as the track was sailed
            "orders": [
                {"time": round(order.k * wanted.step, 9), "rudder_deg": order.rudder_deg, "rev_per_s": order.rev_per_s}
                for order in mover.orders
            ]
            if mover.orders is not None
            else None,
        }
    tables["collision"] = {"friction": 0.3, "restitution": 0.0}
    if any(current):
        tables["environment"] = {"current": [*current]}
    return scenario_text(comment, tables)


def _sentence(kind: Kind, wanted: Wanted) -> str:
    helm = ""
    if kind.helm:
        before, rudder = _either(wanted.before, kind.before), _either(wanted.rudder_deg, kind.rudder_deg)
        helm = f"\nHer rudder is ordered to {rudder:g} deg {before:g} s before the impact."
    return f"Own {kind.words}.{helm}"


def _is_small(speed: float) -> bool:
    return abs(speed) < 1e-12


def _speed(speed: float) -> float:
    return _rounded(speed, 9)


def _rounded(value: float, digits: int) -> float:
    return round(float(value), digits) + 0.0  # no -0.0


def _either(given: float | None, usual: float) -> float:
    return usual if given is None else float(given)


def whole_steps(time: float, step: float) -> int:
    """Communication steps that last at least a time [s]."""
    return max(1, ceil(time / step - 1e-9))
