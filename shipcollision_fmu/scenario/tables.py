"""The tables of a scenario file, one pydantic model each; unknown keys are refused.

    [scenario]    name, description, duration [s], step [s], algorithm
    [ships.NAME]  ship; position = [north, east] or [north, east, down] [m];
                  heading_deg and attitude_deg = [roll, pitch], or quaternion = [x, y, z, w] (n from b);
                  speed, or surge, sway, heave, or velocity_ned = [n, e, d] [m/s];
                  rates = [p, q, r] in b, or angular_velocity_ned [rad/s];
                  hydrodynamics; degrees_of_freedom; orders = [{time, rudder_deg or heading_deg, rev_per_s}];
                  route = {waypoints = [[north, east], ...], lookahead, acceptance};
                  autopilot = {gain, rate_gain, integral_gain, rudder_limit_deg};
                  evasion = {of, distance or time_to_closest, rudder_deg, rev_per_s};
                  fender = {stiffness, damping, thickness} [N/m, N s/m, m], around the hull
    [obstacles.NAME] kind, shape, position = [north, east], heading_deg, ...: see collision/obstacles.py
    [collision]   friction, restitution, response, substep, feedback, minimum_separation_time,
                  clearance_range; damage = {t_eq, half_angle_deg, shells}: indicative, see collision/damage.py
    [environment] current = [north, east] or {speed, towards_deg}: where the water goes to [m/s];
                  wind = {speed, from_deg}: where the wind comes from [m/s]
    [reference]   source, time, note; [reference.ships.NAME] printed, corrected, tolerance

Angles are in degrees only in keys ending `_deg`, everything else is SI. Positions and velocities are of CO (midship,
centreline, waterline). A field's description is also the remedy in the message that refuses it.
"""

from __future__ import annotations

import re
from itertools import pairwise
from math import ceil, cos, hypot, isclose, isfinite, radians, sin
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from ..collision.checks import MAXIMUM_FRICTION
from ..collision.obstacles import FenderTable
from ..collision.responses import RESPONSES
from ..ship.frames import Array, attitude_from_quaternion, rotation

__all__ = [
    "Algorithm", "AutopilotTable", "Collision", "DamageTable", "Environment", "EvasionTable", "Header", "Order",
    "Published", "Quantity", "Reference", "RouteTable", "ShipStart", "Start", "Table", "Tolerance", "WindTable",
]  # fmt: skip

Algorithm = Literal["gauss-seidel", "jacobi"]
Quantity = Literal["x", "y", "z", "h", "p", "r", "v_x", "v_y", "v_z", "w_x", "w_y", "w_z"]

MAXIMUM_STEPS = 1_000_000
"""More rows than this are not a run but a mistake in `step`: 14 h at 0.05 s, some 500 MB of states."""
MAXIMUM_SPEED = 50.0
"""[m/s] No displacement ship is faster; a larger number is a wrong unit."""
MAXIMUM_RATE = 1.0
"""[rad/s] A turn in six seconds; a larger number is a rate in degrees."""
MAXIMUM_CURRENT = 10.0
"""[m/s] The strongest tidal streams run 8 m/s; a larger number is a wrong unit."""
MAXIMUM_WIND = 60.0
"""[m/s] Hurricanes of the strongest category begin at 70; a larger number is a wind in knots."""
MAXIMUM_REVOLUTIONS = 20.0
"""[rev/s] Of a model in a tank; a larger number is one of revolutions per minute."""
SHORTEST_LEG = 1.0
"""[m] A shorter leg of a route has no reliable bearing."""
_REV = "the ordered propeller speed [rev/s]"

Waypoint = Annotated[list[float], Field(min_length=2, max_length=2)]
Shell = Annotated[list[float], Field(min_length=2, max_length=2)]


