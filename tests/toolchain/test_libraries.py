"""Libraries: what is compiled again, same bytes everywhere, files of macOS and Windows, and what is missing."""

from __future__ import annotations

import ctypes
import os
import shutil
import struct
import subprocess
from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.toolchain import bullet_sources, compilers, libraries, load, objects, sources
from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.libraries import build_libraries, build_library, native_cache
from shipcollision_fmu.toolchain.mach_o import join_libraries
from shipcollision_fmu.toolchain.pe import clear_time_stamps
from shipcollision_fmu.toolchain.platforms import PLATFORMS, Target, find_own_target
from shipcollision_fmu.toolchain.sources import Part, find_native
from tests.compiler import compile_c

TARGETS = [target for platform in PLATFORMS.values() for target in platform.targets]
EXPORTS = ("shipcollision_*",)


def own() -> Target:
    """The target of this machine."""
    target = find_own_target()
    assert target is not None
    return target


def small(folder: Path, number: int = 3, text: str = "") -> Part:
    """Two sources and a header in a folder of their own."""
    folder.mkdir(exist_ok=True)
    (folder / "number.hpp").write_text(f"constexpr int NUMBER = {number};\n", encoding="ascii")
    export = 'extern "C" __attribute__((visibility("default"))) int'
    (folder / "a.cpp").write_text(
        f'#include "number.hpp"\n{export} shipcollision_a() {{ return NUMBER; }}\n{text}', "ascii"
    )
    (folder / "b.cpp").write_text(f"{export} other() {{ return 1; }}\n", "ascii")
    return Part(folder, ("a.cpp", "b.cpp"))


def build(part: Part, cache: Path) -> ctypes.CDLL:
    """The library of a part, opened."""
    return ctypes.CDLL(str(build_library("small", [part], own(), EXPORTS, cache=cache, prefer_system=True)))


def test_what_includes_an_edited_file_is_compiled_again(tmp_path: Path) -> None:
    assert build(small(tmp_path / "src"), tmp_path / "cache").shipcollision_a() == 3
    before = {path.name for path in tmp_path.glob("cache/objects/*.o")}
    assert build(small(tmp_path / "src", 5), tmp_path / "cache").shipcollision_a() == 5
    new = {path.name for path in tmp_path.glob("cache/objects/*.o")} - before
    assert [name.partition("-")[0] for name in new] == ["a"]


