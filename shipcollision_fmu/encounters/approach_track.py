"""How a ship comes to an impact: her pose and velocity at every communication point, ending where they are wanted.

Coasting ships come in a straight line. Ships under way are sailed forwards with the model itself, then their track is
turned and shifted so that it ends there; with a current, which does not turn, the start is improved until it does.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, degrees, radians, sin
from typing import NamedTuple

import numpy as np

from ..errors import ScenarioError
from ..manoeuvring.model import ShipManoeuvring
from ..manoeuvring.trials.steady_course import self_propulsion
from ..scenario.scenario import Scenario, order_table
from ..ship.frames import Array
from ..ship.loading.library import load_ship

__all__ = [
    "BEYOND", "Mover", "Order", "Pose", "as_run", "nearer", "relative_velocity", "steered", "track", "under_way",
]  # fmt: skip

BEYOND = 2
"""Communication points of a track after the wanted impact, as if nothing had been met."""


class Order(NamedTuple):
    """From a communication point on: rudder [deg], revolutions [1/s]."""

    k: int
    rudder_deg: float
    rev_per_s: float


@dataclass(frozen=True)
class Mover:
    """How a ship comes to the impact: speed ahead and to starboard through the water, orders None when she coasts."""

    file: str
    surge: float
    sway: float
    orders: tuple[Order, ...] | None
    degrees_of_freedom: int


class Pose(NamedTuple):
    """CO in n [m], attitude [rad], velocity over ground in b [m/s], rate [rad/s]."""

    north: float
    east: float
    down: float
    roll: float
    pitch: float
    heading: float
    surge: float
    sway: float
    heave: float
    roll_rate: float
    pitch_rate: float
    yaw_rate: float


def under_way(ship: str, speed: float, degrees_of_freedom: int) -> Mover:
    """A ship that keeps her speed [m/s] on a straight course. Raises ScenarioError for one that can only coast."""
    if load_ship(ship).manoeuvring is None:
        raise ScenarioError(f"ship {ship!r} can only coast, she has no [manoeuvring]: take --coasting, or another ship")
    order = Order(0, 0.0, self_propulsion(ship, speed) if speed > 0.0 else 0.0)
    return Mover(ship, speed, 0.0, (order,), degrees_of_freedom)


def steered(orders: tuple[Order, ...], k: int, rudder_deg: float) -> tuple[Order, ...]:
    """The first order, and from the communication point k on the rudder."""
    first = orders[0]
    if k == 0:
        return (Order(0, rudder_deg, first.rev_per_s),)
    return (first, Order(k, rudder_deg, first.rev_per_s))


def track(
    mover: Mover, end: Array, heading: float, current: tuple[float, float], steps: int, h: float
) -> list[Pose]:  # fmt: skip
    """Poses at the communication points 0 to steps + BEYOND of a ship whose CO is at `end` (2,) in n at `steps`.

    Raises ScenarioError for a heading that she does not come to in the current.
    """
    if mover.orders is None:
        return _straight(mover, end, heading, steps, h)
    start = heading
    for _ in range(50):
        sailed = _sailed(mover, start, current, steps, h)
        error = heading - sailed[steps].heading
        if not any(current):  # water at rest is the same in every direction
            return _ending(_turned(sailed, error), end, steps)
        if abs(error) < 1e-10:
            return _ending(sailed, end, steps)
        start += error
    raise ScenarioError(
        f"ship {mover.file!r} does not come to {degrees(heading):.1f} deg in this current: take less drift"
    )


def _straight(mover: Mover, end: Array, heading: float, steps: int, h: float) -> list[Pose]:
    c, s = cos(heading), sin(heading)
    north, east = mover.surge * c - mover.sway * s, mover.surge * s + mover.sway * c
    times = [(k - steps) * h for k in range(steps + BEYOND + 1)]
    rest = (0.0, 0.0, 0.0, heading, mover.surge, mover.sway, 0.0, 0.0, 0.0, 0.0)
    return [Pose(float(end[0] + north * t), float(end[1] + east * t), *rest) for t in times]


def _sailed(mover: Mover, heading: float, current: tuple[float, float], steps: int, h: float) -> list[Pose]:
    """The model's own track from n's origin, step by step as a run will make it."""
    model, (north, east) = ShipManoeuvring(), current
    parameters = model.parameters
    parameters.ship, parameters.degrees_of_freedom = mover.file, mover.degrees_of_freedom
    parameters.hydrodynamics = True
    parameters.initial_attitude[2] = heading
    c, s = cos(heading), sin(heading)
    parameters.initial_velocity[:] = [mover.surge + north * c + east * s, mover.sway - north * s + east * c, 0.0]
    model.inputs.current[:] = [north, east]
    orders = {order.k: [radians(order.rudder_deg), order.rev_per_s] for order in mover.orders or ()}
    return _stepped(model, orders, steps, h)


def _stepped(model: ShipManoeuvring, orders: Mapping[int, list[float]], steps: int, h: float) -> list[Pose]:
    """Poses at the communication points; orders by the point at which they are given."""
    inputs = model.inputs
    inputs.rudder_order, inputs.propeller_order = orders.get(0, (0.0, 0.0))
    model.initialise()
    o, poses = model.outputs, []
    for k in range(steps + BEYOND + 1):
        poses.append(Pose(*o.position, *o.attitude, *o.velocity, *o.rate))
        if k in orders:
            inputs.rudder_order, inputs.propeller_order = orders[k]
        if k < steps + BEYOND:
            model.step(k * h, h)
    return poses


def as_run(scenario: Scenario, name: str, steps: int) -> list[Pose]:
    """The track of a ship of a scenario, who meets nobody, to the bit as a run makes it, up to `steps` + BEYOND."""
    table = scenario.ships[name]
    model, start = ShipManoeuvring(), table.start
    parameters = model.parameters
    parameters.ship, parameters.degrees_of_freedom = scenario.ship_file(name), table.free
    parameters.hydrodynamics = table.hydrodynamics
    parameters.initial_position[:], parameters.initial_attitude[:] = start.position, start.attitude
    parameters.initial_velocity[:], parameters.initial_rate[:] = start.velocity, start.rate
    if table.hydrodynamics:
        model.inputs.current[:] = scenario.environment.current
    return _stepped(model, dict(order_table(table, scenario.step)), steps, scenario.step)


def _turned(poses: Sequence[Pose], by: float) -> list[Pose]:
    c, s = cos(by), sin(by)
    return [
        p._replace(north=p.north * c - p.east * s, east=p.north * s + p.east * c, heading=p.heading + by) for p in poses
    ]


def _ending(poses: Sequence[Pose], end: Array, steps: int) -> list[Pose]:
    """Shifted so that it is there then."""
    return nearer(poses, np.array([end[0] - poses[steps].north, end[1] - poses[steps].east]))


def nearer(poses: Sequence[Pose], by: Array) -> list[Pose]:
    """The track shifted by (2,) [m] in n."""
    north, east = float(by[0]), float(by[1])
    return [p._replace(north=p.north + north, east=p.east + east) for p in poses]


def relative_velocity(own: Pose, target: Pose) -> Array:
    """Of own relative to the target at n's origin, where they touch [m/s]; (2,) in n, in plan."""
    velocities = []
    for pose in (own, target):
        c, s = cos(pose.heading), sin(pose.heading)
        north = pose.surge * c - pose.sway * s + pose.yaw_rate * pose.east  # omega x (origin - CO)
        east = pose.surge * s + pose.sway * c - pose.yaw_rate * pose.north
        velocities.append(np.array([north, east]))
    relative: Array = velocities[0] - velocities[1]
    return relative
