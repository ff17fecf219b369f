"""Convex parts of a solid that is not convex: cut in a process of its own, once, and kept in the user's cache.

CoACD (Wei et al. 2022, ACM Trans. Graph. 41(4)) cuts the solid along planes into parts whose convex hulls hold the
whole solid and little more (coacd_process.py). There are two reasons for a process. Once CoACD's library is loaded, an
FMU of a Python wrapper that is instantiated next waits for the interpreter for ever. And a process can be ended when it
takes too long.

    solid, options -> key -> user's cache, or a process -> parts, added volume, bulge

The cutting is seeded: the same solid gives the same parts, to the bit. A cached file that cannot be read is made anew.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from importlib import metadata
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from ...errors import HostError, ShipError, describe_installation
from ...files import user_cache, write_file
from ..frames import Array
from .convex import Indices, enclosed_volume, half_spaces, is_convex

__all__ = ["VOLUME_TOLERANCE", "Cut", "Part", "cut_into_convex_parts"]

VOLUME_TOLERANCE = 0.05
"""Largest volume that the convex parts may add to the solid, relative. More is a contact where there is no ship."""
BULGE_GOAL = 0.01
"""Bulge over B (how far a part stands out where the solid is hollow) at which the cutting is fine enough."""
CONCAVITIES = (0.03, 0.015)
"""CoACD's thresholds (a concavity over half the solid's length), from coarse to fine. From 0.01 on a ship falls into
dozens of parts, which takes half a minute and makes contact slow."""
CONVEX_WITHIN = 1e-3
"""A vertex may lie this far [m] before a face of a mesh that still counts as convex."""
SEED = 1
LONGEST_CUTTING = 300.0
"""Time [s] after which the cutting is ended and the mesh refused. A hull of 22 000 faces takes 45 s. Parts that pass
through each other take minutes, and give nothing of use."""

_log = logging.getLogger("shipcollision_fmu")

Part = tuple[Array, Indices]


@dataclass(frozen=True)
class Cut:
    """Convex meshes that together hold a solid; what they add to its volume, relative; how far they bulge [m]."""

    parts: tuple[Part, ...]
    volume_error: float = 0.0
    bulge: float = 0.0


def cut_into_convex_parts(name: str, vertices: Array, triangles: Indices, max_parts: int) -> Cut:
    """At most max_parts convex parts of a closed solid; the solid itself when it is convex.

    name: of the mesh file, for messages. Raises ShipError when the parts add too much or the cutting takes too long,
    HostError when CoACD is missing or fails.
    """
    if is_convex(vertices, triangles, CONVEX_WITHIN):
        return Cut(((vertices, triangles),))
    cut = _cut_once(name, vertices.tobytes(), triangles.tobytes(), max_parts)
    if cut.volume_error > VOLUME_TOLERANCE:
        raise ShipError(
            f"{name}: its {len(cut.parts)} convex parts hold {cut.volume_error:.1%} more than the solid, at most "
            f"{VOLUME_TOLERANCE:.0%}: raise max_parts = {max_parts}, or leave out what does not touch other ships "
            "(masts, railings, tanks)"
        )
    return cut


@lru_cache(maxsize=8)
def _cut_once(name: str, vertices: bytes, triangles: bytes, max_parts: int) -> Cut:
    """The cut solid, from memory, from the user's cache, or cut now."""
    solid = np.frombuffer(vertices).reshape(-1, 3), np.frombuffer(triangles, dtype=np.int64).reshape(-1, 3)
    if find_spec("coacd") is None:
        raise HostError(
            "coacd cannot be imported (it is not installed), and a hull that is not convex is cut into parts with it: "
            f"{describe_installation('mesh')}"
        )
    kept = user_cache() / "convex-parts" / f"{_compute_key(vertices, triangles, max_parts)}.npz"
    try:
        return _unpack(kept.read_bytes())
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):  # absent, or not what was written
        pass
    cut = _cut_solid(name, solid, max_parts)
    try:
        write_file(kept, _pack(cut), "its parts are cut again in every process until it is writable")
    except HostError as error:
        _log.warning("%s: %s", name, error)
    return cut


def _compute_key(vertices: bytes, triangles: bytes, max_parts: int) -> str:
    """Digest of all that the parts depend on."""
    options = (max_parts, CONCAVITIES, BULGE_GOAL, SEED, metadata.version("coacd"))
    return sha256(repr(options).encode() + sha256(vertices).digest() + sha256(triangles).digest()).hexdigest()[:32]


