"""Variables of the FMU ShipCollision: contact between two or more ships.

What belongs to a contact point, to the latest collision or to the solver jumps (`jumps`): it holds between events, and
a host must not interpolate it. Impulses and energies grow steadily while hulls or fenders press, and are continuous.
Degrees of freedom are an Integer with limits, not an enumeration: libcosim drops enumerations, and its users could no
longer set them; FMI 3.0 sets the two by different functions.

Frames: n is north, east, down at the scenario's origin; b is forward, starboard, down at CO. SI units, radians. The
names are those of the project's contract with other programs; renaming one is a breaking change.
"""

from __future__ import annotations

from math import pi

from ..collision.checks import MAXIMUM_FRICTION
from ..collision.feedback import COMMON_FEEDBACKS, SHIP_FEEDBACKS
from ..collision.findings import FINDINGS
from ..collision.interface import contact_point_count
from ..collision.responses import RESPONSES
from ..ship.coasting_law import COASTING
from .framed_collision import FramedCollision
from .interface import REQUIREMENTS, SHIPS, Interface
from .names import (
    APPLIED,
    ATTITUDE,
    AXES,
    FORCE,
    IMPACT_POINT,
    IMPULSE,
    MOMENT,
    NED,
    POSITION,
    POST,
    RATE,
    VELOCITY,
    contact_point,
    named,
)
from .variables import (
    FORCE_UNITS,
    IMPULSE_UNITS,
    Array,
    Table,
    Variable,
    boolean,
    enumeration,
    integer,
    real,
    string,
    vector,
    wrench,
)

__all__ = ["INTERFACE", "table"]


def table(ships: tuple[str, ...] = SHIPS) -> Table:
    """The variables, in the order of their value references."""
    return (
        *(line for i, name in enumerate(ships) for line in _ship(i, name)),
        *_contacts(contact_point_count(len(ships))),
        *_impact(),
        *_energy(),
        *_solver(),
        *_clearance(),
        *_parameters(),
        *_couples(contact_point_count(len(ships))),
        *(_coasting(i, name) for i, name in enumerate(ships)),
        *_starts(contact_point_count(len(ships))),
        *_diagnosis(len(ships)),
        *(line for i, name in enumerate(ships) for line in _feedback(i, name)),
        *(line for i, name in enumerate(ships) for line in _frames(i, name)),
    )


def _ship(i: int, s: str) -> Table:
    """A ship: inputs at the start of a step, outputs at its end, parameters."""
    return *_received(f"inputs.ships.{i}", s), *_given(f"outputs.ships.{i}", s), *_settings(f"parameters.ships.{i}", s)


def _received(received: str, s: str) -> Table:
    return (
        *vector("input", named(s, POSITION), "m", f"{received}.position", f"CO of {s} in n"),
        *vector("input", named(s, ATTITUDE), "rad", f"{received}.attitude", f"Attitude of {s} (zyx Euler angles)"),
        *vector("input", named(s, VELOCITY), "m/s", f"{received}.velocity", f"Velocity of CO of {s} in b"),
        *vector("input", named(s, RATE), "rad/s", f"{received}.rate", f"Angular velocity of {s} in b"),
        *wrench(
            "input", named(s, APPLIED), IMPULSE_UNITS, f"{received}.impulse_applied",
            f"Cumulative impulse that the model of {s} has applied, in b",
            f"Moment about CO of the cumulative impulse that the model of {s} has applied, in b",
        ),
    )  # fmt: skip


