"""Two master algorithms for ships and the collision between them.

    gauss-seidel    collision first, on the ships' states at t; its impulses reach the ships before they step, so that
                    the impact predicted for [t, t + h] is applied at t and hulls do not overlap
    jacobi          everything is exchanged first, then all step: impulses reach the ships with a one-step delay, and
                    hulls overlap by about closing speed x h

Neither algorithm loses or repeats an impulse, because the collision FMU keeps a ledger of issued and applied impulses.
Both keep momentum to rounding. Under the parallel one a ship has turned by its rate times h before the impulse reaches
it, so the collision FMU expresses the impulse for the pose at which the ship applies it.

Connections are data: a Wire is a group of outputs and a group of inputs on one buffer. After the initialisation and
after every step all wires hold the outputs of that communication point, and a recorder reads them there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .component import Component, Group

__all__ = ["ALGORITHMS", "System", "Wire", "gauss_seidel", "jacobi"]


@dataclass(frozen=True)
class Wire:
    """A connection: `inputs` are written from the buffer that `outputs` are read into."""

    outputs: Group
    inputs: Group

    @classmethod
    def between(cls, source: Component, outputs: Sequence[str], target: Component, inputs: Sequence[str]) -> Wire:
        """Connect Real outputs of `source` with Real inputs of `target`, in this order."""
        group = source.reals(outputs)
        return cls(group, target.reals(inputs, group.values))


@dataclass(frozen=True)
class System:
    """Ships, the collision between them, and their wires: `states` from ships to collision, `answers` back."""

    ships: Sequence[Component]
    collision: Component
    states: Sequence[Wire]
    answers: Sequence[Wire]


def gauss_seidel(system: System, t: float, h: float) -> None:
    """One communication step [t, t + h], sequential: the collision, then the ships."""
    _send(system.states)
    system.collision.step(t, h)
    _fetch(system.answers)
    _send(system.answers)
    for ship in system.ships:
        ship.step(t, h)
    _fetch(system.states)


def jacobi(system: System, t: float, h: float) -> None:
    """One communication step [t, t + h], parallel: all outputs of t are exchanged, then all step."""
    _send(system.states)
    _send(system.answers)
    system.collision.step(t, h)
    for ship in system.ships:
        ship.step(t, h)
    _fetch(system.answers)
    _fetch(system.states)


ALGORITHMS: dict[str, Callable[[System, float, float], None]] = {"gauss-seidel": gauss_seidel, "jacobi": jacobi}


def _send(wires: Sequence[Wire]) -> None:
    for wire in wires:
        wire.inputs.write()


def _fetch(wires: Sequence[Wire]) -> None:
    for wire in wires:
        wire.outputs.read()
