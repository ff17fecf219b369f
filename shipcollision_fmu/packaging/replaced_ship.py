"""A foreign ship in a system: its FMU as an instance, its connections, and what the collision must know of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..cosim.component import Value
from ..fmi.interface import Interface
from ..fmi.names import FORCE, MOMENT
from ..fmi.ship_manoeuvring import INTERFACE as SHIP_INTERFACE
from ..fmi.variable_access import Model
from ..fmi.variables import Variable
from ..scenario.tables.ship_start import StartState
from .foreign_ship import ForeignShip
from .instance import COLLISION, Connection, Instance

__all__ = ["build_replaced_ship", "connect_replaced_ship", "describe_replaced_ship", "list_frames"]


@dataclass(frozen=True)
class _ForeignInstance(Instance):
    """An instance whose FMU is somebody else's file."""

    data: bytes = b""

    def build_fmu(self) -> bytes:
        """The file as it is."""
        return self.data


def build_replaced_ship(name: str, foreign: ForeignShip, ships: tuple[str, ...]) -> Instance:
    """The instance of a foreign ship."""
    ours = {line.name: line for line in SHIP_INTERFACE.table(())}
    table = tuple(
        Variable(theirs, "Real", ours[our].causality, "", None, ours[our].description, ours[our].unit)
        for our, theirs in foreign.names.items()
    )
    start = {variable: value for variable, (_, value) in foreign.start.items()}
    given = tuple(
        Variable(variable, kind, "parameter", "", None, "", "1" if kind == "Real" else None)
        for variable, (kind, _) in foreign.start.items()
    )
    interface = Interface(
        foreign.file.stem, foreign.description, lambda ships: (*table, *given), lambda ships: _no_model()
    )
    return _ForeignInstance(name, interface, ships, start, tuple(start), {}, data=foreign.data)


def connect_replaced_ship(name: str, foreign: ForeignShip) -> list[Connection]:
    """State to the collision, force from it."""
    there = {our: (COLLISION, f"{name}.{our}") for our in foreign.names}
    return [
        Connection(*there[our], name, theirs) if our in (*FORCE, *MOMENT) else Connection(name, theirs, *there[our])
        for our, theirs in foreign.names.items()
    ]


def list_frames(name: str, foreign: ForeignShip) -> dict[str, Value]:
    """Parameters of the collision: it answers by force, in the frame of the ship."""
    return {
        f"{name}.feedback": "force",
        f"{name}.velocity_frame": foreign.velocity_frame,
        f"{name}.force_frame": foreign.force_frame,
    }


def describe_replaced_ship(
    name: str, foreign: ForeignShip, parameters: Mapping[str, object], start: StartState
) -> tuple[str, ...]:
    """What the package cannot know of a foreign ship. start: that of the scenario, in n and b."""
    known = (
        f"{name} is {foreign.file.name}, coupled by force: its orders are its own, its start values those of the file "
        f"and of [start], its mass and inertia must be those of {parameters[f'{name}.ship']}."
    )
    if foreign.start:
        return (known,)
    wiring = foreign.file.with_suffix(".toml").name
    values = (
        f"north {start.position[0]:.6g} m, east {start.position[1]:.6g} m, yaw {start.attitude[2]:.6g} rad, surge "
        f"{start.velocity[0]:.6g} m/s" + (f", sway {start.velocity[1]:.6g} m/s" if start.velocity[1] else "")
    )
    return known, (
        f"The scenario starts {name} at {values}: give these in [start] of {wiring}, by the parameter names of "
        f"{foreign.file.name}, or it starts elsewhere."
    )


def _no_model() -> Model:
    raise NotImplementedError("a foreign ship has no model here")
