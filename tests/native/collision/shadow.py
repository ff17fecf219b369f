"""Shadow: a native collision model that is given what a Python model is given, and compared with it after each step."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from shipcollision_fmu.collision.interface import CollisionOutputs
from shipcollision_fmu.collision.model import ShipCollision
from tests.native.collision.kernels import load_kernels
from tests.native.native_collision import STATE, NativeCollision

__all__ = ["Shadow"]

WHOLE = ("contact_active", "contact_count", "collision_count", "scratch_id", "nearest_ship_a", "nearest_ship_b")
LEAST_IMPULSE, LEAST_ENERGY = 1e3, 1e3
"""Impulses [N s] and energies [J] below which a difference is one of rounding: 1 kN s moves no ship by 1 mm/s."""


class Shadow:
    """The native twin of a Python model with the same parameters and inputs, from its initialisation on."""

    def __init__(self, model: ShipCollision, library: ctypes.CDLL | None = None) -> None:
        self.python, self.native = model, NativeCollision(library or load_kernels(), model.names)
        self.native.parameters = model.parameters
        self.issued: list[dict[tuple[float, ...], list[float]]] = [{(0.0,) * 6: [0.0] * 6} for _ in model.names]
        """By ship, what the native model had issued when the Python model had issued so much."""
        self.give_inputs()
        self.native.initialise()

    def give_inputs(self) -> None:
        """What the Python model is given. Of impulses that were issued and applied the native model gets its own: they
        differ in their last bits, and what is pending must be zero to the bit where it is zero."""
        for i, (ship, given) in enumerate(zip(self.native.inputs.ships, self.python.inputs.ships, strict=True)):
            for name in STATE:
                getattr(ship, name)[:] = getattr(given, name)
            applied = tuple(given.impulse_applied)
            ship.impulse_applied[:] = self.issued[i].get(applied, applied)

    def step(self, t: float, H: float) -> None:
        """The step of the native model, after that of the Python model from the inputs of give_inputs()."""
        self.native.step(t, H)
        for issued, own, twin in zip(self.issued, self.native.outputs.ships, self.python.outputs.ships, strict=True):
            issued[tuple(twin.impulse)] = list(own.impulse)

    def compare(self) -> dict[str, float]:
        """Differences of the outputs as shares of their scale, by name; of whole numbers and words 1."""
        own, twin = self.native.outputs, self.python.outputs
        found = {name: float(getattr(own, name) != getattr(twin, name)) for name in WHOLE}
        found["words"] = float(self.native.warning != self.python.warning or self.native.events != self.python.events)
        found["diagnosis"] = float(own.diagnosis != twin.diagnosis)
        impulses = [[ship.impulse for ship in out.ships] for out in (own, twin)]
        found["impulse"] = differ(*impulses, LEAST_IMPULSE)
        found["state"] = differ(*(list_motions(out) for out in (own, twin)), 1.0)
        found["clearance"] = differ(own.clearance, twin.clearance, 1.0)
        energies = [[out.energy.dissipated, out.energy.normal, out.energy.tangential] for out in (own, twin)]
        found["energy"] = differ(*energies, LEAST_ENERGY)
        found["fender"] = differ(*([out.fender.stored, out.fender.dissipated] for out in (own, twin)), LEAST_ENERGY)
        return found


def list_motions(out: CollisionOutputs) -> list[Any]:
    return [[*ship.position, *ship.attitude, *ship.velocity, *ship.rate] for ship in out.ships]


def differ(own: Any, twin: Any, least: float) -> float:
    """Largest difference as a share of the largest number, or of `least`."""
    a, b = np.asarray(own, dtype=float), np.asarray(twin, dtype=float)
    return float(np.abs(a - b).max() / max(np.abs(b).max(), least))
