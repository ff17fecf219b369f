"""Traffic from a CommonOcean scenario in XML.

    x, y                       north = y, east = x, from own ship's start
    orientation                heading = pi/2 - orientation
    velocity, velocityY        surge and -sway (to port) with an orientation; east and north without one
    yawRate                    r = -yawRate
    planningProblem            own ship: the file has no size of it; its waypoints and goal are its route
    dynamicObstacle            a target: size of its shape, trajectory as its route
    staticObstacle             a fixed obstacle, a buoy and an anchored vessel as well

Without a planning problem the first dynamic obstacle is own ship.
"""

from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, degrees, hypot, pi, sin
from typing import Any

from ...errors import ScenarioError
from .commonocean_schema import CommonOcean, Obstacle, PlanningProblem, Point, State, parse_commonocean
from .commonocean_shapes import find_box, find_middle, place_box, place_corners
from .thinning import thin_track
from .traffic import LONGEST_DEFAULT, WIDEST, ShipSize, Traffic, TrafficStart
from .unread import name_unread

__all__ = ["read_commonocean"]

USUAL_DURATION = 600.0
"""[s] Default duration where no trajectory and no goal ends."""
LATERAL = 2.0
"""[m] Distance from its trajectory within which a route is straightened; the autopilots keep no closer to it."""
SHORTEST = 50.0
"""[m] Least leg of a route; an autopilot cannot follow shorter ones."""


def read_commonocean(content: bytes, file: str) -> Traffic:
    """The traffic in a CommonOcean file with that content.

    Raises ScenarioError, in one line, for another file, and for ships or obstacles without place, size or course.
    """
    scenario = parse_commonocean(content, file)
    ships: list[tuple[str, Obstacle | PlanningProblem]] = [
        *((f"planningProblem {p.id}", p) for p in scenario.planningProblem[:1]),
        *((f"dynamicObstacle {o.id}", o) for o in scenario.dynamicObstacle),
    ]
    if len(ships) + len(scenario.staticObstacle) < 2 or not ships:
        raise ScenarioError(
            f"{file}: has {len(ships)} ship and {len(scenario.staticObstacle)} staticObstacle: a collision needs a "
            "planningProblem or dynamicObstacle, and another body to meet"
        )
    _check_ids(scenario, file)
    origin = _read_point(ships[0][1].initialState, ships[0][0], file)
    roles = _name_roles(len(ships))
    reader = _Reader(origin, scenario.timeStepSize, file)
    starts = {role: reader.read_start(name, ship) for role, (name, ship) in zip(roles, ships, strict=True)}
    for role, start in starts.items():
        if hypot(start.north, start.east) > WIDEST:
            raise ScenarioError(
                f"{file}: {role} is {hypot(start.north, start.east) / 1e3:.0f} km from own ship, at most "
                f"{WIDEST / 1e3:.0f}: check its position"
            )
    return Traffic(
        origin=f"CommonOcean {scenario.commonOceanVersion}",
        frame=f"n's origin is own ship's position in that file, x = {origin.x:g} m, y = {origin.y:g} m; north is y.",
        description=f"CommonOcean {scenario.benchmarkID}".strip(),
        duration=_find_end(scenario) or USUAL_DURATION,
        starts=starts,
        sizes={role: _read_size(ship) for role, (_, ship) in zip(roles, ships, strict=True)},
        obstacles={
            name: table for o in scenario.staticObstacle for name, table in reader.read_obstacle(o).items()
        },
        notes=tuple(_list_notes(scenario)),
    )  # fmt: skip


def _check_ids(scenario: CommonOcean, file: str) -> None:
    seen: dict[str, str] = {}
    for kind, bodies in (("staticObstacle", scenario.staticObstacle), ("dynamicObstacle", scenario.dynamicObstacle)):
        for body in bodies:
            if body.id in seen:
                raise ScenarioError(f"{file}: {kind} {body.id} has the id of a {seen[body.id]}: give each its own")
            seen[body.id] = kind


def _name_roles(count: int) -> list[str]:
    return ["own", *(["target"] if count == 2 else [f"target_{i}" for i in range(1, count)])]


