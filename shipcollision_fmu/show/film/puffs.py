"""Explosion, fire, debris, smoke, dust and splash as soft puffs, each a pure function of time, which may run backwards.

A puff is born at a fixed age of its effect, drifts, grows, fades and dies. Its randomness comes from a generator with
the effect's seed, so that every visit to a time gives the same picture. Offsets are in the axes of n from the effect's
origin, which moves with the ship; lengths and speeds are in units of the effect's `size` [m].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...ship.frames import Array
from ..scene.effects import Effect, EffectKind

__all__ = ["Puffs", "make_puffs"]

GRAVITY = 9.81
"""[m/s2]"""


@dataclass(frozen=True)
class Puffs:
    """k puffs: offset (k, 3) in n [m], radius (k,) [m], colour (k, 3), opacity (k,), and glow (k,): the share of the
    colour that is light of its own, added to what is behind, instead of covering it."""

    offset: Array
    radius: Array
    colour: Array
    opacity: Array
    glow: Array


@dataclass(frozen=True)
class _Kind:
    """Motion and look of an effect's puffs; [size] is the effect's size, ramps run from birth to death."""

    rate: float  # of births, in the time given by `within` or by the effect's duration [1/s]
    within: float | None
    life: float  # of each, give or take a third [s]
    speed: float  # at birth [size/s], slowing down over `life`
    spread: float  # of the directions: 0 straight up, 1 all over the upper half
    rise: float  # steady [size/s]
    fall: float  # share of gravity
    radius: tuple[float, ...]  # [size]
    opacity: tuple[float, ...]
    glow: tuple[float, ...]
    colours: tuple[tuple[float, float, float], ...]


_FLAME = ((1.0, 0.97, 0.80), (1.0, 0.72, 0.20), (0.92, 0.30, 0.05), (0.34, 0.06, 0.03))
_RUST = ((0.42, 0.36, 0.32), (0.52, 0.48, 0.45))
_SPRAY = ((0.94, 0.97, 0.98), (0.86, 0.92, 0.95))
_GREY = ((0.06, 0.055, 0.05), (0.22, 0.22, 0.23), (0.46, 0.47, 0.48))

_KINDS: dict[EffectKind, _Kind] = {
    "explosion": _Kind(220.0, 0.35, 1.5, 4.4, 1.0, 0.4, 0.0, (0.6, 2.2, 2.6), (0.0, 0.9, 0.6, 0.0), (0.8, 0.3), _FLAME),
    "fire": _Kind(26.0, None, 1.5, 0.7, 0.8, 1.6, 0.0, (1.0, 0.35), (0.0, 0.8, 0.0), (0.75, 0.5), _FLAME),
    "debris": _Kind(500.0, 0.15, 3.4, 8.0, 0.9, 0.0, 1.0, (0.13, 0.09), (1.0, 1.0, 0.6), (0.3, 0.0), _FLAME[1:]),
    "smoke": _Kind(11.0, None, 7.5, 0.6, 0.9, 1.25, 0.0, (0.8, 3.6), (0.0, 0.45, 0.3, 0.0), (0.0, 0.0), _GREY),
    "dust": _Kind(60.0, 0.5, 1.6, 2.2, 1.0, 0.3, 0.0, (0.4, 1.7), (0.0, 0.4, 0.0), (0.0, 0.0), _RUST),
    "splash": _Kind(160.0, 0.5, 1.5, 5.0, 0.6, 0.0, 1.0, (0.18, 0.6), (0.7, 0.45, 0.0), (0.0, 0.0), _SPRAY),
}
"""The four effects of Guan et al. 2014, then those of every contact."""


def make_puffs(effect: Effect, time: float) -> Puffs:
    """The puffs of an effect at `time` [s] of the run; none before it begins."""
    kind = _KINDS[effect.kind]
    window = effect.duration if kind.within is None else kind.within
    count = max(8, round(kind.rate * window))
    rng = np.random.default_rng(effect.seed)
    born = np.sort(rng.uniform(0.0, window, count))
    life = kind.life * rng.uniform(2 / 3, 4 / 3, count)
    round_, up = rng.uniform(0.0, 2 * np.pi, count), 1.0 - kind.spread * rng.uniform(0.0, 1.0, count)
    pace = rng.uniform(0.15, 1.0, count)
    grown = time - effect.time - born
    alive = (grown >= 0.0) & (grown < life)
    grown, life, round_, up, pace = (values[alive] for values in (grown, life, round_, up, pace))
    share = grown / life
    flat = np.sqrt(1.0 - up**2)
    way = effect.size * kind.speed * pace * 0.5 * life * (1.0 - (1.0 - share) ** 2)  # slows down to rest
    offset = way[:, None] * np.column_stack([flat * np.cos(round_), flat * np.sin(round_), -up])
    offset[:, 2] += 0.5 * kind.fall * GRAVITY * grown**2 - effect.size * kind.rise * grown
    return Puffs(
        offset,
        effect.size * _interpolate(share, kind.radius),
        np.column_stack([_interpolate(share, channel) for channel in zip(*kind.colours, strict=True)]),
        _interpolate(np.sqrt(share), kind.opacity),
        _interpolate(share, kind.glow),
    )


def _interpolate(share: Array, stops: Sequence[float]) -> Array:
    ramp: Array = np.interp(share, np.linspace(0.0, 1.0, len(stops)), stops)
    return ramp
