"""Universal files of macOS: one file with a library for each instruction set."""

from __future__ import annotations

import struct
from collections.abc import Sequence

__all__ = ["join_libraries"]

_UNIVERSAL = 0xCAFEBABE
_MACH_O_64 = 0xFEEDFACF
_ALIGNMENT = 14
"""Libraries begin at multiples of 2^14 bytes, the pages of Apple's processors; the loader refuses others."""


def join_libraries(libraries: Sequence[bytes]) -> bytes:
    """The universal file of 64-bit Mach-O libraries of different instruction sets. Raises ValueError for other files.

    Layout: magic and count, then for each library its two numbers of the processor, offset, size and alignment.
    """
    page = 1 << _ALIGNMENT
    entries, contents, end = b"", b"", 8 + 20 * len(libraries)
    for library in libraries:
        magic, processor, variant = struct.unpack_from("<III", library) if len(library) >= 12 else (0, 0, 0)
        if magic != _MACH_O_64:
            raise ValueError("this is no 64-bit Mach-O file")
        start = -(-end // page) * page
        entries += struct.pack(">IIIII", processor, variant, start, len(library), _ALIGNMENT)
        contents += bytes(start - end) + library
        end = start + len(library)
    return struct.pack(">II", _UNIVERSAL, len(libraries)) + entries + contents
