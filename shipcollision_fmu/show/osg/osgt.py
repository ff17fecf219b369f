"""OpenSceneGraph's text format: objects as Python values, and their text.

OSG's serialisers (osgDB, since OSG 3.0) read and write `.osgt` files *in order*: they ignore a property that comes too
late, and refuse the properties after it. Each class here therefore has the order of its properties, base class first,
and an Item writes its properties in this order. A property that a class does not have is an error here; OSG would skip
the rest of the object silently.

    osg::Group {                          Item("osg::Group", Name=quote("fleet"), Children=[...])
      UniqueID 1
      Name "fleet"
      Children 1 { ... }
    }

An Item that occurs twice is written once; later occurrences refer to it by its UniqueID, and OSG shares the object.
Source of the orders: src/osgWrappers/serializers of OpenSceneGraph 3.6.5. OSG's world is z-up; zup.py converts.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from ...ship.frames import Array

__all__ = ["HEADER", "Item", "Raw", "format_document", "format_number", "format_numbers", "format_vectors", "quote"]

HEADER = "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\n"
"""Version 161 belongs to OSG 3.6: older viewers refuse it with a message, newer viewers read it."""

_OBJECT = ("Name", "DataVariance")
_NODE = (*_OBJECT, "UpdateCallback", "CullingActive", "NodeMask", "StateSet")
_GROUP = (*_NODE, "Children")
_ARRAY = ("Binding", "vector")
_EFFECT = (
    *_GROUP, "ParticleSystem", "TextureFileName", "Position", "Scale", "Intensity", "StartTime", "EmitterDuration",
)  # fmt: skip

ORDER: dict[str, tuple[str, ...]] = {
    "osg::Node": _NODE,
    "osg::Group": _GROUP,
    "osg::MatrixTransform": (*_GROUP, "Matrix"),
    "osg::Sequence": (*_GROUP, "TimeList", "Begin", "End", "Speed", "NumRepeats", "Mode", "Sync"),
    "osg::LightSource": (*_GROUP, "Light"),
    "osg::ClearNode": (*_GROUP, "RequiresClear", "ClearColor"),
    "osg::Geode": (*_NODE, "Drawables"),
    "osg::Geometry": (*_OBJECT, "StateSet", "PrimitiveSetList", "VertexArray", "NormalArray", "ColorArray"),
    "osg::DrawArrays": ("Mode", "First", "Count"),
    "osg::DrawElementsUInt": ("Mode", "vector"),
    "osg::Vec3Array": _ARRAY,
    "osg::Vec4Array": _ARRAY,
    "osg::StateSet": (*_OBJECT, "ModeList", "AttributeList", "RenderingHint", "RenderBinMode", "BinNumber", "BinName"),
    "osg::Material": ("ColorMode", "Ambient", "Diffuse", "Specular", "Shininess"),
    "osg::LineWidth": ("Width",),
    "osg::Light": ("LightNum", "Ambient", "Diffuse", "Specular", "Position"),
    "osg::AnimationPathCallback": ("AnimationPath",),
    "osg::AnimationPath": ("TimeControlPointMap", "LoopMode"),
    "osgParticle::ParticleSystem": (),
    "osgParticle::ExplosionEffect": _EFFECT,
    "osgParticle::ExplosionDebrisEffect": _EFFECT,
    "osgParticle::FireEffect": _EFFECT,
    "osgParticle::SmokeEffect": _EFFECT,
}
"""Properties of each class that is used here, in the order in which OSG reads them."""


class Item:
    """An object of OSG: its class and its properties, given in any order.

    A property is a Raw (words as they stand), another Item, or a list of Items. Raises KeyError for a class, and
    ValueError for a property, that ORDER does not have: a fault of the caller's.
    """

    def __init__(self, kind: str, **properties: Raw | Item | Sequence[Item]) -> None:
        order = ORDER[kind]
        unknown = properties.keys() - set(order)
        if unknown:
            raise ValueError(f"{kind} has no property {sorted(unknown)}")
        self.kind = kind
        self.properties = {name: properties[name] for name in order if name in properties}


class Raw(str):
    """Text that stands behind a property's name as it is; it may hold lines and Items between its words."""

    items: tuple[Item, ...]

    def __new__(cls, text: object, *items: Item) -> Raw:
        """`items` are the objects that the text's placeholders, one `{}` each, stand for."""
        raw = super().__new__(cls, text)
        raw.items = items
        return raw


def format_number(value: float) -> str:
    """A number to nine significant digits: a tenth of a millimetre at a hundred kilometres."""
    return f"{float(value):.9g}"


def format_numbers(values: Iterable[float]) -> Raw:
    """Numbers side by side, such as a vector."""
    return Raw(" ".join(format_number(value) for value in values))


def quote(text: str) -> Raw:
    """A string in quotation marks; its own marks and backslashes are escaped, control characters become spaces."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    return Raw('"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"')


def format_vectors(rows: Array) -> Raw:
    """Rows (n, k) as the property `vector` of an array; one row a line."""
    lines = "\n".join(" ".join(format_number(value) for value in row) for row in np.atleast_2d(rows).tolist())
    return Raw(f"{len(rows)} {{\n{lines}\n}}")


def format_document(root: Item) -> str:
    """Text of the file that holds `root`."""
    lines = _format_lines(root, {})
    depth, out = 0, []
    for line in lines:
        depth -= line.startswith("}")
        out.append("  " * depth + line)
        depth += line.endswith("{")
    return HEADER + "\n".join(out) + "\n"


def _format_lines(item: Item, seen: dict[int, int]) -> Iterator[str]:
    """Lines of an object, not yet indented. `seen`: UniqueIDs given so far, by Python's id of the Item."""
    yield f"{item.kind} {{"
    known = id(item) in seen
    yield f"UniqueID {seen.setdefault(id(item), len(seen) + 1)}"
    if not known:
        for name, value in item.properties.items():
            yield from _format_property(name, value, seen)
    yield "}"


def _format_property(name: str, value: Any, seen: dict[int, int]) -> Iterator[str]:
    if isinstance(value, Item):
        yield f"{name} TRUE {{"
        yield from _format_lines(value, seen)
        yield "}"
    elif isinstance(value, Raw):
        yield from _format_raw(f"{name} {value}", value.items, seen)
    else:
        yield f"{name} {len(value)} {{"
        for item in value:
            yield from _format_lines(item, seen)
        yield "}"


def _format_raw(text: str, items: tuple[Item, ...], seen: dict[int, int]) -> Iterator[str]:
    rest = iter(items)
    for line in text.splitlines():
        if line == "{}":
            yield from _format_lines(next(rest), seen)
        else:
            yield line
