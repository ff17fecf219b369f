"""sources/ of a native FMU, for hosts that compile FMUs themselves: C++, the headers of FMI, and Bullet's files where
the FMU has contact.

FMI 2.0 lists the files in modelDescription.xml, FMI 3.0 in sources/buildDescription.xml, with compiler options.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from ...toolchain import libraries
from ...toolchain.bullet_sources import DEFINES, FILES, LICENCE, VERSION, find_bullet_sources
from ...toolchain.objects import FLAGS
from ...toolchain.sources import COLLISION, find_fmi_headers, find_native, list_fmu_parts
from .model_description import to_bytes

__all__ = ["list_compiled", "list_source_files", "read_bullet_licence", "read_fmi_licence"]

_FOLDER = "sources"
_BUILD = "buildDescription.xml"
_README = """C++17, to be compiled into one shared library with the headers of this folder and no other library:

    g++ -shared -fPIC {flags} -I. -o NAME.so {some} ...

Without -ffp-contract=off the numbers differ in their last digits between processors.
"""
_ABOUT_BULLET = f"""
BulletCollision and LinearMath are files of {VERSION}, unchanged; their licence is {LICENCE}. Without
-D{DEFINES[0]} nothing compiles.
"""


def list_compiled(name: str) -> tuple[str, ...]:
    """Names of the files to be compiled for the FMU called `name`, below sources/."""
    return tuple(file for part in list_fmu_parts(name, libraries.native_cache()) for file in part.files)


def list_source_files(name: str, fmi: int) -> dict[str, bytes]:
    """The files by their place in the FMU called `name`. Raises HostError when some are not installed."""
    native, compiled, has_contact = find_native(), list_compiled(name), name == COLLISION
    others = ("batch",) if has_contact else ("batch", "collision")
    headers = [path for path in native.rglob("*.hpp") if path.relative_to(native).parts[0] not in others]
    files = {path.relative_to(native).as_posix(): path.read_bytes() for path in headers}
    files |= {file: (native / file).read_bytes() for file in compiled if (native / file).is_file()}
    files |= {path.name: path.read_bytes() for path in find_fmi_headers().glob("fmi[23]*.h")}
    flags, about = (*FLAGS, *(f"-D{define}" for define in DEFINES if has_contact)), ""
    if has_contact:
        bullet, about = find_bullet_sources(libraries.native_cache()), _ABOUT_BULLET
        files |= {file: (bullet / file).read_bytes() for file in FILES}
    files["README.txt"] = (_README.format(flags=" ".join(flags), some=" ".join(compiled[:2])) + about).encode()
    if fmi == 3:
        files[_BUILD] = to_bytes(_describe_build(name, compiled, flags))
    return {f"{_FOLDER}/{place}": content for place, content in files.items()}


def read_fmi_licence() -> str:
    """The licence of the headers of FMI, as they carry it."""
    text = Path(find_fmi_headers(), "fmi3Functions.h").read_text(encoding="utf-8")
    return text[text.index("Copyright (C)") : text.index("*/")].strip() + "\n"


def read_bullet_licence() -> str:
    """The licence of Bullet, as its files carry it."""
    return (find_bullet_sources(libraries.native_cache()) / LICENCE).read_text(encoding="utf-8")


def _describe_build(name: str, compiled: tuple[str, ...], flags: tuple[str, ...]) -> Element:
    root = Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    configuration = SubElement(root, "BuildConfiguration", {"modelIdentifier": name})
    files = SubElement(
        configuration, "SourceFileSet", {"language": "C++17", "compiler": "gcc", "compilerOptions": " ".join(flags)}
    )
    for file in compiled:
        SubElement(files, "SourceFile", {"name": file})
    SubElement(files, "IncludeDirectory", {"name": "."})
    return root