def _find_end(scenario: CommonOcean) -> float:
    """Time [s] of the last state of a trajectory or of a goal, at most LONGEST_DEFAULT; zero where none ends."""
    times = [s.time for o in scenario.dynamicObstacle if o.trajectory is not None for s in o.trajectory.state]
    times += [goal.time for problem in scenario.planningProblem[:1] for goal in problem.goalState]
    steps = [t.exact if t.exact is not None else t.intervalEnd for t in times if t is not None]
    return min(LONGEST_DEFAULT, max((step for step in steps if step is not None), default=0.0) * scenario.timeStepSize)


def _list_notes(scenario: CommonOcean) -> list[str]:
    notes = []
    if len(scenario.planningProblem) > 1:
        notes.append(f"Not used: the planning problems after {scenario.planningProblem[0].id}, which is own ship.")
    if not scenario.planningProblem:
        notes.append(f"No planning problem: dynamicObstacle {scenario.dynamicObstacle[0].id} is own ship.")
    if any(o.depth is not None for o in scenario.dynamicObstacle):
        notes.append("The depth of dynamic obstacles is not used: draughts are estimated from the width.")
    states = [o.initialState for o in scenario.dynamicObstacle] + [p.initialState for p in scenario.planningProblem[:1]]
    if any(_has_interval(state) for state in states):
        notes.append("Intervals in initial states are replaced by their middles.")
    movable = sorted({o.type for o in scenario.staticObstacle if o.type in ("buoy", "anchoredvessel")})
    if movable:
        notes.append(f"Static obstacles are fixed, of type {' and '.join(movable)} as well.")
    return [*notes, *name_unread(scenario)]


def _has_interval(state: State) -> bool:
    values = (state.orientation, state.velocity, state.velocityY, state.yawRate)
    return any(value is not None and value.exact is None and value.middle is not None for value in values)


def _read_point(state: State, name: str, file: str) -> Point:
    """The position of a state: a point, or the middle of an area."""
    middle = None if state.position is None else find_middle(state.position)
    if middle is None:
        raise ScenarioError(f"{file}: {name} has no position in its initialState: give a point")
    return middle


def _read_size(ship: Obstacle | PlanningProblem) -> ShipSize:
    """Size of a ship: of its rectangle, or of the box about its polygon. A circle has no length."""
    if isinstance(ship, PlanningProblem):
        return ShipSize()
    _, length, width = find_box(ship.shape) or (None, None, None)
    return ShipSize(f"{ship.type} {ship.id}", ship.type, length or None, width or None)


