"""Resources of native FMUs: where a host may say that they are, and tables of variables that are not as they should be.

A location is right by RFC 3986, RFC 8089 (the file scheme) and FMI 2.0.4, section 2.1.5, or because hosts write it so.
"""

from __future__ import annotations

import ctypes
import os
import shutil
from collections.abc import Callable
from ctypes import CFUNCTYPE, byref, c_bool, c_char_p, c_int, c_size_t
from ctypes import c_void_p as pointer
from pathlib import Path
from typing import Any
from urllib.parse import quote
from zlib import crc32

import pytest
from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from shipcollision_fmu.toolchain.libraries import build_library, native_cache
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import Part, find_native

from .native_fmus import TOKEN

CACHE = native_cache()

NAMES = ["plain", "a b", "a%20b", "ä", "船", "a(1) é#%25", "100%", "q?x=1", "a+b&c", "semi;colon", "'quoted'", "dots.."]
Try = Callable[..., str]


@pytest.fixture(scope="session")
def attempt(test_library: Path) -> Try:
    """Instantiates at a location, by FMI 2.0 or 3.0; what was logged, "" for an instance."""
    dll = ctypes.CDLL(str(test_library))
    dll.fmi2Instantiate.restype = dll.fmi3InstantiateCoSimulation.restype = pointer

    def attempt(location: str | bytes, fmi: int = 2) -> str:
        said: list[bytes] = []
        where, made = location.encode() if isinstance(location, str) else location, None
        if fmi == 2:
            callbacks = fmi2CallbackFunctions()
            callbacks.logger = fmi2CallbackLoggerTYPE(lambda env, name, status, category, line: said.append(line))
            made = dll.fmi2Instantiate(b"one", 1, TOKEN.encode(), where, byref(callbacks), 0, 0)
        else:
            log = CFUNCTYPE(None, pointer, c_int, c_char_p, c_char_p)(
                lambda env, status, category, line: said.append(line)
            )
            flags = [c_bool(False)] * 4
            made = dll.fmi3InstantiateCoSimulation(
                b"one", TOKEN.encode(), where, *flags, None, c_size_t(0), None, log, None
            )
        if made is not None:
            getattr(dll, f"fmi{fmi}FreeInstance")(pointer(made))
        assert (made is None) == (len(said) == 1)
        return said[0].decode() if said else ""

    return attempt


def moved(native_dummies: dict[str, Path], tmp_path: Path, name: str, flavour: str = "2") -> Path:
    """A copy of the resources in a folder of that name."""
    resources = tmp_path / name / "resources"
    shutil.copytree(native_dummies[flavour] / "resources", resources)
    return resources


@pytest.mark.parametrize("name", NAMES)
def test_every_legal_uri_is_read(attempt: Try, native_dummies: dict[str, Path], tmp_path: Path, name: str) -> None:
    resources = moved(native_dummies, tmp_path, name)
    path = str(resources)
    lower = quote(path).replace("%C3", "%c3").replace("%E8", "%e8")
    whole = "".join(c if c == "/" else "".join(f"%{byte:02X}" for byte in c.encode()) for c in path)
    for uri in (
        resources.as_uri(), f"file:{quote(path)}", f"file://{quote(path)}/", f"file://localhost{quote(path)}",
        f"FILE://LOCALHOST{quote(path)}", f"file://{lower}", f"file://{whole}", f"file:{quote(path)}///",
    ):  # fmt: skip
        assert attempt(uri) == "", uri


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("fmi", [2, 3])
def test_a_plain_path_is_taken_as_it_is(
    attempt: Try, native_dummies: dict[str, Path], tmp_path: Path, name: str, fmi: int
) -> None:
    resources = moved(native_dummies, tmp_path, name, str(fmi))
    assert attempt(str(resources), fmi) == ""
    assert attempt(f"{resources}/", fmi) == ""
    assert attempt(resources.as_uri(), fmi) == ""


def test_hosts_that_encode_nothing_are_understood(
    attempt: Try, native_dummies: dict[str, Path], tmp_path: Path
) -> None:
    for name in ("a b", "ä", "50% off", "c#", "q?"):
        assert attempt(f"file://{moved(native_dummies, tmp_path, name)}") == ""


