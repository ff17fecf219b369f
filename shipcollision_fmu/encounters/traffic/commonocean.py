"""Traffic from a CommonOcean scenario in XML.

    x, y              north = y, east = x, from own ship's start
    planningProblem   own ship: the file has no size of it; its waypoints and goal are its route
    dynamicObstacle   a target: size of its shape, trajectory as its route
    staticObstacle    a fixed obstacle, a buoy and an anchored vessel as well

Without a planning problem the first dynamic obstacle is own ship.
"""

from __future__ import annotations

from math import hypot

from ...errors import ScenarioError
from .commonocean_obstacles import build_obstacle_tables
from .commonocean_schema import CommonOcean, Obstacle, PlanningProblem, State, parse_commonocean
from .commonocean_shapes import Frame, read_position
from .commonocean_ships import read_size, read_start
from .traffic import LONGEST_DEFAULT, WIDEST, Traffic
from .unread import name_unread

__all__ = ["read_commonocean"]

USUAL_DURATION = 600.0
"""[s] Default duration where no trajectory and no goal ends."""


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
    origin = read_position(ships[0][1].initialState, ships[0][0], file)
    roles = _name_roles(len(ships))
    frame = Frame(origin, scenario.timeStepSize, file)
    starts = {role: read_start(name, ship, frame) for role, (name, ship) in zip(roles, ships, strict=True)}
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
        sizes={role: read_size(ship) for role, (_, ship) in zip(roles, ships, strict=True)},
        obstacles={
            name: table for o in scenario.staticObstacle for name, table in build_obstacle_tables(o, frame).items()
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
