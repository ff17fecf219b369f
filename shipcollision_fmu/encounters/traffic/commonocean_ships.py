"""Start and route of CommonOcean's ships.

orientation           heading = pi/2 - orientation
velocity, velocityY   surge and -sway (to port) with an orientation; east and north without one
yawRate               r = -yawRate
trajectory            its corners are the route; the mean speeds between them are planned
waypoint, goalState   the route of a planning problem
"""

from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, hypot, pi, sin

from ...errors import ScenarioError
from ...scenario.tracks.ship_size import ShipSize
from .commonocean_schema import Obstacle, PlanningProblem, State
from .commonocean_shapes import Frame, find_box, find_middle, place_box, read_position
from .thinning import thin_track
from .traffic import TrafficStart

__all__ = ["read_size", "read_start"]

LATERAL = 2.0
"""[m] Distance from its trajectory within which a route is straightened; the autopilots keep no closer to it."""
SHORTEST = 50.0
"""[m] Least leg of a route; an autopilot cannot follow shorter ones."""

Passage = tuple[float | None, float, float]
"""Time [s], None where it is free; north and east [m]."""


def read_size(ship: Obstacle | PlanningProblem) -> ShipSize:
    """Size of a ship: of its rectangle, or of the box about its polygon. A circle has no length."""
    if isinstance(ship, PlanningProblem):
        return ShipSize()
    _, length, width = find_box(ship.shape) or (None, None, None)
    return ShipSize(f"{ship.type} {ship.id}", ship.type, length or None, width or None)


def read_start(name: str, ship: Obstacle | PlanningProblem, frame: Frame) -> TrafficStart:
    """The start of a ship and its route; `name` names it in messages.

    Raises ScenarioError for a ship without position, course or speed.
    """
    state = ship.initialState
    at = read_position(state, name, frame.file)
    north, east = frame.place(at)
    track = _read_track(ship, frame)
    heading, v_north, v_east = _read_velocity(name, state, (0.0, north, east), track, frame.file)
    if isinstance(ship, Obstacle):
        north, east = frame.place(place_box(ship.shape, at, 0.5 * pi - heading))
    speed = hypot(v_north, v_east)
    course = atan2(v_east, v_north) if speed > 0.0 else heading
    route, speeds = _plan_route((0.0, north, east), track, speed)
    yaw_rate = 0.0 if state.yawRate is None else -(state.yawRate.middle or 0.0)
    return TrafficStart(north, east, heading, course, speed, route, speeds, yaw_rate)


def _read_track(ship: Obstacle | PlanningProblem, frame: Frame) -> list[Passage]:
    """Time [s], north and east [m] of the states to come; without time for a planning problem."""
    if isinstance(ship, PlanningProblem):
        places = [find_middle(s.position) for s in (*ship.waypoint, *ship.goalState[:1]) if s.position is not None]
        return [(None, *frame.place(point)) for point in places if point is not None]
    states = [] if ship.trajectory is None else ship.trajectory.state
    found = ((s.time, None if s.position is None else find_middle(s.position)) for s in states)
    return [
        ((time.middle or 0.0) * frame.time_step, *frame.place(point))
        for time, point in found
        if time is not None and point is not None
    ]


def _read_velocity(
    name: str, state: State, start: Passage, track: list[Passage], file: str
) -> tuple[float, float, float]:
    """Heading [rad], velocity north and east [m/s]."""
    u, v = (None if value is None else value.middle for value in (state.velocity, state.velocityY))
    orientation = None if state.orientation is None else state.orientation.middle
    if orientation is not None:
        heading = 0.5 * pi - orientation
        if u is None:
            u = _find_first_speed(name, start, track, file)
        sway = -(v or 0.0)
        return heading, u * cos(heading) - sway * sin(heading), u * sin(heading) + sway * cos(heading)
    if u is None or v is None or hypot(u, v) == 0.0:
        raise ScenarioError(f"{file}: {name} has no orientation in its initialState: give it in radians")
    return atan2(u, v), v, u


def _find_first_speed(name: str, start: Passage, track: list[Passage], file: str) -> float:
    """Speed [m/s] on the way to the first state of the trajectory."""
    for time, north, east in track:
        if time is not None and time > 0.0:
            return hypot(north - start[1], east - start[2]) / time
    raise ScenarioError(f"{file}: {name} has no velocity in its initialState: give it in m/s")


def _plan_route(start: Passage, track: list[Passage], speed: float) -> tuple[list[list[float]], list[float]]:
    """Waypoints to come, and the mean speed on the leg to each."""
    passages = [start, *track]
    kept = thin_track([(north, east) for _, north, east in passages], LATERAL, SHORTEST)
    route: list[list[float]] = []
    speeds: list[float] = []
    for before, i in pairwise(kept):
        earlier, (time, north, east) = passages[before][0], passages[i]
        if time is not None and earlier is not None and time > earlier:
            way = pairwise(passages[before : i + 1])
            speed = sum(hypot(b[1] - a[1], b[2] - a[2]) for a, b in way) / (time - earlier)
        route.append([round(north, 3) + 0.0, round(east, 3) + 0.0])
        speeds.append(speed)
    return route, speeds