def test_each_file_is_read_once_to_find_a_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sources include the same headers: all of native/ together include theirs fifteen times over."""
    part = small(tmp_path / "src")
    (part.root / "b.cpp").write_text('#include "number.hpp"\nextern "C" int other() { return NUMBER; }\n', "ascii")
    build(part, tmp_path / "cache")
    read: list[str] = []

    def count(one: Part, home: Path, inside: str) -> tuple[bytes, list[tuple[Path, Path]]]:
        read.append(inside)
        return objects.read_text(one, home, inside)

    monkeypatch.setattr(libraries, "read_text", count)
    build(part, tmp_path / "cache")
    assert sorted(read) == ["a.cpp", "b.cpp", "number.hpp"]


def test_other_names_are_not_exported(tmp_path: Path) -> None:
    library = build(small(tmp_path / "src"), tmp_path / "cache")
    with pytest.raises(AttributeError):
        library.other  # noqa: B018  # the access is what is tested


def test_a_library_in_the_cache_needs_no_compiler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build(small(tmp_path / "src"), tmp_path / "cache")
    monkeypatch.setattr(libraries, "find_compiler", None)
    assert build(small(tmp_path / "src"), tmp_path / "cache").shipcollision_a() == 3


def test_a_cache_that_cannot_be_written_is_refused_before_a_compiler_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    part = small(tmp_path / "src")
    with monkeypatch.context() as patched:
        patched.setattr(libraries, "compile_object", None)
        with pytest.raises(HostError) as refused:
            build(part, tmp_path / "file" / "cache")
    assert str(refused.value) == (
        f"cannot write to {tmp_path}/file/cache: {tmp_path}/file is not a folder; make it writable, or name another "
        "folder for caches in the environment variable XDG_CACHE_HOME"
    )
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "other"))
    assert build(part, native_cache()).shipcollision_a() == 3
    assert (tmp_path / "other").is_dir()


def test_what_takes_long_at_first_use_is_announced_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    part = small(tmp_path / "src")
    monkeypatch.setattr(sources, "list_library_parts", lambda _: [part])
    monkeypatch.setattr(bullet_sources, "has_bullet_sources", lambda cache: cache.is_dir())
    load.build_own_library(tmp_path / "cache")
    assert capfd.readouterr() == ("", f"{load.FETCHING}\n{load.COMPILING.format(load.OWN)}\n")
    load.build_own_library(tmp_path / "cache")
    assert capfd.readouterr() == ("", "")


def test_progress_ends_at_the_last_step(tmp_path: Path) -> None:
    said: list[tuple[int, int]] = []
    part = small(tmp_path / "src")
    build_libraries(
        "small", [part], [own()], EXPORTS, cache=tmp_path / "cache", prefer_system=True,
        report=lambda done, total: said.append((done, total)),
    )  # fmt: skip
    assert said == [(1, 3), (2, 3), (3, 3)]


def test_a_source_that_does_not_compile_is_told_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(HostError, match=r"^cannot compile a\.cpp for .* by .*: a\.cpp:3:.*error: .*[^\n]$"):
        build(small(tmp_path / "src", text="nonsense;\n"), tmp_path / "cache")
    assert not list(tmp_path.glob("cache/*/small.*"))


def test_a_warning_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(HostError, match=r"unused"):
        build(small(tmp_path / "src", text="static int unused(int argument) { return 1; }\n"), tmp_path / "cache")


def lack(monkeypatch: pytest.MonkeyPatch, *names: str) -> None:
    """Let the compilers of these functions be missing."""
    for name in names:
        monkeypatch.setattr(compilers, name, lambda: None)


def test_without_zig_other_platforms_are_refused_with_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    lack(monkeypatch, "_find_zig", "_find_system")
    other = next(target for target in TARGETS if target.is_macos)
    with pytest.raises(HostError, match=r"for x86_64-darwin is compiled by Zig, which is not .*\[native\]'.*\)$"):
        find_compiler(other)


def test_without_any_compiler_the_line_names_both(monkeypatch: pytest.MonkeyPatch) -> None:
    lack(monkeypatch, "_find_zig", "_find_system")
    with pytest.raises(HostError, match=r"no C\+\+ compiler .*-fmu\[native\].*, or install g\+\+ or clang"):
        find_compiler(own())


def test_the_systems_compiler_does_where_zig_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    system = compilers.Compiler("c++ 1", ("c++",), ("cc",))
    lack(monkeypatch, "_find_zig")
    monkeypatch.setattr(compilers, "_find_system", lambda: system)
    assert find_compiler(own()) is system
    with pytest.raises(HostError, match=f"or build for this machine alone, with --platforms {own_platform()}$"):
        find_compiler(next(target for target in TARGETS if target.is_windows))


@pytest.mark.parametrize(("name", "beside"), [("g++", "gcc"), ("clang++", "clang"), ("c++", "cc")])
def test_each_usual_compiler_is_found_with_its_driver(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, beside: str
) -> None:
    for program in (name, beside):
        (tmp_path / program).write_text(f"#!/bin/sh\necho {program} 1.2\n", encoding="ascii")
        (tmp_path / program).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    found = compilers._find_system.__wrapped__()
    assert found is not None
    assert (found.name, found.compile, found.link) == (
        f"{name} 1.2", (str(tmp_path / name),), (str(tmp_path / beside),)
    )  # fmt: skip


def test_a_compiler_that_does_not_run_counts_as_missing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("g++", "gcc"):
        (tmp_path / name).write_bytes(b"\x7fELF of another machine")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert compilers._find_system.__wrapped__() is None


def own_platform() -> str:
    """Its name on this machine."""
    return next(one.name for one in PLATFORMS.values() if own() in one.targets)


def numbers(folder: Path) -> Part:
    """A part of native/ that links alone, copied."""
    shutil.copytree(find_native(), folder)
    exported = folder / "exported.cpp"  # Zig's linker for macOS fails on a library without exports
    exported.write_text(
        '#include "export.hpp"\n#include "numbers/elementary.hpp"\n'
        "SHIPCOLLISION_EXPORT double shipcollision_sin(double x) { return shipcollision::sin(x); }\n",
        encoding="ascii",
    )
    return Part(folder, ("exported.cpp", "numbers/elementary.cpp", "windows.cpp"))


@pytest.mark.slow
def test_another_folder_gives_the_same_bytes_for_every_platform(tmp_path: Path) -> None:
    built = []
    for name in ("here", "there/and/deeper"):
        part = numbers(tmp_path / name / "native")
        made = build_libraries("shipcollision", [part], TARGETS, EXPORTS, cache=tmp_path / name / "cache")
        built.append({target.folder: path.read_bytes() for target, path in made.items()})
    assert built[0] == built[1]
    assert all(str(tmp_path).encode() not in data for data in built[0].values())


@pytest.mark.slow
@pytest.mark.needs("wine")
def test_windows_runs_constructors_and_extends_the_stack(tmp_path: Path) -> None:
    """native/windows.cpp in place of MinGW's start-up code. 200 kB of local variables are many pages of a stack; Wine
    gives them all at once, so it shows that no register is lost, and not that every page is touched."""
    source = tmp_path / "src"
    source.mkdir()
    shutil.copy(find_native() / "windows.cpp", source)
    (source / "a.cpp").write_text(
        "static volatile int seed = 5;\n"
        "struct Made { Made(int value) : number(value) {} int number; };\n"
        "static Made first(seed), second(seed + 2);\n"
        'extern "C" __declspec(dllexport) int shipcollision_sum() {\n'
        "  volatile char pages[200000];\n"
        "  for (int k = 0; k < 200000; ++k) pages[k] = 1;\n"
        "  return first.number + 10 * second.number + 100 * pages[seed];\n"
        "}\n",
        encoding="ascii",
    )
    target = PLATFORMS["win64"].targets[0]
    part = Part(source, ("a.cpp", "windows.cpp"))
    build_library("small", [part], target, EXPORTS, cache=tmp_path / "cache")
    library = next(tmp_path.glob("cache/*/small.dll"))
    host = tmp_path / "host.c"
    host.write_text(
        "#include <windows.h>\n"
        "int main(int count, char **words) {\n"
        "  (void)count;\n"
        '  int (*sum)(void) = (int (*)(void))(void *)GetProcAddress(LoadLibraryA(words[1]), "shipcollision_sum");\n'
        "  return sum();\n"
        "}\n",
        encoding="ascii",
    )
    compile_c("-O1", host, "-o", tmp_path / "host.exe", target=target.zig)
    prefix = {
        "WINEPREFIX": str(tmp_path / "wine"),
        "WINEDEBUG": "-all",
        "PATH": os.environ["PATH"],
        "HOME": str(tmp_path),
    }
    command = ["wine", str(tmp_path / "host.exe"), f"Z:{library}"]
    done = subprocess.run(command, env=prefix, capture_output=True, check=False, timeout=600)
    assert done.returncode == 175


def test_a_windows_library_without_time_stamp() -> None:
    plain = bytearray(b"MZ" + bytes(62) + b"PE\0\0" + bytes(200))
    struct.pack_into("<I", plain, 0x3C, 64)
    stamped = bytearray(plain)
    struct.pack_into("<I", stamped, 64 + 8, 123456)
    struct.pack_into("<I", stamped, 64 + 88, 99)
    assert clear_time_stamps(bytes(stamped)) == bytes(plain)
    with pytest.raises(ValueError, match="this is no PE file"):
        clear_time_stamps(b"\x7fELF")


def test_a_universal_file_holds_each_library_at_a_page() -> None:
    slices = [struct.pack("<III", 0xFEEDFACF, 0x01000007 + k, 3) + bytes([k]) * 20000 for k in range(2)]
    whole = join_libraries(slices)
    assert struct.unpack_from(">II", whole) == (0xCAFEBABE, 2)
    for k, one in enumerate(slices):
        processor, variant, start, size, alignment = struct.unpack_from(">IIIII", whole, 8 + 20 * k)
        assert (processor, variant, start % 2**alignment, alignment) == (0x01000007 + k, 3, 0, 14)
        assert whole[start : start + size] == one
    with pytest.raises(ValueError, match="this is no 64-bit Mach-O file"):
        join_libraries([b"\x7fELF"])