def _cut_solid(name: str, solid: Part, max_parts: int) -> Cut:
    """The solid cut at the first of CONCAVITIES that is fine enough, or at the one that bulges least."""
    volume, best = enclosed_volume(*solid), None
    _log.warning(
        "%s: is cut into convex parts, once for this file: %d faces, at most %g s", name, len(solid[1]), LONGEST_CUTTING
    )
    for threshold in CONCAVITIES:
        parts = _run_coacd(name, solid, threshold, max_parts)
        cut = Cut(parts, sum(enclosed_volume(*part) for part in parts) / volume - 1.0, _measure_bulge(solid[0], parts))
        if best is None or cut.bulge < best.bulge:
            best = cut
        if best.bulge <= BULGE_GOAL * float(np.ptp(solid[0][:, 1])):
            break
    assert best is not None
    return best


def _run_coacd(name: str, solid: Part, threshold: float, max_parts: int) -> tuple[Part, ...]:
    """Parts that a process with CoACD cuts the solid into. It ends itself too, should this process die before it."""
    program = [_find_interpreter(), "-m", f"{__package__}.coacd_process"]
    arguments = [str(threshold), str(max_parts), str(SEED), str(LONGEST_CUTTING)]
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as folder:
        given, made = Path(folder, "solid.npz"), Path(folder, "parts.npz")
        np.savez(given, vertices=solid[0], triangles=solid[1])
        try:
            done = subprocess.run(
                [*program, str(given), str(made), *arguments],
                stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False,
                timeout=LONGEST_CUTTING, env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise ShipError(
                f"{name}: is not cut into convex parts within {LONGEST_CUTTING:g} s: give parts that pass through each "
                "other as one surface (boolean union), simplify the mesh, or leave out what does not touch other ships"
            ) from None
        if done.returncode != 0 or not made.is_file():
            said = done.stderr.strip().splitlines()[-1:] or [f"exit status {done.returncode}"]
            raise HostError(f"{name}: cannot be cut into convex parts: coacd failed ({said[0]})")
        return _read_parts(made.read_bytes())


def _find_interpreter() -> str:
    """Python's program. In a simulator that embeds Python, sys.executable may be the simulator or empty."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    candidates = [Path(sys.executable)] if Path(sys.executable).name.startswith("python") else []
    for prefix in (sys.prefix, sys.exec_prefix, sys.base_exec_prefix):
        candidates += [Path(prefix, "bin", version), Path(prefix, "bin", "python3"), Path(prefix, "python.exe")]
    for candidate in candidates:
        if candidate.is_file():
            return str(candidate)
    raise HostError(
        f"no Python program is found below {sys.exec_prefix}, and a hull that is not convex is cut in a process of its "
        "own: load the ship once with `shipcollision ships`, which keeps its parts"
    )


def _measure_bulge(surface: Array, parts: Sequence[Part]) -> float:
    """How deep [m] the deepest vertex of the solid's surface lies inside a part; it should lie on one."""
    deepest = 0.0
    for part in parts:
        planes = half_spaces(*part)
        inside = (planes[:, 3] - surface @ planes[:, :3].T).min(axis=1)
        deepest = max(deepest, float(inside.max()))
    return deepest


# -- files ------------------------------------------------------------------------------------------


def _pack(cut: Cut) -> bytes:
    arrays = {"measures": np.array([cut.volume_error, cut.bulge]), "count": np.array(len(cut.parts))}
    for i, (vertices, triangles) in enumerate(cut.parts):
        arrays |= {f"v{i}": vertices, f"t{i}": triangles}
    file = BytesIO()
    np.savez(file, **arrays)  # type: ignore[arg-type]  # the stub takes names for flags
    return file.getvalue()


def _unpack(content: bytes) -> Cut:
    """The cut of _pack. Raises ValueError, KeyError, EOFError, OSError or BadZipFile for anything else."""
    with _open(content) as arrays:
        volume_error, bulge = arrays["measures"].tolist()
    return Cut(_read_parts(content), volume_error, bulge)


def _read_parts(content: bytes) -> tuple[Part, ...]:
    with _open(content) as arrays:
        return tuple((arrays[f"v{i}"], arrays[f"t{i}"]) for i in range(int(arrays["count"])))


def _open(content: bytes) -> np.lib.npyio.NpzFile:
    opened = np.load(BytesIO(content), allow_pickle=False)
    if not isinstance(opened, np.lib.npyio.NpzFile):
        raise ValueError("not a file of several arrays")
    return opened
