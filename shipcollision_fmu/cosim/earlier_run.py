"""Files that a run would replace: those of an earlier run may be, others are the user's.

The folder of a run has a summary.json with the version of this package in it (results/summary.py).
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from ..files import refuse_other_origin

__all__ = ["refuse_foreign_files"]


def refuse_foreign_files(out: Path, names: Iterable[str]) -> None:
    """Raise HostError when the folder `out` has files of these names and is not that of an earlier run."""
    if not _is_of_a_run(out / "summary.json"):
        refuse_other_origin(out, names, "no run of this program has its summary.json there")


def _is_of_a_run(summary: Path) -> bool:
    try:
        content = json.loads(summary.read_bytes())
    except (OSError, ValueError):
        return False
    versions = content.get("versions") if isinstance(content, dict) else None
    return isinstance(versions, dict) and "shipcollision_fmu" in versions
