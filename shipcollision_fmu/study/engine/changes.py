"""What has changed in a study since its folder was begun, for the line that refuses to go on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import Any

from ... import __version__
from ...errors import StudyError
from ...ship.loading.toml import parse_toml
from .interface import Study

__all__ = ["describe_changes"]

MOST_NAMED = 3
"""Changes that the line names; the others it counts."""
SHOWN = 57
"""Characters of a value that the line shows."""
MISSING = object()
"""Stands for the value of a key that is not there."""


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
        return f"it was begun by another build of version {__version__}, or its study.toml was edited"
    more = f" and {len(changes) - MOST_NAMED} more" if len(changes) > MOST_NAMED else ""
    return f"changed since: {', '.join(changes[:MOST_NAMED])}{more}"


def _list_changed_keys(study: Study, folder: Path) -> Iterator[str]:
    """Keys of the study file whose value is another one, each with both values. Comments and layout do not count."""
    try:
        text = (folder / "study.toml").read_text(encoding="utf-8")
        before = parse_toml(text, "study.toml", StudyError)
    except (OSError, UnicodeDecodeError, StudyError):
        return
    now = parse_toml(study.text, "the study file", StudyError)
    for key in dict.fromkeys((*before, *now)):
        values = before.get(key, MISSING), now.get(key, MISSING)
        place = f"[{key}]" if any(isinstance(value, dict) for value in values) else key
        for where, was, is_ in _compare(*values, place):
            yield f"{where} ({_describe(was, is_)})"


def _list_changed_inputs(study: Study, found: Mapping[str, Any]) -> Iterator[str]:
    before = found.get("inputs")
    for name, digest in study.inputs.items():
        if isinstance(before, dict) and before.get(name, digest) != digest:
            yield f"{name} (its content)"


def _compare(before: Any, now: Any, place: str) -> Iterator[tuple[str, Any, Any]]:
    """The innermost places with different values, as messages of a study file name them, each with both values."""
    if before == now:
        return
    if _is_table(place):
        before, now = ({} if value is MISSING else value for value in (before, now))
    if isinstance(before, dict) and isinstance(now, dict):
        for key in dict.fromkeys((*before, *now)):
            yield from _compare(before.get(key, MISSING), now.get(key, MISSING), _join(place, key))
    elif isinstance(before, list) and isinstance(now, list) and isinstance((before or now)[0], dict):
        for i, (was, is_) in enumerate(zip_longest(before, now, fillvalue=MISSING)):
            yield from _compare(was, is_, f"{place}[{i}]")
    else:
        yield place, before, now


def _is_table(place: str) -> bool:
    return place.endswith("]") and " " not in place


def _join(place: str, key: str) -> str:
    """ "[own] sampled[0].C_b" for the key C_b, "[tables.traffic]" for one of the tables."""
    if place == "[tables]":
        return f"[tables.{key}]"
    return f"{place} {key}" if _is_table(place) else f"{place}.{key}"


def _describe(was: Any, is_: Any) -> str:
    """Both values, shortened; long ones that begin alike from shortly before their difference."""
    before, now = ("missing" if value is MISSING else str(value) for value in (was, is_))
    if before[:SHOWN] == now[:SHOWN]:
        alike = next(
            (i for i, (a, b) in enumerate(zip(before, now, strict=False)) if a != b), min(len(before), len(now))
        )
        begin = max(alike - SHOWN // 3, 0)
        before, now = (f"...{text[begin:]}" for text in (before, now))
    return f"was {_shorten(before)}, is {_shorten(now)}"


def _shorten(text: str) -> str:
    return text if len(text) <= SHOWN + 3 else f"{text[:SHOWN]}..."