def _given(given: str, s: str) -> Table:
    post = f"{s}.{POST}"
    return (
        *vector(
            "output", named(post, POSITION), "m", f"{given}.position", f"CO of {s} at the end of the step, in n",
            depends_on=(f"{s}.position",),
        ),
        *vector(
            "output", named(post, ATTITUDE), "rad", f"{given}.attitude",
            f"Attitude of {s} at the end of the step",
            depends_on=(f"{s}.attitude",),
        ),
        *vector(
            "output", named(post, VELOCITY), "m/s", f"{given}.velocity",
            f"Velocity of CO of {s} after impact, in b", depends_on=(f"{s}.velocity",),
        ),
        *vector(
            "output", named(post, RATE), "rad/s", f"{given}.rate", f"Angular velocity of {s} after impact, in b",
            depends_on=(f"{s}.rate",),
        ),
        *wrench(
            "output", named(s, IMPULSE), IMPULSE_UNITS, f"{given}.impulse",
            f"Cumulative impulse issued to {s}, in b", f"Moment about CO of the cumulative impulse issued to {s}, in b",
            depends_on=(),
        ),
        *wrench(
            "output", named(s, (*FORCE, *MOMENT)), FORCE_UNITS, f"{given}.force",
            f"Mean contact force on {s} over the last step, in b",
            f"Mean moment about CO of the contact forces on {s} over the last step, in b", depends_on=(),
        ),
    )  # fmt: skip


def _settings(settings: str, s: str) -> Table:
    return (
        string(
            "parameter", f"{s}.ship", f"{settings}.ship",
            f"Ship of {s}: a name in the FMU's resources or a TOML file",
        ),
        integer(
            "parameter", f"{s}.degrees_of_freedom", f"{settings}.degrees_of_freedom",
            "Degrees of freedom, as in the ship's own model; 3: surge, sway, yaw; 4: and roll; 6: all",
            minimum=3, maximum=6,
        ),
        real(
            "parameter", f"{s}.fender.stiffness", "N/m", f"{settings}.fender.stiffness", None,
            "Stiffness of a fender around the hull; 0: no fender", minimum=0.0,
        ),
        real(
            "parameter", f"{s}.fender.damping", "N.s/m", f"{settings}.fender.damping", None,
            "Damping of a fender around the hull", minimum=0.0,
        ),
        real(
            "parameter", f"{s}.fender.thickness", "m", f"{settings}.fender.thickness", None,
            "Distance from the hull within which its fender acts; 0: no fender", minimum=0.0,
        ),
    )  # fmt: skip


def _contacts(slots: int) -> Table:
    """The contact points of the step, from 1; unused slots are zero."""
    lines: list[Table] = [(
        boolean(
            "output", "contact.active", "outputs.contact_active",
            "Hulls touched in this step; a ship that a sequential master stopped rests up to one step's way off, see "
            "clearance", depends_on=(),
        ),
        integer(
            "output", "contact.count", "outputs.contact_count", "Contact points in this step, fenders' included",
            minimum=0, maximum=slots, depends_on=(),
        ),
    )]  # fmt: skip
    for k in range(slots):
        lines.append(_contact(contact_point(k + 1), f"outputs.contacts.{k}", slots))
    return tuple(line for block in lines for line in block)


