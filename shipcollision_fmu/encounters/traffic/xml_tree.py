"""parse_xml(): a foreign XML file as plain lists and dicts, without the parts of XML that can harm.

Python's own parser (expat) is enough for elements, attributes and text. A document type declaration is refused,
and with it entities, whose expansion fills the memory, and references to other files.
"""

from __future__ import annotations

from typing import Any
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from ...errors import ScenarioError

__all__ = ["parse_xml"]

DEEPEST = 40
"""Levels of elements; CommonOcean has ten. More would exhaust the stack."""


def parse_xml(content: bytes, file: str) -> tuple[str, dict[str, Any]]:
    """Name and content of the root element.

    An element with elements or attributes is a dict: of lists of its elements by name, and of its attributes. Another
    one is its text. Raises ScenarioError for content that is not XML, or has a document type declaration.
    """
    builder, parser, depth = TreeBuilder(), expat.ParserCreate(), 0

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > DEEPEST:
            raise ScenarioError(f"{file}: elements are nested more than {DEEPEST} deep: give a CommonOcean scenario")
        builder.start(name, attributes)

    def end(name: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(name)

    def refuse(*_: object) -> None:
        raise ScenarioError(f"{file}: has a document type declaration (<!DOCTYPE>), which is not read: remove it")

    parser.buffer_text = True
    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, builder.data
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(content, True)
    except (expat.ExpatError, ValueError, LookupError) as error:
        raise ScenarioError(f"{file}: is not valid XML: {error}") from None
    root = builder.close()
    converted = _convert(root)
    return root.tag, converted if isinstance(converted, dict) else {}


def _convert(element: Element) -> dict[str, Any] | str:
    if not len(element) and not element.attrib:
        return " ".join((element.text or "").split())
    table: dict[str, Any] = {key: " ".join(value.split()) for key, value in element.attrib.items()}
    for below in element:
        entry = table.setdefault(below.tag, [])
        if isinstance(entry, list):
            entry.append(_convert(below))
    return table
