"""The URI by which a host gives an FMU of FMI 2.0 the place of its resources, as the FMU's wrapper can read it.

FMI asks for a URI (RFC 3986): every character but letters, digits and a few others is percent-encoded. The wrapper of
pythonfmu decodes %20 alone, and a folder that it does not find ends the process. For its FMUs only spaces are encoded.
"""

from __future__ import annotations

from pathlib import Path

from ...errors import HostError

__all__ = ["locate_resources"]

_MARK = "slavemodule.txt"
"""A file among the resources of every FMU that pythonfmu made."""


def locate_resources(unpacked: Path) -> str:
    """URI of the resources of an FMU that is unpacked into an absolute folder.

    Raises HostError for a folder that the wrapper of pythonfmu cannot read, whatever the URI.
    """
    resources = unpacked / "resources"
    if not (resources / _MARK).is_file():
        return resources.as_uri()
    path = resources.as_posix()
    if "%20" in path:
        raise HostError(
            f"{unpacked}: an FMU cannot be loaded from a folder with %20 in its name, which its wrapper takes for a "
            "space: set the environment variable TMPDIR to another folder"
        )
    return f"file://{'' if path.startswith('/') else '/'}{path.replace(' ', '%20')}"