class Table(BaseModel):
    """Base of all tables: no unknown keys, no conversions from text, finite numbers, unchangeable."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


class Header(Table):
    """[scenario]: what is run, for how long, in which steps."""

    name: str = Field(description='the name of the run\'s folder, e.g. "head_on"')
    description: str = ""
    duration: float = Field(gt=0, description="a whole number of steps [s], e.g. 120.0")
    step: float = Field(default=0.05, gt=0, description="the communication step [s], e.g. 0.05")
    algorithm: Algorithm = Field(default="gauss-seidel", description="how the master orders its steps")

    @property
    def steps(self) -> int:
        """Number of communication steps in the run."""
        return round(self.duration / self.step)

    @field_validator("name")
    @classmethod
    def _fit_for_a_folder(cls, name: str) -> str:
        if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", name):
            raise ValueError(f"[scenario] name = {name!r} cannot name a folder: take letters, digits, '_', '-' and '.'")
        return name

    @model_validator(mode="after")
    def _whole_number_of_steps(self) -> Header:
        ratio = self.duration / self.step
        if ratio > MAXIMUM_STEPS:
            raise ValueError(
                f"[scenario] step = {self.step:g} s makes {ratio:.3g} steps of {self.duration:g} s, "
                f"the limit is {MAXIMUM_STEPS}: take a longer step"
            )
        if round(ratio) < 1 or not isclose(ratio, round(ratio), rel_tol=1e-9):
            whole = [n * self.step for n in (int(ratio), ceil(ratio)) if n > 0]
            raise ValueError(
                f"[scenario] duration = {self.duration:g} s is {ratio:.6g} steps of {self.step:g} s, must be a whole "
                f"number: take duration = {' or '.join(f'{d:g}' for d in whole)}, or a step that divides it"
            )
        return self


class Order(Table):
    """What the bridge orders from a time on; what is left out stays as it was.

    heading_deg hands the rudder to the autopilot, rudder_deg takes it back; both end a route.
    """

    time: float = Field(ge=0, description="given at the first communication point at or after it [s]")
    rudder_deg: float | None = Field(default=None, ge=-90, le=90, description="the ordered rudder angle [deg]")
    heading_deg: float | None = Field(default=None, ge=-360, le=720, description="the heading to steer [deg]")
    rev_per_s: float | None = Field(default=None, ge=-MAXIMUM_REVOLUTIONS, le=MAXIMUM_REVOLUTIONS, description=_REV)

    @model_validator(mode="after")
    def _orders_something(self) -> Order:
        if self.rudder_deg is None and self.heading_deg is None and self.rev_per_s is None:
            raise ValueError("orders nothing: give rudder_deg or rev_per_s")
        if self.rudder_deg is not None and self.heading_deg is not None:
            raise ValueError("gives both rudder_deg and heading_deg: keep one of them")
        return self


class AutopilotTable(Table):
    """autopilot: gains of the heading autopilot; what is left out follows from the ship's length and speed."""

    gain: float = Field(default=1.5, gt=0, le=20, description="rudder per error in heading [deg/deg]")
    rate_gain: float | None = Field(default=None, ge=0, description="rudder per rate of turn [s], e.g. 60.0")
    integral_gain: float = Field(default=0.0, ge=0, le=1, description="rudder per error and second [1/s], e.g. 0.005")
    rudder_limit_deg: float = Field(default=35.0, gt=0, le=90, description="the largest order [deg]")


class RouteTable(Table):
    """route: waypoints to follow from the start; the last leg is sailed on beyond its end."""

    waypoints: list[Waypoint] = Field(min_length=1, description="[[north, east], ...] [m], without the ship's start")
    lookahead: float | None = Field(default=None, gt=0, description="how far ahead the track is aimed at [m]")
    acceptance: float | None = Field(default=None, gt=0, description="how far before a waypoint the turn begins [m]")


class EvasionTable(Table):
    """evasion: what is ordered, over autopilot, route and orders, once another ship is near. For good."""

    of: str = Field(min_length=1, description="the name of the ship to evade")
    distance: float | None = Field(default=None, gt=0, description="between the midships [m], e.g. 900.0")
    time_to_closest: float | None = Field(default=None, gt=0, description="to the closest approach [s], e.g. 60.0")
    rudder_deg: float = Field(ge=-90, le=90, description="the ordered rudder angle [deg], e.g. 35.0")
    rev_per_s: float | None = Field(default=None, ge=-MAXIMUM_REVOLUTIONS, le=MAXIMUM_REVOLUTIONS, description=_REV)

    @model_validator(mode="after")
    def _one_trigger(self) -> EvasionTable:
        if (self.distance is None) == (self.time_to_closest is None):
            raise ValueError("evasion must say how late: give distance or time_to_closest, one of them")
        return self


class Start(Table):
    """A ship's state at time 0, about CO, as the FMU takes it: position and attitude in n, velocity and rate in b."""

    position: list[float]
    attitude: list[float]
    velocity: list[float]
    rate: list[float]


def _vector(size: int, description: str) -> Any:
    return Field(default=None, min_length=size, max_length=size, description=description)


