"""What makes the components of a run: the models in process, or instances of FMUs. An ExitStack closes all of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack, closing
from pathlib import Path

from ..fmi.interface import SHIPS, Interface
from ..fmi.ship_collision import INTERFACE as COLLISION
from ..fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from .component import Component, InProcessComponent
from .fmi2_component import Fmi2Component
from .fmi3_component import Fmi3Component
from .fmu_instance import UnpackedFmu

__all__ = ["Factories", "MakeCollision", "MakeShip", "fmu_factories", "model_factories"]

MakeShip = Callable[[str], Component]
"""Makes the component of the ship of that name."""
MakeCollision = Callable[[], Component]
Factories = tuple[MakeShip, MakeCollision]


def model_factories(ships: tuple[str, ...], stack: ExitStack) -> Factories:
    """Factories of components that are the models themselves, for ships of these names."""

    def make_ship(name: str) -> Component:
        return stack.enter_context(closing(InProcessComponent(name, MANOEUVRING.make_access())))

    def make_collision() -> Component:
        return stack.enter_context(closing(InProcessComponent("collision", COLLISION.make_access(ships))))

    return make_ship, make_collision


def fmu_factories(
    fmus: Mapping[str, Path], stack: ExitStack, ships: tuple[str, ...] = SHIPS, fmi: int = 2
) -> Factories:
    """Factories of instances of the files "ShipManoeuvring" and "ShipCollision", each unpacked once.

    FMUs of FMI 3.0 must have been built for `ships`.
    """
    unpacked = {name: stack.enter_context(closing(UnpackedFmu(path))) for name, path in fmus.items()}

    def make(name: str, interface: Interface) -> Component:
        fmu = unpacked[interface.name]
        if fmi == 3:
            return stack.enter_context(closing(Fmi3Component(name, fmu, interface.table(ships))))
        return stack.enter_context(closing(Fmi2Component(name, fmu)))

    return lambda name: make(name, MANOEUVRING), lambda: make("collision", COLLISION)
