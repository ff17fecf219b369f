"""The four effects of Guan et al. 2014 at the first contact point of each scratch: explosion, debris, fire, smoke.

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
from .run_folder import RunFolder
from .scratches import Scratch

__all__ = ["Effect", "EffectKind", "make_effects"]

EffectKind = Literal["explosion", "debris", "fire", "smoke"]

E_FULL = 1e8
"""[J] Energy of an effect at full strength; a larger value makes every effect smaller."""
FAINTEST = 0.05
"""Least intensity; with zero a scratch would have no visible effect."""
LARGEST = 6.0
"""[m] Size at full strength; sizes and speeds of the particles scale with it."""
KINDS: dict[EffectKind, tuple[float, float]] = {
    "explosion": (0.0, 1.0), "debris": (0.0, 1.0), "fire": (0.4, 25.0), "smoke": (0.8, 60.0),
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
    """Four effects per scratch in events.json, in order of time."""
    lengths = {name: body.L_pp for name, body in run.bodies.ships.items()}
    number, energy = run.contacts["scratch"].astype(int), run.contacts["energy"]
    found = []
    for event in run.events.scratches:
        borne = [scratch for scratch in scratches if scratch.id == event.id]
        scratch_on_ship = min(borne, key=lambda scratch: scratch.points[0, 0] / lengths[scratch.ship])
        dissipated = float(energy[number == event.id].sum())
        intensity = float(np.clip(np.cbrt(max(dissipated, 0.0) / E_FULL), FAINTEST, 1.0))
        for k, (kind, (delay, duration)) in enumerate(KINDS.items()):
            found.append(
                Effect(
                    kind,
                    scratch_on_ship.ship,
                    event.id,
                    scratch_on_ship.points[0],
                    scratch_on_ship.normals[0],
                    event.start + delay * intensity,
                    duration * intensity,
                    intensity,
                    LARGEST * intensity,
                    4 * event.id + k,
                )
            )
    return tuple(sorted(found, key=lambda effect: (effect.time, effect.seed)))
