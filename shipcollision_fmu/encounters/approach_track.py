"""Tracks to an impact: pose and velocity of a ship at every communication point, ending at a given place and heading.

A coasting ship moves in a straight line: ahead, or by coasting = "straight". A sailed ship is stepped forwards with the
manoeuvring model, in the current and the wind of the encounter. Its track is then turned and shifted so that it ends
where required. Current and wind do not turn with the track: with them the heading at the start is corrected until the
heading at the end is right. Both are uniform, so that a track may be shifted.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, degrees, radians, sin

import numpy as np

from ..errors import ScenarioError
from ..manoeuvring.model import ShipManoeuvring
from ..scenario.order_schedule import schedule_orders
from ..scenario.scenario import Scenario
from ..scenario.tables.environment import Environment
from ..ship.frames import Array
from ..ship.ship_state import ShipState
from .approaching_ship import ApproachingShip

__all__ = ["POINTS_AFTER", "compute_relative_velocity", "make_track", "sail_as_in_run", "shift_track"]

POINTS_AFTER = 2
"""Communication points of a track after the impact, computed as if there were no contact. With fewer, an impact that
the collision model finds one step late would be missed."""
HEADING_TOLERANCE = 1e-10
"""[rad] Error of the heading at the impact in current and wind; a file rounds headings to 2e-9 rad."""
HEADING_CORRECTIONS = 50
"""Corrections of the heading at the start in current and wind, after which the encounter is refused."""

LEAST_SLOPE = 0.2
"""Least change of the heading at the impact with that at the start that a correction supposes. Without a limit, a ship
that turns into the wind from wherever it starts would be sent round and round."""


def make_track(
    ship: ApproachingShip, end: Array, heading: float, around: Environment, steps: int, h: float
) -> list[ShipState]:  # fmt: skip
    """Poses at the communication points 0 to steps + POINTS_AFTER, with CO at `end` (2,) in n [m] at `steps`.

    heading [rad] at `steps`, communication step h [s]. `around` acts on a sailed ship alone. Raises ScenarioError for a
    heading that the ship does not reach in it.
    """
    if ship.orders is None:
        return _make_straight_track(ship, end, heading, steps, h)
    start, slope, before = heading, 1.0, None
    for _ in range(HEADING_CORRECTIONS):
        poses = _sail(ship, start, around, steps, h)
        error = heading - poses[steps].heading
        if not any(around.current) and around.wind is None:  # calm water is the same in every direction
            return _end_track_at(_turn_track(poses, error), end, steps)
        if abs(error) < HEADING_TOLERANCE:
            return _end_track_at(poses, end, steps)
        if before is not None:  # secant method: a ship that the wind turns needs twice as many corrections without
            slope = min(max((before[1] - error) / (start - before[0]), LEAST_SLOPE), 1.0 / LEAST_SLOPE)
        before, start = (start, error), start + error / slope
    raise ScenarioError(
        f"ship {ship.file!r} does not come to {degrees(heading):.1f} deg in this current and wind: take less of them, "
        "less drift, or a shorter time to the impact"
    )


def _make_straight_track(ship: ApproachingShip, end: Array, heading: float, steps: int, h: float) -> list[ShipState]:
    c, s = cos(heading), sin(heading)
    north, east = ship.surge * c - ship.sway * s, ship.surge * s + ship.sway * c
    times = [(k - steps) * h for k in range(steps + POINTS_AFTER + 1)]
    constant = (0.0, 0.0, 0.0, heading, ship.surge, ship.sway, 0.0, 0.0, 0.0, 0.0)
    return [ShipState(float(end[0] + north * t), float(end[1] + east * t), *constant) for t in times]


def _sail(ship: ApproachingShip, heading: float, around: Environment, steps: int, h: float) -> list[ShipState]:
    """The manoeuvring model's track from n's origin, in the same steps as a run takes."""
    model, (north, east) = ShipManoeuvring(), around.current
    parameters = model.parameters
    parameters.ship, parameters.degrees_of_freedom = ship.file, ship.degrees_of_freedom
    parameters.hydrodynamics = True
    parameters.initial_attitude[2] = heading
    c, s = cos(heading), sin(heading)
    parameters.initial_velocity[:] = [ship.surge + north * c + east * s, ship.sway - north * s + east * c, 0.0]
    _put_environment(model, around)
    orders = {order.k: [radians(order.rudder_deg), order.rev_per_s] for order in ship.orders or ()}
    return _step_model(model, orders, steps, h)


def sail_as_in_run(scenario: Scenario, name: str, steps: int) -> list[ShipState]:
    """The track of a scenario's ship without contact, to the bit as in a run, up to steps + POINTS_AFTER."""
    table = scenario.ships[name]
    model, start = ShipManoeuvring(), table.start
    parameters = model.parameters
    parameters.ship, parameters.degrees_of_freedom = scenario.ship_file(name), table.free
    parameters.hydrodynamics, parameters.coasting = bool(table.hydrodynamics), table.law
    parameters.initial_position[:], parameters.initial_attitude[:] = start.position, start.attitude
    parameters.initial_velocity[:], parameters.initial_rate[:] = start.velocity, start.rate
    if table.hydrodynamics:
        _put_environment(model, scenario.environment)
    return _step_model(model, dict(schedule_orders(table, scenario.step)), steps, scenario.step)