def _contact(name: str, path: str, slots: int) -> Table:
    """A contact point; in FMI 3.0 a row of the arrays contact.*."""

    def each(field: str, description: str) -> Array:
        return Array(f"contact.{field}", (slots,), description)

    def point(field: str, components: tuple[str, ...], description: str) -> Array:
        return Array(f"contact.{field}", (slots, 3), f"{description}: {', '.join(components)}")

    def triple(group: str, components: tuple[str, ...], unit: str, at: str, description: str, field: str) -> Table:
        return vector(
            "output", named(group, components), unit, f"{path}.{at}", description, depends_on=(),
            array=point(field, components, description), jumps=True,
        )  # fmt: skip

    def value(field: str, unit: str, description: str, minimum: float | None = None) -> Variable:
        return real(
            "output", f"{name}.{field}", unit, f"{path}.{field}", None, description, depends_on=(),
            minimum=minimum, array=each(field, description), jumps=True,
        )  # fmt: skip

    def number(field: str, description: str, at: str | None = None) -> Variable:
        return integer(
            "output", f"{name}.{field}", f"{path}.{at or field}", description, minimum=0, depends_on=(),
            array=each(field, description),
        )  # fmt: skip

    return (
        *triple(name, NED, "m", "point", "Contact point in n", "position"),
        *triple(f"{name}.normal", NED, "1", "normal", "Unit normal from ship_a to ship_b in n", "normal"),
        value("gap", "m", "Gap, negative in overlap"),
        value("impulse_normal", "N.s", "Normal impulse over the step", minimum=0.0),
        value("impulse_tangential", "N.s", "Friction impulse over the step", minimum=0.0),
        value("energy", "J", "Energy dissipated over the step"),
        *triple(
            f"{name}.impulse", NED, "N.s", "impulse",
            "Impulse on ship_b in n over the step; ship_a takes the opposite", "impulse",
        ),
        *triple(f"{name}.a", AXES, "m", "r_a", "Contact point in b of ship_a", "a"),
        *triple(f"{name}.b", AXES, "m", "r_b", "Contact point in b of ship_b", "b"),
        number("ship_a", "First ship, from 1; 0: slot unused"),
        number("ship_b", "Second ship, from 1; beyond the ships: obstacles, in their order; 0: slot unused"),
        number("impact", "Number of the collision; 0: a fender acts, the hulls do not touch", "collision"),
        number("scratch", "Number of the scratch"),
    )  # fmt: skip


def _couples(slots: int) -> Table:
    """What place x impulse lacks of the moment of the contact points; in FMI 3.0 one array."""
    description = "Moment of the step's impulses on ship_b about the contact point, in n"
    array = Array("contact.couple", (slots, 3), f"{description}: {', '.join(NED)}")
    return tuple(
        line
        for k in range(slots)
        for line in vector(
            "output", named(f"{contact_point(k + 1)}.couple", NED), "N.m.s", f"outputs.contacts.{k}.couple",
            description, depends_on=(), array=array, jumps=True,
        )
    )  # fmt: skip


def _starts(slots: int) -> Table:
    """How the collision of each contact point began: of several that begin in one step, impact.* shows the last."""

    def value(k: int, field: str, unit: str, description: str, maximum: float | None = None) -> Variable:
        return real(
            "output", f"{contact_point(k + 1)}.{field}", unit, f"outputs.contacts.{k}.{field}", None, description,
            depends_on=(), minimum=None if field == "start" else 0.0, maximum=maximum,
            array=Array(f"contact.{field}", (slots,), description), jumps=True,
        )  # fmt: skip

    description = "First contact point of the collision in n"
    first = Array("contact.first", (slots, 3), f"{description}: {', '.join(NED)}")
    return tuple(
        line
        for k in range(slots)
        for line in (
            value(k, "start", "s", "Start of the collision of this contact point"),
            *vector(
                "output", named(f"{contact_point(k + 1)}.first", NED), "m", f"outputs.contacts.{k}.first", description,
                depends_on=(), array=first, jumps=True,
            ),
            value(k, "closing_speed", "m/s", "Closing speed along the normal at the start of the collision"),
            value(k, "angle", "rad", "Angle between the headings at the start of the collision", maximum=pi),
        )
    )  # fmt: skip


def _impact() -> Table:
    """The latest collision, and the scratch being drawn."""
    return (
        integer("output", "impact.count", "outputs.collision_count", "Collisions so far", minimum=0, depends_on=()),
        real(
            "output", "impact.time", "s", "outputs.impact.time", None, "Start of the latest collision", depends_on=(),
            jumps=True,
        ),
        *vector(
            "output", IMPACT_POINT, "m", "outputs.impact.point",
            "First contact point of the latest collision in n: where the explosion goes", depends_on=(),
            array=Array("impact.position", (3,), "First contact point of the latest collision in n: north, east, down"),
            jumps=True,
        ),
        real(
            "output", "impact.closing_speed", "m/s", "outputs.impact.closing_speed", None,
            "Closing speed along the normal at the first contact of the latest collision", minimum=0.0, depends_on=(),
            jumps=True,
        ),
        real(
            "output", "impact.angle", "rad", "outputs.impact.angle", None,
            "Angle between the headings at the latest collision, 0 (same) to pi (head-on)",
            minimum=0.0, maximum=pi, depends_on=(), jumps=True,
        ),
        integer(
            "output", "impact.ship_a", "outputs.impact.ship_a",
            "First ship of the latest collision, from 1", minimum=0, depends_on=(),
        ),
        integer(
            "output", "impact.ship_b", "outputs.impact.ship_b",
            "Second ship of the latest collision, from 1; beyond the ships: an obstacle", minimum=0, depends_on=(),
        ),
        integer(
            "output", "scratch.id", "outputs.scratch_id",
            "Scratch being drawn, 0 when nothing touches", minimum=0, depends_on=(),
        ),
    )  # fmt: skip


