"""What shared libraries export and which others they load: ELF, PE and Mach-O files, read from their bytes."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass

__all__ = ["Contents", "read_library"]


@dataclass(frozen=True)
class Contents:
    """Names that a library exports, names of the libraries that it loads, and whether it is signed (macOS)."""

    exports: frozenset[str]
    loads: frozenset[str]
    is_signed: bool = False


def read_library(data: bytes) -> Contents:
    """The contents of a 64-bit library of any of our platforms."""
    if data[:4] == b"\x7fELF":
        return _read_elf(data)
    return _read_pe(data) if data[:2] == b"MZ" else _read_mach_o(data)


def _text(data: bytes, offset: int) -> str:
    return data[offset : data.index(b"\0", offset)].decode()


def _read_elf(data: bytes) -> Contents:
    start, size, count = struct.unpack_from("<Q", data, 40)[0], *struct.unpack_from("<HH", data, 58)
    sections = [struct.unpack_from("<IIQQQQIIQQ", data, start + k * size) for k in range(count)]
    exports, loads = set(), set()
    for _, kind, _, _, offset, length, link, *_ in sections:
        names = sections[link][4] if link < count else 0
        if kind == 11:  # the table of dynamic symbols
            for at in range(offset, offset + length, 24):
                name, _, _, section = struct.unpack_from("<IBBH", data, at)
                if section != 0:
                    exports.add(_text(data, names + name))
        if kind == 6:  # what the loader reads
            for at in range(offset, offset + length, 16):
                tag, value = struct.unpack_from("<QQ", data, at)
                if tag == 1:
                    loads.add(_text(data, names + value))
    return Contents(frozenset(exports), frozenset(loads))


def _read_pe(data: bytes) -> Contents:
    header = struct.unpack_from("<I", data, 0x3C)[0] + 4
    count, optional = struct.unpack_from("<H", data, header + 2)[0], header + 20
    first = optional + struct.unpack_from("<H", data, header + 16)[0]
    sections = [struct.unpack_from("<8sIIII", data, first + 40 * k) for k in range(count)]

    def place(address: int) -> int:
        """Where in the file an address of memory is."""
        return next(
            address - start + offset
            for _, size, start, stored, offset in sections
            if start <= address < start + max(size, stored)
        )  # fmt: skip

    exported, imported = (struct.unpack_from("<I", data, optional + 112 + 8 * k)[0] for k in range(2))
    number, _, names = struct.unpack_from("<III", data, place(exported) + 24)
    pointers = struct.unpack_from(f"<{number}I", data, place(names))
    loads, at = set(), place(imported)
    while (name := struct.unpack_from("<I", data, at + 12)[0]) != 0:
        loads.add(_text(data, place(name)))
        at += 20
    return Contents(frozenset(_text(data, place(one)) for one in pointers), frozenset(loads))


def _read_mach_o(data: bytes) -> Contents:
    count = struct.unpack_from("<I", data, 16)[0]
    exports, loads, is_signed, at = set(), set(), False, 32
    for _ in range(count):
        command, size = struct.unpack_from("<II", data, at)
        if command == 2:  # the table of symbols
            symbols, number, names, _ = struct.unpack_from("<IIII", data, at + 8)
            for k in range(number):
                name, kind = struct.unpack_from("<IB", data, symbols + 16 * k)
                if kind & 0x1F == 0x0F:  # defined here, external, not private
                    exports.add(_text(data, names + name).removeprefix("_"))
        if command == 12:  # a library
            loads.add(_text(data, at + struct.unpack_from("<I", data, at + 8)[0]))
        is_signed = is_signed or command == 29
        at += size
    return Contents(frozenset(exports), frozenset(loads), is_signed)


def list_glibc_versions(data: bytes) -> set[tuple[int, ...]]:
    """Versions of glibc's symbols that an ELF file names."""
    found = re.findall(rb"GLIBC_([0-9.]+)", data)
    return {tuple(map(int, one.decode().split("."))) for one in found}
