"""Variables of the FMU ShipManoeuvring: the motion of one ship.

Frames: n is north, east, down at the scenario's origin; b is forward, starboard, down at CO. SI units, radians. The
names are those of the project's contract with other programs; renaming one is a breaking change.
"""

from __future__ import annotations

from ..manoeuvring.model import ShipManoeuvring
from ..ship.coasting_law import COASTING
from .interface import Interface
from .names import (
    APPLIED,
    ATTITUDE,
    CURRENT,
    FORCE,
    HULL,
    IMPULSE,
    MOMENT,
    POSITION,
    PROPELLER,
    PROPELLER_ORDER,
    RATE,
    RUDDER,
    RUDDER_ORDER,
    VELOCITY,
    WIND,
    WIND_DIRECTION,
    WIND_SPEED,
    named,
)
from .variables import FORCE_UNITS, IMPULSE_UNITS, Table, boolean, enumeration, integer, real, string, vector, wrench

__all__ = ["INTERFACE", "table"]


def table(ships: tuple[str, ...] = ()) -> Table:
    """The variables, in the order of their value references."""
    del ships  # this FMU is one ship
    return (*_state(), *_forces(), *_inputs(), *_parameters())


def _state() -> Table:
    """Outputs: the ship at the end of the step."""
    return (
        *vector(
            "output", POSITION, "m", "outputs.position", "Position of CO in n", depends_on=("initial.position",)
        ),
        *vector(
            "output", ATTITUDE, "rad", "outputs.attitude",
            "Attitude (zyx Euler angles); yaw is the heading, unwrapped", depends_on=("initial.attitude",),
        ),
        *vector(
            "output", VELOCITY, "m/s", "outputs.velocity", "Velocity of CO over ground, in b",
            depends_on=("initial.velocity",),
        ),
        *vector(
            "output", RATE, "rad/s", "outputs.rate", "Angular velocity in b", depends_on=("initial.rate",)
        ),
        real(
            "output", "rudder_angle", "rad", "outputs.rudder_angle", None, "Rudder angle, limited in rate and range",
            depends_on=(),
        ),
        real(
            "output", "propeller_speed", "rev/s", "outputs.propeller_speed", None, "Propeller speed",
            depends_on=(PROPELLER_ORDER, "ship", "hydrodynamics"),
        ),
        *wrench(
            "output", APPLIED, IMPULSE_UNITS, "outputs.impulse_applied",
            "Cumulative impulse that the ship has applied, in b",
            "Moment about CO of the cumulative impulse that the ship has applied, in b", depends_on=(),
        ),
    )  # fmt: skip


def _forces() -> Table:
    """Outputs: forces by origin."""
    return (
        *wrench(
            "output", HULL, FORCE_UNITS, "outputs.hull", "Force of the water on the hull, in b",
            "Moment of the water on the hull about CO, in b",
        ),
        *wrench(
            "output", PROPELLER, FORCE_UNITS, "outputs.propeller", "Force of the propeller, in b",
            "Moment of the propeller about CO, in b",
        ),
        *wrench(
            "output", RUDDER, FORCE_UNITS, "outputs.rudder", "Force of the rudder, in b",
            "Moment of the rudder about CO, in b",
        ),
        *wrench(
            "output", WIND, FORCE_UNITS, "outputs.wind", "Force of the wind, in b",
            "Moment of the wind about CO, in b",
        ),
    )  # fmt: skip


def _inputs() -> Table:
    """Held over the step."""
    return (
        real("input", RUDDER_ORDER, "rad", "inputs.rudder_order", None, "Ordered rudder angle"),
        real("input", PROPELLER_ORDER, "rev/s", "inputs.propeller_order", None, "Ordered propeller speed"),
        *vector("input", CURRENT, "m/s", "inputs.current", "Velocity of the water, towards, in n"),
        real(
            "input", WIND_SPEED, "m/s", "inputs.wind_speed", None,
            "Speed of the wind over ground; 0: no force of the air",
        ),
        real(
            "input", WIND_DIRECTION, "rad", "inputs.wind_direction", None,
            "Direction that the wind comes from, clockwise from north",
        ),
        *wrench(
            "input", IMPULSE, IMPULSE_UNITS, "inputs.impulse",
            "Cumulative impulse on the ship, in b; its increase is applied at the start of the next step",
            "Moment about CO of the cumulative impulse on the ship, in b",
        ),
        *wrench(
            "input", (*FORCE, *MOMENT), FORCE_UNITS, "inputs.force",
            "External force held over the step, in b", "External moment about CO held over the step, in b",
        ),
    )  # fmt: skip


def _parameters() -> Table:
    """Fixed."""
    return (
        string("parameter", "ship", "parameters.ship", "Name of a ship in the FMU's resources, or path of a TOML file"),
        integer(
            "parameter", "degrees_of_freedom", "parameters.degrees_of_freedom",
            "Degrees of freedom; 3: surge, sway, yaw; 4: and roll; 6: all", minimum=3, maximum=6,
        ),
        boolean(
            "parameter", "hydrodynamics", "parameters.hydrodynamics",
            "false: the ship coasts between impulses, without manoeuvring forces, as the parameter coasting says",
        ),
        real(
            "parameter", "substep", "s", "parameters.substep", None, "Longest internal step of the hydrodynamics",
            minimum=0.0,
        ),
        *vector("parameter", named("initial", POSITION), "m", "parameters.initial_position", "CO at the start, in n"),
        *vector("parameter", named("initial", ATTITUDE), "rad", "parameters.initial_attitude", "Attitude at the start"),
        *vector(
            "parameter", named("initial", VELOCITY), "m/s", "parameters.initial_velocity",
            "Velocity of CO over ground at the start, in b",
        ),
        *vector(
            "parameter", named("initial", RATE), "rad/s", "parameters.initial_rate",
            "Angular velocity at the start, in b",
        ),
        enumeration(
            "parameter", "coasting", COASTING, "parameters.coasting",
            "Motion without hydrodynamics: Kirchhoff's equations with restoring and damping of heave, roll and pitch; "
            "Kirchhoff's equations alone; or velocity and angular velocity constant in n",
        ),
    )  # fmt: skip


INTERFACE = Interface(
    name="ShipManoeuvring",
    description="Motion of one ship in 3, 4 or 6 degrees of freedom under orders, wind, current, forces and impulses.",
    table=table,
    model=lambda ships: ShipManoeuvring(),
    terminals=lambda ships: {"collision": ""},
)