def _energy() -> Table:
    """Energy lost to contact and in fenders."""
    return (
        real(
            "output", "energy.dissipated", "J", "outputs.energy.dissipated", None,
            "Kinetic energy lost to contact since the start", depends_on=(),
        ),
        real(
            "output", "energy.normal", "J", "outputs.energy.normal", None,
            "Part of energy.dissipated lost along the contact normals", depends_on=(),
        ),
        real(
            "output", "energy.tangential", "J", "outputs.energy.tangential", None,
            "Part of energy.dissipated lost to friction", depends_on=(),
        ),
        real(
            "output", "fender.stored", "J", "outputs.fender.stored", None,
            "Kinetic energy that fenders hold now; not part of energy.*", minimum=0.0, depends_on=(),
        ),
        real(
            "output", "fender.dissipated", "J", "outputs.fender.dissipated", None,
            "Kinetic energy lost in fenders since the start; not part of energy.*", depends_on=(),
        ),
    )  # fmt: skip


def _solver() -> Table:
    """Accuracy of the contact solver."""
    return (
        real(
            "output", "solver.residual", "1", "outputs.solver.residual", None,
            "Largest violation of the contact law in this step, as a share of the approach speed", depends_on=(),
            nominal=1e-9, jumps=True,
        ),
        integer(
            "output", "solver.sweeps", "outputs.solver.sweeps", "Most solver sweeps of a contact problem in this step",
            minimum=0, depends_on=(),
        ),
        integer(
            "output", "solver.unconverged", "outputs.solver.unconverged",
            "Contact problems so far whose residual was above 1e-9", minimum=0, depends_on=(),
        ),
        integer(
            "output", "solver.scaled", "outputs.solver.scaled",
            "Contact problems so far whose impulses were scaled back so as not to add energy, by more than 0.1 mm/s of "
            "a ship's velocity", minimum=0, depends_on=(),
        ),
    )  # fmt: skip


def _clearance() -> Table:
    """The nearest pair."""
    return (
        real(
            "output", "clearance", "m", "outputs.clearance", None,
            "Least distance between hulls, and between hulls and obstacles, at most clearance_range",
        ),
        integer(
            "output", "nearest.ship_a", "outputs.nearest_ship_a",
            "First ship of the nearest pair, from 1; 0: no pair within clearance_range", minimum=0,
        ),
        integer(
            "output", "nearest.ship_b", "outputs.nearest_ship_b",
            "Second ship of the nearest pair; beyond the ships: an obstacle, in their order", minimum=0,
        ),
    )  # fmt: skip


