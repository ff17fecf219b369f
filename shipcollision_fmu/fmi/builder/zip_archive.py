"""A zip archive that depends on the names and contents of its files only.

Names are sorted; every entry has the same date, permissions by its kind, and the same method of compression. Hosts
compare FMUs by their digest, and a build that is repeated must give the same bytes.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping

__all__ = ["LIBRARIES", "zip_bytes"]

LIBRARIES = (".so", ".dll", ".dylib")
"""Files that the system loads as code: some systems refuse them without permission to execute."""

_ARCHIVES = (".fmu",)
"""Files that are compressed already, and are stored as they are."""
_DATE = (1980, 1, 1, 0, 0, 0)
"""The earliest that a zip archive can say."""


def zip_bytes(files: Mapping[str, bytes]) -> bytes:
    """The archive of these files, given by their names in it."""
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w") as archive:
        for name, data in sorted(files.items()):
            entry = zipfile.ZipInfo(name, _DATE)
            entry.create_system = 3  # Unix, also when made elsewhere
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(_ARCHIVES) else zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if name.endswith(LIBRARIES) else 0o100644) << 16
            archive.writestr(entry, data, compresslevel=9)
    return target.getvalue()
