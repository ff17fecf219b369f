"""The program that cuts a solid by CoACD, in a process of its own (convex_parts.py).

    python -m shipcollision_fmu.ship.hull.coacd_process SOLID.npz PARTS.npz LONGEST THRESHOLD MAX_PARTS ITERATIONS SEED

SOLID has vertices (n, 3) and triangles (m, 3); PARTS gets count, and v0, t0, v1, t1, ... of the parts.
"""

from __future__ import annotations

import faulthandler
import sys
from importlib import import_module
from pathlib import Path

import numpy as np

from ..frames import Array
from .child_process import read_arrays, write_arrays
from .convex import Indices, enclosed_volume


def main(solid: str, made: str, longest: str, threshold: str, max_parts: str, iterations: str, seed: str) -> None:
    """Cut the solid of one file into the parts of another. Ends the process after `longest` seconds."""
    faulthandler.dump_traceback_later(float(longest), exit=True)
    coacd = import_module("coacd")

    coacd.set_log_level("error")
    given = read_arrays(Path(solid).read_bytes())
    found = coacd.run_coacd(
        coacd.Mesh(given["vertices"], given["triangles"]), threshold=float(threshold), max_convex_hull=int(max_parts),
        preprocess_mode="off", mcts_iterations=int(iterations), seed=int(seed),
    )  # fmt: skip
    arrays = {"count": np.array(len(found))}
    for i, (vertices, triangles) in enumerate(found):
        p, faces = _turn_outward(np.array(vertices, dtype=float), np.array(triangles, dtype=np.int64))
        arrays |= {f"v{i}": p, f"t{i}": faces}
    Path(made).write_bytes(write_arrays(arrays))


def _turn_outward(vertices: Array, triangles: Indices) -> tuple[Array, Indices]:
    outward = enclosed_volume(vertices, triangles) > 0.0
    return vertices, triangles if outward else triangles[:, ::-1].copy()


if __name__ == "__main__":
    main(*sys.argv[1:])
