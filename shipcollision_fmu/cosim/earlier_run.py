"""Files that a run would replace: those of an earlier run may be, others are the user's.

The folder of a run has a summary.json with the version of this package in it (results/summary.py).
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from ..errors import HostError

__all__ = ["refuse_foreign_files"]

MOST_NAMED = 3
"""Files named in a refusal; more would break its one line."""


def refuse_foreign_files(out: Path, names: Iterable[str]) -> None:
    """Raise HostError when the folder `out` has files of these names and is not that of an earlier run."""
    there = [name for name in names if (out / name).exists()]
    if not there or _is_of_a_run(out / "summary.json"):
        return
    listed = ", ".join(there[:MOST_NAMED]) + (" and others" if len(there) > MOST_NAMED else "")
    raise HostError(
        f"{out} holds {listed} of other origin (no run of this program has its summary.json there): give another "
        "folder with --out, or replace what is there with --overwrite (overwrite=True in Python)"
    )


def _is_of_a_run(summary: Path) -> bool:
    try:
        content = json.loads(summary.read_bytes())
    except (OSError, ValueError):
        return False
    versions = content.get("versions") if isinstance(content, dict) else None
    return isinstance(versions, dict) and "shipcollision_fmu" in versions
