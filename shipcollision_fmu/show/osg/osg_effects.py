"""The effects in OpenSceneGraph: its own four particle effects, and the sprite that they are drawn with.

They stand in the ship's z-up body axes and move with her. StartTime counts from the first frame, as an AnimationPath's
time does; all sizes and speeds scale with Scale.

Each effect is given a particle system of its own, in a Geode beside it. Left to make one itself it emits at Position
*in the world*, wherever its parents are (OSG 3.6: ModularEmitter with an absolute reference frame carries each new
particle over by the inverse of the system's world matrix); given one, it emits relative to its own place.

Their defaults name pictures (Images/smoke.rgb, Images/particle.rgb) that OSG's packages do not bring: it complains and
draws squares. The soft sprite under those names too keeps it quiet. SmokeEffect is white; a grey sprite makes it smoke.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..scene.effects import Effect
from . import zup
from .osgt import Item, Raw, number, numbers, quoted

__all__ = ["SPRITE", "effect_items", "sprite_files"]

SPRITE = "soft.png"
SMOKE = "smoke.png"
DEFAULTS = ("Images/smoke.rgb", "Images/particle.rgb")
SIZE = 64
"""Width and height of the sprite [pixels]."""

_CLASSES = {
    "explosion": "ExplosionEffect", "debris": "ExplosionDebrisEffect", "fire": "FireEffect", "smoke": "SmokeEffect",
}  # fmt: skip
_SCALE = {"explosion": 2.2, "debris": 1.5, "fire": 4.5, "smoke": 3.5}
"""OSG's Scale per metre of an effect's size: so much smaller are its puffs than those of the other pictures."""


def effect_items(effects: Sequence[Effect], delay: float) -> list[Item]:
    """Children of a ship's transform: her effects. `delay` [s]: how much later than in the run things happen here."""
    systems = [Item("osgParticle::ParticleSystem") for _ in effects]
    emitters = [_emitter(effect, system, delay) for effect, system in zip(effects, systems, strict=True)]
    return [*emitters, Item("osg::Geode", Name=quoted("particles"), Drawables=systems)] if emitters else []


def _emitter(effect: Effect, system: Item, delay: float) -> Item:
    return Item(
        f"osgParticle::{_CLASSES[effect.kind]}",
        ParticleSystem=Raw("{\n{}\n}", system),
        TextureFileName=quoted(SMOKE if effect.kind == "smoke" else SPRITE),
        Position=numbers(np.round(zup.places(effect.point), 4)),
        Scale=Raw(number(_SCALE[effect.kind] * effect.size)),
        Intensity=Raw(number(max(effect.intensity, 0.25))),
        StartTime=Raw(number(effect.time + delay)),
        EmitterDuration=Raw(number(effect.duration)),
    )


def sprite_files() -> dict[str, bytes]:
    """The sprite by file name: as PNG, and as the SGI pictures that OSG looks for by default."""
    pixels = _sprite(255)
    return {SPRITE: _png(pixels), SMOKE: _png(_sprite(80, 0.6)), **dict.fromkeys(DEFAULTS, _sgi(pixels))}


def _sprite(grey: int, density: float = 1.0) -> npt.NDArray[np.uint8]:
    """Of one grey, its opacity falling smoothly to nothing at the edge; (SIZE, SIZE, 4)."""
    u = (np.arange(SIZE) + 0.5) / SIZE * 2.0 - 1.0
    inside = np.clip(1.0 - np.hypot(*np.meshgrid(u, u)), 0.0, 1.0)
    pixels = np.full((SIZE, SIZE, 4), grey, dtype=np.uint8)
    pixels[..., 3] = np.round(255.0 * density * inside**2 * (3.0 - 2.0 * inside))
    return pixels


def _png(pixels: npt.NDArray[np.uint8]) -> bytes:
    """PNG of RGBA pixels. W3C PNG specification, sections 5 and 11."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)  # 0: the row is not filtered
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def _sgi(pixels: npt.NDArray[np.uint8]) -> bytes:
    """SGI picture of RGBA pixels, not packed: a header of 512 bytes, then planes from the lowest row up."""
    height, width, planes = pixels.shape
    header = struct.pack(">hBBHHHHii4x80si404x", 474, 0, 1, 3, width, height, planes, 0, 255, b"", 0)
    return header + np.ascontiguousarray(np.moveaxis(pixels[::-1], 2, 0)).tobytes()
