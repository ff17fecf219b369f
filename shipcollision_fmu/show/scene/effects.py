"""The four effects of Guan et al. 2014 at the first contact point of each scratch: explosion, debris, fire, smoke.

They are made up for the eye; only their place, time and strength come from the run. They sit on the ship that is
struck, that which was touched less far forward, and move with her.

    intensity = (E / E_FULL)^(1/3), within [FAINTEST, 1]      E: energy dissipated along the scratch [J]

as the size of a blast grows with its energy (Hopkinson 1915); a scratch that dissipated nothing is a faint puff.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...ship.frames import Array
from .run_folder import RunFolder
from .scratches import Scratch

__all__ = ["Effect", "EffectKind", "effects_of"]

EffectKind = Literal["explosion", "debris", "fire", "smoke"]

E_FULL = 1e8
"""Energy [J] of an effect at full strength."""
FAINTEST = 0.05
LARGEST = 6.0
"""Size [m] at full strength: what the sizes and speeds of the particles scale with."""
KINDS: dict[EffectKind, tuple[float, float]] = {
    "explosion": (0.0, 1.0), "debris": (0.0, 1.0), "fire": (0.4, 25.0), "smoke": (0.8, 60.0),
}  # fmt: skip
"""By kind: delay after the contact and, at full strength, time during which particles are sent out [s]."""


@dataclass(frozen=True, eq=False)
class Effect:
    """An effect: kind, the ship it moves with, its point (3,) and outward direction (3,) in b [m], start [s].

    `duration` [s] is how long it sends out particles, `intensity` in (0, 1], `size` [m] what their sizes scale with.
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


def effects_of(run: RunFolder, scratches: tuple[Scratch, ...]) -> tuple[Effect, ...]:
    """Four effects per scratch in events.json, in order of time."""
    lengths = {name: body.L_pp for name, body in run.bodies.ships.items()}
    number, energy = run.contacts["scratch"].astype(int), run.contacts["energy"]
    found = []
    for event in run.events.scratches:
        borne = [scratch for scratch in scratches if scratch.id == event.id]
        struck = min(borne, key=lambda scratch: scratch.points[0, 0] / lengths[scratch.ship])
        dissipated = float(energy[number == event.id].sum())
        intensity = float(np.clip(np.cbrt(max(dissipated, 0.0) / E_FULL), FAINTEST, 1.0))
        for k, (kind, (delay, duration)) in enumerate(KINDS.items()):
            found.append(
                Effect(
                    kind,
                    struck.ship,
                    event.id,
                    struck.points[0],
                    struck.normals[0],
                    event.start + delay * intensity,
                    duration * intensity,
                    intensity,
                    LARGEST * intensity,
                    4 * event.id + k,
                )
            )
    return tuple(sorted(found, key=lambda effect: (effect.time, effect.seed)))