class ShipStart(Table):
    """[ships.NAME]: a ship, its state at time 0, and how it is sailed."""

    ship: str = Field(min_length=1, description="a shipped model's name, or the path of a ship file")
    position: list[float] = Field(min_length=2, max_length=3, description="[north, east] or [north, east, down] [m]")
    heading_deg: float | None = Field(default=None, ge=-360, le=720, description="clockwise from north [deg]")
    attitude_deg: list[float] | None = _vector(2, "[roll, pitch] [deg]")
    quaternion: list[float] | None = _vector(4, "[x, y, z, w], n from b, of length 1")
    speed: float | None = Field(default=None, description="ahead, over ground [m/s]")
    surge: float | None = Field(default=None, description="ahead, over ground [m/s]")
    sway: float | None = Field(default=None, description="to starboard, over ground [m/s]")
    heave: float | None = Field(default=None, description="down [m/s]")
    velocity_ned: list[float] | None = _vector(3, "[north, east, down] of CO [m/s]")
    rates: list[float] | None = _vector(3, "[p, q, r] in b [rad/s]")
    angular_velocity_ned: list[float] | None = _vector(3, "[north, east, down] [rad/s]")
    hydrodynamics: bool = Field(default=False, description="false for a ship that coasts")
    degrees_of_freedom: Literal[3, 4, 6] | None = Field(default=None, description="3, 4 or 6")
    orders: list[Order] = Field(default=[], description="[{time = 0.0, rudder_deg = 0.0, rev_per_s = 1.5}, ...]")
    autopilot: AutopilotTable | None = Field(default=None, description="{gain = 1.5, rudder_limit_deg = 20.0}")
    route: RouteTable | None = Field(default=None, description="{waypoints = [[1000.0, 0.0], [2000.0, 500.0]]}")
    evasion: EvasionTable | None = Field(default=None, description='{of = "own", distance = 900.0, rudder_deg = 35.0}')
    fender: FenderTable | None = Field(
        default=None, description="{stiffness = 1e6, damping = 1e5, thickness = 1.0} [N/m, N s/m, m]"
    )

    @property
    def free(self) -> int:
        """Degrees of freedom: as given, else 3 with hydrodynamics (plane motion of the MMG model) and 6 without."""
        return self.degrees_of_freedom or (3 if self.hydrodynamics else 6)

    @property
    def start(self) -> Start:
        """State at time 0."""
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
        return Start(position=position, attitude=attitude, velocity=velocity, rate=rate)

    @model_validator(mode="after")
    def _each_quantity_once(self) -> ShipStart:
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

    @model_validator(mode="after")
    def _believable(self) -> ShipStart:
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
    def _orders_in_sequence(self) -> ShipStart:
        for key in ("orders", "route", "autopilot", "evasion"):
            if getattr(self, key) and not self.hydrodynamics:
                raise ValueError(f"has {key}, but coasts: set hydrodynamics = true, or remove {key}")
        for earlier, later in pairwise(order.time for order in self.orders):
            if later <= earlier:
                raise ValueError(f"orders: time {later:g} s comes after {earlier:g} s: put them in order of time")
        return self

    @model_validator(mode="after")
    def _steered_by_someone(self) -> ShipStart:
        if self.autopilot is not None and self.route is None and all(o.heading_deg is None for o in self.orders):
            raise ValueError("has an autopilot with nothing to steer: give orders a heading_deg, or give a route")
        if self.route is not None:
            for earlier, later in pairwise([[float(x) for x in self.position[:2]], *self.route.waypoints]):
                if hypot(later[0] - earlier[0], later[1] - earlier[1]) < SHORTEST_LEG:
                    raise ValueError(f"route: waypoint {later} must be {SHORTEST_LEG:g} m or more from the one before")
        return self


class DamageTable(Table):
    """damage: report indicative damage with each collision, by the formulae of collision/damage.py."""

    t_eq: float = Field(gt=0, le=2, description="plate thickness of decks and bottoms of both ships, summed [m]")
    half_angle_deg: float = Field(gt=0, lt=90, description="of the striking bow in plan [deg], e.g. 30.0")
    shells: list[Shell] = Field(default=[], description="[[height, thickness], ...] of side shells torn open [m]")

    @field_validator("shells")
    @classmethod
    def _believable(cls, shells: list[Shell]) -> list[Shell]:
        for height, thickness in shells:
            if not (0.0 < height <= 50.0 and 0.0 < thickness <= 0.1):
                raise ValueError(f"damage: shell {[height, thickness]} must be a height and a thickness in metres")
        return shells