class _Reader:
    """Turns states and shapes into n, with its origin at a point of the file. time_step [s]."""

    def __init__(self, origin: Point, time_step: float, file: str) -> None:
        self.origin = origin
        self.time_step = time_step
        self.file = file

    def place(self, point: Point) -> tuple[float, float]:
        """North and east [m]."""
        return point.y - self.origin.y, point.x - self.origin.x

    def read_start(self, name: str, ship: Obstacle | PlanningProblem) -> TrafficStart:
        state = ship.initialState
        at = _read_point(state, name, self.file)
        north, east = self.place(at)
        track = self._read_track(ship)
        heading, v_north, v_east = self._read_velocity(name, state, (0.0, north, east), track)
        if isinstance(ship, Obstacle):
            north, east = self.place(place_box(ship.shape, at, 0.5 * pi - heading))
        speed = hypot(v_north, v_east)
        course = atan2(v_east, v_north) if speed > 0.0 else heading
        route, speeds = self._plan_route((0.0, north, east), track, speed)
        yaw_rate = 0.0 if state.yawRate is None else -(state.yawRate.middle or 0.0)
        return TrafficStart(north, east, heading, course, speed, route, speeds, yaw_rate)

    def _read_track(self, ship: Obstacle | PlanningProblem) -> list[tuple[float | None, float, float]]:
        """Time [s], north and east [m] of the states to come; without time for a planning problem."""
        if isinstance(ship, PlanningProblem):
            places = [find_middle(s.position) for s in (*ship.waypoint, *ship.goalState[:1]) if s.position is not None]
            return [(None, *self.place(point)) for point in places if point is not None]
        states = [] if ship.trajectory is None else ship.trajectory.state
        found = ((s.time, None if s.position is None else find_middle(s.position)) for s in states)
        return [
            ((time.middle or 0.0) * self.time_step, *self.place(point))
            for time, point in found
            if time is not None and point is not None
        ]

    def _read_velocity(
        self, name: str, state: State, start: tuple[float, float, float],
        track: list[tuple[float | None, float, float]],
    ) -> tuple[float, float, float]:  # fmt: skip
        """Heading [rad], velocity north and east [m/s]."""
        u, v = (None if value is None else value.middle for value in (state.velocity, state.velocityY))
        orientation = None if state.orientation is None else state.orientation.middle
        if orientation is not None:
            heading = 0.5 * pi - orientation
            if u is None:
                u = self._find_first_speed(name, start, track)
            sway = -(v or 0.0)
            return heading, u * cos(heading) - sway * sin(heading), u * sin(heading) + sway * cos(heading)
        if u is None or v is None or hypot(u, v) == 0.0:
            raise ScenarioError(f"{self.file}: {name} has no orientation in its initialState: give it in radians")
        return atan2(u, v), v, u

    def _find_first_speed(
        self, name: str, start: tuple[float, float, float], track: list[tuple[float | None, float, float]]
    ) -> float:  # fmt: skip
        """Speed [m/s] on the way to the first state of the trajectory."""
        for time, north, east in track:
            if time is not None and time > 0.0:
                return hypot(north - start[1], east - start[2]) / time
        raise ScenarioError(f"{self.file}: {name} has no velocity in its initialState: give it in m/s")

    def _plan_route(
        self, start: tuple[float, float, float], track: list[tuple[float | None, float, float]], speed: float
    ) -> tuple[list[list[float]], list[float]]:  # fmt: skip
        """Waypoints to come, and the mean speed on the leg to each."""
        kept = thin_track([start[1:], *((north, east) for _, north, east in track)], LATERAL, SHORTEST)
        route: list[list[float]] = []
        speeds: list[float] = []
        before = 0
        for i in kept[1:]:
            time, north, east = track[i - 1]
            earlier = start if before == 0 else track[before - 1]
            if time is not None and earlier[0] is not None and time > earlier[0]:
                way = [(start, *track)[k] for k in range(before, i + 1)]
                length = sum(hypot(b[1] - a[1], b[2] - a[2]) for a, b in pairwise(way))
                speed = length / (time - earlier[0])
            route.append([round(north, 3) + 0.0, round(east, 3) + 0.0])
            speeds.append(speed)
            before = i
        return route, speeds

    def read_obstacle(self, obstacle: Obstacle) -> dict[str, dict[str, Any]]:
        """Tables [obstacles.NAME], one for each area of the shape."""
        name = f"staticObstacle {obstacle.id}"
        at = _read_point(obstacle.initialState, name, self.file)
        turn = obstacle.initialState.orientation
        psi = 0.0 if turn is None else turn.middle or 0.0
        rest = {"bottom": obstacle.foot}
        shape, tables = obstacle.shape, list[dict[str, Any]]()
        for rectangle in shape.rectangle:
            position = self.place(_add(rectangle.center, at))
            heading = round(90.0 - degrees(psi + rectangle.orientation), 6) % 360.0
            tables.append({"shape": "box", "length": rectangle.length, "breadth": rectangle.width,
                           "position": list(position), "heading_deg": heading})  # fmt: skip
        for circle in shape.circle:
            position = self.place(_add(circle.center, at))
            tables.append({"shape": "cylinder", "diameter": 2.0 * circle.radius, "position": list(position)})
        for polygon in shape.polygon:
            middle = self.place(at)
            corners = [self.place(point) for point in place_corners(polygon.point, at, psi)]
            points = [[round(n - middle[0], 6) + 0.0, round(e - middle[1], 6) + 0.0] for n, e in corners]
            tables.append({"shape": "polygon", "points": points, "position": list(middle)})
        if not tables:
            raise ScenarioError(f"{self.file}: {name} has no shape: give a rectangle, a circle or a polygon")
        label = _make_identifier(f"{obstacle.type}_{obstacle.id}")
        several = len(tables) > 1
        return {
            f"{label}_{i}" if several else label: {"kind": obstacle.type, **table, **rest}
            for i, table in enumerate(tables, start=1)
        }


def _add(a: Point, b: Point) -> Point:
    return Point(x=a.x + b.x, y=a.y + b.y)


def _make_identifier(text: str) -> str:
    return "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in text)