def _parameters() -> Table:
    """Parameters of all pairs."""
    return (
        real(
            "parameter", "friction", "1", "parameters.friction", None,
            "Coulomb friction coefficient of the hulls", minimum=0.0, maximum=MAXIMUM_FRICTION,
        ),
        real(
            "parameter", "restitution", "1", "parameters.restitution", None,
            "Coefficient of restitution: normal speed after over normal speed before impact", minimum=0.0, maximum=1.0,
        ),
        real("parameter", "substep", "s", "parameters.substep", None, "Length of an internal step", minimum=0.0),
        real(
            "parameter", "minimum_separation_time", "s", "parameters.minimum_separation_time", None,
            "Time without contact after which the next contact is a new collision", minimum=0.0,
        ),
        real(
            "parameter", "clearance_range", "m", "parameters.clearance_range", None,
            "Largest clearance that is measured", minimum=0.0,
        ),
        enumeration("parameter", "response", tuple(RESPONSES), "parameters.response", "Solver of the contact problem"),
        enumeration(
            "parameter", "feedback", COMMON_FEEDBACKS, "parameters.feedback",
            "How the ship models respond: by impulse_applied, by force, by adopting post.*, or not at all",
        ),
        string(
            "parameter", "obstacles", "parameters.obstacles",
            "Fixed obstacles: TOML text with one table each, or the path of a TOML file; empty for none",
        ),
    )  # fmt: skip


def _coasting(i: int, s: str) -> Variable:
    """How a ship moves between impulses."""
    return enumeration(
        "parameter", f"{s}.coasting", COASTING, f"parameters.ships.{i}.coasting",
        f"Motion that is expected of {s} between impulses, as in the ship's own model: Kirchhoff's equations with "
        "restoring and damping; Kirchhoff's equations alone; or velocity and angular velocity constant in n",
    )  # fmt: skip


def _diagnosis(ships: int) -> Table:
    """What was found wrong with the wiring."""
    return (
        integer(
            "output", "diagnosis.code", "outputs.diagnosis.code",
            "0: nothing suspicious; else the number of the first finding about the wiring of a ship",
            minimum=0, maximum=len(FINDINGS), depends_on=(),
        ),
        integer(
            "output", "diagnosis.ship", "outputs.diagnosis.ship", "Ship of the first finding, from 1; 0: none",
            minimum=0, maximum=ships, depends_on=(),
        ),
        integer(
            "output", "diagnosis.count", "outputs.diagnosis.count", "Findings so far, each one a warning in the log",
            minimum=0, depends_on=(),
        ),
        string(
            "output", "diagnosis.text", "outputs.diagnosis.text", "Text of the first finding, with its remedy",
            depends_on=(),
        ),
    )  # fmt: skip


def _feedback(i: int, s: str) -> Table:
    """How one ship responds, where it is not as the others do."""
    return (
        enumeration(
            "parameter", f"{s}.feedback", SHIP_FEEDBACKS, f"parameters.ships.{i}.feedback",
            f"How the model of {s} responds: as the parameter feedback says; by impulse_applied, by force, by adopting "
            "post.*, or not at all; or prescribed: it follows its track, as if its mass were infinite",
        ),
        string(
            "parameter", f"{s}.feedback_name", f"parameters.ships.{i}.feedback_name",
            f"{s}.feedback as text, for hosts that do not pass enumerations; empty: {s}.feedback holds",
        ),
    )  # fmt: skip


def _frames(i: int, s: str) -> Table:
    """For a ship model that speaks n. Text, since not all hosts pass enumerations."""
    return (
        string(
            "parameter", f"{s}.velocity_frame", f"frames.{i}.velocity",
            f'Frame of {s}.velocity and {s}.rate: "b", or "n" where surge, sway, heave hold north, east, down',
        ),
        string(
            "parameter", f"{s}.force_frame", f"frames.{i}.force",
            f'Frame of {s}.force and {s}.moment: "b", or "n" where surge, sway, heave hold north, east, down',
        ),
    )  # fmt: skip


INTERFACE = Interface(
    name="ShipCollision",
    description="Ships collide: states in, post-impact states, impulses, contact points and energy out.",
    table=table,
    model=FramedCollision,
    tolerance=1e-9,  # residual to which contact problems are solved
    requirements=(*REQUIREMENTS, "pybullet>=3.2.5; python_version < '3.12'"),  # it has wheels for no later one
    instead="With CPython 3.12 and later: shipcollision_fmu, installed there, whose own library detects contacts.",
    systems=("linux",),
    terminals=lambda ships: {ship: f"{ship}." for ship in ships},
)
