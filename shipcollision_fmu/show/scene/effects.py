"""The effects at the first contact point of each scratch, for pictures.

    dust, splash                       of every scratch: from the plating, and at the waterline below
    explosion, debris, fire, smoke     of Guan et al. 2014, of a scratch that dissipates enough energy (IGNITION)

Only place, time and strength come from the run; the rest is for the eye. Effects move with the struck ship, the ship
whose contact point is farther aft.

    intensity = (E / E_FULL)^(1/3), within [FAINTEST, 1]      E: energy dissipated along the scratch [J]

since the size of a blast grows with the cube root of its energy (Hopkinson 1915). A scratch without dissipation is a
faint puff.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...ship.frames import Array
from ...ship.ship_type import find_ship_type
from .run_folder import RunFolder
from .scratches import Scratch

__all__ = ["Effect", "EffectKind", "find_ignition", "make_effects", "point_outwards"]

EffectKind = Literal["explosion", "debris", "fire", "smoke", "dust", "splash"]

E_FULL = 1e9
"""[J] Energy of an effect at full strength; few collisions dissipate more. Larger values make all smaller."""
FAINTEST = 0.023
"""Least intensity; with zero a scratch would have no visible effect."""
IGNITION = 5.0e7
"""[J] Least energy along a scratch with explosion and fire, of dry cargo ships: half of what the published encounter
dissipates. A lower value sets ships on fire that touch gently. It is a choice for pictures, not a model of ignition."""
IGNITION_OF_OIL_AND_GAS = 3.27e7
"""[J] The same where a tanker or a gas carrier takes part: 32.7 MJ, the energy that Minorsky (1959) found to be spent
before a ship's side is opened to a depth. Cargo can burn from then on."""
OIL_AND_GAS = ("tanker, loaded", "tanker, in ballast", "liquefied natural gas tanker")
"""Types of ship whose cargo, or what is left of it in empty tanks, burns."""
LARGEST = 13.0
"""[m] Size at full strength; sizes and speeds of the particles scale with it."""
KINDS: dict[EffectKind, tuple[float, float]] = {
    "explosion": (0.0, 1.5), "debris": (0.0, 1.5), "fire": (0.6, 54.0), "smoke": (0.9, 130.0),
    "dust": (0.0, 2.6), "splash": (0.0, 2.2),
}  # fmt: skip
"""Delay after the contact and duration of the emission at full strength [s], by kind."""


@dataclass(frozen=True, eq=False)
class Effect:
    """An effect: kind, the ship it moves with, its point (3,) and outward direction (3,) in b [m], start [s].

    `duration` of the emission [s], `intensity` in (0, 1], `size` [m], with which the particles scale.
    `seed` is the same in every picture of the run.
    """

    kind: EffectKind
    ship: str
    scratch: int
    point: Array
    outwards: Array
    time: float
    duration: float
    intensity: float
    size: float
    seed: int


def make_effects(run: RunFolder, scratches: tuple[Scratch, ...]) -> tuple[Effect, ...]:
    """The effects of all scratches in events.json, in order of time."""
    lengths = {name: body.L_pp for name, body in run.bodies.ships.items()}
    number, energy = run.contacts["scratch"].astype(int), run.contacts["energy"]
    found = []
    for event in run.events.scratches:
        borne = [scratch for scratch in scratches if scratch.id == event.id]
        scratch_on_ship = min(borne, key=lambda scratch: scratch.points[0, 0] / lengths[scratch.ship])
        dissipated = float(energy[number == event.id].sum())
        intensity = float(np.clip(np.cbrt(max(dissipated, 0.0) / E_FULL), FAINTEST, 1.0))
        burns = dissipated >= find_ignition(run, event.ship_a, event.ship_b)
        for k, (kind, (delay, duration)) in enumerate(KINDS.items()):
            if kind not in ("dust", "splash") and not burns:
                continue
            found.append(
                Effect(
                    kind,
                    scratch_on_ship.ship,
                    event.id,
                    scratch_on_ship.points[0],
                    point_outwards(scratch_on_ship.normals[0], scratch_on_ship.points[0]),
                    event.start + delay * intensity,
                    duration * intensity,
                    intensity,
                    LARGEST * intensity,
                    len(KINDS) * event.id + k,
                )
            )
    return tuple(sorted(found, key=lambda effect: (effect.time, effect.seed)))


def point_outwards(normal: Array, point: Array) -> Array:
    """The direction in which a point of a hull bursts open: its normal, and at the bottom that of the side above it.

    Ships often touch first along the keel, where the nearest face may be the bottom.
    """
    return normal if abs(normal[2]) < 0.9 else np.array([0.0, np.copysign(1.0, point[1]), 0.0])


def find_ignition(run: RunFolder, *names: str) -> float:
    """Least energy [J] of an explosion between the named ships; obstacles carry no cargo."""
    types = [find_ship_type(run.bodies.ships[name].kind).name for name in names if name in run.bodies.ships]
    return IGNITION_OF_OIL_AND_GAS if any(name in OIL_AND_GAS for name in types) else IGNITION
