"""Windows libraries (PE files) without the time at which they were linked."""

from __future__ import annotations

import struct

__all__ = ["clear_time_stamps"]

_OFFSET = 0x3C
"""Where a PE file says at which position its header begins."""


def clear_time_stamps(library: bytes) -> bytes:
    """The same library with time stamp and checksum 0, so that the same sources give the same bytes.

    Zig 0.17 writes a digest in place of the time; other linkers do not. Windows checks the checksum of drivers only.
    Raises ValueError for another file.
    """
    data = bytearray(library)
    header = struct.unpack_from("<I", data, _OFFSET)[0] if data[:2] == b"MZ" else 0
    if data[header : header + 4] != b"PE\0\0":
        raise ValueError("this is no PE file")
    struct.pack_into("<I", data, header + 8, 0)  # TimeDateStamp of the file header
    struct.pack_into("<I", data, header + 24 + 64, 0)  # CheckSum of the optional header
    return bytes(data)
