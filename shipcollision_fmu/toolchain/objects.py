"""One source compiled to an object, which is kept by a digest of all that it is made from.

After an edit only those sources are compiled that include the edited file. Files that are included are found by their
names in the text; those that are found nowhere belong to the compiler.
"""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

from ..errors import HostError
from ..files import IN_PLACE, write_file
from .compilers import Compiler
from .platforms import Target
from .sources import Part

__all__ = ["FLAGS", "compile_object", "digest_source", "is_kept", "read_text", "run"]

FLAGS = (
    "-std=c++17", "-O2", "-DNDEBUG",
    "-ffp-contract=off",  # a product and a sum in one rounding would give other bits on some processors
    "-fno-math-errno",  # sqrt is the processor's
    "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics",  # all that needs a run-time library of C++
    "-fvisibility=hidden", "-fno-ident", "-g0",
)  # fmt: skip
"""How every source is compiled. Without one of them bits or exports differ between platforms."""

_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">]', re.MULTILINE)


Read = Callable[[Part, Path, str], tuple[bytes, list[tuple[Path, Path]]]]


def read_text(part: Part, home: Path, inside: str) -> tuple[bytes, list[tuple[Path, Path]]]:
    """Content of a file below the folder `home`, and where the files lie that it includes, as (folder, path below)."""
    content = (home / inside).read_bytes()
    return content, list(_find_included(part, home, Path(inside).parent, content))


def digest_source(part: Part, file: str, target: Target, read: Read = read_text) -> str:
    """Digest of a source, of all files that it includes, and of how it is compiled.

    read: for many sources at once, read_text() with a memory: they include the same files, a hundred times over.
    """
    total = sha256(repr((FLAGS, part.flags, target.zig)).encode())
    for name, content in sorted(_gather(part, file, read).items()):
        total.update(f"{name}\0{len(content)}\0".encode() + content)
    return total.hexdigest()


def compile_object(part: Part, file: str, target: Target, compiler: Compiler, cache: Path) -> Path:
    """The object of a source, compiled if it is not in the folder `cache`. Raises HostError with the first error."""
    key = sha256(repr((compiler.name, compiler.flags, digest_source(part, file, target))).encode()).hexdigest()
    kept = cache / f"{Path(file).stem}-{key[:32]}.o"
    if is_kept(kept):
        return kept
    positions = () if target.is_windows else ("-fPIC",)
    folders = [f"-isystem{folder}" for folder in part.includes]  # where warnings are of no interest
    names = [f"-ffile-prefix-map={folder}=." for folder in part.includes]
    with tempfile.TemporaryDirectory(prefix="shipcollision-") as aside:
        made = Path(aside, "object.o")
        flags = [*FLAGS, *compiler.flags, *positions, *part.flags, *folders, *names]
        command = [*compiler.compile, *flags, "-c", file, "-o", str(made)]
        run(command, compiler, f"cannot compile {file} for {target.folder}", part.root)
        return write_file(kept, made.read_bytes(), IN_PLACE)


def is_kept(path: Path) -> bool:
    """Whether a file is in the cache; then it counts as used."""
    if not path.is_file():
        return False
    with suppress(OSError):  # the cache may be somebody else's
        os.utime(path)
    return True


def run(command: list[str], compiler: Compiler, failure: str, folder: Path | None = None) -> None:
    """Run a command of a compiler in a folder. Raises HostError: `failure`, and what the compiler said first."""
    environment = os.environ | dict(compiler.environment)
    try:
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    except OSError as error:
        raise HostError(f"{failure}: {command[0]} cannot be run: {error.strerror or error}") from None
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines() or [f"exit status {done.returncode}"]
        first = next((line for line in said if "error" in line), said[0])
        raise HostError(f"{failure} by {compiler.name}: {first.strip()}")


def _gather(part: Part, file: str, read: Read) -> dict[str, bytes]:
    """Contents of a source and of all files that it includes, by their names below their folders."""
    found: dict[str, bytes] = {}
    waiting = [(part.root, Path(file))]
    while waiting:
        home, name = waiting.pop()
        inside = os.path.normpath(name).replace(os.sep, "/")
        if inside in found:
            continue
        found[inside], included = read(part, home, inside)
        waiting.extend(included)
    return found


def _find_included(part: Part, home: Path, folder: Path, content: bytes) -> Iterator[tuple[Path, Path]]:
    """Where the included files of a text lie: beside it, or in the folders of the part."""
    for match in _INCLUDE.finditer(content):
        name = match.group(1).decode("utf-8", "replace")
        for place, path in ((home, folder / name), *((other, Path(name)) for other in part.includes)):
            if (place / path).is_file():
                yield place, path
                break