def test_bytes_that_are_no_utf8_are_a_path_like_others(
    attempt: Try, native_dummies: dict[str, Path], tmp_path: Path
) -> None:
    folder = bytes(tmp_path) + b"/\xff\xe4"
    shutil.copytree(bytes(native_dummies["2"] / "resources"), folder)
    assert attempt(b"file://" + bytes(tmp_path) + b"/%FF%e4") == ""
    assert attempt(folder) == ""


@pytest.mark.parametrize(
    ("location", "line"),
    [
        ("http://somewhere/resources", "'http://somewhere/resources' is not on this machine: give the resource "
                                       "location as file:///PATH"),
        ("file://server/share", "'file://server/share' is not on this machine: give the resource location as file:///"),
        ("file:", "'file:' cannot be a resource location: it is too long, or no path"),
        ("file:///a%00b", "'file:///a%00b' cannot be a resource location: it is too long, or no path"),
        ("file:///" + "x" * 5000, "'file:///xxxxxxxxxx"),
        ("/" + "x" * 4096, "'/xxxxxxxx"),
        ("file:///nowhere/at/all/", "/nowhere/at/all/variables.txt cannot be opened: it is missing, or may not be"),
        ("nowhere", "nowhere/variables.txt cannot be opened"),
    ],
)  # fmt: skip
def test_a_location_that_is_none_is_one_line(attempt: Try, location: str, line: str) -> None:
    for fmi in (2, 3):
        assert attempt(location, fmi).startswith(line.replace("%", "%%") if fmi == 2 else line)


# Windows, as the same code reads it there. ----------------------------------------------------------------------------

WINDOWS = [
    ("file:///C:/fmu/resources", "C:/fmu/resources"),
    ("file:/c:/fmu/resources/", "c:/fmu/resources"),
    ("file://localhost/C:/a%20b", "C:/a b"),
    ("file://C:/fmu", "C:/fmu"),
    ("file:///C|/fmu", "C:/fmu"),
    ("file://server/share/fmu", "//server/share/fmu"),
    ("file:////server/share/fmu", "//server/share/fmu"),
    ("C:\\fmu\\resources\\", "C:\\fmu\\resources"),
    ("C:/fmu/resources", "C:/fmu/resources"),
    ("\\\\server\\share", "\\\\server\\share"),
    ("file:///C:/%C3%A4", "C:/ä"),
]


@pytest.fixture(scope="session")
def locate(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, bool], str]:
    """The path that find_resources() makes of a location; "" for one that is refused."""
    native, folder = find_native(), tmp_path_factory.mktemp("locate")
    (folder / "locate.cpp").write_text(
        '#include "fmi/resource_location.hpp"\n'
        'extern "C" __attribute__((visibility("default"))) bool locate(const char* location, char* path, int room,\n'
        "                                                              bool is_windows) {\n"
        "  shipcollision::Text why;\n"
        "  return shipcollision::find_resources(location, path, static_cast<size_t>(room), why,\n"
        "                                       is_windows ? shipcollision::Platform::windows\n"
        "                                                  : shipcollision::Platform::posix);\n"
        "}\n"
    )
    files = ("fmi/resource_location.cpp", "numbers/text.cpp", "numbers/decimal.cpp")
    parts = [Part(native, files), Part(folder, ("locate.cpp",), includes=(native,))]
    target = find_own_target()
    assert target is not None
    dll = ctypes.CDLL(str(build_library("locate", parts, target, ("locate",), cache=CACHE, prefer_system=True)))

    def locate(location: str, is_windows: bool, room: int = 4096) -> str:
        path = ctypes.create_string_buffer(room)
        found = dll.locate(location.encode(), path, room, c_bool(is_windows))
        return path.value.decode() if found & 1 else ""

    return locate


@pytest.mark.parametrize(("location", "path"), WINDOWS)
def test_drives_and_shares(locate: Any, location: str, path: str) -> None:
    assert locate(location, True) == path


def test_a_drive_is_a_folder_elsewhere(locate: Any) -> None:
    assert locate("file:///C:/fmu", False) == "/C:/fmu"
    assert locate("file://server/share", False) == ""