class Collision(Table):
    """[collision]: parameters of the collision FMU; what is left out keeps the FMU's own start value."""

    friction: float | None = Field(
        default=None, ge=0, le=MAXIMUM_FRICTION, description="Coulomb's coefficient, e.g. 0.3"
    )
    restitution: float | None = Field(default=None, ge=0, le=1, description="0 for plastic, 1 for elastic")
    response: str | None = Field(default=None, description='the rule of contact, e.g. "pgs"')
    substep: float | None = Field(default=None, gt=0, description="internal step of the collision FMU [s], e.g. 0.01")
    feedback: Literal["ledger", "force", "state", "none"] | None = Field(default=None, description="how ships answer")
    minimum_separation_time: float | None = Field(default=None, gt=0, description="ends a collision [s], e.g. 10.0")
    clearance_range: float | None = Field(default=None, gt=0, description="the cap of the clearance [m], e.g. 200.0")
    damage: DamageTable | None = Field(default=None, description="{t_eq = 0.1, half_angle_deg = 30.0}; absent: none")

    @field_validator("response")
    @classmethod
    def _offered(cls, response: str | None) -> str | None:
        if response is not None and response not in RESPONSES:
            raise ValueError(f"[collision] response = {response!r} is not offered: take one of {', '.join(RESPONSES)}")
        return response

    @field_validator("feedback")
    @classmethod
    def _our_ships_answer(cls, feedback: str | None) -> str | None:
        if feedback == "state":
            raise ValueError(
                '[collision] feedback = "state" wants ships that adopt post.*, for which ShipManoeuvring has no input: '
                "take ledger, force or none"
            )
        return feedback


class WindTable(Table):
    """A uniform wind: its speed over ground, and where it comes from."""

    speed: float = Field(ge=0.0, le=MAXIMUM_WIND, description="the wind's speed [m/s]")
    from_deg: float = Field(ge=-360, le=720, description="where the wind comes from, clockwise from north [deg]")


class Environment(Table):
    """[environment]: what acts on every ship that has hydrodynamics."""

    current: list[float] = Field(
        default=[0.0, 0.0], min_length=2, max_length=2, description="[north, east] or {speed, towards_deg} [m/s]"
    )
    wind: WindTable | None = Field(default=None, description="{speed = 10.0, from_deg = 270.0} [m/s, deg]")

    @field_validator("current", mode="before")
    @classmethod
    def _from_speed_and_direction(cls, given: Any) -> Any:
        if not isinstance(given, dict):
            return given
        known = set(given) == {"speed", "towards_deg"}
        if not known or not all(type(value) in (int, float) and isfinite(value) for value in given.values()):
            raise ValueError(
                f"[environment] current = {given} must be two finite numbers: {{speed = 1.0, towards_deg = 90.0}}"
            )
        speed, towards = float(given["speed"]), radians(given["towards_deg"])
        return [speed * cos(towards), speed * sin(towards)]

    @field_validator("current")
    @classmethod
    def _believable(cls, current: list[float]) -> list[float]:
        if max(map(abs, current)) > MAXIMUM_CURRENT:
            raise ValueError(f"{current} runs faster than the limit of {MAXIMUM_CURRENT:g} m/s: give metres per second")
        return current


class Tolerance(Table):
    """How near the computed numbers must be to the published ones."""

    horizontal: float = Field(gt=0, description="the tolerance of x and y [m]")
    vertical: float = Field(gt=0, description="the tolerance of z [m]")
    quaternion: float = Field(gt=0, description="the tolerance of h, p and r [1]")
    velocity: float = Field(gt=0, description="the tolerance of v_x, v_y and v_z [m/s]")
    rate: float = Field(gt=0, description="the tolerance of w_x, w_y and w_z [rad/s]")


class Published(Table):
    """[reference.ships.NAME]: a ship's published state as printed, and what of it had to be corrected."""

    printed: dict[Quantity, float] = Field(min_length=1, description="{x = ..., h = ..., v_x = ...} as printed")
    corrected: dict[Quantity, float] = Field(default={}, description="only the numbers that differ from print")
    tolerance: Tolerance

    @model_validator(mode="after")
    def _corrects_what_is_printed(self) -> Published:
        for quantity in self.corrected:
            if quantity not in self.printed:
                raise ValueError(f"corrects {quantity}, which is not printed: printed are {', '.join(self.printed)}")
        return self


class Reference(Table):
    """[reference]: published results at one time, in the frame of Guan et al. 2014 (see cosim/reference.py)."""

    source: str = Field(min_length=1, description="author, year, table")
    time: float = Field(gt=0, description="when the published state holds, from the start of the scenario [s]")
    note: str = ""
    ships: dict[str, Published] = Field(min_length=1, description="a table [reference.ships.NAME] per ship")


def _floats(v: Array) -> list[float]:
    return [float(x) for x in v]
