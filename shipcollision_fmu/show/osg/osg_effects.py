"""The effects as OpenSceneGraph's own four particle effects, and their sprites.

They are in the ship's z-up body axes and move with the ship. StartTime counts from the first frame, like the time of an
AnimationPath; all sizes and speeds scale with Scale. OSG has no dust and no spray: a scratch without fire has none.

Each effect has its own particle system, in a Geode beside it, and then emits relative to its own place. Without one OSG
3.6 makes a system that emits at Position *in the world*, wherever the effect's parents are: ModularEmitter with an
absolute reference frame transforms each new particle by the inverse of the system's world matrix.

The effects' defaults name pictures (Images/smoke.rgb, Images/particle.rgb) that OSG's packages do not contain; OSG then
prints a warning and draws squares. Our soft sprite has these names too. SmokeEffect is white: its sprite is grey.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..scene.effects import Effect
from . import zup
from .osgt import Item, Raw, format_number, format_numbers, quote

__all__ = ["SPRITE", "build_effects", "build_sprites"]

SPRITE = "soft.png"
SMOKE = "smoke.png"
DEFAULTS = ("Images/smoke.rgb", "Images/particle.rgb")
SIZE = 64
"""Width and height of the sprite [pixels]."""

_CLASSES = {
    "explosion": "ExplosionEffect", "debris": "ExplosionDebrisEffect", "fire": "FireEffect", "smoke": "SmokeEffect",
}  # fmt: skip
_SCALE = {"explosion": 2.2, "debris": 1.5, "fire": 4.5, "smoke": 3.5}
"""OSG's Scale per metre of an effect's size; it makes OSG's puffs as large as those of the other pictures."""


def build_effects(effects: Sequence[Effect], delay: float) -> list[Item]:
    """Children of a ship's transform: its effects. delay: of all times after the run's [s]."""
    effects = [effect for effect in effects if effect.kind in _CLASSES]
    systems = [Item("osgParticle::ParticleSystem") for _ in effects]
    emitters = [_build_emitter(effect, system, delay) for effect, system in zip(effects, systems, strict=True)]
    return [*emitters, Item("osg::Geode", Name=quote("particles"), Drawables=systems)] if emitters else []


def _build_emitter(effect: Effect, system: Item, delay: float) -> Item:
    return Item(
        f"osgParticle::{_CLASSES[effect.kind]}",
        ParticleSystem=Raw("{\n{}\n}", system),
        TextureFileName=quote(SMOKE if effect.kind == "smoke" else SPRITE),
        Position=format_numbers(np.round(zup.convert_vectors(effect.point), 4)),
        Scale=Raw(format_number(_SCALE[effect.kind] * effect.size)),
        Intensity=Raw(format_number(max(effect.intensity, 0.25))),
        StartTime=Raw(format_number(effect.time + delay)),
        EmitterDuration=Raw(format_number(effect.duration)),
    )


def build_sprites() -> dict[str, bytes]:
    """The sprite by file name: as PNG, and as the SGI pictures that OSG looks for by default."""
    pixels = _draw_sprite(255)
    return {
        SPRITE: _encode_png(pixels),
        SMOKE: _encode_png(_draw_sprite(80, 0.6)),
        **dict.fromkeys(DEFAULTS, _encode_sgi(pixels)),
    }


def _draw_sprite(grey: int, density: float = 1.0) -> npt.NDArray[np.uint8]:
    """Of one grey, its opacity falling smoothly to nothing at the edge; (SIZE, SIZE, 4)."""
    u = (np.arange(SIZE) + 0.5) / SIZE * 2.0 - 1.0
    inside = np.clip(1.0 - np.hypot(*np.meshgrid(u, u)), 0.0, 1.0)
    pixels = np.full((SIZE, SIZE, 4), grey, dtype=np.uint8)
    pixels[..., 3] = np.round(255.0 * density * inside**2 * (3.0 - 2.0 * inside))
    return pixels


def _encode_png(pixels: npt.NDArray[np.uint8]) -> bytes:
    """PNG of RGBA pixels. W3C PNG specification, sections 5 and 11."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)  # 0: the row is not filtered
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def _encode_sgi(pixels: npt.NDArray[np.uint8]) -> bytes:
    """SGI picture of RGBA pixels, not packed: a header of 512 bytes, then planes from the lowest row up."""
    height, width, planes = pixels.shape
    header = struct.pack(">hBBHHHHii4x80si404x", 474, 0, 1, 3, width, height, planes, 0, 255, b"", 0)
    return header + np.ascontiguousarray(np.moveaxis(pixels[::-1], 2, 0)).tobytes()
