"""Names of ships for people: a ship from a file has the name in its [ship] table."""

from __future__ import annotations

import re
from collections import Counter

from ..definition.fleet import NamedShip
from ..definition.study import Study

__all__ = ["name_ships"]

LABEL = re.compile(r"(?P<file>.*\.toml)(?P<loading> at \S+ T)?")
"""Of a ship from a file in the tables of a study: the file, and the draught as a share of the full one."""


def name_ships(study: Study) -> dict[str, str]:
    """Names by label of the ships from files, the file beside the name where two files have one name."""
    found: dict[str, tuple[str, str, str]] = {}
    for choice in (*study.own.choices, *study.target.choices):
        parts = LABEL.fullmatch(choice.label)
        if parts is not None and isinstance(choice, NamedShip) and not isinstance(choice.source, str):
            name = str(choice.source.get("ship", {}).get("name") or parts["file"])
            found[choice.label] = (name, parts["file"], parts["loading"] or "")
    files = Counter(name for name, _ in {(name, file) for name, file, _ in found.values()})
    return {
        label: (name if files[name] == 1 else f"{name} ({file})") + loading
        for label, (name, file, loading) in found.items()
    }
