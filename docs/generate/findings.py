"""The findings about wrong wiring, from the table in the collision model."""

from __future__ import annotations

from shipcollision_fmu.collision.findings import FINDINGS

from .markdown import cell, table

__all__ = ["findings"]

_HOLDERS = {
    "ship": "own", "other": "target", "moved": "A", "given": "B", "off": "C", "yaw": "A", "unit": "knots",
    "overlap": "A", "duration": "A", "share": "B", "mass": "C",
}  # fmt: skip
"""What stands for the values measured."""


class _Holder(str):
    """A placeholder that takes any format."""

    def __format__(self, _: str) -> str:
        return str(self)

    __slots__ = ()


def findings() -> str:
    """A row per finding: its code, what a user notices, the warning and the remedy."""
    holders = {name: _Holder(value) for name, value in _HOLDERS.items()}
    rows = [
        (str(code), cell(f.symptom), cell(f.message.format(**holders)), cell(f.remedy.format(**holders)))
        for code, f in FINDINGS.values()
    ]
    return table(("`diagnosis.code`", "symptom", "warning", "remedy"), rows)