def test_room_for_a_path_is_kept(locate: Any) -> None:
    for size in range(1, 12):
        found = locate("file:///abc/%64ef", True, size)
        assert found == ("/abc/def" if size > 8 else "")


# Tables. -------------------------------------------------------------------------------------------------------------


@pytest.fixture
def table(native_dummies: dict[str, Path], tmp_path: Path) -> Callable[..., Path]:
    """Writes the dummy's table of FMI 3.0 with some of its text replaced, and a digest that is right."""

    def write(*replaced: tuple[str, str], sealed: bool = True) -> Path:
        text = (native_dummies["3"] / "resources" / "variables.txt").read_text(encoding="utf-8")
        text = text[: text.rindex("crc32")] if sealed else text
        for old, new in replaced:
            assert old in text, old
            text = text.replace(old, new, 1)
        data = text.encode()
        if sealed:
            data += f"crc32 {crc32(data):08x}\n".encode()
        (tmp_path / "variables.txt").write_bytes(data)
        return tmp_path

    return write


GAIN = '"gain.first" "parameters.gain" 0 0x1.999999999999ap-4'


def test_the_table_as_written_is_read(attempt: Try, table: Any) -> None:
    assert attempt(str(table()), 3) == ""


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("shipcollision variables 2", "shipcollision variables 1", " has version 1 of its format, and this library "
         "reads version 2: build the FMU again"),
        ("shipcollision variables", "shipcollision ships", " is not the table of variables of an FMU: unpack the FMU "),
        ("fmi 3", "fmi 4", ", line 3, cannot be read (FMI 2 or 3): build the FMU again"),
        ("ships\n", "ships own\n", ", line 7, cannot be read"),
        ("ships\n", "ships \"own\n", ", line 7, cannot be read"),
        ("ships\n", "", ", line 7, cannot be read"),
        ("presets\n", "presets 19\n", ", line 28, cannot be read"),
        ("presets\n", "presets -1\n", ", line 28, cannot be read"),
        ("presets\n", "preset\n", ", line 28, cannot be read"),
        ("scalars 19", "scalars 18", ", line 27, cannot be read: build the FMU again"),
        ("scalars 19", "scalars 20", ", line 28, cannot be read"),
        ("scalars 19", "scalars 999999999", ", line 8, cannot be read"),
        ("scalars 19", "scalars -1", ", line 8, cannot be read"),
        ("references 15", "references 16", ", line 44, cannot be read"),
        ("references 15", "references 14", ", line 44, cannot be read"),
        ('"place" 0 1 2', '"place" 0 1 19', ", line 30, cannot be read"),
        ('"place" 0 1 2', '"place"', ", line 30, cannot be read"),
        ('"place" 0 1 2', '"place" 0 1 3', ", line 30, cannot be read"),
        ('"method" 18', '"method"' + " 18" * 9, ", line 44, cannot be read"),
        (GAIN, GAIN.replace("p-4", "p-4000"), ", line 22, cannot be read"),
        (GAIN, GAIN.replace("0x1.999999999999ap-4", "0.1"), ", line 22, cannot be read"),
        (GAIN, GAIN.replace(" 0 ", " 0  "), ", line 22, cannot be read"),
        (GAIN, GAIN.replace(" 0 ", " 99999999999 "), ", line 22, cannot be read"),
        ('"good"', '"good', ", line 24, cannot be read"),
        ('"good"', '"go\\od"', ", line 24, cannot be read"),
        ('"good"', '"' + "g" * 4096 + '"', ", line 24, cannot be read"),
        ('- 1 - - "pgs"', '- 4 - - "pgs"', ", line 27, cannot be read"),
        ('- 1 - - "pgs" "closed_form" "bullet"', "- 1 - -", ", line 27, cannot be read"),
    ],
)  # fmt: skip
def test_a_table_that_is_wrong_is_one_line(attempt: Try, table: Any, old: str, new: str, line: str) -> None:
    said = attempt(str(table((old, new))), 3)
    assert line in said
    assert said.count("\n") == 0


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (GAIN, GAIN.replace("parameters.gain", "parameters.pain"), "gain.first (parameters.pain)"),
        (GAIN, GAIN.replace(" 0 ", " 2 "), "gain.first (parameters.gain)"),
        (GAIN, GAIN.replace(" 0 ", " - "), "gain.first (parameters.gain)"),
        ('"count" "parameters.count"', '"count" "parameters.quick"', "count (parameters.quick)"),
        ('"closed_form" "bullet"', '"bullet" "closed_form"', "method (parameters.method)"),
    ],
)
def test_a_table_of_another_library_is_refused(attempt: Try, table: Any, old: str, new: str, line: str) -> None:
    assert attempt(str(table((old, new))), 3) == (
        f"Dummy: this library has no variable {line} as its table has it: build the FMU again"
    )


