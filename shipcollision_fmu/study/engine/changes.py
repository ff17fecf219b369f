"""What has changed in a study since its folder was begun, for the line that refuses to go on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ... import __version__
from ...errors import StudyError
from ...ship.loading.toml import parse_toml
from .interface import Study

__all__ = ["describe_changes"]

MOST_NAMED = 3
"""Changes that the line names; the others it counts."""


def describe_changes(study: Study, found: Mapping[str, Any], folder: Path) -> str:
    """The changes against study.json (`found`) and study.toml of a folder, in words."""
    there = found["versions"].get("shipcollision_fmu") if isinstance(found.get("versions"), dict) else None
    if there != __version__:
        return f"it was begun by version {there} of shipcollision-fmu, this is {__version__}"
    changes = [*_list_changed_keys(study, folder), *_list_changed_inputs(study, found)]
    if changes and all(change.startswith("[study] rows (") for change in changes):
        return (
            f"rows = {study.rows} in place of {found['rows']}, and all rows of a latin-hypercube depend on their number"
        )
    if not changes:
        return f"it was begun by another build of version {__version__}"
    more = f" and {len(changes) - MOST_NAMED} more" if len(changes) > MOST_NAMED else ""
    return f"changed since: {', '.join(changes[:MOST_NAMED])}{more}"


def _list_changed_keys(study: Study, folder: Path) -> Iterator[str]:
    """Keys of the study file whose value is another one, each with both values. Comments and layout do not count."""
    try:
        text = (folder / "study.toml").read_text(encoding="utf-8")
        before = _flatten(parse_toml(text, "study.toml", StudyError))
    except (OSError, UnicodeDecodeError, StudyError):
        return
    now = _flatten(parse_toml(study.text, "the study file", StudyError))
    for key in dict.fromkeys((*before, *now)):
        if before.get(key) != now.get(key):
            table, _, name = key.rpartition(".")
            place = f"[{table}] {name}" if table else name
            yield f"{place} (was {_format(before, key)}, is {_format(now, key)})"


def _list_changed_inputs(study: Study, found: Mapping[str, Any]) -> Iterator[str]:
    before = found.get("inputs")
    for name, digest in study.inputs.items():
        if isinstance(before, dict) and before.get(name, digest) != digest:
            yield f"{name} (its content)"


def _flatten(table: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Values by dotted key; a distribution is one value."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict) and (not above or above == "tables"):
            flat |= _flatten(value, f"{above}.{key}" if above else key)
        else:
            flat[f"{above}.{key}" if above else key] = value
    return flat


def _format(values: Mapping[str, Any], key: str) -> str:
    text = str(values[key]) if key in values else "missing"
    return text if len(text) <= 60 else f"{text[:57]}..."
