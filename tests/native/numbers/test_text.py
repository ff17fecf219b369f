"""Numbers and texts of native/ beside Python's repr, format and zlib."""

from __future__ import annotations

import ctypes
import struct
import zlib
from random import Random

import pytest

from tests.native.kernels import load_kernels

SPECIAL = [
    0.0, -0.0, float("inf"), -float("inf"), float("nan"), 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 9.5,
    99.5, 0.5, 2.5, 1e-5, 1e-4, 9.999995, 1e15, 1e16, 1e22, 1e23, 123456789012345680.0, 1234565.0, 9007199254740993.0,
]  # fmt: skip
COUNT = 3000


def draw_double(random: Random) -> float:
    """Of any size: random bits, small and round numbers, powers of two and subnormals."""
    match random.randrange(6):
        case 0:
            return float(struct.unpack("d", random.randbytes(8))[0])
        case 1:
            return random.uniform(-1000.0, 1000.0)
        case 2:
            return float(struct.unpack("d", struct.pack("Q", random.getrandbits(random.randrange(1, 53))))[0])
        case 3:
            return float(random.randrange(10 ** random.randrange(1, 20))) * 10.0 ** random.randrange(-20, 20)
        case 4:
            return 2.0 ** random.randrange(-1074, 1024)
        case _:
            return round(random.uniform(0.0, 10.0), random.randrange(6))


def numbers() -> list[float]:
    random = Random(1)
    return SPECIAL + [draw_double(random) for _ in range(COUNT)]


def test_numbers_are_written_as_by_python() -> None:
    exact, rounded = ctypes.create_string_buffer(100), ctypes.create_string_buffer(100)
    for k, number in enumerate(numbers()):
        digits = (1, 2, 3, 6, 10, 17)[k % 6]
        load_kernels().shipcollision_write_number(ctypes.c_double(number), digits, exact, rounded)
        assert (exact.value.decode(), rounded.value.decode()) == (repr(number), f"{number:.{digits}g}")


def read_real(text: str) -> float | None:
    """The number of a line, None for other text."""
    number, line = ctypes.c_double(), ctypes.create_string_buffer(text.encode())
    function = load_kernels().shipcollision_read_real
    function.restype = ctypes.c_bool
    return number.value if function(line, ctypes.byref(number)) else None


def test_hexadecimal_numbers_are_read_exactly() -> None:
    for number in numbers():
        found = read_real(number.hex())
        assert found is not None
        assert struct.pack("d", found) == struct.pack("d", number)


@pytest.mark.parametrize(
    "text",
    ["", "0x", "0x2.0p+0", "0x1.00000000000000p+0", "0x1.0p", "0x1.0p+", "0x1.0p+1024", "0x1.0p-1023", "0x1.p+0",
     "0x0.8p+0", "0x1.0p+99999", "1.0", "-", " 0x1.0p+0", "0X1.0P+0", "+0x1.0p+0", "infinity"],
)  # fmt: skip
def test_other_text_is_no_hexadecimal_number(text: str) -> None:
    assert read_real(text) is None


@pytest.mark.parametrize("text", ["plain", "it's", 'say "no"', "both ' and \"", "\n\t\r\x01\x7f\\", "Ærøskøbing", ""])
def test_text_is_quoted_as_by_python(text: str) -> None:
    quoted = ctypes.create_string_buffer(200)
    load_kernels().shipcollision_quote(text.encode(), quoted)
    assert quoted.value.decode() == repr(text)


def write(text: bytes) -> bytes:
    """What a Text has of a text and the letters `xy` after it."""
    written = ctypes.create_string_buffer(6000)
    load_kernels().shipcollision_write_text(text, written)
    return written.value


@pytest.mark.parametrize("letter", ["x", "ø", "船", "🚢"])
@pytest.mark.parametrize("size", [1990, 1994, 1997, 1998, 1999, 2000, 2001, 5000, 300_000])
def test_a_text_that_is_too_long_lacks_its_middle(letter: str, size: int) -> None:
    """Whole characters are left out, and its end is there, where a refusal has its remedy."""
    for first in ("", "a", "ab", "abc"):
        text = first + letter * ((size - len(first)) // len(letter.encode()))
        written = write(text.encode()).decode()
        if len(text.encode()) + 2 <= 2000:
            assert written == f"{text}xy"
            continue
        begin, gap, end = written.partition("...")
        assert gap
        assert text.startswith(begin)
        assert f"{text}xy".endswith(end)
        assert end.endswith("xy")
        assert 1850 < len(written.encode()) <= 2000
        assert min(len(begin.encode()), len(end.encode())) > 800


NO_UTF8 = [
    b"\x80", b"\xff\xe4", b"a\xc3", b"\xc3(", b"\xc0\xaf", b"\xc1\xbf", b"\xe0\x9f\xbf", b"\xe2\x82", b"\xed\xa0\x80",
    b"\xf0\x8f\xbf\xbf", b"\xf0\x9f\x9a", b"\xf4\x90\x80\x80", b"\xf5\x80\x80\x80", b"\xf8\x88\x80\x80\x80",
    "\u0800\ud7ff\ue000\U0010ffff\x7f\x80".encode(),
]  # fmt: skip


def test_bytes_that_are_no_characters_are_written_in_digits() -> None:
    random = Random(1)
    for text in NO_UTF8 + [bytes(random.choices(b"a\x80\xbf\xc3\xe2\xed\xf0\x9f", k=12)) for _ in range(300)]:
        assert write(text) == text.decode(errors="backslashreplace").encode() + b"xy"
    assert write(b"\x80" * 5000).decode().endswith("80xy")
    assert write(b"a\nb\r\t\x1b[0m") == b"a\\x0ab\\x0d\\x09\\x1b[0mxy"  # a message is one line


def test_checksum() -> None:
    function = load_kernels().shipcollision_crc32
    function.restype = ctypes.c_uint32
    for data in (b"", b"a", bytes(range(256)) * 5):
        assert function(data, ctypes.c_size_t(len(data))) == zlib.crc32(data)