def _put_environment(model: ShipManoeuvring, around: Environment) -> None:
    model.inputs.current[:] = around.current
    if around.wind is not None:
        model.inputs.wind_speed, model.inputs.wind_direction = around.wind.speed, radians(around.wind.from_deg)


def _step_model(model: ShipManoeuvring, orders: Mapping[int, list[float]], steps: int, h: float) -> list[ShipState]:
    """Poses at the communication points; `orders` (rudder [rad], revolutions [1/s]) by communication point."""
    inputs = model.inputs
    inputs.rudder_order, inputs.propeller_order = orders.get(0, (0.0, 0.0))
    model.initialise()
    o, poses = model.outputs, []
    for k in range(steps + POINTS_AFTER + 1):
        poses.append(ShipState(*o.position, *o.attitude, *o.velocity, *o.rate))
        if k in orders:
            inputs.rudder_order, inputs.propeller_order = orders[k]
        if k < steps + POINTS_AFTER:
            model.step(k * h, h)
    return poses


def _turn_track(poses: Sequence[ShipState], angle: float) -> list[ShipState]:
    """The track turned about n's origin by an angle [rad]."""
    c, s = cos(angle), sin(angle)
    return [
        p._replace(north=p.north * c - p.east * s, east=p.north * s + p.east * c, heading=p.heading + angle)
        for p in poses
    ]


def _end_track_at(poses: Sequence[ShipState], end: Array, steps: int) -> list[ShipState]:
    """The track shifted so that CO is at `end` (2,) in n [m] at the communication point `steps`."""
    return shift_track(poses, np.array([end[0] - poses[steps].north, end[1] - poses[steps].east]))


def shift_track(poses: Sequence[ShipState], shift: Array) -> list[ShipState]:
    """The track shifted by (2,) in n [m]."""
    north, east = float(shift[0]), float(shift[1])
    return [p._replace(north=p.north + north, east=p.east + east) for p in poses]


def compute_relative_velocity(own: ShipState, target: ShipState) -> Array:
    """Velocity of own's material point at n's origin relative to the target's there, in plan; (2,) in n [m/s].

    v = v_CO + omega x (origin - CO) for each ship.
    """
    velocities = []
    for pose in (own, target):
        north, east = pose.plan_velocity
        velocities.append(np.array([north + pose.yaw_rate * pose.east, east - pose.yaw_rate * pose.north]))
    relative: Array = velocities[0] - velocities[1]
    return relative
