"""[ships.NAME]: which ship starts where, how fast, and how it is steered."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, isclose, radians
from typing import Any, Literal

from pydantic import Field, PrivateAttr, model_validator

from ...collision.obstacles import FenderTable
from ...ship.coasting_law import COASTING
from ...ship.frames import Array, attitude_from_quaternion, rotation
from ...ship.tables.table import Table
from ..tracks.track import Track
from .ais import AisTable, TrackTable
from .autopilot import SHORTEST_LEG, AutopilotTable, RouteTable
from .evasion import EvasionTable
from .orders import Order

__all__ = ["ShipStart", "StartState"]

WITH_TRACK = frozenset({"track", "ship", "ais", "fender"})
"""Keys of a ship that follows a track."""
MAXIMUM_SPEED = 50.0
"""[m/s] Limit of every velocity. No displacement ship is faster; a larger value was meant in another unit."""
MAXIMUM_RATE = 1.0
"""[rad/s] Limit of every rate: a full turn in six seconds. A larger value was meant in degrees."""


class StartState(Table):
    """State of CO at time 0: position [m] and attitude [rad] in n, velocity [m/s] and rate [rad/s] in b."""

    position: list[float]
    attitude: list[float]
    velocity: list[float]
    rate: list[float]


def _vector(size: int, description: str) -> Any:
    return Field(default=None, min_length=size, max_length=size, description=description)


class ShipStart(Table):
    """[ships.NAME]: a ship, its state at time 0, and how it is steered."""

    ship: str | None = Field(
        default=None,
        min_length=1,
        description="a shipped model's name, or the path of a ship file; only a ship with a track may leave it out",
    )
    position: list[float] | None = Field(
        default=None,
        min_length=2,
        max_length=3,
        description="the position of CO, [north, east] or [north, east, down] [m]; of a ship without a track",
    )
    heading_deg: float | None = Field(
        default=None, ge=-360, le=720, description="the heading, clockwise from north [deg]"
    )
    attitude_deg: list[float] | None = _vector(2, "the attitude [roll, pitch] [deg]")
    quaternion: list[float] | None = _vector(4, "the attitude [x, y, z, w], n from b, of length 1")
    speed: float | None = Field(
        default=None, description="the speed ahead, over ground [m/s]; for a ship without sway and heave"
    )
    surge: float | None = Field(default=None, description="the velocity ahead, over ground [m/s]")
    sway: float | None = Field(default=None, description="the velocity to starboard, over ground [m/s]")
    heave: float | None = Field(default=None, description="the velocity down [m/s]")
    velocity_ned: list[float] | None = _vector(3, "the velocity of CO, [north, east, down] [m/s]")
    rates: list[float] | None = _vector(3, "the rates of roll, pitch and yaw, [p, q, r] in b [rad/s]")
    angular_velocity_ned: list[float] | None = _vector(3, "the angular velocity, [north, east, down] [rad/s]")
    hydrodynamics: bool | None = Field(
        default=None,
        description="true for a ship with the manoeuvring model, false for a ship that coasts; default: true for a "
        "ship with a table [manoeuvring], unless coasting is given",
    )
    coasting: Literal["kirchhoff", "free", "straight"] | None = Field(
        default=None,
        description='how a ship coasts: "kirchhoff" (default) by Kirchhoff\'s equations, in 4 and 6 degrees of freedom '
        'with restoring and damping of heave, roll and pitch; "free" by Kirchhoff\'s equations alone; "straight" with '
        "velocity and angular velocity constant in n",
    )
    degrees_of_freedom: Literal[3, 4, 6] | None = Field(
        default=None, description="3 (surge, sway, yaw), 4 (and roll) or 6; default 3"
    )
    orders: list[Order] = Field(default=[], description="[{time = 0.0, rudder_deg = 0.0, rev_per_s = 1.5}, ...]")
    autopilot: AutopilotTable | None = Field(default=None, description="{gain = 1.5, rudder_limit_deg = 20.0}")
    route: RouteTable | None = Field(default=None, description="{waypoints = [[1000.0, 0.0], [2000.0, 500.0]]} [m]")
    evasion: EvasionTable | None = Field(default=None, description='{of = "own", distance = 900.0, rudder_deg = 35.0}')
    track: TrackTable | None = Field(
        default=None, description='{file = "ais.csv", mmsi = 211234560}: recorded AIS that the ship follows'
    )
    ais: AisTable | None = Field(
        default=None, description='{mmsi = 211234560, name = "OWN SHIP"}: what it tells by AIS'
    )
    fender: FenderTable | None = Field(
        default=None, description="{stiffness = 1e6, damping = 1e5, thickness = 1.0} [N/m, N s/m, m]"
    )

    _recorded: Track | None = PrivateAttr(default=None)  # the track, once the scenario has read it

    @property
    def recorded(self) -> Track | None:
        """The track that the ship follows."""
        return self._recorded

    def follow(self, track: Track) -> None:
        """Take the motion of a track, which the scenario has read."""
        self._recorded = track

    @property
    def free(self) -> int:
        """Degrees of freedom: as given, else 3 (motion in the plane)."""
        return self.degrees_of_freedom or 3

    @property
    def law(self) -> str:
        """How the ship coasts, by its name in ship/coasting_law.py; with a track, straight from point to point."""
        return "straight" if self.track is not None else self.coasting or COASTING[0]

    @property
    def predicted_law(self) -> str:
        """What the collision model expects of the ship between impulses. For a ship under way all that its manoeuvring
        model does beside going straight is an other force, which is measured."""
        return "straight" if self.hydrodynamics else self.law

    @property
    def start(self) -> StartState:
        """The state at time 0 from whichever keys give it, or from the track."""
        if self._recorded is not None:
            state = self._recorded.state(0.0)
            return StartState(
                position=[*state.position], attitude=[*state.attitude], velocity=[*state.velocity], rate=[*state.rate]
            )
        assert self.position is not None
        if self.quaternion is not None:
            attitude = _floats(attitude_from_quaternion(self.quaternion))
        else:
            roll, pitch = self.attitude_deg or (0.0, 0.0)
            attitude = [radians(roll), radians(pitch), radians(self.heading_deg or 0.0)]
        R_bn = rotation(attitude).T
        velocity = [float(self.surge or self.speed or 0.0), float(self.sway or 0.0), float(self.heave or 0.0)]
        if self.velocity_ned is not None:
            velocity = _floats(R_bn @ self.velocity_ned)
        rate = [float(w) for w in self.rates or (0.0, 0.0, 0.0)]
        if self.angular_velocity_ned is not None:
            rate = _floats(R_bn @ self.angular_velocity_ned)
        position = [float(x) for x in (*self.position, 0.0)[:3]]
        return StartState(position=position, attitude=attitude, velocity=velocity, rate=rate)

    @model_validator(mode="after")
    def _check_each_quantity_once(self) -> ShipStart:
        if self.track is not None:
            return self._check_track()
        for key in ("ship", "position"):
            if getattr(self, key) is None:
                said = ShipStart.model_fields[key].description
                raise ValueError(f"{key} is missing: give {said}")
        given = self.model_fields_set
        for one, others in (
            ("quaternion", ("heading_deg", "attitude_deg")),
            ("speed", ("surge", "sway", "heave", "velocity_ned")),
            ("velocity_ned", ("surge", "sway", "heave")),
            ("rates", ("angular_velocity_ned",)),
        ):
            twice = [other for other in others if other in given]
            if one in given and twice:
                raise ValueError(f"gives both {one} and {twice[0]}: keep one of them")
        if self.heading_deg is None and self.quaternion is None:
            raise ValueError("heading_deg is missing: clockwise from north [deg], e.g. 90.0 for east")
        return self

    def _check_track(self) -> ShipStart:
        """Refuse keys that a track gives, and those that need a ship that is free to move."""
        for key in self.model_fields_set - WITH_TRACK:
            value = getattr(self, key)
            if not (value is None or value is False or value == []):
                raise ValueError(f"has a track, which gives its motion, and {key}: remove {key}")
        return self

    @model_validator(mode="after")
    def _check_ranges(self) -> ShipStart:
        if self.track is not None:
            return self
        if self.quaternion is not None:
            length = sum(q * q for q in self.quaternion) ** 0.5
            if not isclose(length, 1.0, abs_tol=1e-3):
                raise ValueError(f"quaternion has length {length:.6g}, must be 1 within 0.001: normalise it")
        if self.attitude_deg is not None and max(map(abs, self.attitude_deg)) >= 90:
            raise ValueError(f"attitude_deg = {self.attitude_deg} must be within 90 deg: start with a ship that floats")
        fastest = max(map(abs, self.start.velocity))
        if fastest > MAXIMUM_SPEED:
            raise ValueError(f"moves at {fastest:g} m/s, the limit is {MAXIMUM_SPEED:g}: give metres per second")
        quickest = max(map(abs, self.start.rate))
        if quickest > MAXIMUM_RATE:
            raise ValueError(f"turns at {quickest:g} rad/s, the limit is {MAXIMUM_RATE:g}: give radians per second")
        return self

    @model_validator(mode="after")
    def _check_orders(self) -> ShipStart:
        for key in ("orders", "route", "autopilot", "evasion"):
            if getattr(self, key) and not self.hydrodynamics:
                raise ValueError(f"has {key}, but coasts: set hydrodynamics = true, or remove {key}")
        if self.hydrodynamics and self.coasting is not None:
            raise ValueError(f"coasting = {self.coasting!r} goes with hydrodynamics = false: remove one of them")
        for earlier, later in pairwise(order.time for order in self.orders):
            if later <= earlier:
                raise ValueError(f"orders: time {later:g} s comes after {earlier:g} s: put them in order of time")
        return self

    @model_validator(mode="after")
    def _check_steering(self) -> ShipStart:
        if self.autopilot is not None and self.route is None and all(o.heading_deg is None for o in self.orders):
            raise ValueError("has an autopilot with nothing to steer: give orders a heading_deg, or give a route")
        if self.route is not None:
            for earlier, later in pairwise([self.start.position[:2], *self.route.waypoints]):
                if hypot(later[0] - earlier[0], later[1] - earlier[1]) < SHORTEST_LEG:
                    raise ValueError(f"route: waypoint {later} must be {SHORTEST_LEG:g} m or more from the one before")
        return self


def _floats(v: Array) -> list[float]:
    return [float(x) for x in v]
