"""A ship model of somebody else in a package: its FMU, and how its variables are called.

    vessel.fmu     any FMU for co-simulation, FMI 2.0, or 3.0 with scalars, that gives its state and takes a force
    vessel.toml    beside it, where its variables are not called as those of ShipManoeuvring

    position = ["x", "y", ""]           # n: north, east, down [m]; "" for what the model does not have
    attitude = ["", "", "psi"]          # [rad]
    velocity = ["u", "v", ""]           # [m/s]
    rate = ["", "", "r"]                # [rad/s]
    force = ["X", "Y", ""]              # inputs [N]
    moment = ["", "", "N"]              # inputs about CO [N m]
    velocity_frame = "n"                # of velocity and rate; "b" when left out
    force_frame = "n"                   # of force and moment; "b" when left out
    [start]                             # start values by name
    psi_0 = 1.57

It is coupled by force, the one input that every vessel FMU has. Its mass and inertia must be those of the scenario's
ship file, from which the collision model takes them.
"""

from __future__ import annotations

import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ..cosim.component import Value
from ..errors import ScenarioError
from ..fmi.names import ATTITUDE, FORCE, MOMENT, POSITION, RATE, VELOCITY
from ..fmi.variables import Kind
from ..ship.loading.toml import read_toml

__all__ = ["ForeignShip", "read_foreign_ship"]

GROUPS: Mapping[str, tuple[str, Sequence[str], frozenset[str]]] = {
    "position": ("output", POSITION, frozenset({"m"})),
    "attitude": ("output", ATTITUDE, frozenset({"rad"})),
    "velocity": ("output", VELOCITY, frozenset({"m/s", "m.s-1"})),
    "rate": ("output", RATE, frozenset({"rad/s", "rad.s-1"})),
    "force": ("input", FORCE, frozenset({"N"})),
    "moment": ("input", MOMENT, frozenset({"N.m", "N*m", "Nm", "N m"})),
}
"""Causality, names of ShipManoeuvring and spellings of the unit, by key."""
_NEEDED = {*POSITION[:2], ATTITUDE[2], *VELOCITY[:2], RATE[2], *FORCE[:2], MOMENT[2]}
"""What a ship in the plane has."""
_FRAMES = ("velocity_frame", "force_frame")
_KINDS: Mapping[str, Kind] = {
    "Real": "Real", "Float64": "Real", "Integer": "Integer", "Int32": "Integer", "Boolean": "Boolean",
    "String": "String",
}  # fmt: skip
_TYPES: Mapping[Kind, tuple[tuple[type, ...], str]] = {
    "Real": ((int, float), "a number"), "Integer": ((int,), "a whole number"), "Boolean": ((bool,), "true or false"),
    "String": ((str,), "text in quotes"),
}  # fmt: skip
"""Types of a start value in TOML, by kind of the variable."""


@dataclass(frozen=True)
class _Known:
    kind: Kind
    causality: str
    unit: str
    has_start: bool


@dataclass(frozen=True)
class ForeignShip:
    """An FMU and its wiring. names: its variable for each of ShipManoeuvring's, of those that it has; start: start
    values with the kind of their variable."""

    file: Path
    data: bytes
    description: str
    names: Mapping[str, str]
    velocity_frame: str
    force_frame: str
    start: Mapping[str, tuple[Kind, Value]]


def read_foreign_ship(file: Path) -> ForeignShip:
    """The FMU at `file`, wired as the TOML file beside it says. Raises ScenarioError with what does not fit."""
    if not file.is_file():
        raise ScenarioError(
            f"--replace: {file} {'is a folder' if file.is_dir() else 'does not exist'}: give a .fmu file"
        )
    try:
        data = file.read_bytes()
        with zipfile.ZipFile(file) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    except (OSError, KeyError, zipfile.BadZipFile, ElementTree.ParseError) as error:
        raise ScenarioError(f"--replace: {file} is no FMU that can be read ({error}): give a .fmu file") from None
    if root.find("CoSimulation") is None:
        raise ScenarioError(f"--replace: {file.name} is not for co-simulation: export it for co-simulation")
    known = _list_variables(root)
    said = _read_wiring(file.with_suffix(".toml"))
    names: dict[str, str] = {}
    for key, (causality, ours, units) in GROUPS.items():
        for our, theirs in zip(ours, said.get(key, ours), strict=True):
            if theirs in known or our in _NEEDED or (key in said and theirs):
                names[our] = _check(file, our, theirs, known, causality, units)
    start = said.get("start", {})
    for name, value in start.items():
        _check_start(file, name, value, known)
    return ForeignShip(
        file, data, root.get("description", ""), names, said.get("velocity_frame", "b"), said.get("force_frame", "b"),
        {name: (known[name].kind, value) for name, value in start.items()},
    )  # fmt: skip


