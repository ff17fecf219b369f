"""Words that have left the house: no module, class, function, argument or variable of the package is called by them.

Each had two or more meanings, or was a riddle to whoever had not been told (docs/glossary.md has the words in use). The
names of the FMUs' variables, of files in a run's folder and of keys in TOML files are a contract, and not looked at.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import shipcollision_fmu

PACKAGE = Path(shipcollision_fmu.__file__).parent

MODULES = {
    "ahead": "coasting", "aim": "targeting", "apart": "initial_overlap", "books": "impulse_ledger", "drift":
    "other_forces", "engine": "bullet", "joined": "compound_hull", "level": "plan_overlap", "ports": "interface",
    "sailing": "mmg", "shadow": "body_state", "slots": "contact_points", "spatial": "mmg_6dof", "touching":
    "plan_contact", "tracks": "approach_track", "uncarried": "left_out", "wanted": "request",
}  # fmt: skip
"""Names of files, and what they are called now."""

CLASSES = {
    "Books": "ImpulseLedger", "Coming": "Approach", "Drift": "OtherForces", "Found": "Hit", "Seen": "ReceivedState",
    "Shadow": "BodyState", "Slot": "ContactPoint", "Wanted": "Request",
}  # fmt: skip

WORDS = {
    "aimed": "a verb",
    "books": "ledger, balance or energy",
    "delivered": "applied_n",
    "late": "one_step_delay, pending_substeps or time_error",
    "meant": "issued_n",
    "owed": "deficit",
    "restless": "out_of_range",
    "shadow": "body state",
    "shadows": "body states",
    "struck": "a noun",
    "uncarried": "left out",
    "wanted": "request",
}
"""Words inside of names, and what to use."""

BARE = {"drift": "other_forces, drift_angle or drift_speed", "settled": "is_settled"}
"""Words that say something only together with another."""


def words(name: str) -> list[str]:
    """The words of a name: "nuReceived" and "nu_received" are nu, received."""
    return [word.lower() for word in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name)]


def names(text: str) -> Iterator[tuple[int, str, bool]]:
    """Line and name of all that a text defines, and whether it is a class."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ClassDef):
            yield node.lineno, node.name, True
        elif isinstance(node, ast.FunctionDef):
            yield node.lineno, node.name, False
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg, False
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id, False
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.attr, False


def retired(text: str) -> list[str]:
    """The retired names in a text, each with its line and what to use."""
    found = []
    for line, name, is_class in sorted(set(names(text))):
        if is_class and name.strip("_") in CLASSES:
            found.append(f"{line}: {name}: use {CLASSES[name.strip('_')]}")
        found += [f"{line}: {name}: use {WORDS[word]}" for word in words(name) if word in WORDS]
        if name.strip("_") in BARE:
            found.append(f"{line}: {name}: use {BARE[name.strip('_')]}")
    return found


SOURCES = sorted(PACKAGE.rglob("*.py"))


def test_no_file_has_a_retired_name() -> None:
    assert [path.name for path in SOURCES if path.stem in MODULES] == []


@pytest.mark.parametrize("path", SOURCES, ids=[str(path.relative_to(PACKAGE)) for path in SOURCES])
def test_no_name_is_retired(path: Path) -> None:
    assert retired(path.read_text(encoding="utf-8")) == []


def test_retired_names_are_found() -> None:
    text = "class Shadow:\n    def late(self, owed_n): self._wantedNow = drift = 1\n    drift_angle = is_settled = 0\n"
    found = [line.split(": ")[1] for line in retired(text)]
    assert found == ["Shadow", "Shadow", "_wantedNow", "drift", "late", "owed_n"]
