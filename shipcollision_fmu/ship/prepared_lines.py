"""The lines of prepared files: what Python computes, as a small file of text that native code reads.

    shipcollision prepared ship 2     kind of file and version
    key 0x1.4p+8 ...                  a key and its values
    hull 2 0x1.5p+7 0x1.4p+4          number of convex parts, reach and least extent [m]; then for each part
    part, planes                      its vertices (k, 3) [m] and half-spaces (m, 4)
    crc32 0f1e2d3c                    of all before

Reals are hexadecimal, as float.hex() writes them, hence exact; text is in double quotes, with backslashes before
backslashes and quotes. The order of lines is fixed. native/ship/prepared_lines.hpp reads them.
"""

from __future__ import annotations

from collections.abc import Iterable
from zlib import crc32

import numpy as np

from .frames import Array
from .hull.convex import half_spaces
from .hull.solid import HullMesh

__all__ = ["describe_hull", "quote", "reals", "seal"]


def reals(key: str, values: Iterable[float] | Array) -> str:
    """A line of numbers."""
    return " ".join([key, *(float(value).hex() for value in values)])


def quote(text: str) -> str:
    """Text in double quotes, in one line and without NUL, which ends text in C."""
    text = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\r", "\\r")
    return '"' + text.replace("\0", "\N{REPLACEMENT CHARACTER}") + '"'


def describe_hull(hull: HullMesh) -> list[str]:
    """The lines of a hull. A hull of one part may be without planes: they are found here."""
    reach = float(np.linalg.norm(hull.vertices, axis=1).max())
    extent = float(np.ptp(hull.vertices, axis=0).min())
    lines = [f"hull {len(hull.parts)} {reach.hex()} {extent.hex()}"]
    for part, planes in zip(hull.parts, hull.planes or (half_spaces(hull.vertices, hull.triangles),), strict=True):
        lines += [reals("part", part.ravel()), reals("planes", planes.ravel())]
    return lines


def seal(lines: Iterable[str]) -> bytes:
    """The content of a file of these lines, with its checksum."""
    content = f"{chr(10).join(lines)}\n".encode("utf-8", "replace")
    return content + f"crc32 {crc32(content):08x}\n".encode()
