"""Tables of keys from a JSON schema: pydantic's of ship and scenario files, and the shipped one of events.json.

A section of the page is an object of the schema. Its heading is the place of the object in the file: `ships.NAME` for a
table with a name of the user's, `ships.NAME.orders[]` for an element of a list.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from importlib.resources import files
from typing import Any

import shipcollision_fmu
from shipcollision_fmu.scenario.scenario import Scenario
from shipcollision_fmu.ship.loading.ship_file import ShipFile

from .markdown import anchored, cell, plain, table
from .variables import collision_starts

__all__ = ["events", "scenario_file", "ship_file"]

Schema = Mapping[str, Any]

UNITS = frozenset({
    "1/rad", "1/s", "1/s2", "J", "N", "N m s", "N s", "N s/m", "N/m", "deg", "deg/deg", "deg/s", "kg", "kg m", "kg m2",
    "kg/m3", "m", "m/s", "m2", "m3", "rad", "rad/s", "rev/s", "s",
})  # fmt: skip
"""What is a unit in the brackets of a description; other brackets are lists."""

_START = "start of the FMU"
"""Beside the words of JSON schema: what the FMU starts with where the file has no value."""
_BRACKETS = re.compile(r" ?\[([^\[\]]+)\]")
_DERIVATIVE = re.compile(r"([XYN])_([vr]+)")
_WORDS = {"number": "number", "integer": "whole number", "string": "text", "boolean": "true or false"}


def ship_file() -> str:
    """Every key of a ship file."""
    return _pages(ShipFile.model_json_schema(), "## Tables of the file")


def scenario_file() -> str:
    """Every key of a scenario file. The default of a key of [collision] is the start value of the FMU's parameter."""
    root = Scenario.model_json_schema()
    keys = root["$defs"]["Collision"]["properties"]
    for name, value in collision_starts().items():
        if name in keys:
            keys[name][_START] = value
    return _pages(root, "## Tables of the file")


def events() -> str:
    """Every key of events.json."""
    text = files(shipcollision_fmu).joinpath("results", "events.schema.json").read_text(encoding="utf-8")
    return _pages(json.loads(text), "## events.json", level=3)


def _pages(root: Schema, heading: str, level: int = 2) -> str:
    """A section under `heading` for the whole, and one of that level for every object in it."""
    parts = []
    for place, schema in _objects("", root, root):
        own = f"{'#' * level} `{place}` {{ #{_anchor(place)} }}" if place else heading
        parts.append(f"{own}\n\n{_section(place, schema, root)}")
    return "\n".join(parts)


def _objects(place: str, schema: Schema, root: Schema) -> Iterator[tuple[str, Schema]]:
    """Every object of the schema with its place, those within an object after it."""
    if "properties" in schema:
        yield place, schema
        for key, value in schema["properties"].items():
            inner = _resolved(value, root)
            yield from _objects(f"{place}.{key}" if place else key, inner, root)
    elif "anyOf" in schema:
        for option in schema["anyOf"]:
            yield from _objects(place, _resolved(option, root), root)
    elif isinstance(schema.get("additionalProperties"), Mapping):
        yield from _objects(f"{place}.NAME", _resolved(schema["additionalProperties"], root), root)
    elif isinstance(schema.get("items"), Mapping):
        yield from _objects(f"{place}[]", _resolved(schema["items"], root), root)


def _section(place: str, schema: Schema, root: Schema) -> str:
    required = schema.get("required", ())
    rows = [_row(place, key, value, key in required, root) for key, value in schema["properties"].items()]
    return f"{plain(_said(schema))}\n\n{table(('key', 'type', 'unit', 'limits', 'default', 'meaning'), rows)}"