def test_a_model_that_is_not_there_is_refused(attempt: Try, table: Any) -> None:
    assert attempt(str(table(('fmu "Dummy"', 'fmu "Mummy"'))), 3) == (
        "this library cannot make the model Mummy: build the FMU again"
    )


def test_the_other_version_of_fmi_is_refused(attempt: Try, native_dummies: dict[str, Path]) -> None:
    assert attempt(str(native_dummies["3"] / "resources")) == "Dummy was built for FMI 3 and is called by FMI 2"
    assert attempt(str(native_dummies["2"] / "resources"), 3) == "Dummy was built for FMI 2 and is called by FMI 3"


def test_a_damaged_table_is_refused(attempt: Try, table: Any) -> None:
    folder = table(("p-4", "p-3"), sealed=False)
    path = folder / "variables.txt"
    assert attempt(str(folder), 3) == f"{path} is damaged: unpack the FMU again"
    for data in (b"", path.read_bytes()[:-1], path.read_bytes()[:-20], path.read_bytes() + b"\n", b"\0" * 100):
        path.write_bytes(data)
        assert attempt(str(folder), 3) in (
            f"{path} is damaged: unpack the FMU again",
            f"{path} is not the table of variables of an FMU: unpack the FMU again",
        )


def test_changed_line_ends_of_the_table_are_named(attempt: Try, table: Any) -> None:
    folder = table(("p-4", "p-4"))
    path = folder / "variables.txt"
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert attempt(str(folder), 3) == (
        f"{path} is damaged: its line ends were changed, as git and editors of Windows do; unpack the FMU again"
    )


REMEDY = "; the host must pass the folder `resources` of the unpacked FMU"


def test_a_table_of_four_gigabytes_is_refused(attempt: Try, tmp_path: Path) -> None:
    path = tmp_path / "variables.txt"
    with path.open("wb") as file:
        file.truncate(2**32)  # a hole, which takes no room
    assert attempt(str(tmp_path)) == f"{path} is longer than 16777216 bytes: it is not what it should be{REMEDY}"


def test_a_folder_in_place_of_the_table_is_refused(attempt: Try, tmp_path: Path) -> None:
    (tmp_path / "variables.txt").mkdir()
    assert attempt(str(tmp_path)) == f"{tmp_path / 'variables.txt'} cannot be read: it is not a file{REMEDY}"


def test_a_pipe_in_place_of_the_table_is_refused_at_once(attempt: Try, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "variables.txt")
    assert attempt(str(tmp_path)) == f"{tmp_path / 'variables.txt'} cannot be read: it is not a file{REMEDY}"


@pytest.mark.parametrize("fmi", [2, 3])
def test_what_is_logged_is_utf8(attempt: Try, fmi: int) -> None:
    assert attempt(b"/\xff\xe4/\xc3\xb8", fmi) == (
        "/\\xff\\xe4/ø/variables.txt cannot be opened: it is missing, or may not be read"
        "; the host must pass the folder `resources` of the unpacked FMU"
    )
    assert attempt(b"/a\nb", fmi).startswith("/a\\x0ab/variables.txt cannot be opened: it is missing")
    assert attempt(b"\x80" * 4000, fmi).endswith(
        "\\x80/variables.txt cannot be opened: it is missing, or may not be read"
        "; the host must pass the folder `resources` of the unpacked FMU"
    )