def _list_variables(root: ElementTree.Element) -> dict[str, _Known]:
    """Scalar variables of FMI 2.0 and 3.0 by name."""
    found: dict[str, _Known] = {}
    for node in root.iterfind("ModelVariables/*"):
        typed = node[0] if node.tag == "ScalarVariable" else node
        kind = _KINDS.get(typed.tag)
        if kind is not None and typed.find("Dimension") is None:
            name, causality = str(node.get("name")), node.get("causality", "local")
            found[name] = _Known(kind, causality, typed.get("unit", ""), "start" in typed.attrib)
    return found


def _read_wiring(file: Path) -> dict[str, Any]:
    """The keys of the TOML file, checked one by one; nothing when there is no file."""
    if not file.is_file():
        return {}
    said = read_toml(file, ScenarioError)
    for key, value in said.items():
        if key in GROUPS:
            fine = isinstance(value, list) and len(value) == 3 and all(isinstance(name, str) for name in value)
            limit = 'three names, "" for what the model does not have'
        elif key in _FRAMES:
            fine, limit = value in ("b", "n"), '"b" or "n"'
        elif key == "start":
            fine, limit = isinstance(value, dict), "a table of start values"
        else:
            keys = ", ".join((*GROUPS, *_FRAMES, "start"))
            raise ScenarioError(f"--replace: {file.name}: unknown key {key}: known are {keys}")
        if not fine:
            raise ScenarioError(f"--replace: {file.name}: {key} = {value!r} must be {limit}")
    return said


def _check(
    file: Path, our: str, theirs: str, known: Mapping[str, _Known], causality: str, units: frozenset[str]
) -> str:
    """The name of a variable that fits."""
    found = known.get(theirs)
    if not theirs:
        parts = ", ".join(sorted(_NEEDED, key=[*chain(*(names for _, names, _ in GROUPS.values()))].index))
        raise ScenarioError(
            f'--replace: {file.with_suffix(".toml").name} has "" for {our}, which is required: {file.name} must have '
            f'{parts}; only the others may be ""'
        )
    if found is None or found.kind != "Real" or found.causality != causality:
        fitting = [name for name, one in known.items() if one.kind == "Real" and one.causality == causality]
        raise ScenarioError(
            f"--replace: {file.name} has no real {causality} {theirs!r} for {our}: name it in "
            f"{file.with_suffix('.toml').name} beside the FMU; {_list(fitting, f'real {causality}')}"
        )
    if found.unit and found.unit not in units:
        raise ScenarioError(
            f"--replace: {theirs} of {file.name} is in {found.unit}, {our} in {min(units, key=len)}: convert it in the "
            "model, since a package has no place for that"
        )
    return theirs


def _check_start(file: Path, name: str, value: object, known: Mapping[str, _Known]) -> None:
    """Refuse a start value of a variable that is not there, or of another type."""
    if name not in known:
        if name in GROUPS or name in _FRAMES:
            raise ScenarioError(
                f"--replace: [start] {name}: {name} is no start value: it belongs above the line [start] of "
                f"{file.with_suffix('.toml').name}"
            )
        settable = [
            other for other, one in known.items()
            if one.causality == "parameter" or (one.causality == "input" and one.has_start)
        ]  # fmt: skip
        raise ScenarioError(
            f"--replace: [start] {name}: {file.name} has no such variable; {_list(settable, 'parameter')}"
        )
    types, said = _TYPES[known[name].kind]
    if not isinstance(value, types) or (isinstance(value, bool) and bool not in types):
        raise ScenarioError(f"--replace: [start] {name} = {value!r} must be {said}, as in {file.name}")


def _list(names: Sequence[str], what: str) -> str:
    if not names:
        return f"it has no {what}"
    return "it has " + ", ".join(names[:20]) + (f" and {len(names) - 20} more" if len(names) > 20 else "")