def _row(place: str, key: str, value: Schema, required: bool, root: Schema) -> tuple[str, ...]:
    path = f"{place}.{key}" if place else key
    schema = _resolved(value, root)
    meaning, unit = _meaning(key, value.get("description", ""), schema)
    default = "required" if required else _default(value.get("default"))
    default = value.get("without", default)
    if _START in value:
        default = f"`{value[_START]}` (of the FMU)"
    return anchored(key, path), cell(_type(schema, root, path)), unit, cell(_limits(schema)), default, cell(meaning)


def _resolved(schema: Schema, root: Schema) -> Schema:
    """The schema behind references and behind `or nothing`, with what stands beside a reference."""
    if "$ref" in schema:
        target: Any = root
        for part in schema["$ref"].removeprefix("#/").split("/"):
            target = target[part]
        return {**_resolved(target, root), **{k: v for k, v in schema.items() if k not in ("$ref", "description")}}
    if "anyOf" in schema:
        options = [option for option in schema["anyOf"] if option.get("type") != "null"]
        if len(options) == 1:
            return _resolved(options[0], root)
    return schema


def _meaning(key: str, description: str, schema: Schema) -> tuple[str, str]:
    """What a description says, and the unit in it."""
    if found := _DERIVATIVE.fullmatch(key):
        powers = " ".join(f"{name}'" for name in found[2])
        return f"hull derivative of {found[1]}' by {powers}", "1"
    said = description or _said(schema).rstrip(".")
    units = [found for found in _BRACKETS.finditer(said) if set(found[1].split(", ")) <= UNITS]
    if not units:
        return said, ""
    last = units[-1]
    rest = (said[: last.start()] + said[last.end() :]).strip() if len(units) == 1 else said
    return rest, last[1]


def _type(schema: Schema, root: Schema, place: str) -> str:
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return "one of " + ", ".join(f"`{json.dumps(item)}`" for item in schema["enum"])
    if "anyOf" in schema:
        return " or ".join(_type(_resolved(option, root), root, place) for option in schema["anyOf"])
    if "properties" in schema:
        return f"[table](#{_anchor(place)})"
    kind = schema["type"]
    if isinstance(kind, list):
        return " or ".join(_WORDS.get(one, one) for one in kind)
    if kind == "array":
        return f"list{_size(schema)} of {_plural(_type(_resolved(schema['items'], root), root, f'{place}[]'))}"
    if kind == "object":
        inner = _resolved(schema["additionalProperties"], root)
        names = schema.get("propertyNames", {}).get("enum", ())
        by = f"by {', '.join(names)}" if names else "by name"
        return f"{_plural(_type(inner, root, f'{place}.NAME'))} {by}"
    return _WORDS[kind]


def _plural(word: str) -> str:
    for one in ("number", "table"):
        word = word.replace(f"[{one}]", f"[{one}s]") if word.startswith("[") else word
    return f"{word}s" if word.endswith("number") else word


def _size(schema: Schema) -> str:
    least, most = schema.get("minItems"), schema.get("maxItems")
    if least == most:
        return "" if least is None else f" ({least})"
    return f" ({least} or more)" if most is None else f" ({least or 0} to {most})"


def _limits(schema: Schema) -> str:
    signs = {"exclusiveMinimum": ">", "minimum": "≥", "exclusiveMaximum": "<", "maximum": "≤"}
    return ", ".join(f"{sign} {schema[key]:g}" for key, sign in signs.items() if key in schema)


def _default(value: Any) -> str:
    return "" if value is None or isinstance(value, dict) or value == "" else f"`{json.dumps(value)}`"


def _said(schema: Schema) -> str:
    """What the schema says of itself: its first paragraph, without the name of the table that some begin with."""
    first = " ".join(schema.get("description", "").split("\n\n")[0].split())
    said = re.sub(r"^(\[[\w.]+\]|[a-z]+)( = \{.*?\})?: ", "", first)
    code = re.match(r"\w+ = \{.*?\}", said)
    return f"`{code[0]}`{said[code.end() :]}" if code else said[:1].upper() + said[1:]


def _anchor(place: str) -> str:
    """What links to the section of an object."""
    return f"table-{place.replace('[]', '')}"
