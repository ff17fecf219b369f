"""sources/ of a native FMU, for hosts that compile FMUs themselves: C++ and the headers of FMI.

FMI 2.0 lists the files in modelDescription.xml, FMI 3.0 in sources/buildDescription.xml, with compiler options.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from ...toolchain.objects import FLAGS
from ...toolchain.sources import find_fmi_headers, find_native, list_fmu_parts
from .model_description import to_bytes

__all__ = ["list_compiled", "list_source_files", "read_fmi_licence"]

_FOLDER = "sources"
_BUILD = "buildDescription.xml"
_README = """C++17, to be compiled into one shared library with the headers of this folder and no other library:

    g++ -shared -fPIC {flags} -I. -o NAME.so {some} ...

Without -ffp-contract=off the numbers differ in their last digits between processors.
"""


def list_compiled() -> tuple[str, ...]:
    """Names of the files to be compiled, below sources/."""
    return tuple(file for part in list_fmu_parts() for file in part.files)


def list_source_files(name: str, fmi: int) -> dict[str, bytes]:
    """The files by their place in the FMU called `name`. Raises HostError when some are not installed."""
    native, compiled = find_native(), list_compiled()
    headers = [path for path in native.rglob("*.hpp") if path.relative_to(native).parts[0] != "collision"]
    files = {path.relative_to(native).as_posix(): path.read_bytes() for path in headers}
    files |= {file: (native / file).read_bytes() for file in compiled}
    files |= {path.name: path.read_bytes() for path in find_fmi_headers().glob("fmi[23]*.h")}
    files["README.txt"] = _README.format(flags=" ".join(FLAGS), some=" ".join(compiled[:2])).encode()
    if fmi == 3:
        files[_BUILD] = to_bytes(_describe_build(name, compiled))
    return {f"{_FOLDER}/{place}": content for place, content in files.items()}


def read_fmi_licence() -> str:
    """The licence of the headers of FMI, as they carry it."""
    text = Path(find_fmi_headers(), "fmi3Functions.h").read_text(encoding="utf-8")
    return text[text.index("Copyright (C)") : text.index("*/")].strip() + "\n"


def _describe_build(name: str, compiled: tuple[str, ...]) -> Element:
    root = Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    configuration = SubElement(root, "BuildConfiguration", {"modelIdentifier": name})
    files = SubElement(
        configuration, "SourceFileSet", {"language": "C++17", "compiler": "gcc", "compilerOptions": " ".join(FLAGS)}
    )
    for file in compiled:
        SubElement(files, "SourceFile", {"name": file})
    SubElement(files, "IncludeDirectory", {"name": "."})
    return root
